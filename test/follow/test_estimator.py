"""Estimates of numbers whose law is known: errors, promises of intervals, what is not identifiable."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.judging import judged_by
from beardyn_core.follow.learning import true_values, widen_intervals
from beardyn_core.follow.quantities import BY_NAME
from test.follow.synthetic import NAMES, drawn, standard_estimator, taught

FOUR_SIGMA = 4.0


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return standard_estimator()


def inside(share: float, level: float, count: int, calibrated: int = 200) -> bool:
    """Whether a share of runs fits the level within what chance does to both sets of runs."""
    return abs(share - level) < FOUR_SIGMA * np.sqrt(level * (1.0 - level) * (1.0 / count + 1.0 / calibrated))


def test_intervals_hold_the_truth_as_often_as_they_say(estimator: Estimator) -> None:
    found = judged_by(estimator, drawn(400, 3)).scores
    for name in ("vertical_load", "end_play", "width"):
        for share, level in zip(found[name].coverage, LEVELS, strict=True):
            assert inside(share, level, found[name].runs), (name, share, level)
    assert found["vertical_load"].error < 0.1
    assert found["width"].explained > 0.7  # of some 240 descriptors nearly all are noise


def test_another_tier_biases_the_load_and_a_few_of_its_runs_straighten_it() -> None:
    other = drawn(400, 4, shift=3.0)
    few = drawn(60, 5, shift=3.0)
    bent, straight = (
        judged_by(taught(few, straightened=each), other).scores["vertical_load"] for each in (False, True)
    )
    assert abs(bent.bias) > 0.15
    assert abs(straight.bias) < 0.05
    assert straight.error < 0.5 * bent.error
    for found in (bent, straight):  # either way the promise holds: the one with wider intervals
        assert all(inside(s, level, 400, 60) for s, level in zip(found.coverage, LEVELS, strict=True))


def test_part_is_told_with_a_set_that_holds_the_truth_as_often_as_it_says(estimator: Estimator) -> None:
    others = drawn(400, 6)
    found = [estimator.estimates(row[None]).part for row in others.descriptors]
    right = [
        each is not None and each.condition == truth
        for each, truth in zip(found, others.conditions, strict=True)
    ]
    assert np.mean(right) > 0.95
    held = [
        each is not None and truth in each.sets[-1]
        for each, truth in zip(found, others.conditions, strict=True)
    ]
    assert np.mean(held) > 0.9 - FOUR_SIGMA * np.sqrt(0.09 * (1 / 400 + 1 / 200))


def test_depth_that_nothing_tells_is_called_not_identifiable(estimator: Estimator) -> None:
    runs = drawn(50, 7)
    spalled = estimator.estimates(runs.descriptors[runs.conditions == "cup"][:1])
    assert np.isnan(spalled["depth"].value)
    assert "not identifiable" in spalled["depth"].sentence
    assert "90 % interval" in spalled["width"].sentence
    sound = estimator.estimates(runs.descriptors[runs.conditions == "healthy"][:1])
    assert sound["width"].sentence.endswith("no part is called spalled")


def test_an_interval_as_wide_as_the_range_learnt_from_is_no_estimate() -> None:
    noisy = taught(drawn(200, 8, noise=40.0))  # its intervals are set by runs that tell nothing
    found = noisy.estimates(drawn(1, 9).descriptors)["vertical_load"]
    assert np.isnan(found.value)
    assert found.reason.startswith("not identifiable from this signal")
    low, high = found.intervals[-1]
    assert low < 3.2e4
    assert high > 8.5e4


def test_signals_unlike_all_that_was_learnt_from_are_told(estimator: Estimator) -> None:
    usual = drawn(400, 10).descriptors
    # one in twenty exceeds the bound by design, so the share is what is promised, not the largest
    assert inside(float((estimator.strangeness(usual) <= 1.0).mean()), 0.95, 400)
    strange = usual[:1] + 60.0 * (np.arange(len(NAMES)) % 2)
    assert "unlike all that was learnt from" in estimator.estimates(strange).sentences[-1]


def test_a_file_gives_the_same_estimates_and_is_small(estimator: Estimator, tmp_path: Path) -> None:
    path = tmp_path / "one.npz"
    estimator.save(path)
    again, rows = read_estimator(path), drawn(5, 11).descriptors
    assert path.stat().st_size < 300_000
    for one, other in zip(
        estimator.estimates(rows).quantities, again.estimates(rows).quantities, strict=True
    ):
        assert one.reason == other.reason
        np.testing.assert_allclose(one.value, other.value, rtol=1e-4)
        np.testing.assert_allclose(one.intervals, other.intervals, rtol=1e-3, atol=1e-6)
    part, same = estimator.estimates(rows).part, again.estimates(rows).part
    assert part is not None
    assert same is not None
    assert part.sets == same.sets


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (None, "there is no such file"),
        (b"", "is no estimator"),
        (b"PK\x03\x04 cut", "is no estimator"),
        (b"mileage,load\n", "is no estimator that `beardyn train` wrote$"),
    ],
)
def test_files_that_are_no_estimator_are_refused(
    content: bytes | None, sentence: str, tmp_path: Path
) -> None:
    path = tmp_path / "broken.npz"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=sentence):
        read_estimator(path)


def test_an_interval_is_the_widest_of_those_of_the_sets_that_calibrate_it() -> None:
    quiet, loud = drawn(200, 12), drawn(200, 13, noise=6.0)
    one = taught(quiet)
    both = widen_intervals(one, loud)
    for runs in (drawn(400, 14), drawn(400, 15, noise=6.0)):
        shown = both.standardise(runs.descriptors)
        for name in ("width", "length"):
            values, there = true_values(BY_NAME[name], runs)
            guess = both.regressions[name].guess(shown[there])
            held = (guess.low[-1] <= values[there]) & (values[there] <= guess.high[-1])
            assert held.mean() > LEVELS[-1] - FOUR_SIGMA * np.sqrt(0.09 * (1 / there.sum() + 1 / 130))
    for name, each in widen_intervals(one, quiet).regressions.items():
        # none gets narrower; threads of linear algebra may add in another order
        np.testing.assert_allclose(each.reach, one.regressions[name].reach, rtol=1e-12)


def test_too_few_runs_that_judge_an_interval_give_no_number() -> None:
    found = widen_intervals(taught(drawn(200, 12)), drawn(5, 16)).estimates(drawn(1, 9).descriptors)
    assert np.isnan(found["vertical_load"].value)
    assert "not reported: no runs prove its interval" in found["vertical_load"].sentence
