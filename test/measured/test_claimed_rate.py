"""A claimed rate is read with its unit and place, believed within limits, and refused where two differ."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.measured.claimed_rate import (
    FASTEST,
    SLOWEST,
    Stamps,
    claims_by_path,
    claims_in,
    claims_on,
    decide_rate,
)
from beardyn_core.measured.units import ACCELERATION, TIME, unit_in, usual
from test.examples import examples
from test.measured.files import COUNT, RATE, noise, problems, table

NAMES = (
    "fs", "Sampling Frequency", "sampling_rate", "SampleRate", "Abtastrate", "Abtastfrequenz", "Scan rate",
    "Samples per second", "Fréquence d'échantillonnage", "sr", "SamplingFrequency",
)  # fmt: skip
STEPS = (
    "dt",
    "Sample interval",
    "sampling_period",
    "Abtastintervall",
    "wf_increment",
    "Delta t",
    "time_step",
)
PREFIXES = {"": 1.0, "k": 1e3, "M": 1e6}


def decided(said: dict[str, Any], stamps: Stamps | None = None) -> Any:
    return decide_rate(claims_in(said), stamps, None, name="a", is_vibration=True)


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("Sampling Frequency", "25.6 kHz"), ("Sampling Frequency", "25,6 kHz"), ("Sample rate", "25,600 Hz"),
        ("Sample rate", "25 600"), ("Sample rate", "25\u202f600 Hz"), ("Sample rate", "25'600 Hz"),
        ("Abtastrate", "25.600,0 Hz"), ("Abtastrate", "25.600 Hz"), ("fs", "25.6kS/s"), ("fs", "0.0256 MHz"),
        ("Sampling rate [kHz]", "25.6"), ("fs_kHz", 25.6), ("rate (kS/s)", "25.6"), ("fs", "2.56e4"),
        ("dt", "39.0625 us"), ("dt", "39,0625 µs"), ("Sample interval (ms)", "0.0390625"), ("dt_us", 39.0625),
        ("dt", "39 062.5 ns"), ("Abtastintervall", "0,0390625 ms"), ("fs", "25600 Hz per channel"),
        ("Abtastrate", "25,6;kHz"), ("Sample rate", "25600;25600"), ("fs", "25600 samples/s"),
    ],
)  # fmt: skip
def test_unit_and_thousands_of_a_rate_are_read(name: str, written: Any) -> None:
    assert decided({name: written}).rate == pytest.approx(25_600.0, rel=1e-9)


@pytest.mark.parametrize(
    "written",
    [
        "25.6",
        "25.6 Hz",
        "25.6 furlongs",
        "512.000 Hz",
        "25600;1000",
        "25600,12800",
        "1e12",
        "0",
        "-25600",
        "12 34",
    ],
)
def test_a_rate_that_is_not_understood_or_absurd_is_asked_for(written: str) -> None:
    found = decided({"Sampling rate": written})
    assert not found.rate > 0.0
    assert any("give --rate-hz" in each and f"Sampling rate = {written}" in each for each in found.problems)


@given(
    name=some.sampled_from(NAMES),
    rate=some.integers(200, 9_999_999) | some.integers(1, 9_999).map(lambda thousands: 1000 * thousands),
    prefix=some.sampled_from(sorted(PREFIXES)),
    sign=some.sampled_from([".", ","]), unit=some.sampled_from(["Hz", "S/s"]),
    space=some.sampled_from(["", " "]),
    group=some.sampled_from(["", " ", "'", ".", ",", "\u00a0"]),
)  # fmt: skip
@settings(max_examples=examples(600), deadline=None)
def test_a_written_rate_is_read_or_asked_for_and_never_another(
    name: str, rate: int, prefix: str, sign: str, unit: str, space: str, group: str
) -> None:
    whole, _, part = f"{rate / PREFIXES[prefix]:.9f}".rstrip("0").partition(".")
    grouped = f"{int(whole):,}".replace(",", group) if group != sign else whole
    text = f"{grouped}{sign}{part}" if part else grouped
    found = decided({name: f"{text}{space}{prefix}{unit}"})
    if found.problems:  # only where a point or comma before three digits has two plausible meanings
        assert not found.rate > 0.0
        assert any(mark in text for mark in ".,")
    else:
        assert found.rate == pytest.approx(rate, rel=1e-6)


@given(
    name=some.sampled_from(STEPS), rate=some.floats(SLOWEST * 1.01, FASTEST * 0.99),
    unit=some.sampled_from(["s", "ms", "us", "µs", "ns"]), inside=some.booleans(),
)  # fmt: skip
@settings(max_examples=examples(200), deadline=None)
def test_a_written_step_is_read(name: str, rate: float, unit: str, inside: bool) -> None:
    step = f"{1.0 / rate / TIME[usual(unit)]:.15g}"
    said = {f"{name} [{unit}]": step} if inside else {name: f"{step} {unit}"}
    assert decided(said).rate == pytest.approx(rate, rel=1e-6)


@given(rate=some.floats(1e-9, 1e15), other=some.floats(200.0, 1e7), stamped=some.floats(200.0, 1e7))
@settings(max_examples=examples(300), deadline=None)
def test_no_absurd_rate_is_believed_and_no_conflict_is_decided(
    rate: float, other: float, stamped: float
) -> None:
    alone = decided({"fs": rate})
    assert (alone.rate > 0.0) == (SLOWEST <= rate <= FASTEST) == (not alone.problems)
    both = decided({"fs": other}, Stamps("stamps say", stamped, True, False))
    assert (both.rate > 0.0) == (abs(stamped - other) <= 0.01 * other) == (not both.problems)


@given(
    vibration=some.floats(200.0, 1e6), tacho=some.floats(200.0, 1e6), depth=some.integers(0, 2),
    meta=some.booleans(),
)  # fmt: skip
@settings(max_examples=examples(100), deadline=None)
def test_a_rate_belongs_to_its_own_struct_first(
    vibration: float, tacho: float, depth: int, meta: bool
) -> None:
    inner = ".".join(["vib", *["deep"] * depth])
    place = f"{inner}.info" if meta else inner
    channels = [(*inner.split("."), "acc"), ("tacho", "pulses")]
    claims = claims_by_path({f"{place}.fs": vibration, "tacho.fs": tacho})
    for channel, rate in zip(channels, (vibration, tacho), strict=True):
        own = claims_on(channel, claims, channels)
        assert decide_rate(own, None, None, name="a", is_vibration=True).rate == pytest.approx(rate)
    lonely = claims_on(("other",), claims, [*channels, ("other",)])
    assert lonely == ()  # what stands beside other channels is not its own


def test_two_structs_have_their_own_rates_and_two_claims_from_elsewhere_are_refused(tmp_path: Path) -> None:
    from scipy.io import savemat

    path = tmp_path / "a.mat"
    savemat(path, {"vib": {"acc": noise(), "fs": RATE}, "tacho": {"p": noise(), "fs": 1000.0}})
    assert bd.read_measured(path, channels="z=vib.acc", unit="g").vibration.rate == RATE
    savemat(path, {"acc": noise(), "one": {"fs": RATE}, "two": {"fs": 1000.0}})
    (found,) = problems(path, unit="g")
    assert "states one.fs = 12000 (12000 Hz) and two.fs = 1000 (1000 Hz); give --rate-hz" in found
    savemat(path, {"acc": noise(), "tacho": {"p": noise(), "fs": 1000.0}})
    (found,) = problems(path, channels="z=acc", unit="g")
    assert "does not state the rate at which acc was sampled" in found


def test_a_unit_beside_a_rate_is_read(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["v/az_g"], file["v/fs"] = noise()[:, 0], 12.0
        file["v/fs"].attrs["unit"] = "kHz"
    assert bd.read_measured(tmp_path / "a.h5").vibration.rate == RATE


@pytest.mark.parametrize(
    "head", ["Sampling Frequency: 12 kHz", "Abtastrate;12,0;kHz", "# dt = 83.3333333 us"]
)
def test_a_rate_above_a_table_has_its_unit(head: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        f"{head}\naz [g];ax [g]\n" + "".join(f"{a};{-a}\n" for a in noise()[:, 0]), encoding="utf-8"
    )
    assert bd.read_measured(path).vibration.rate == pytest.approx(RATE, rel=1e-6)


def test_days_of_a_spreadsheet_are_asked_about(tmp_path: Path) -> None:
    days = 46_000.0 + np.arange(COUNT) / RATE / 86_400.0
    path = tmp_path / "a.csv"
    rows = (f"{day:.14f},{value}\n" for day, value in zip(days, noise()[:, 0], strict=True))
    path.write_text("time,az_g\n" + "".join(rows))
    (found,) = problems(path)
    assert "too fast for a vibration; give --time-unit" in found
    assert "d (12000 Hz)" in found
    assert bd.read_measured(path, time_unit="d").vibration.rate == pytest.approx(RATE, rel=1e-6)


def test_a_file_that_claims_one_hertz_does_not_grow(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, a=noise()[:, 0], wf_increment=1.0)
    (found,) = problems(path, unit="g", speed_rpm=1800)
    assert "states wf_increment = 1, which is 1 Hz; the sampling rate of a vibration is 200 Hz to" in found


def test_a_speed_channel_far_longer_or_faster_than_the_vibration_stays_small(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    for step, rpm in ((50.0, 900.0), (0.01, 1e9)):
        with h5py.File(tmp_path / "a.h5", "w") as file:
            file["v/az_g"] = noise()[:, 0]
            file["v"].attrs["fs"] = RATE
            file["s/time"], file["s/n_rpm"] = np.arange(COUNT) * step, np.full(COUNT, rpm)
        if rpm > 1e6:
            (found,) = problems(tmp_path / "a.h5", speed_channel="s.n_rpm")
            assert "allowed is up to 1e+06 rpm: check --speed-unit" in found
        else:  # 83 hours of speed beside half a second of vibration
            run = bd.read_measured(tmp_path / "a.h5", speed_channel="s.n_rpm")
            assert len(run.shaft) < 1000


@given(
    unit=some.sampled_from(sorted(ACCELERATION)), stem=some.from_regex(r"[a-z]{1,6}[xyz]", fullmatch=True),
    way=some.sampled_from(["/", " ", "_", " in ", ", "]),
)  # fmt: skip
@settings(max_examples=examples(200), deadline=None)
def test_a_unit_is_a_whole_word(unit: str, stem: str, way: str) -> None:
    assert unit_in(f"{stem}{way}{unit}", ACCELERATION) == unit


@given(letters=some.from_regex(r"[a-z]{1,3}", fullmatch=True), way=some.sampled_from(["/", " ", "_"]))
@settings(max_examples=examples(200), deadline=None)
def test_what_is_longer_than_a_unit_is_another_one(letters: str, way: str) -> None:
    written = f"{letters}m/s2"
    known = written if written in ACCELERATION else ""
    assert unit_in(f"az{way}{written}", ACCELERATION) == known


@pytest.mark.parametrize(
    ("heading", "factor"),
    [
        ("az/mm/s2", 1e-3), ("az [cm/s^2]", 1e-2), ("az (µg)", 9.80665e-6), ("az_mg", 9.80665e-3),
        ("az dm/s²", 0.1),
        ("az in/s²", 0.0254), ("az/ft/s2", 0.3048), ("az milli-g", 9.80665e-3), ("az_gal", 0.01),
        ("az mm·s⁻²", 1e-3),
        ("az/foo/s2", None), ("az [10 mm/s2]", None), ("az mV/g", None),
        ("az km/s2", None), ("az mm/s", None),
    ],
)  # fmt: skip
def test_units_of_headings_are_known_or_asked_for(heading: str, factor: float | None, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = "".join(f"{k / RATE:.9f};{value}\n" for k, value in enumerate(noise(200)[:, 0]))
    path.write_text(f"time;{heading}\n{rows}", encoding="utf-8")
    if factor is None:
        assert any("give --unit" in each for each in problems(path))
    else:
        sensors = bd.read_measured(path).measured["sensors"]
        assert sensors["accelerometer"]["m_per_s2_per_number"]["z"] == pytest.approx(factor)


def test_unit_rate_and_speed_are_asked_for_at_once(tmp_path: Path) -> None:
    from beardyn_core.measured.options import Reading
    from beardyn_core.measured.survey import survey

    one = table(tmp_path / "a.csv", {"a": noise()[:, 0]})
    two = table(tmp_path / "b.csv", {"a": noise()[:, 0], "b": noise(seed=2)[:, 0]})
    for path, count in ((one, 3), (two, 4)):  # of two columns also which one
        with pytest.raises(bd.InputError) as caught:
            survey([path], Reading(), needs_speed=True)
        text = "\n".join(caught.value.problems)
        assert all(option in text for option in ("--unit", "--rate-hz", "--speed-rpm"))
        assert len(caught.value.problems) == count


@pytest.mark.parametrize("first", [0.0, 7.5])
def test_a_ramp_of_time_is_no_axis(first: float, tmp_path: Path) -> None:
    from scipy.io import savemat

    time = first + np.arange(COUNT) / RATE
    savemat(tmp_path / "a.mat", {"d": np.column_stack([time, noise(axes=3)])})
    run = bd.read_measured(tmp_path / "a.mat", unit="g")
    assert run.vibration.rate == RATE
    np.testing.assert_allclose(run.vibration.values, noise(axes=3) * 9.80665)
    savemat(tmp_path / "a.mat", {"d": np.column_stack([time, noise(axes=2)])})
    (found,) = problems(tmp_path / "a.mat", unit="g")
    assert "does not state which channel is the acceleration" in found
    assert "it has d[1], d[2]" in found


@pytest.mark.parametrize(
    "ramp",
    [np.arange(COUNT), np.arange(COUNT) % 256, -np.arange(COUNT) / RATE, 1000 * np.arange(COUNT) // 12_000],
    ids=["counter", "counter that wraps", "falling", "rounded"],
)
def test_counters_and_other_ramps_are_left_out(ramp: Any, tmp_path: Path) -> None:
    from scipy.io import savemat

    savemat(tmp_path / "a.mat", {"d": np.column_stack([ramp, noise()])})
    run = bd.read_measured(tmp_path / "a.mat", unit="g", rate_Hz=RATE)
    assert run.measured["sensors"]["accelerometer"]["channels"] == {"z": "d[1]"}


def test_a_ramp_in_another_unit_is_asked_about_or_settled_by_the_rate(tmp_path: Path) -> None:
    from scipy.io import savemat

    arrays = {"d": np.column_stack([np.arange(COUNT) * 1e3 / RATE, noise()])}
    savemat(tmp_path / "a.mat", arrays)
    (found,) = problems(tmp_path / "a.mat", unit="g")
    assert "if they are in s, too slow for a vibration; give --time-unit" in found
    assert "ms (12000 Hz)" in found
    savemat(tmp_path / "a.mat", {**arrays, "fs": RATE})
    assert bd.read_measured(tmp_path / "a.mat", unit="g").vibration.rate == RATE


def test_whole_rates_of_wav_files_are_warned_of_where_they_may_be_rounded(tmp_path: Path) -> None:
    soundfile = pytest.importorskip("soundfile")
    for rate in (12_207, 12_000):
        soundfile.write(tmp_path / "a.wav", noise()[:, 0] / 10.0, rate, subtype="DOUBLE")
        if rate % 25:
            with pytest.warns(UserWarning, match="12207 Hz may be rounded by half of one .*give rate_Hz"):
                bd.read_measured(tmp_path / "a.wav", unit="g")
        else:
            assert not bd.read_measured(tmp_path / "a.wav", unit="g").measured["warnings"]


@pytest.mark.parametrize(
    ("stamp", "separator"),
    [
        ("31.01.2026 12:00:{:07.4f}", ","), ("31.01.2026 12:00:{:07.4f}", ";"),
        ("2026-01-31T12:00:{:07.4f}+01:00", ","),
        ("2026-01-31 12:00:{:07.4f}-0530", ","), ("2026/01/31 12:00:{:07.4f} UTC", ","),
        ("1.2.2026 9:00:{:07.4f}", ","),
    ],
)  # fmt: skip
def test_dates_of_other_countries_and_zones_are_read(stamp: str, separator: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = "".join(
        f"{stamp.format(k / 1000.0)}{separator}{value}\n" for k, value in enumerate(noise(3000)[:, 0])
    )
    path.write_text(f"stamp{separator}az_g\n{rows}")
    run = bd.read_measured(path)
    assert run.vibration.rate == 1000.0
    assert len(run.vibration) == 3000
