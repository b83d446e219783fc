"""A desk run feeds and closes its sinks, and its means are taken over whole cage revolutions."""

from __future__ import annotations

import math
import signal
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core import run
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.cli import simulate
from beardyn_core.record.sinks import MemorySink
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.operation import MeasuredOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.sensors.stage_clock import StageClock
from beardyn_core.sensors.summary import SETTLING_S, averaging_start, time_mean
from beardyn_core.study import desk_run
from test.record.synthetic_run import BLOCK_NS, SyntheticRun, body_names

SHAFT_SPEED = 122.0
SENTENCE = "the penetration left its range at 0.06 s; use a smaller load"


class PureRolling:
    """The part of a twin that a desk run uses; leaves its validity or is interrupted when told to."""

    block_ns = BLOCK_NS
    blocks_at_once = 1
    invalid_at: int | None = None
    interrupted_at: int | None = None

    def __init__(self, scene: Scene) -> None:
        self.body_names = body_names(scene.bearing.roller_count)
        self._run = SyntheticRun(SHAFT_SPEED)
        self.stages = StageClock()
        self._index = 0

    def warm(self) -> None:
        self.warmed = True

    def start(self, load: LoadHistory) -> None:
        assert self.warmed
        self._load = load

    def truth(self) -> dict[str, Any]:
        return {"scene": "static_80kN"}

    def advance(self, blocks: int = 1) -> Block:
        assert blocks == 1
        block = self._run.block(self._index)
        assert self._load.time_ns[-1] >= block.end_ns
        if self._index == self.interrupted_at:
            raise KeyboardInterrupt
        if self._index == self.invalid_at:
            raise ValidityError(SENTENCE, replace(block, status=4))
        self._index += 1
        return block


@pytest.fixture
def rolling(monkeypatch: pytest.MonkeyPatch) -> type[PureRolling]:
    twin = type("Twin", (PureRolling,), {})
    monkeypatch.setattr(run, "Twin", twin)
    return twin


def test_every_block_reaches_every_sink(rolling: type[PureRolling]) -> None:
    first, second = MemorySink(), MemorySink()
    seen: list[Block] = []
    summary = desk_run.run(load_scene("static_80kN", duration=0.5), [first, second], seen.append)
    assert [block.index for block in first.blocks] == list(range(25))
    assert second.blocks == first.blocks == seen
    assert first.status == ""
    assert first.run is not None
    assert first.run.load is not None
    assert summary.complete
    assert summary.duration == pytest.approx(0.5)


def test_a_duration_between_blocks_is_covered(rolling: type[PureRolling]) -> None:
    assert desk_run.run(load_scene("static_80kN", duration=0.05)).duration == pytest.approx(0.06)


def test_cage_speed_ratio_of_pure_rolling_is_one(rolling: type[PureRolling]) -> None:
    summary = desk_run.run(load_scene("static_80kN", duration=1.0))
    # the cages of the synthetic run swing by 0.2 % about the kinematic speed, with a period of 0.157 s
    assert summary.cage_speed_ratio == pytest.approx((1.0, 1.0), abs=1e-3)
    assert summary.shaft_torque == pytest.approx(-5.0)
    assert summary.energy_residual == pytest.approx(0.01 / 9.99)
    revolution = 2 * math.pi / (fault_frequencies(load_scene("static_80kN").bearing).ftf * SHAFT_SPEED)
    first, last = summary.averaged
    assert summary.cage_revolutions == math.floor((last - SETTLING_S) / revolution)
    assert last - first == pytest.approx(summary.cage_revolutions * revolution, rel=3e-3)


def test_leaving_the_validity_delivers_the_block_and_closes_with_the_sentence(
    rolling: type[PureRolling],
) -> None:
    rolling.invalid_at = 3
    sink = MemorySink()
    summary = desk_run.run(load_scene("static_80kN", duration=0.5), [sink])
    assert not summary.complete
    assert [block.status for block in sink.blocks] == [0, 0, 0, 4]
    assert sink.status == summary.status == SENTENCE


def test_an_interrupt_closes_the_sinks(rolling: type[PureRolling]) -> None:
    rolling.interrupted_at = 2
    sink = MemorySink()
    with pytest.raises(KeyboardInterrupt):
        desk_run.run(load_scene("static_80kN", duration=0.5), [sink])
    assert len(sink.blocks) == 2
    assert "interrupted" in (sink.status or "")


class HalfWritten(MemorySink):
    """A file in the middle of a record when Ctrl-C comes."""

    writing = False

    def write(self, block: Block) -> None:
        assert not self.writing, "the block before was left half written"
        self.writing = True
        if block.index == 2:
            signal.raise_signal(signal.SIGINT)
        super().write(block)
        self.writing = False

    def close(self, status: str = "") -> None:
        assert not self.writing, "closed with half a record"
        super().close(status)


def test_an_interrupt_waits_for_the_end_of_a_record(rolling: type[PureRolling]) -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        sinks = HalfWritten(), MemorySink()
        with pytest.raises(KeyboardInterrupt):
            desk_run.run(load_scene("static_80kN", duration=0.5), sinks)
        assert [len(sink.blocks) for sink in sinks] == [3, 3]
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)


class FullSink(MemorySink):
    """Refuses to be finished."""

    def close(self, status: str = "") -> None:
        raise InputError("cannot write on full.mcap: No space left on device")


def test_a_sink_that_cannot_be_closed_leaves_no_other_open(rolling: type[PureRolling]) -> None:
    other = MemorySink()
    with pytest.raises(InputError, match="No space left"):
        desk_run.run(load_scene("static_80kN", duration=0.1), [FullSink(), other])
    assert other.status == ""
    rolling.interrupted_at = 2
    with pytest.raises(KeyboardInterrupt):
        desk_run.run(load_scene("static_80kN", duration=0.1), [FullSink(), other])
    assert "interrupted" in (other.status or "")


class ImpatientSink(MemorySink):
    """Gets a second Ctrl-C while it closes."""

    def close(self, status: str = "") -> None:
        signal.raise_signal(signal.SIGINT)
        super().close(status)


def test_ctrl_c_while_closing_is_ignored(rolling: type[PureRolling]) -> None:
    sink, before = ImpatientSink(), signal.getsignal(signal.SIGINT)
    desk_run.run(load_scene("static_80kN", duration=0.1), [sink])
    assert sink.status == ""
    assert signal.getsignal(signal.SIGINT) == before


def test_a_load_that_cannot_be_made_opens_no_sink(rolling: type[PureRolling], tmp_path: Any) -> None:
    scene = replace(load_scene("static_80kN"), operation=MeasuredOperation(tmp_path / "gone.csv"))
    sink = MemorySink()
    with pytest.raises(InputError):
        desk_run.run(scene, [sink])
    assert sink.run is None


def test_means_over_whole_revolutions_do_not_see_what_turns_with_the_cage() -> None:
    times = np.arange(400) / 400.0
    speed = 53.0
    first, revolutions = averaging_start(times, np.full(400, speed))
    signal = 7.0 + np.cos(speed * times)
    assert revolutions == int((times[-1] - SETTLING_S) * speed / (2 * math.pi))
    # linear interpolation between 47 samples a revolution: (speed dt)^2 / 12 of the amplitude
    assert time_mean(times, signal, first) == pytest.approx(7.0, abs=2e-3)
    assert abs(time_mean(times, signal, first + 0.06) - 7.0) > 1e-2


def test_a_resting_shaft_has_no_cage_speed_ratio() -> None:
    times = np.arange(40) / 400.0
    first, revolutions = averaging_start(times, np.zeros(40))
    assert revolutions == 0
    assert first == pytest.approx(0.5 * times[-1])


def test_a_run_too_short_for_a_trend_has_no_means(
    rolling: type[PureRolling], monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = SyntheticRun.block

    def without_trend(run: SyntheticRun, index: int) -> Block:
        names = ("trend_time_ns", "force", "shaft_torque", "shaft_speed", "cage_speed")
        block = whole(run, index)
        return replace(block, **{name: getattr(block, name)[:0] for name in names})

    monkeypatch.setattr(SyntheticRun, "block", without_trend)
    summary = desk_run.run(load_scene("static_80kN", duration=0.02))
    assert summary.complete
    assert all(math.isnan(value) for value in (*summary.mean_force, *summary.cage_speed_ratio))
    assert "too little: 0.02 s end before the first values" in simulate.text(summary, None)
    assert "nan" not in simulate.text(summary, None, verbose=True)


def test_summary_holds_the_rating_life_of_the_load(rolling: type[PureRolling]) -> None:
    summary = desk_run.run(load_scene("static_80kN", duration=0.04))
    assert summary.life is not None
    assert summary.life.equivalent_load == pytest.approx(80e3)
    assert summary.life.reference_basic > summary.life.basic
