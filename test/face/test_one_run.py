"""One run, the same from memory, from its file and from its blocks."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.effects import Thermal
from beardyn_core.record.arrays import Timed
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.record.sinks import McapSink, MemorySink
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.summary import RunSummary
from beardyn_core.study import desk_run
from test.effects.test_thermal import warming_scene

ARRAYS = (
    *("force", "force_waveform", "vibration", "specific_force", "shaft", "torque", "cages", "rollers"),
    *("bodies", "contacts", "load", "temperature"),
)
# columns of clouds are float32 on the wire, small messages float64
SINGLE = {"force_waveform", "vibration", "bodies", "contacts"}


@dataclass(frozen=True)
class Both:
    """A run in memory and the recording of the same run."""

    memory: Run
    file: Run
    summary: RunSummary


def spalled() -> Scene:
    return load_scene("cup_spall", tier="quasistatic", duration=0.5)


def hot() -> Scene:
    """An axlebox at 130 degrees Celsius that cools slowly."""
    return replace(warming_scene(Thermal(time_scale=10.0)), temperature=403.15, duration=0.6)


def run_both(scene: Scene, path: Path) -> Both:
    memory = MemorySink()
    summary = desk_run.run(scene, [memory, McapSink(path)])
    return Both(memory.to_run(lambda: summary), read_run(path), summary)


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> Both:
    return run_both(spalled(), tmp_path_factory.mktemp("one_run") / "run.mcap")


@pytest.fixture(scope="module")
def heated(tmp_path_factory: pytest.TempPathFactory) -> Both:
    return run_both(hot(), tmp_path_factory.mktemp("hot_run") / "run.mcap")


@pytest.mark.parametrize("name", ARRAYS)
def test_memory_and_file_hold_the_same_arrays(both: Both, heated: Both, name: str) -> None:
    found = heated if name == "temperature" else both
    one, two = getattr(found.memory, name), getattr(found.file, name)
    assert isinstance(one, Timed)
    assert type(one) is type(two)
    assert len(one) > 0
    for field in fields(one):
        mine, recorded = getattr(one, field.name), getattr(two, field.name)
        if not isinstance(mine, np.ndarray):
            assert mine == recorded
            continue
        assert mine.shape == recorded.shape, field.name
        assert mine.dtype == recorded.dtype, field.name
        if mine.dtype != np.float64:
            np.testing.assert_array_equal(recorded, mine)
        elif name in SINGLE:
            np.testing.assert_array_equal(recorded, mine.astype(np.float32).astype(np.float64))
        else:  # temperature is in degrees Celsius on the wire: a last bit may differ
            np.testing.assert_allclose(recorded, mine, rtol=1e-14 if name == "temperature" else 0.0)


def test_the_temperature_of_every_part_is_kept(heated: Both) -> None:
    for run in (heated.memory, heated.file):
        assert run.temperature.values.shape == (3, 6)
        assert (run.temperature.values > 400.0).all()
        assert dict(run.summary.temperatures)["axlebox"] > 400.0


def test_the_shapes_are_those_of_the_documentation(both: Both) -> None:
    for run in (both.memory, both.file):
        rollers = run.described().roller_count
        assert run.rollers.speed.shape == (len(run.rollers), 2, rollers)
        assert run.cages.angle.shape == (len(run.cages), 2)
        assert run.contacts.force.shape == (len(run.contacts), 2, rollers, 4, 3)
        assert run.torque.values.shape == run.torque.time.shape
        assert run.bodies.pose.shape == (len(run.bodies), 4 + 2 * rollers, 7)
        assert run.temperature.components[-1] == "axlebox"
        assert run.vibration.rate == 25_600.0
        assert (run.force.rate, run.torque.rate, run.contacts.rate) == (400.0, 200.0, 200.0)
        assert list(run.sensors) == ["axlebox_top"]
        assert run.load.wrench.shape == (len(run.load), 6)


def test_truth_and_status_are_the_same(both: Both) -> None:
    assert both.memory.truth == both.file.truth
    assert both.memory.labels == both.file.labels
    assert both.memory.status == both.file.status == "complete"
    assert both.memory.scene_text == both.file.scene_text
    assert both.memory.described().load is not None
    assert both.memory.diagnostics == both.file.diagnostics


def test_truth_holds_what_a_learner_needs(both: Both) -> None:
    truth, load = both.file.truth, both.file.load
    assert truth["condition"] == "cup"
    assert truth["load"]["fz_N"]["max"] == load.wrench[:, 2].max()
    assert truth["load"]["fz_N"]["min"] < truth["load"]["fz_N"]["mean"] < truth["load"]["fz_N"]["max"]
    assert truth["speed"]["kmh"]["mean"] == pytest.approx(200.0, rel=1e-6)
    assert truth["speed"]["rpm"]["mean"] == pytest.approx(200.0 / 3.6 / 0.46 * 30.0 / np.pi, rel=1e-6)
    hertz = truth["speed"]["rpm"]["mean"] / 60.0
    assert truth["fault_frequencies_Hz"]["BPFO"] == truth["fault_frequencies_per_rev"]["BPFO"] * hertz
    assert truth["geometry"]["roller_count"] == 17
    assert truth["end_play_m"] == pytest.approx(1e-4)
    assert truth["temperature_K"] == pytest.approx(343.15)
    assert truth["sampling_rate_Hz"]["vibration"] == {"axlebox_top": 25_600.0}
    row = both.file.labels
    assert row["fault_width_m"] == pytest.approx(6e-3)
    assert row["load_fz_N_mean"] == truth["load"]["fz_N"]["mean"]
    assert all(isinstance(value, str | int | float | bool | None) for value in row.values())


def test_labels_of_the_file_stand_in_the_recording_itself(both: Both) -> None:
    recorded = both.file.described().truth
    for key in ("load", "speed", "fault_frequencies_Hz"):
        assert recorded[key] == both.file.truth[key]


def test_the_summary_of_a_file_is_that_of_the_run(both: Both) -> None:
    told, made = both.summary, both.file.summary
    assert both.memory.summary is told
    for name in (
        "scene",
        "tier",
        "effects",
        "not_in_tier",
        "faults",
        "status",
        "cage_revolutions",
    ):
        assert getattr(made, name) == getattr(told, name), name
    assert made.averaged == pytest.approx(told.averaged, rel=2e-4)  # cages turn unevenly on waves
    assert made.mean_force == pytest.approx(told.mean_force, rel=1e-5, abs=0.1)
    torque = both.memory.torque.values
    doubt = float(np.std(torque)) / np.sqrt(len(torque))  # of a mean of 200 Hz of 400
    assert made.shaft_torque == pytest.approx(told.shaft_torque, abs=doubt)
    assert doubt < 0.05 * abs(told.shaft_torque)
    assert made.cage_speed_ratio == pytest.approx(told.cage_speed_ratio, rel=2e-3)  # the same
    assert made.duration == told.duration
    assert made.life is not None
    assert told.life is not None
    assert made.life.reference_basic == pytest.approx(told.life.reference_basic, rel=1e-6)


def test_a_run_of_live_blocks_has_the_same_arrays(both: Both) -> None:
    live = Run.of_blocks(blocks(spalled(), duration=0.1))
    count = len(live.vibration)
    np.testing.assert_array_equal(live.vibration.values, both.memory.vibration.values[:count])
    np.testing.assert_array_equal(live.rollers.speed, both.memory.rollers.speed[: len(live.rollers)])
    assert live.bodies.names == both.memory.bodies.names
    assert live.truth == {}
    np.testing.assert_array_equal(live.load.wrench[:, 2] > 0.0, True)


def test_without_contact_force_is_zero_and_the_rest_is_not_a_number(both: Both) -> None:
    contacts = both.file.contacts
    gone = ~contacts.touching
    assert gone.any()
    assert contacts.touching.any()
    assert not contacts.force[gone].any()
    assert np.isnan(contacts.slip[gone]).all()
    assert (contacts.load[contacts.touching] > 0.0).all()


def test_a_run_without_blocks_has_arrays_without_samples() -> None:
    run = Run.of_blocks([])
    for name in ARRAYS:
        assert len(getattr(run, name)) == 0, name
    with pytest.raises(InputError, match="does not name its bearing"):
        _ = run.summary


def test_a_run_is_two_lines_of_text(both: Both) -> None:
    for run in (both.memory, both.file):
        assert len(repr(run).splitlines()) <= 3
        assert "cup_spall" in repr(run)
    for name in ARRAYS:
        assert len(repr(getattr(both.memory, name))) < 120
