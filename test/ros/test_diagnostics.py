"""What a twin says of its run, without a graph."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.published import kept_pace
from beardyn_ros import pacer as pacing
from beardyn_ros.load_gate import RefusalReport
from beardyn_ros.pacer import LATE_AFTER_S, Pacer
from beardyn_ros.run_state import FINISHED, RUNNING, SessionReport
from beardyn_ros.twin_report import NodeStanding, pace_sentence, twin_diagnostic

STANDING = NodeStanding("", 0, "lockstep", 0.0, 1, {}, 0, ())
NONE_REFUSED = RefusalReport(0, (), "", recent=False)


@pytest.mark.parametrize("residual", [None, 0.0, 2e-5])
def test_without_an_audit_no_residual_is_told(residual: float | None) -> None:
    """An `energy_residual` of zero would be a balance that holds, and nobody has kept one."""
    report = SessionReport(blocks=3, simulated_s=0.06, energy_residual=residual)
    told = twin_diagnostic("axlebox/twin", report, NONE_REFUSED, STANDING).value("energy_residual")
    assert told == (None if residual is None else f"{residual:.3e}")


def test_a_block_is_late_by_when_it_is_published_and_not_by_when_it_is_ready(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now = 100.0
    monkeypatch.setattr(pacing, "time", SimpleNamespace(monotonic=lambda: now))
    pacer = Pacer(2.0)
    due = [pacer.hand_over(20_000_000 * index) for index in (1, 2, 3)]
    assert due == pytest.approx([100.01, 100.02, 100.03])
    for index, late in enumerate((0.5, 1.5, 0.1), start=1):
        now = 100.0 + 0.01 * index + late * LATE_AFTER_S
        pacer.check_published(20_000_000 * index, due[index - 1])
    assert pacer.late_blocks == 1
    assert pacer.last_late_s == pytest.approx(0.04)
    assert pacer.worst_lag_s == pytest.approx(1.5 * LATE_AFTER_S)
    assert pacer.lag_s == pytest.approx(0.1 * LATE_AFTER_S)


def test_time_waited_for_somebody_else_makes_no_block_late(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(pacing, "time", SimpleNamespace(monotonic=lambda: now))
    pacer = Pacer(1.0)
    now = 103.0
    pacer.shift(3.0)
    pacer.check_published(20_000_000, pacer.hand_over(20_000_000))
    assert (pacer.late_blocks, pacer.lag_s) == (0, 0.0)


def test_without_a_pace_no_block_is_late() -> None:
    pacer = Pacer(0.0)
    pacer.check_published(20_000_000, pacer.hand_over(20_000_000))
    assert (pacer.late_blocks, pacer.worst_lag_s) == (0, 0.0)
    assert pace_sentence(SessionReport(blocks=3, simulated_s=0.06), 0.0) == ""


def test_the_last_word_and_the_log_state_pace_and_late_blocks() -> None:
    report = SessionReport(state=FINISHED, blocks=100, simulated_s=2.0, wall_s=2.5)
    report.late_blocks, report.worst_lag_s, report.last_late_s = 3, 0.5, 1.9
    told = pace_sentence(report, 1.0)
    assert "pace 0.8000 of 1 asked for" in told
    assert "3 of 100 blocks were late, the worst by 500 ms, the last at simulated t = 1.90 s" in told
    assert "no block was late" in pace_sentence(SessionReport(blocks=1, simulated_s=1.0, wall_s=1.0), 1.0)
    paced = NodeStanding("", 0, "lockstep", 1.0, 1, {}, 0, ())
    status = twin_diagnostic("axlebox/twin", report, NONE_REFUSED, paced)
    assert (status.value("late_blocks"), status.value("last_late_time")) == ("3", "1.900")
    assert kept_pace([status]) == (0.8, 3)
    foreign = Diagnostic("axlebox/twin", 0, "", (("pace", "x"), ("speed_factor", "1"), ("late_blocks", "-")))
    assert kept_pace([status, foreign]) == (None, None)
    report.state = RUNNING  # killed: what it said last is of one second
    assert kept_pace([twin_diagnostic("axlebox/twin", report, NONE_REFUSED, paced)]) == (None, None)
    report.state = FINISHED
    unpaced = twin_diagnostic("axlebox/twin", report, NONE_REFUSED, STANDING)
    assert kept_pace([unpaced]) == (None, None) == kept_pace([])
