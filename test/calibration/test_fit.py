"""What spectra determine is found with intervals; what they do not is said and left at its base value."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.calibration.fitting import FEWEST_RUNS, Fitted
from beardyn_core.calibration.identify import PRIOR, common_slope, identify
from beardyn_core.calibration.spectra import Reception, StretchLevels, levels_of, rides_of
from beardyn_core.calibration.unknowns import BY_NAME
from test.calibration.law import BASES, fitter, law

pytest.importorskip("cma")
TRUTH = {"frequency": 1.09, "damping": 0.6, "background": 1.5, "noise": 0.002, "end_play": 0.18}


def by_name(found: Fitted) -> dict[str, object]:
    return {each.unknown.name: each for each in found.fits}


def test_hidden_values_are_found_within_their_intervals() -> None:
    found = fitter(TRUTH, budget=90).fit()
    for each in found.fits:
        truth = TRUTH[each.unknown.name]
        low, high = each.interval
        assert not each.reason
        assert low < each.value < high
        # an interval of 90 % may miss; twice as wide a one hardly does
        assert abs(truth - each.value) < high - low, each.sentence
    assert np.sqrt(np.mean(found.after**2)) < 0.3 * np.sqrt(np.mean(found.before**2))


def test_what_nothing_follows_from_is_left_and_said() -> None:
    found = fitter({"frequency": 1.09}, budget=60, silent=("end_play",)).fit()
    each = next(each for each in found.fits if each.unknown.name == "end_play")
    assert each.reason.startswith("not determined")
    assert each.value == BASES["end_play"]
    assert "left at 0.1 mm" in each.sentence


def test_noise_below_everything_else_is_not_determined() -> None:
    found = fitter({"noise": 1e-5, "frequency": 1.05}, budget=60, scatter=1.0).fit()
    each = next(each for each in found.fits if each.unknown.name == "noise")
    assert each.value == BASES["noise"]
    assert each.reason.startswith("not determined")


def test_two_numbers_that_are_received_alike_are_not_told_apart() -> None:
    found = fitter({"background": 1.5}, budget=70, alike=True).fit()
    fits = {each.unknown.name: each for each in found.fits}
    left = [name for name in ("background", "damping") if fits[name].reason]
    assert len(left) == 1
    other = {"background": "damping", "damping": "background"}[left[0]]
    assert fits[left[0]].partner == other
    # what both do together is put on the one that is fitted
    assert fits[other].value == pytest.approx(1.5, rel=0.15)


def test_one_unknown_alone_is_fitted_and_has_no_partner() -> None:
    found = fitter({"frequency": 0.93}, names=("frequency",)).fit()
    (each,) = found.fits
    assert each.value == pytest.approx(0.93, rel=0.01)
    assert (each.partner, each.correlation) == ("", 0.0)


def test_a_recording_that_determines_nothing_leaves_the_scene_as_it_is() -> None:
    (each,) = fitter({}, names=("end_play",), silent=("end_play",)).fit().fits
    assert each.value == each.base
    assert "not determined" in each.reason


def test_a_twin_that_ends_early_costs_no_more_than_its_run() -> None:
    found = fitter({"damping": 0.7}, most_damping=1.5).fit()
    damping = next(each for each in found.fits if each.unknown.name == "damping")
    assert damping.value == pytest.approx(0.7, rel=0.2)


@pytest.mark.parametrize("runs", [12, 45, 55])
def test_an_interrupted_search_leaves_the_best_so_far(runs: int) -> None:
    found = fitter(TRUTH, budget=60, interrupted_after=runs).fit()
    assert found.interrupted
    assert found.runs == runs + 1
    assert all("best so far" in each.sentence for each in found.fits if not each.reason) == (runs < 50)
    assert np.sqrt(np.mean(found.after**2)) < np.sqrt(np.mean(found.before**2))


def test_interrupted_before_the_search_there_is_nothing_to_leave() -> None:
    with pytest.raises(KeyboardInterrupt):
        fitter(TRUTH, interrupted_after=2).fit()


def test_the_budget_is_kept() -> None:
    for budget in (FEWEST_RUNS, 50):
        assert fitter(TRUTH, budget=budget).fit().runs <= budget


def test_the_same_recordings_give_the_same_scene() -> None:
    one, other = (fitter(TRUTH, budget=40).fit() for _ in range(2))
    assert [each.value for each in one.fits] == [each.value for each in other.fits]


def test_white_noise_that_is_added_to_powers_is_that_which_is_received() -> None:
    density, seconds = 0.02, 40.0
    reception = Reception(("z",), 25_600.0, seconds)
    count = round(seconds * reception.rate)
    noise = np.random.default_rng(1).normal(0.0, density * np.sqrt(0.5 * reception.rate), (count, 1))
    added = law().levels(np.zeros((1, len(reception.middles))), density)
    # 230 independent lines in the narrowest band of 5.8 Hz: a standard deviation of 0.35 dB
    assert levels_of(noise, reception) == pytest.approx(added, abs=1.4)
    assert np.mean(levels_of(noise, reception) - added) == pytest.approx(0.0, abs=0.1)


def test_intervals_widen_with_what_the_fit_leaves_and_with_scatter() -> None:
    random = np.random.default_rng(2)
    slope, weight = random.normal(0.0, 20.0, (100, 2)), np.ones(100)
    scatter = random.normal(0.0, 1.0, (4, 100))
    model = np.full(50, 1e-3)

    def deviation(slope: Float, scatter: Float, excess: float, model: Float, twins: int = 4) -> Float:
        return identify(slope, weight, scatter, excess, model, (1, 2, 50), twins).deviation

    usual = deviation(slope, scatter, 1.0, model)
    assert (deviation(slope, 2.0 * scatter, 1.0, model) > 1.5 * usual).all()
    assert (deviation(slope, scatter, 4.0, model) > 1.5 * usual).all()
    assert (deviation(slope, scatter, 1.0, 6e3 * model) > 1.5 * usual).all()
    assert deviation(0.0 * slope, scatter, 1.0, model) == pytest.approx(PRIOR)
    # one twin scatters as the recording does, the mean of four by half of it
    one = deviation(slope, scatter, 1.0, model, twins=1)
    assert one / usual == pytest.approx(np.sqrt((1.0 + 1.0) / (1.0 + 0.25)), rel=0.02)


def test_slopes_that_two_seeds_do_not_agree_in_say_nothing() -> None:
    random = np.random.default_rng(3)
    truth = np.stack([random.normal(0.0, 5.0, 400), np.zeros(400)], axis=1)
    one, other = (truth + random.normal(0.0, 1.0, truth.shape) for _ in range(2))
    found = common_slope(one, other, np.ones(400))
    assert found[:, 0] == pytest.approx(truth[:, 0], abs=4.0)
    # of a mean square of 0.5 the share of chance in 400 bands is a tenth
    assert np.mean(found[:, 1] ** 2) < 0.03


def test_stretches_are_put_together_by_speed() -> None:
    levels = np.zeros((2, 4))
    received = [StretchLevels(speed, levels) for speed in (19.0, 19.2, 19.1, 12.0, 12.1, 7.0)]
    rides = rides_of(received)
    assert [round(each.shaft_frequency, 1) for each in rides] == [19.1, 12.1]
    assert [len(each.levels) for each in rides] == [3, 2]


def test_ends_and_scales_hold_the_base_value() -> None:
    for name, base in BASES.items():
        unknown = BY_NAME[name]
        low, high = unknown.ends(base)
        assert low < base < high
        assert unknown.restored(unknown.scaled(base)) == pytest.approx(base)
