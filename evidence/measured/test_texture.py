"""Quantities of texture on signals whose truth is known, and tables of recordings with mistakes."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.config import load_plate
from evidence.measured.own_records import measure_table
from evidence.measured.texture_quantities import (
    measure,
    measure_line,
    measure_octaves,
    measure_ring_down,
    measure_wander,
    shares_of,
)

RATE, SHAFT, ORDER = 25_600.0, 8.65, 8.3
COUNT = round(6.0 * RATE)
ANGLE: Float = np.asarray(2.0 * np.pi * SHAFT * np.arange(COUNT) / RATE, np.float64)


def noise(seed: int = 1) -> Float:
    return np.random.default_rng(seed).standard_normal(COUNT)


def strikes(wander: float, damping: float, resonance: float = 7000.0, seed: int = 2) -> Float:
    """Strikes at `ORDER` whose period spreads by a share, each of which rings."""
    random = np.random.default_rng(seed)
    period = 1.0 / (ORDER * SHAFT)
    when = np.cumsum(period * random.normal(1.0, wander, int(6.0 / period) - 8))
    impulse = np.zeros(COUNT)
    impulse[np.round(when * RATE).astype(int)] = random.normal(1.0, 0.2, len(when))
    lag = np.arange(2048) / RATE
    rate = 2.0 * np.pi * resonance
    return np.convolve(impulse, np.exp(-damping * rate * lag) * np.sin(rate * lag))[:COUNT]


def test_a_modulation_depth_of_0_3_is_found_as_0_3() -> None:
    found = measure_line(noise() * (1.0 + 0.3 * np.cos(ORDER * ANGLE)), RATE, ANGLE, 1.01 * ORDER)
    assert found.depth == pytest.approx(0.3, abs=0.03)
    assert found.order == pytest.approx(ORDER, rel=1e-3)
    assert found.level > 20.0


def test_noise_has_hardly_a_depth_and_short_strikes_nearly_two() -> None:
    assert measure_line(noise(), RATE, ANGLE, ORDER).depth < 0.06
    assert 1.5 < measure_line(strikes(0.0, 0.03, 4500.0), RATE, ANGLE, ORDER).depth < 2.0


@pytest.mark.parametrize(("damping", "resonance"), [(0.01, 7000.0), (0.02, 7000.0), (0.0125, 5000.0)])
def test_ring_down_of_a_known_damping_is_found_within_20_percent(damping: float, resonance: float) -> None:
    struck = strikes(0.01, damping, resonance)
    signal = struck + 0.1 * struck.std() * noise()
    found = measure_ring_down(signal, RATE)
    assert found.frequency == pytest.approx(resonance, rel=0.01)
    assert found.time == pytest.approx(1.0 / (2.0 * np.pi * damping * resonance), rel=0.2)


def test_a_tone_is_no_resonance_and_noise_does_not_ring() -> None:
    struck = strikes(0.01, 0.01)
    tone = 3.0 * struck.std() * np.sin(2.0 * np.pi * 10_000.0 * np.arange(COUNT) / RATE)
    assert measure_ring_down(struck + tone, RATE).frequency == pytest.approx(7000.0, rel=0.01)
    assert measure_ring_down(noise(), RATE).time < 0.5e-3


def test_an_echo_of_each_strike_does_not_lengthen_the_ring_down() -> None:
    """It interferes with the strike that still rings, so that the ring-down comes out up to 40 % shorter."""
    struck, true = strikes(0.01, 0.0125, 5300.0), 1.0 / (2.0 * np.pi * 0.0125 * 5300.0)
    found = measure_ring_down(struck + 0.7 * np.roll(struck, round(2.4e-3 * RATE)), RATE)
    assert 0.6 * true < found.time < 1.1 * true


def test_octave_shares_sum_to_one_and_white_noise_has_them_by_width() -> None:
    octaves = measure_octaves(noise(), RATE)
    shares = shares_of(octaves.levels)
    assert shares.sum() == pytest.approx(1.0)
    assert shares == pytest.approx(np.array([0.5, 1.0, 2.0, 4.0, 4.0]) / 11.5, rel=0.05)
    assert octaves.levels[2] == pytest.approx(math.sqrt(2000.0 / (0.5 * RATE)), rel=0.02)
    assert octaves.above == pytest.approx(np.linalg.norm(octaves.levels[3:]))


def test_octaves_beyond_the_sampling_rate_have_no_number() -> None:
    octaves = measure_octaves(noise(), 12_000.0)
    assert np.isnan(octaves.levels).tolist() == [False, False, False, True, True]
    assert math.isnan(octaves.above)
    assert np.nansum(shares_of(octaves.levels)) == pytest.approx(1.0)


def test_a_wander_of_half_a_percent_is_found() -> None:
    found = []
    for seed in range(6):
        struck = strikes(0.005, 0.02, 4500.0, seed)
        found.append(measure_wander(struck + 0.3 * struck.std() * noise(seed), RATE, ANGLE, ORDER))
    assert np.median(found) == pytest.approx(0.005, rel=0.25)
    struck = strikes(0.0, 0.02, 4500.0)
    assert measure_wander(struck + 0.3 * struck.std() * noise(), RATE, ANGLE, ORDER) < 0.001


def test_the_phase_of_a_line_that_is_not_clear_is_not_followed() -> None:
    assert math.isnan(measure(noise(), RATE, ANGLE, ORDER).wander)
    found = measure(strikes(0.005, 0.02, 4500.0) + 9.81, RATE, ANGLE, ORDER)
    assert 0.0 < found.wander < 0.02
    assert found.kurtosis > 10.0


def test_a_table_of_own_records_is_refused_with_every_mistake(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    table.write_text(
        "file,condition,bearing,speed_kmh,rpm,wheel_diameter_mm,unit,channel\n"
        "absent.csv,cupp,6205,90,,,g,\n"
        "short.csv,cup,nothing,-3,,920,g,\n"
        "short.csv,cup,6205,,1800,,furlong,acc\n"
        "short.csv,cup,6205,,1800,,g,acc\n",
        encoding="utf-8",
    )
    rows = "\n".join(f"{step / 1000:.3f},{step % 7 / 10}" for step in range(200))
    (tmp_path / "short.csv").write_text(f"time_s,acc\n{rows}\n", encoding="utf-8")
    with pytest.raises(InputError) as refused:
        measure_table(table)
    problems = refused.value.problems
    for row, word in (
        (2, "no such file"), (2, "'cupp'"), (2, "the speed is missing"), (3, "'nothing'"), (3, "'-3'"),
        (4, "furlong"), (5, "at least 25"),
    ):  # fmt: skip
        assert any(f"row {row}:" in problem and word in problem for problem in problems), (row, word)


def test_a_table_without_its_columns_is_refused(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    table.write_text("file,bearing,colour\na.csv,6205,red\n", encoding="utf-8")
    with pytest.raises(InputError) as refused:
        measure_table(table)
    assert [problem.split(": ")[1].split(";")[0] for problem in refused.value.problems] == [
        "colour is no column",
        "the column condition is missing",
    ]


def test_an_own_record_is_measured_by_its_bearing_and_speed(tmp_path: Path) -> None:
    order, turns = load_plate("6205").frequencies.bpfo, 20.0
    time = np.arange(round(3.0 * 20_000)) / 20_000
    carrier = np.random.default_rng(4).standard_normal(len(time))
    signal = carrier * (1.0 + 0.3 * np.cos(2.0 * np.pi * order * turns * time))
    cells = "\n".join(f"{when:.6f},{value:.6f}" for when, value in zip(time, signal, strict=True))
    (tmp_path / "own.csv").write_text(f"time_s,acc\n{cells}\n", encoding="utf-8")
    table = tmp_path / "table.csv"
    table.write_text(
        "file,condition,bearing,speed_kmh,wheel_diameter_mm,unit,channel\n"
        f"own.csv,cup,6205,{3.6 * math.pi * 0.92 * turns},920,g,acc\n",
        encoding="utf-8",
    )
    ((record, found),) = measure_table(table)
    assert record.part == "cup"
    assert found.depth == pytest.approx(0.3, abs=0.04)
    assert found.levels[0] == pytest.approx(9.80665 * math.sqrt(500.0 / 10_000.0 * 1.045), rel=0.05)
