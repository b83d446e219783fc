"""A width of an estimator stands in where the monitor measures none, and so does the least of it."""

from __future__ import annotations

from dataclasses import replace
from math import nan
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from beardyn_core.fleet import analysis as analysing
from beardyn_core.fleet.analysis import Analysis
from beardyn_core.fleet.health import ACT, PLAN, replay
from beardyn_core.fleet.mileage_left import judge_mileage
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.fault_location import PartEstimate
from beardyn_core.follow.quantities import BY_NAME
from test.fleet.made_history import analysis, history, recording, wide
from test.follow.synthetic import PLATE

ENDS = ((15e-3, 34e-3), (14e-3, 34e-3))
LEAST = Estimate(BY_NAME["width"], nan, ENDS, "at least 14 mm: it reaches the end", 14e-3)
NUMBER = Estimate(BY_NAME["width"], 8e-3, ((7e-3, 9e-3), (6e-3, 10e-3)))
NOTHING = Estimate(BY_NAME["width"], nan, (), "not identifiable")


def with_estimate(
    told: Estimate, found: Analysis, monkeypatch: pytest.MonkeyPatch, part: str = "cup"
) -> Analysis:
    estimates = Estimates(PartEstimate(part, 0.95, ((part,), (part,))), (told,), 0.5, 1, 20.0)
    monkeypatch.setattr("beardyn_core.follow.inference.estimates_of", lambda *_: estimates)
    run: Any = SimpleNamespace(sensors={}, vibration=(), label="run")
    one = replace(recording(), path=Path("one.npz"))
    return analysing._with_estimate(found, run, PLATE, one, "shipped")


def test_a_number_and_a_least_width_stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    number = with_estimate(NUMBER, analysis("cup"), monkeypatch)
    assert (number.width, number.width_low, number.width_from) == (8e-3, 6e-3, "estimator")
    least = with_estimate(LEAST, analysis("cup", stage_reason="size not measurable"), monkeypatch)
    assert least.width != least.width
    assert (least.width_low, least.width_from) == (14e-3, "estimator")
    assert least.stage_reason == "size not measurable; estimator: at least 14 mm: it reaches the end"
    assert replay(history([least] * 4), {})[0].state == ACT
    assert replay(history([with_estimate(NOTHING, analysis("cup"), monkeypatch)] * 4), {})[0].state == PLAN


def test_the_monitor_comes_first_and_parts_must_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    measured = wide("cup", 5e-3)
    for told in (NUMBER, LEAST):
        assert with_estimate(told, measured, monkeypatch).width == 5e-3
        assert with_estimate(told, analysis("cup"), monkeypatch, "cone").width_from == ""
        assert with_estimate(told, analysis("healthy"), monkeypatch).width_from == ""


def of_estimator(width: float, half: float) -> Analysis:
    return replace(wide("cup", width, half), width_from="estimator")


def test_a_90_percent_interval_counts_as_wide_as_a_95_percent_one_of_the_same_deviation() -> None:
    # 1.645 and 1.960 standard deviations of 1 mm
    known, monitor = of_estimator(8e-3, 1.645e-3), wide("cup", 8e-3, 1.960e-3)
    for each in (known, monitor):
        assert each.width_deviation == pytest.approx(1e-3, rel=1e-3)
        assert each.width_ends == pytest.approx((6.04e-3, 9.96e-3), rel=1e-3)
    widths = np.array([6e-3, 6.3e-3, 7e-3, 7.4e-3, 8e-3])
    lefts = [
        judge_mileage(history([make(each, half) for each in widths]), "cup").distance
        for make, half in ((of_estimator, 1.645e-3), (lambda w, h: wide("cup", w, h), 1.960e-3))
    ]
    assert lefts[0] == pytest.approx(lefts[1], rel=0.01)


@pytest.mark.parametrize(("half", "state"), [(8.7e-3, PLAN), (9.2e-3, ACT)])
def test_an_estimated_spall_that_could_be_20_mm_by_its_95_percent_interval_must_come_out(
    half: float, state: str
) -> None:
    # its 90 % interval ends below 19 mm, its width is below 10 mm
    assert replay(history([of_estimator(9.4e-3, half)] * 4), {})[0].state == state
