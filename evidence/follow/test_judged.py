"""Coverage beside chance, errors by class, and the section of the page, of guesses whose errors are known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binomtest

from beardyn_core.follow.conformal import Guess
from beardyn_core.follow.judging import Guessed
from evidence.follow import judged
from evidence.follow.page import PAGE
from evidence.pages import with_section

COUNT = 60


def guesses(error: float) -> Guessed:
    """Guess widths of some 3 and 10 mm too wide by a share; every second interval of 50 % holds the truth."""
    near = 1.0 + 1e-3 * np.arange(COUNT)
    truth = np.log(near * np.where(np.arange(COUNT) < COUNT // 2, 3e-3, 10e-3))
    value = truth + np.log1p(error)
    far = np.where(np.arange(COUNT) % 2, 0.5, 2.0) * np.log1p(error)
    half = np.stack([far, 4.0 * far])
    return Guessed(Guess(value, value - half, value + half), truth, np.arange(COUNT))


def drawn() -> dict[str, np.ndarray]:
    return {
        judged.WIDTH: np.where(np.arange(COUNT) < COUNT // 2, 3.0, 10.0),
        judged.SPEED: np.linspace(141.0, 259.0, COUNT),
        judged.NOISE: np.full(COUNT, 0.002),
    }


def test_limits_of_chance_are_those_of_a_binomial_test() -> None:
    for level in (0.5, 0.9):
        low, high = judged.limits_of(level, 320)
        for share, inside in ((low, True), (high, True), (low - 0.01, False), (high + 0.01, False)):
            test = binomtest(
                round(share * 320), 320, level, alternative="less" if share < level else "greater"
            )
            assert (test.pvalue > 0.025) == inside
    low, high = judged.limits_of(0.9, 320)
    assert (low, high) == pytest.approx((0.866, 0.931), abs=0.005)


def test_coverage_that_chance_does_not_explain_is_told() -> None:
    rows = judged.coverage_table({"width": guesses(0.2)})
    assert rows[-1].startswith("| width of the spall along the raceway | 60 | 50 % | ")
    assert "100 %, outside" in rows[-1]


def test_errors_are_told_by_class_and_few_runs_are_not() -> None:
    rows = judged.class_table({"width": guesses(0.2)}, judged.classes_of(drawn(), np.ones(COUNT, bool)))
    told = {row.split("|")[1].strip(): row for row in rows}
    assert "20 % of 60 | 100 %" in told["all"]
    assert "20 % of 30" in told["width from 4 mm"]
    assert "20 % of 30" in told["width 2 to 4 mm"]
    assert "- | -" in told["width 4 to 8 mm"]
    assert "- | -" in told["box beyond"]
    speeds = [int(told[f"{low} to {low + 40} km/h"].split(" of ")[1].split()[0]) for low in (140, 180, 220)]
    assert sum(speeds) == COUNT


def test_ranges_are_those_of_the_sweep() -> None:
    found = judged.ranges_of("high_speed_axlebox", judged.DAMPING, judged.NOISE)
    assert found == {judged.DAMPING: (0.5, 2), judged.NOISE: (0.0003, 0.01)}


def test_the_section_is_put_before_the_next_one_and_replaced_the_second_time() -> None:
    page = PAGE.read_text(encoding="utf-8")
    classes = judged.classes_of(drawn(), np.ones(COUNT, bool))
    written = judged.section({"width": guesses(0.2)}, classes, 362, COUNT)
    once = with_section(page, judged.TITLE, written, judged.NEXT)
    assert once.count(judged.TITLE) == 1
    assert once.index(judged.TITLE) < once.index(judged.NEXT)
    assert with_section(once, judged.TITLE, written, judged.NEXT) == once
