"""Every way to a monitor is one way: what it says live it says over the recording too."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.cli.main import main
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.record.reading import read_run
from beardyn_core.record.sinks import MemorySink
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.study import desk_run
from beardyn_core.study.monitored_recording import EXIT_CODES, HOT_BOX, MonitoredRecording, findings_of
from beardyn_core.study.trial import results_over
from test.face.test_one_run import hot, spalled

SETTINGS = MonitorSettings(interval=0.1, least_revolutions=2.0)


def monitor_of(scene: Scene) -> Monitor:
    return Monitor(fault_frequencies(scene.bearing), scene.bearing.roller_count, settings=SETTINGS)


def test_a_hot_box_is_called_beside_the_run_over_its_recording_and_in_a_trial(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, path = replace(hot(), duration=1.2), tmp_path / "hot.mcap"
    beside = MonitoredRecording(path, scene.bearing)
    desk_run.run(scene, [beside])
    in_trial, status = results_over(scene, monitor_of(scene))
    assert status == "complete"
    recorded = findings_of(read_run(path), scene.bearing)
    for found in (beside.findings, recorded, in_trial):
        assert found[-1].verdict == HOT_BOX, found[-1].reason
        assert found[-1].temperature > 400.0
    assert main(["monitor", str(path), "--json"]) == EXIT_CODES[HOT_BOX]
    said = json.loads(capsys.readouterr().out)
    assert said["verdict"] == HOT_BOX
    assert bd.monitor(bd.read(path)).verdict == HOT_BOX


def test_run_and_blocks_feed_a_monitor_with_the_same_signals() -> None:
    scene, memory = replace(spalled(), duration=1.2), MemorySink()  # long enough for a verdict that is clear
    desk_run.run(scene, [memory])
    live = list(run_monitor(monitor_of(scene), map(MonitorInput.of_block, blocks(scene))))
    later = list(run_monitor(monitor_of(scene), memory.to_run().monitor_inputs()))
    # the blocks of a run end where its filters let them, the parts of a recording every 512 samples: what is
    # hardly seen in one may be seen in the other, and then the verdicts are the same
    verdicts = [[each.verdict for each in received] for received in (live, later)]
    assert verdicts[0][-1] == verdicts[1][-1] == "cup"
    assert sum(one != other for one, other in zip(*verdicts, strict=True)) <= 1
    ends = np.array([[each.end_ns, other.end_ns] for each, other in zip(live, later, strict=True)])
    assert (np.abs(np.diff(ends)) < 20_000_000).all()
    np.testing.assert_allclose([each.load for each in later], [each.load for each in live], rtol=0.02)


def test_no_sample_is_left_out_or_given_twice() -> None:
    memory = MemorySink()
    desk_run.run(spalled(), [memory])
    run = memory.to_run()
    parts = list(run.monitor_inputs())
    joined = np.concatenate([part.vibration_time_ns for part in parts])
    np.testing.assert_array_equal(joined, run.vibration.time_ns)
    angle = np.concatenate([part.shaft_angle for part in parts])
    np.testing.assert_array_equal(angle, run.shaft.angle[: len(angle)])
    assert len(run.shaft) - len(angle) <= 1  # a shaft sample after the last vibration is not known yet
