"""The width of a spall follows from its two events, and is not measurable where there is one."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_any_bearing
from beardyn_core.monitor import streaming
from beardyn_core.monitor.chain import REFERENCE, MonitorResult
from beardyn_core.monitor.severity import ENTRY_AND_EXIT, NOT_MEASURABLE, severity_near, severity_of
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.study.monitored_recording import Finding, conclude

RATE = 25_600.0
PLATE = NamePlate(name="axlebox", roller_count=17, roller_diameter=26.7e-3, pitch_diameter=185e-3)
SPACING = {"cup": np.pi * (185e-3 + 26.7e-3) / 17, "cone": np.pi * (185e-3 - 26.7e-3) / 17}


def _passages(fault, width, speed=19.0, seed=1, seconds=2.0, rolling=0.05):
    """Two strikes a passage, the way of a spall apart, and rolling noise, through three modes."""
    random = np.random.default_rng(seed)
    time = np.arange(int(seconds * RATE)) / RATE
    angle = 2 * np.pi * speed * time
    order = PLATE.frequencies.bpfo if fault == "cup" else PLATE.frequencies.bpfi
    passage = np.arange(1, int(speed * order * seconds) - 1) / (speed * order)
    impulses = np.zeros(len(time))
    ways = [0.0] if width is None else [0.0, (width - ENTRY_AND_EXIT) / SPACING[fault]]
    for way, strength in zip(ways, (0.8, -1.0)[: len(ways)], strict=True):
        at = (passage + way / (speed * order)) * RATE
        whole = at.astype(int)
        np.add.at(impulses, whole, strength * (1.0 - (at - whole)))
        np.add.at(impulses, whole + 1, strength * (at - whole))
    impulses += rolling * random.normal(size=len(time))
    signal = np.zeros(len(time))
    for frequency, damping in ((2300.0, 0.1), (5200.0, 0.08), (8300.0, 0.06)):
        pole = np.exp(2 * np.pi * frequency * (-damping + 1j) / RATE)
        signal += lfilter([1.0], [1.0, -2 * pole.real, abs(pole) ** 2], impulses)
    signal += 0.01 * signal.std() * random.normal(size=len(time))
    return signal[:, None], angle, order


@pytest.mark.parametrize("width", [3e-3, 5e-3, 8e-3, 12e-3])
def test_width_follows_from_entry_and_exit_on_the_cup(width):
    signal, angle, order = _passages("cup", width)
    found = severity_of(signal, RATE, angle, "cup", order, PLATE)
    assert found.low <= width <= found.high
    assert found.width == pytest.approx(width, abs=0.3e-3)
    assert found.grade == ("incipient" if width < 4e-3 else "developed")


def test_of_barrels_no_width_is_stated():
    """Runs of `freight_spherical_cup` gave 2.7 mm for 6 mm: the way is not of a line contact."""
    signal, angle, order = _passages("cup", 5e-3)
    plate = replace(NamePlate.of(load_any_bearing("SRB120x260")), name="barrels")
    assert plate.has_barrels
    alike = {key: getattr(PLATE, key) for key in ("roller_count", "roller_diameter", "pitch_diameter")}
    found = severity_of(signal, RATE, angle, "cup", order, replace(plate, **alike, contact_angle=0.0))
    assert found.grade == NOT_MEASURABLE
    assert "not with barrels" in found.reason
    assert severity_of(signal, RATE, angle, "cup", order, PLATE).grade != NOT_MEASURABLE
    assert not NamePlate.of(load_any_bearing("WJ130x240")).has_barrels


@pytest.mark.parametrize("beyond", [3e-3, 3.75e-3, 4.75e-3, 8e-3, 9.75e-3])
def test_on_the_cone_a_spall_strikes_as_one_wider_by_the_distance_of_two_rollers(beyond):
    # the signals of both are the same, so no number may be given of either
    reasons = []
    for width in (beyond, beyond + SPACING["cone"]):
        signal, angle, order = _passages("cone", width)
        found = severity_of(signal, RATE, angle, "cone", order, PLATE)
        assert found.grade == NOT_MEASURABLE
        assert np.isnan(found.width)
        assert not found.low > width
        reasons.append(found.reason)
    if beyond < 5e-3:  # the second event is clear
        assert all("at least" in each and "29.3 mm, strike alike" in each for each in reasons)


@pytest.mark.parametrize("fault", ["cup", "cone"])
@pytest.mark.parametrize("width", [20e-3, 24e-3, 28e-3, 30e-3, 33e-3, 36e-3, 38e-3, 40e-3])
def test_a_wide_spall_is_never_measured_as_a_narrow_one(fault, width):
    # its exit is followed by the entry of the next roller, as near as the entry of a narrow one lies before
    signal, angle, order = _passages(fault, width)
    found = severity_of(signal, RATE, angle, fault, order, PLATE)
    assert found.grade == NOT_MEASURABLE
    assert not found.low > width
    if np.isfinite(found.low):
        assert "at least" in found.reason


def test_one_event_noise_and_rollers_are_not_measurable():
    signal, angle, order = _passages("cup", None)
    assert severity_of(signal, RATE, angle, "cup", order, PLATE).grade == NOT_MEASURABLE
    bare, angle, order = _passages("cup", None, rolling=0.0)
    assert severity_of(bare, RATE, angle, "cup", order, PLATE).grade == NOT_MEASURABLE
    noise = np.random.default_rng(2).normal(size=signal.shape)
    assert "no second event" in severity_of(noise, RATE, angle, "cup", order, PLATE).reason
    assert "not on roller" in severity_of(signal, RATE, angle, "roller", order, PLATE).reason
    assert "fewer than" in severity_of(signal[:3000], RATE, angle[:3000], "cup", order, PLATE).reason
    small = NamePlate(name="6205", roller_count=9, roller_diameter=7.94e-3, pitch_diameter=39.04e-3)
    assert "elements of 15 mm or more" in severity_of(signal, RATE, angle, "cup", order, small).reason


def _results(fault, width, algorithm=REFERENCE, speed=19.0, seconds=4.0):
    signal, angle, _ = _passages(fault, width, speed=speed, seconds=seconds)
    monitor = Monitor(
        PLATE.frequencies, PLATE.roller_count, RATE, algorithm=algorithm, bearing=PLATE,
    )  # fmt: skip
    time_ns = np.round(np.arange(len(angle)) * (1e9 / RATE)).astype(np.int64)
    none = np.empty(0, np.int64)
    parts = (
        MonitorInput(
            time_ns[here], signal[here], time_ns[here], angle[here], none, np.empty(0), none, np.empty(0)
        )
        for here in (slice(first, first + 5120) for first in range(0, len(angle), 5120))
    )
    return list(run_monitor(monitor, parts))


def test_every_analysis_that_names_a_part_says_how_wide_the_spall_is():
    findings = [Finding.of(each) for each in _results("cup", 6e-3)]
    named = [each for each in findings if each.verdict == "cup"]
    assert len(named) > 3
    for each in named:
        assert each.spall_width == pytest.approx(6e-3, abs=0.4e-3)
        assert each.spall_width_low <= 6e-3 <= each.spall_width_high
        assert each.stage == "developed"
    assert _of_run(findings).spall_width == pytest.approx(6e-3, abs=0.3e-3)


def test_without_a_width_the_reason_is_given():
    for each in (Finding.of(result) for result in _results("cup", None)):
        if each.is_fault:
            assert each.stage == NOT_MEASURABLE
            assert "no second event" in each.stage_reason
            assert np.isnan(each.spall_width)

    def algorithm(stretch, orders, count, settings):
        return MonitorResult("cup", "it is loud", stretch.end_ns)

    finding = Finding.of(_results("cup", 6e-3, algorithm)[-1])
    assert finding.stage == NOT_MEASURABLE
    assert "states no order" in finding.stage_reason


def test_size_and_stage_pass_through_the_topic_unchanged():
    finding = Finding.of(_results("cup", 6e-3)[-1])
    received = Finding.from_diagnostic(finding.to_diagnostic("axlebox/monitor"))
    for name in ("stage", "stage_reason"):
        assert getattr(received, name) == getattr(finding, name) != ""
    for name in ("spall_width", "spall_width_low", "spall_width_high"):
        assert getattr(received, name) == pytest.approx(getattr(finding, name), rel=1e-8)


def _of_run(findings):
    finding = conclude(findings).finding
    assert finding is not None
    return finding


def _sized(width, verdict="cup", time=0.0):
    stage = NOT_MEASURABLE if np.isnan(width) else "developed"
    ends = {"spall_width_low": 0.9 * width, "spall_width_high": 1.1 * width}
    return Finding(verdict, "", time, spall_width=width, **ends, stage=stage, stage_reason=f"{width:g}")


def test_the_spall_of_a_run_is_that_of_middle_width_where_a_third_of_the_analyses_have_one_and_agree():
    widths = (6e-3, 20e-3, np.nan, 5.9e-3, np.nan, np.nan)
    found = _of_run([_sized(each, time=float(at)) for at, each in enumerate(widths)])
    assert (found.time, found.spall_width) == (5.0, 6e-3)
    rare = _of_run([_sized(each) for each in (np.nan, 6e-3, np.nan, np.nan)])
    assert np.isnan(rare.spall_width)
    assert rare.stage == NOT_MEASURABLE
    apart = _of_run([_sized(each) for each in (6e-3, 12e-3, 20e-3, np.nan)])
    assert np.isnan(apart.spall_width)
    other = _of_run([_sized(6e-3, "cone"), _sized(8e-3), _sized(8e-3)])
    assert other.spall_width == 8e-3


def test_the_load_is_that_of_the_analysis_whatever_is_kept_for_the_size():
    signal, angle, _ = _passages("cup", 6e-3, seconds=8.0)
    time_ns = np.round(np.arange(len(angle)) * (1e9 / RATE)).astype(np.int64)
    monitor = Monitor(PLATE.frequencies, PLATE.roller_count, RATE, bearing=PLATE)
    monitor.push_vibration(time_ns, signal)
    monitor.push_shaft(time_ns, angle)
    load_ns = np.arange(0, 8_000_000_000, 2_500_000)
    monitor.push_load(load_ns, np.where(load_ns < 4.5e9, 50e3, 80e3))  # 60 revolutions are 3.2 s
    result = monitor.result()
    assert result.verdict == "cup"
    assert result.load == pytest.approx(80e3)


@pytest.mark.slow
def test_a_size_is_measured_again_on_longer_and_on_new_stretches_alone(monkeypatch):
    counted = []

    def measured(*arguments):
        counted.append(len(arguments[0]))
        return severity_near(*arguments)

    monkeypatch.setattr(streaming, "severity_near", measured)
    named = [each for each in _results("cup", 6e-3, seconds=24.0) if each.verdict == "cup"]
    assert all(each.severity.width == pytest.approx(6e-3, abs=0.4e-3) for each in named[5:])
    assert len(named) > 40
    assert 6 <= len(counted) < 0.4 * len(named)


def test_an_order_with_too_few_samples_in_a_passage_has_no_size():
    def algorithm(stretch, orders, count, settings):
        return MonitorResult("cup", "", stretch.end_ns, fault_order=1e5)

    finding = Finding.of(_results("cup", 6e-3, algorithm)[-1])
    assert "too few samples" in finding.stage_reason
