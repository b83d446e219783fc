"""The study of the converged step: its statistics, its verdicts, its page, and short runs of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from beardyn_core.physics.tiers.step_choice import AUDIBLE_BAND, choose_steps
from beardyn_core.study.measures import NOMINAL_BANDS
from evidence.step.cases import (
    BRIDGE,
    LAMINAE,
    POINTS,
    REFERENCE,
    Method,
    chosen,
    compared,
    scene_of,
)
from evidence.step.comparison import (
    MEAN_LIMIT,
    NOT,
    OPEN,
    WITHIN,
    Difference,
    difference,
    run_variance,
)
from evidence.step.run import LINES, PARTS, StepRun, attempt, line_levels
from evidence.step.study import Extent, Runs, point_mapping
from evidence.step.table import point_tables
from evidence.step.unstable import unstable_run
from test.kernels.rig import Float

RUN_SCATTER = 0.1  # of the torque of a whole run, relative; parts scatter by root of their number more


def samples(rng: np.random.Generator, count: int, mean: float, components: int = 1) -> list[Float]:
    """Whole run and parts of independent normal numbers."""
    found = []
    for _ in range(count):
        parts = mean + RUN_SCATTER * np.sqrt(PARTS) * rng.normal(size=(PARTS, components))
        found.append(np.concatenate([parts.mean(axis=0, keepdims=True), parts]))
    return found


def test_doubt_and_band_are_exceeded_as_rarely_as_stated() -> None:
    """5 % of 1000 comparisons, binomial scatter 0.7 %; the factor for runs that scatter more errs safely."""
    rng = np.random.default_rng(1)
    beyond = single = 0
    for _ in range(1000):
        found = difference(samples(rng, 4, 1.0), samples(rng, 3, 1.0))
        beyond += bool(abs(found.value[0]) > found.doubt[0])
        pair = samples(rng, 1, 1.0)[0][0, 0] - samples(rng, 1, 1.0)[0][0, 0]
        single += bool(abs(pair) > found.band[0])
    assert 0.01 < beyond / 1000 < 0.07
    assert 0.01 < single / 1000 < 0.07


def test_band_of_many_components_holds_for_all_of_them_together() -> None:
    rng = np.random.default_rng(2)
    left = 0
    for _ in range(300):
        found = difference(samples(rng, 1, 0.0, 50), samples(rng, 3, 0.0, 50))
        left += bool(np.any(np.abs(found.value) > found.band))
    assert left / 300 < 0.08


def test_runs_that_scatter_more_than_their_parts_raise_the_variance() -> None:
    rng = np.random.default_rng(3)
    calm = samples(rng, 6, 1.0, 20)
    shifted = [run + shift for run, shift in zip(calm, (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0), strict=True)]
    assert np.mean(run_variance(shifted)) > 0.9
    assert np.mean(run_variance(calm)) == pytest.approx(RUN_SCATTER**2, rel=0.4)


@pytest.mark.parametrize(
    ("value", "doubt", "verdict"),
    [(0.1, 0.2, WITHIN), (-0.1, 0.2, WITHIN), (0.4, 0.2, OPEN), (-0.9, 0.2, NOT)],
)
def test_a_verdict_counts_what_the_difference_is_known_to(value: float, doubt: float, verdict: str) -> None:
    calm = Difference(np.array([0.0, value]), np.array([0.0, doubt]), np.array([0.5, 0.35]))
    assert calm.against(0.5) == verdict
    assert calm.against_band() == verdict


def test_lines_hold_the_power_of_the_signal() -> None:
    """White noise of 2 m/s^2 on three axes over 12.8 kHz: 12 (m/s^2)^2 / 256 in each 50 Hz."""
    noise = 2.0 * np.random.default_rng(4).normal(size=(200_000, 3))
    levels = line_levels(noise)
    assert levels.shape == LINES.shape
    assert LINES[-1] == AUDIBLE_BAND
    expected = 10.0 * np.log10(12.0 / 256.0) + 120.0
    np.testing.assert_allclose(levels, expected, atol=0.8)


def test_the_study_asks_the_rule_what_is_chosen() -> None:
    for point in POINTS:
        scene = scene_of(point, REFERENCE)
        load, speed = (point.load, point.load), (point.speed, point.speed)
        loud, calm = (
            choose_steps(
                scene.bearing, load, speed, scene.effects, laminae=LAMINAE, end_play=scene.end_play, band=band
            )
            for band in (AUDIBLE_BAND, 0.0)
        )
        assert chosen(point) == {"vibration": loud, "torque": calm}
        methods = compared(point, ())
        assert {method.steps for method in methods if method.integrator == "implicit"} == {
            loud.steps_per_sample,
            calm.steps_per_sample,
        }


def synthetic(rng: np.random.Generator, mean: float, scatter: float, level: float) -> StepRun:
    def level_of(count: int) -> Float:
        return level + 0.1 * rng.normal(size=(1 + PARTS, count))

    return StepRun(
        mean=mean + 1e-3 * rng.normal(size=1 + PARTS),
        scatter=scatter + 1e-2 * rng.normal(size=1 + PARTS),
        filtered_scatter=scatter + 1e-2 * rng.normal(size=1 + PARTS),
        bands=level_of(len(NOMINAL_BANDS)),
        lines=level_of(len(LINES)),
        begun=mean,
        chatter=0.01,
        status="fine",
        wall=1.0,
    )


@pytest.fixture(scope="module")
def mapping() -> dict[str, Any]:
    """Made-up runs: implicit steps are right but for 1 step a sample; 4 explicit steps end early."""
    rng = np.random.default_rng(5)
    extent = Extent(steps=(1, 2, 5))
    runs: Runs = {}
    for method in (REFERENCE, *compared(POINTS[0], extent.steps)):
        wrong = method == Method("implicit", 1)
        values = (-3.3, 1.6, 96.0) if wrong else (-3.0, 1.0, 90.0)
        runs[POINTS[0], method] = [synthetic(rng, *values) for _ in range(3)]
    runs[POINTS[0], Method("explicit", 4)] = ["a number became NaN"]
    return point_mapping(POINTS[0], extent, runs)


def row_of(mapping: dict[str, Any], method: Method) -> dict[str, Any]:
    return next(
        row
        for row in mapping["rows"]
        if (row["integrator"], row["steps"]) == (method.integrator, method.steps)
    )


def test_a_right_step_is_within_and_a_wrong_one_is_not(mapping: dict[str, Any]) -> None:
    criteria = ("mean", "pooled_mean", "scatter", "bands", "bands_limit", "lines")
    right, wrong = row_of(mapping, Method("implicit", 5)), row_of(mapping, Method("implicit", 1))
    assert {key: right[key]["verdict"] for key in criteria} == dict.fromkeys(criteria, WITHIN)
    assert {key: wrong[key]["verdict"] for key in criteria} == dict.fromkeys(criteria, NOT)
    assert wrong["mean"]["difference"] == pytest.approx(0.1, rel=0.02)
    assert mapping["chosen"]["vibration"]["verdict"] == WITHIN


def test_a_run_that_ended_is_a_row_without_numbers(mapping: dict[str, Any]) -> None:
    row = row_of(mapping, Method("explicit", 4))
    assert row["ended"] == "a number became NaN"
    data = {"bands_Hz": list(NOMINAL_BANDS), "lines_Hz": LINES.tolist()}
    for table in point_tables(mapping, data):
        cells = next(cells for cells in table.rows if cells[0].startswith("explicit 9.8 us"))
        assert len(cells) == len(table.head)


@pytest.mark.slow
@pytest.mark.parametrize("point", POINTS, ids=lambda point: point.name)
def test_the_chosen_steps_keep_to_the_explicit_reference(point: Any) -> None:
    """The study's own criteria, with a third of its reference: nothing is beyond, the scatter is within."""
    extent = Extent(settling=0.2, duration=0.4, reference_runs=2, bridge_runs=4, runs=8, steps=())
    counts = {REFERENCE: extent.reference_runs, BRIDGE: extent.bridge_runs}
    runs: Runs = {
        (point, method): [
            attempt(point, method, number, extent.settling, extent.duration)
            for number in range(counts.get(method, extent.runs if method.integrator == "implicit" else 1))
        ]
        for method in (REFERENCE, *compared(point, ()))
    }
    found = point_mapping(point, extent, runs)
    for choice in found["chosen"].values():
        assert choice["verdicts"]["scatter"] == WITHIN
        assert NOT not in choice["verdicts"].values()
    row = row_of(found, Method("implicit", found["chosen"]["vibration"]["steps_per_sample"]))
    assert row["pooled_mean"]["doubt"] < 4.0 * MEAN_LIMIT


@pytest.mark.slow
def test_explicit_steps_beyond_their_limit_flip_under_a_right_mean() -> None:
    """9.8 us at 150 kN: explicit steps flip under a mean that is right, implicit ones do not."""
    calm, wild, implicit = (
        unstable_run("standard", POINTS[1], method)
        for method in (BRIDGE, Method("explicit", 4), Method("implicit", 4))
    )
    assert wild.mean == pytest.approx(calm.mean, rel=0.1)
    assert wild.scatter > 10.0 * calm.scatter
    assert implicit.scatter == pytest.approx(calm.scatter, rel=0.3)
    ended = unstable_run("standard", POINTS[1], Method("explicit", 2))
    assert ended.ended
