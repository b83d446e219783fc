"""Each step of the monitoring chain against signals whose answer is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binomtest

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.monitor.chain import REFERENCE, Band, Chain, MonitorSettings, Stretch, algorithm_named
from beardyn_core.monitor.chain.false_alarm_rate import evidence, trimmed_tail
from beardyn_core.monitor.chain.fault_lines import FaultLines, comb_score
from beardyn_core.monitor.chain.kurtogram import by_kurtogram, fast_kurtogram
from beardyn_core.monitor.chain.levels import levels_of, rise
from beardyn_core.monitor.chain.verdict import Verdict, strongest_pattern, temperature_state
from beardyn_core.monitor.chain.wheel import SECTORS, struck_sectors, without_wheel
from beardyn_core.monitor.chain.whitening import by_cepstrum, not_whitened
from beardyn_core.monitor.features import analytic_band, order_spectrum
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_stretch


def _with_flat(
    stretch: Stretch, resonance: float = 2400.0, by_rollers: float = 0.0, decay_rate: float = 800.0
) -> Stretch:
    """A strike once a revolution through a resonance [Hz] that decays [1/s], ten times the noise.

    ``by_rollers``: how much louder and quieter it is as the rollers stand.
    """
    revolution = stretch.shaft_angle / (2.0 * np.pi)
    strikes = np.zeros(len(revolution))
    turned = np.arange(0.3, revolution[-1], 1.0)
    loudness = 1.0 + by_rollers * np.cos(2.0 * np.pi * ORDERS.bpfi * turned)
    strikes[np.searchsorted(revolution, turned)] = loudness
    decay = np.arange(round(200 * 800.0 / decay_rate)) / RATE
    ringing = 100.0 * np.exp(-decay_rate * decay) * np.sin(2.0 * np.pi * resonance * decay)
    added = np.convolve(strikes, ringing)[: len(strikes), None] * [0.3, 0.1, 1.0]
    return replace(stretch, acceleration=stretch.acceleration + added)


@pytest.mark.parametrize("fault", ["cup", "cone", "roller"])
def test_kurtogram_finds_the_resonance_that_the_fault_excites(fault: str) -> None:
    band = by_kurtogram(fault_stretch(fault, 20), SETTINGS)
    assert band.low < 4500.0 < band.high
    assert band.high - band.low < 5000.0
    assert band.kurtosis > 5.0 * band.scatter


def test_kurtosis_of_noise_is_zero_within_its_scatter_however_the_axes_correlate() -> None:
    noise = np.random.default_rng(3).normal(size=(50_000, 3)) @ np.array(
        [[1, 0.9, 0], [0, 1, 0.5], [0, 0, 2]]
    )
    angle = np.asarray(2.0 * np.pi * 19.0 * np.arange(50_000) / RATE, np.float64)
    bands = fast_kurtogram(Stretch(RATE, noise, angle, 0.0, 0), 1500.0, SETTINGS)
    assert len(bands) > 10
    assert all(abs(band.kurtosis) < 5.0 * band.scatter for band in bands)
    assert by_kurtogram(Stretch(RATE, noise, angle, 0.0, 0), SETTINGS) == Band(*SETTINGS.band)


def test_strikes_of_a_flat_are_told_from_a_spalled_cone() -> None:
    flat = struck_sectors(_with_flat(fault_stretch(None, 21)), SETTINGS)
    assert flat[int(0.3 * SECTORS)]
    assert 1 <= flat.sum() < SECTORS // 4
    for fault in (None, "cup", "cone", "roller"):
        assert not struck_sectors(fault_stretch(fault, 21), SETTINGS).any()


def test_a_flat_that_rings_for_long_is_found_whichever_way_time_runs() -> None:
    stretch = _with_flat(fault_stretch(None, 21), decay_rate=200.0)
    struck = struck_sectors(stretch, SETTINGS)
    back = replace(
        stretch,
        acceleration=stretch.acceleration[::-1].copy(),
        shaft_angle=stretch.shaft_angle[-1] - stretch.shaft_angle[::-1],
    )
    found = struck_sectors(back, SETTINGS)
    assert struck.sum() > 10
    assert abs(int(found.sum()) - int(struck.sum())) <= 2


def test_a_load_zone_that_a_wide_spall_fills_is_no_strike_of_the_wheel() -> None:
    turned = np.arange(int(40.0 * RATE / 15.0)) * 15.0 / RATE
    loud = 1.0 + 5.0 * np.maximum(0.0, np.cos(2.0 * np.pi * turned)) ** 2
    angle = np.asarray(2.0 * np.pi * turned, np.float64)
    noise = np.random.default_rng(4).normal(size=len(turned))
    assert not struck_sectors(Stretch(RATE, loud * noise, angle, 0.0, 0), SETTINGS).any()
    at_once = 1.0 + 5.0 * ((turned + 0.02) % 1.0 < 0.04)
    struck = struck_sectors(Stretch(RATE, at_once * noise, angle, 0.0, 0), SETTINGS)
    assert struck[[0, -1]].all()


def test_what_comes_back_with_the_shaft_is_taken_out_and_a_fault_stays() -> None:
    turned = np.arange(50 * 256) / 256
    wheel = 5.0 + 3.0 * np.cos(2.0 * np.pi * 20.0 * turned) + (turned % 1.0 < 0.1)
    fault = np.cos(2.0 * np.pi * ORDERS.bpfo * turned)
    rest = without_wheel((wheel + fault).reshape(50, 256), np.zeros(SECTORS, dtype=bool)).reshape(-1)
    assert np.std(rest - fault) < 0.15


@pytest.mark.parametrize("seed", range(5))
def test_a_flat_wheel_raises_no_alarm_and_hides_no_spall(seed: int) -> None:
    healthy = REFERENCE(_with_flat(fault_stretch(None, 30 + seed)), ORDERS, ROLLERS, SETTINGS)
    assert healthy.verdict == "healthy", healthy.reason
    assert healthy.crest > 10.0  # it is anything but quiet
    spalled = REFERENCE(_with_flat(fault_stretch("cup", 30 + seed)), ORDERS, ROLLERS, SETTINGS)
    assert spalled.verdict == "cup", spalled.reason


@pytest.mark.parametrize("resonance", [2400.0, 4800.0, 8000.0, 11_000.0])
def test_strikes_as_loud_as_the_rollers_let_them_be_are_no_fault(resonance: float) -> None:
    stretch = _with_flat(fault_stretch(None, 36), resonance, by_rollers=0.7)
    assert struck_sectors(stretch, SETTINGS)[int(0.3 * SECTORS)]
    found = REFERENCE(stretch, ORDERS, ROLLERS, SETTINGS)
    assert found.verdict == "healthy", found.reason
    assert max(found.scores) < found.threshold


def test_a_stretch_cut_off_in_a_strike_is_received_like_any_other() -> None:
    whole = fault_stretch(None, 51, noise=0.01)
    last = np.clip(np.arange(len(whole.shaft_angle)) - len(whole.shaft_angle) + 0.02 * RATE, 0.0, None)
    cut = replace(whole, acceleration=whole.acceleration + 0.4 * last[:, None])  # up to 200 m/s² within 20 ms
    assert by_kurtogram(cut, SETTINGS) == by_kurtogram(whole, SETTINGS) == Band(*SETTINGS.band)
    levels, usual = (REFERENCE(stretch, ORDERS, ROLLERS, SETTINGS) for stretch in (cut, whole))
    assert levels.rms == pytest.approx(usual.rms, rel=1e-3)
    assert levels.crest == pytest.approx(usual.crest, rel=1e-2)


def test_strikes_of_the_wheel_do_not_make_a_fault_shallow() -> None:
    depths = []

    def decide(found: FaultLines, stretch: Stretch, settings: MonitorSettings) -> Verdict:
        depths.append(found.candidates[0].strikes)
        return strongest_pattern(found, stretch, settings)

    listening = Chain(select_band=lambda stretch, settings: Band(1600.0, 6400.0), decide=decide)
    for stretch in (fault_stretch("cup", 52), _with_flat(fault_stretch("cup", 52))):
        assert listening(stretch, ORDERS, ROLLERS, SETTINGS).verdict == "cup"
    assert depths[1] == pytest.approx(depths[0], rel=0.15)


@pytest.mark.parametrize("lines", [5, 15])
def test_tail_of_the_trimmed_sum_is_that_of_drawn_exponentials(lines: int) -> None:
    drawn = np.random.default_rng(1).exponential(size=(200_000, lines))
    trimmed = drawn.sum(axis=1) - drawn.max(axis=1)
    for share in (1e-1, 1e-2, 1e-3):
        # the quantile of 200 and more draws scatters by 7 %
        assert trimmed_tail(float(np.quantile(trimmed, 1.0 - share)), lines) == pytest.approx(share, rel=0.3)


@pytest.mark.parametrize("revolutions", [15, 60])
def test_false_alarms_in_noise_stay_below_the_stated_rate(revolutions: int) -> None:
    """Upper 99.9 % limit; the statistic knows nothing of these draws."""
    settings = MonitorSettings(samples_per_revolution=128, false_alarm_rate=0.1)
    random = np.random.default_rng(revolutions)
    alarms = 0
    for _ in range(200):
        found = comb_score(random.exponential(size=revolutions * 128), ORDERS, ROLLERS, 19.0, settings)
        alarms += any(candidate.score >= candidate.threshold for candidate in found.candidates)
    assert binomtest(alarms, 200, 0.1, alternative="greater").pvalue > 1e-3


def test_threshold_rises_as_the_stated_rate_falls() -> None:
    tracked = np.random.default_rng(0).exponential(size=30 * 128)
    thresholds = []
    for rate in (1e-2, 1e-4, 1e-6):
        settings = MonitorSettings(samples_per_revolution=128, false_alarm_rate=rate)
        found = comb_score(tracked, ORDERS, ROLLERS, 19.0, settings)
        thresholds.append([candidate.threshold for candidate in found.candidates])
    assert (np.diff(thresholds, axis=0) > 0.5).all()


def test_evidence_goes_on_where_the_tail_is_no_number_any_more() -> None:
    assert trimmed_tail(2e3, 5) == 0.0
    sure, surer = evidence(2e3, 5, 1.0), evidence(4e3, 5, 1.0)
    # far out the largest mean of the sum rules: 4 of 5
    assert (surer - sure) / 2e3 == pytest.approx(1.0 / 0.8, rel=1e-2)
    assert np.isfinite(evidence(1e12, 15, 100.0))
    assert evidence(20.0, 5, 100.0) == pytest.approx(-np.log(100.0 * trimmed_tail(20.0, 5)))
    assert evidence(3.0, 5, 1.0) == -np.inf


def test_a_loud_tone_and_a_loud_resonance_hide_no_fault() -> None:
    stretch = fault_stretch("cup", 44)
    time = np.arange(len(stretch.shaft_angle)) / RATE
    humming = np.random.default_rng(1).normal(size=(len(time), 3))
    pole = 0.995 * np.exp(2j * np.pi * 8000.0 / RATE)
    humming = lfilter([1.0], [1.0, -2.0 * pole.real, abs(pole) ** 2], humming, axis=0)
    tone = 500.0 * np.sin(2.0 * np.pi * 3000.0 * time)[:, None]
    loud = replace(stretch, acceleration=stretch.acceleration + 3.0 * humming + tone)
    assert REFERENCE(loud, ORDERS, ROLLERS, SETTINGS).verdict == "cup"
    deaf = Chain(whiten=not_whitened)
    assert deaf(loud, ORDERS, ROLLERS, SETTINGS).verdict == "healthy"


def test_a_fault_that_strikes_like_clockwork_is_received_as_measured() -> None:
    """Its strikes are tones, which whitening takes away."""
    stretch = fault_stretch(None, 48, noise=0.1)
    passing = ORDERS.bpfo * 19.2
    since = np.mod(np.arange(len(stretch.shaft_angle)) / RATE * passing, 1.0) / passing
    strikes = 60.0 * np.exp(-since / 8e-4) * np.sin(2.0 * np.pi * 3400.0 * since)
    struck = replace(stretch, acceleration=stretch.acceleration + strikes[:, None])
    found = REFERENCE(struck, ORDERS, ROLLERS, SETTINGS)
    assert found.verdict == "cup", found.reason
    assert REFERENCE(stretch, ORDERS, ROLLERS, SETTINGS).verdict == "healthy"


def test_whitening_leaves_every_frequency_of_every_axis_the_same_power() -> None:
    stretch = fault_stretch("cup", 45)
    white = by_cepstrum(replace(stretch, acceleration=stretch.acceleration * [1.0, 1e-3, 1e3]), SETTINGS)
    power = np.mean(white.acceleration**2, axis=0)
    assert power == pytest.approx(np.ones(3), rel=1e-3)
    magnitude = np.abs(np.fft.rfft(white.acceleration, axis=0))[1:-1]
    assert np.ptp(magnitude) < 1e-6 * magnitude.max()


def test_lines_that_another_bearing_explains_better_are_no_fault() -> None:
    turned = np.arange(60 * 1024) / 1024
    noise = np.random.default_rng(6).exponential(size=len(turned))
    own, other = (
        sum(np.cos(2.0 * np.pi * harmonic * order * turned) for harmonic in range(1, 6))
        for order in (ORDERS.bpfo, 4.1)
    )
    verdicts = []
    for beside in (0.0, 0.5):
        found = comb_score(noise + 0.1 * own + beside * other, ORDERS, ROLLERS, 19.0, SETTINGS)
        cup = found.candidates[0]
        assert cup.score > cup.threshold
        verdicts.append(strongest_pattern(found, fault_stretch(None, 46), SETTINGS))
    assert [verdict.name for verdict in verdicts] == ["cup", "unexplained"]
    assert "a comb of order 4.100" in verdicts[1].reason


def test_a_roller_that_strikes_one_race_only_is_its_own_and_no_rival() -> None:
    turned = np.arange(60 * 1024) / 1024
    noise = np.random.default_rng(7).exponential(size=len(turned))
    spin = sum(np.cos(2.0 * np.pi * harmonic * ORDERS.bsf * turned) for harmonic in range(1, 11))
    roller = comb_score(noise + 0.2 * spin, ORDERS, ROLLERS, 19.0, SETTINGS).candidates[2]
    assert roller.score > roller.threshold
    assert roller.rival.evidence < 5.0


def test_a_dead_axis_is_told_and_a_dead_accelerometer_is_no_healthy_bearing() -> None:
    stretch = fault_stretch("cup", 47)
    one = REFERENCE(
        replace(stretch, acceleration=stretch.acceleration * [0.0, 1.0, 1.0]), ORDERS, ROLLERS, SETTINGS
    )
    assert one.verdict == "cup"
    assert one.reason.endswith("dead: axis 1")
    none = REFERENCE(
        replace(stretch, acceleration=np.full((len(stretch.acceleration), 3), 9.8)), ORDERS, ROLLERS, SETTINGS
    )
    assert (none.verdict, none.reason) == (
        "not_diagnosable",
        "the accelerometer is dead: its signal does not change",
    )


@pytest.mark.parametrize(
    ("fault", "spoiled", "verdict", "told"),
    [
        (None, lambda signal: np.round(signal / 20.0) * 20.0, "not_diagnosable", "steps only"),
        (
            None,
            lambda signal: signal.clip(-2.0 * signal.std(), 2.0 * signal.std()),
            "not_diagnosable",
            "the signal is clipped: ",
        ),
        ("cup", lambda signal: np.clip(signal, -30.0, 30.0), "cup", "fault of the outer ring (cup): "),
        (None, lambda signal: signal, "healthy", "no fault: "),
    ],
)
def test_what_may_hide_a_fault_is_not_called_healthy(
    fault: str | None, spoiled: Callable[[Float], Float], verdict: str, told: str
) -> None:
    stretch = fault_stretch(fault, 54)
    found = REFERENCE(replace(stretch, acceleration=spoiled(stretch.acceleration)), ORDERS, ROLLERS, SETTINGS)
    assert found.verdict == verdict, found.reason
    assert told in found.reason


def test_a_rate_that_is_too_low_is_not_diagnosable_and_says_which_is_needed() -> None:
    stretch = replace(fault_stretch("cup", 55), rate=4000.0)
    found = REFERENCE(stretch, ORDERS, ROLLERS, SETTINGS)
    assert found.verdict == "not_diagnosable"
    assert found.reason.startswith("the sampling rate is 4000 Hz; at least 6000 Hz are needed")


def test_one_line_alone_is_no_fault() -> None:
    turned = np.arange(50 * 1024) / 1024
    tracked = np.random.default_rng(2).exponential(size=len(turned)) + 3.0 * np.cos(
        2 * np.pi * ORDERS.bpfo * turned
    )
    found = comb_score(tracked, ORDERS, ROLLERS, 19.0, SETTINGS)
    cup = found.candidates[0]
    assert found.strongest_level > 30.0
    assert cup.score < cup.threshold


def test_a_pattern_that_is_sure_but_shallow_is_no_fault_however_loud_it_is() -> None:
    loud = fault_stretch("cup", 42)
    far = replace(loud, acceleration=1e-3 * loud.acceleration)
    found = REFERENCE(loud, ORDERS, ROLLERS, SETTINGS)
    time = np.arange(len(loud.acceleration)) / RATE
    tones = sum(np.sin(2 * np.pi * frequency * time) for frequency in (2400.0, 4000.0, 9000.0))
    hum = 20.0 * np.std(loud.acceleration) * np.asarray(tones)
    both = replace(loud, acceleration=loud.acceleration + hum[:, None])
    covered = REFERENCE(replace(both, acceleration=1e-3 * both.acceleration), ORDERS, ROLLERS, SETTINGS)
    assert found.verdict == REFERENCE(far, ORDERS, ROLLERS, SETTINGS).verdict == "cup"
    assert covered.score > covered.threshold
    assert covered.verdict == "healthy"
    assert "but it does not strike" in covered.reason
    assert REFERENCE(both, ORDERS, ROLLERS, SETTINGS).verdict == "healthy"


def test_noise_that_swells_as_the_rollers_pass_is_no_fault_and_short_strikes_are() -> None:
    """The same lines, the same share of the power: a hum has them in one harmonic, strikes in many."""
    stretch = fault_stretch(None, 53)
    passing = np.mod(ORDERS.bpfo * stretch.shaft_angle / (2.0 * np.pi), 1.0)
    noise = np.random.default_rng(8).normal(size=stretch.acceleration.shape)
    hum = np.sqrt(1.0 + 0.7 * np.cos(2.0 * np.pi * passing))
    strikes = np.where(passing < 0.08, 3.0, 1.0)
    said = [
        REFERENCE(replace(stretch, acceleration=noise * loud[:, None]), ORDERS, ROLLERS, SETTINGS)
        for loud in (hum, strikes)
    ]
    assert [each.verdict for each in said] == ["healthy", "cup"]
    assert said[0].score > said[0].threshold
    assert "but it does not strike" in said[0].reason


def test_a_single_knock_near_the_end_is_on_no_whole_order() -> None:
    power = np.random.default_rng(4).exponential(size=(40, 1024))
    power[37, 300] += 1e4
    rest = without_wheel(power, np.zeros(SECTORS, dtype=bool)).reshape(-1)
    spectrum = order_spectrum(rest, 1024, 40.0, 3.0)
    at = np.searchsorted(spectrum.order, np.arange(1.0, 40.0) - 1e-9)
    beside = np.searchsorted(spectrum.order, np.arange(1.5, 40.0))
    assert spectrum.amplitude[at].max() < 0.05 * spectrum.amplitude[beside].min()


def test_levels_of_a_sine_and_their_rise() -> None:
    time = np.arange(25_600) / RATE
    signal = np.column_stack([3.0 * np.sin(2 * np.pi * 5000.0 * time), np.zeros(25_600)])
    levels = levels_of(analytic_band(signal, RATE, (2000.0, 10_000.0)).real, 19.0)
    assert levels.rms == pytest.approx(3.0 / np.sqrt(2.0), rel=1e-3)
    assert levels.crest == pytest.approx(np.sqrt(2.0), rel=1e-2)
    assert levels.kurtosis == pytest.approx(1.5, rel=1e-2)
    half = replace(levels, rms=0.5 * levels.rms)
    slow = replace(levels, rms=9.0, shaft_frequency=10.0)
    assert rise(levels, [half, half, half, slow, slow]) == pytest.approx(6.02, abs=0.01)
    assert np.isnan(rise(levels, [half, half, slow]))


@pytest.mark.parametrize(
    ("celsius", "kelvin_a_minute", "state"),
    [
        (np.nan, np.nan, "unknown"),
        (50.0, np.nan, "normal"),
        (50.0, 9.0, "normal"),  # it warms up
        (89.9, 4.9, "normal"),
        (65.0, 5.1, "hot"),
        (90.1, 0.0, "warm"),
        (120.1, 0.0, "hot"),
    ],
)
def test_temperature_rule(celsius: float, kelvin_a_minute: float, state: str) -> None:
    assert temperature_state(celsius + 273.15, kelvin_a_minute / 60.0, SETTINGS) == state


def test_a_hot_box_is_called_beside_the_lines() -> None:
    hot = replace(fault_stretch(None, 40), temperature=400.0, heating=0.1)
    assert REFERENCE(hot, ORDERS, ROLLERS, SETTINGS).verdict == "hot_box"
    spalled = replace(fault_stretch("cup", 40), temperature=400.0, heating=0.1)
    both = REFERENCE(spalled, ORDERS, ROLLERS, SETTINGS)
    assert (both.verdict, both.temperature_state) == ("cup", "hot")
    assert both.reason.startswith("hot box: 127 °C, rising by 6.0 K a minute; fault of the outer ring (cup)")


def test_a_step_of_ones_own_takes_its_place_in_the_chain() -> None:
    chain = Chain(select_band=lambda stretch, settings: Band(3000.0, 6000.0))
    result = chain(fault_stretch("cup", 41), ORDERS, ROLLERS, SETTINGS)
    assert result.band == (3000.0, 6000.0)
    assert result.verdict == "cup"


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("chain", "write module:function"),
        ("no_such_module:chain", "there is no module no_such_module"),
        ("json:nothing", "has no nothing"),
        ("json:decoder", "is a module"),
        ("beardyn_core.monitor.chain:Chain", "is a type"),
    ],
)
def test_a_name_that_is_no_algorithm_is_refused(name: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        algorithm_named(name)
    assert algorithm_named("") is REFERENCE
