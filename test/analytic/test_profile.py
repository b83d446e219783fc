"""Generator profiles: symmetry, limits, closed forms; what the laminae of a line carry of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.life import edge_concentration
from beardyn_core.bearing.profile import PROFILE_KINDS, Profile
from beardyn_core.config import load_bearing
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.lamina_table import lamina_pressure
from test.analytic.line_load import line_load

HALF, DIAMETER, MODULUS = 25.0e-3, 26.7e-3, 226.4e9
HS = load_bearing("HS130x230")
SCALE = 0.5 * DIAMETER * (1.0e9 / (0.5 * MODULUS)) ** 2  # q / (pi E*) at 1 GPa, [m]


def profile(kind: str) -> Profile:
    pressure = 0.0 if kind in ("straight", "crowned") else 1.0e9
    return Profile(kind, drop=12.0e-6, design_pressure=pressure, crowned_share=0.6)


def drop(kind: str, share: object, half: float = HALF) -> np.ndarray:
    return profile(kind).drop_at(np.asarray(share) * half, half, DIAMETER, MODULUS)


@pytest.mark.parametrize("kind", PROFILE_KINDS)
@given(first=st.floats(0.0, 1.0), second=st.floats(0.0, 1.0))
def test_drop_is_even_never_negative_and_grows_outwards(kind: str, first: float, second: float) -> None:
    near, far = sorted((first, second))
    assert drop(kind, near) == drop(kind, -near)
    assert 0.0 <= drop(kind, near) <= drop(kind, far) < 1e-3
    assert drop(kind, 0.0) == 0.0


@pytest.mark.parametrize("kind", PROFILE_KINDS)
def test_drop_is_proportional_to_all_lengths(kind: str) -> None:
    """A roller twice as large in every way, end drop included, is the same shape."""
    share = np.linspace(-1.0, 1.0, 41)
    shape = profile(kind)
    small = shape.drop_at(share * HALF, HALF, DIAMETER, MODULUS)
    larger = replace(shape, drop=2.0 * (shape.drop or 0.0))
    large = larger.drop_at(share * 2.0 * HALF, 2.0 * HALF, 2.0 * DIAMETER, MODULUS)
    np.testing.assert_allclose(large, 2.0 * small, rtol=1e-12)


def test_lundberg_is_its_own_formula_by_pressure_and_by_load() -> None:
    share = np.array([0.0, 0.5, 0.9, 0.99])
    expected = -SCALE * np.log(1.0 - share**2)
    np.testing.assert_allclose(drop("lundberg", share), expected, rtol=1e-12)
    np.testing.assert_array_equal(drop("logarithmic", share), drop("lundberg", share))
    load = math.pi * 0.5 * DIAMETER * (1.0e9) ** 2 / (0.5 * MODULUS) * 2.0 * HALF
    by_load = Profile("lundberg", design_load=load).drop_at(share * HALF, HALF, DIAMETER, MODULUS)
    np.testing.assert_allclose(by_load, expected, rtol=1e-12)


def test_johns_gohar_is_lundberg_in_the_middle_and_finite_at_the_end() -> None:
    np.testing.assert_allclose(drop("johns_gohar", 0.5), drop("lundberg", 0.5), rtol=5e-3)
    half_width = DIAMETER * 1.0e9 / (0.5 * MODULUS)  # Hertz at the design pressure, 2 R p0 / E*
    end = SCALE * math.log(1.0 / (0.3033 * half_width / HALF))
    assert drop("johns_gohar", 1.0) == pytest.approx(end, rel=1e-9)
    assert drop("johns_gohar", 0.999) < drop("lundberg", 0.999)


def test_fujiwara_has_its_end_drop_a_straight_middle_and_lundberg_as_a_limit() -> None:
    assert drop("fujiwara", 1.0) == pytest.approx(12.0e-6, rel=1e-12)
    np.testing.assert_array_equal(drop("fujiwara", [0.0, 0.2, 0.4 - 1e-12]), 0.0)
    assert drop("fujiwara", 0.5) > 0.0
    deep = Profile("fujiwara", drop=1.0, design_pressure=1.0e9)
    share = np.array([0.3, 0.9, 0.99])
    np.testing.assert_allclose(
        deep.drop_at(share * HALF, HALF, DIAMETER, MODULUS), drop("lundberg", share), rtol=1e-12
    )
    twice = Profile("fujiwara", drop=1.0, design_pressure=1.0e9, load_factor=2.0)
    np.testing.assert_allclose(
        twice.drop_at(share * HALF, HALF, DIAMETER, MODULUS), 2.0 * drop("lundberg", share), rtol=1e-12
    )


def test_profile_of_a_long_roller_by_iso_has_a_straight_middle() -> None:
    """Beyond 2.5 diameters: 0 for |2x| below L - 2.5 D, then 0.0005 D ln(...)."""
    half = 2.0 * DIAMETER
    flat = (2.0 * half - 2.5 * DIAMETER) / (2.0 * half)
    iso = Profile("iso_16281")
    np.testing.assert_array_equal(iso.drop_at(np.array([0.0, 0.5, 0.999]) * flat * half, half, DIAMETER), 0.0)
    x = 0.45 * 2.0 * half
    beyond = (2.0 * x - (2.0 * half - 2.5 * DIAMETER)) / (2.5 * DIAMETER)
    expected = 0.0005 * DIAMETER * math.log(1.0 / (1.0 - beyond**2))
    assert iso.drop_at(x, half, DIAMETER) == pytest.approx(expected, rel=1e-12)


def test_design_pressure_scales_the_profile_of_iso_by_its_square() -> None:
    ends = [
        float(Profile("iso_16281", design_pressure=p).drop_at(0.9 * HALF, HALF, DIAMETER, MODULUS))
        for p in (1.0e9, 2.0e9)
    ]
    assert ends[1] == pytest.approx(4.0 * ends[0], rel=1e-12)
    assert ends[0] == pytest.approx(float(drop("lundberg", 0.9)), rel=1e-12)


@pytest.mark.parametrize("kind", PROFILE_KINDS)
@pytest.mark.parametrize("count", [1, 6, 20, 40])
def test_drop_of_a_lamina_is_its_mean(kind: str, count: int) -> None:
    """Against a sum over 1e5 points a lamina; the kink where a straight middle ends costs 0.05 %."""
    shape = profile(kind)
    found = shape.lamina_drop(count, 2.0 * HALF, DIAMETER, MODULUS)
    points = 100_000
    x = ((np.arange(count * points) + 0.5) / (count * points) - 0.5) * 2.0 * HALF
    mean = shape.drop_at(x, HALF, DIAMETER, MODULUS).reshape(count, points).mean(axis=1)
    np.testing.assert_allclose(found, mean, rtol=5e-4, atol=1e-12)
    np.testing.assert_allclose(found, found[::-1], rtol=1e-12)


def test_middle_of_the_last_lamina_would_miss_much_of_its_drop() -> None:
    """Why the mean: mean of ln(1/(1-s^2)) over the last eighth is 1.758, at its middle 1.451."""
    mean = profile("lundberg").lamina_drop(8, 2.0 * HALF, DIAMETER, MODULUS)[-1]
    middle = float(drop("lundberg", 0.875))
    assert mean / SCALE == pytest.approx(4.0 * _antiderivative(0.75, 1.0), rel=1e-4)
    assert middle / mean == pytest.approx(1.451 / 1.758, abs=1e-3)


def _antiderivative(start: float, end: float) -> float:
    """Integral of ln(1/(1 - s^2)) = -[(1+s) ln(1+s) - (1-s) ln(1-s) - 2 s]."""

    def at(s: float) -> float:
        rest = (1.0 - s) * math.log(1.0 - s) if s < 1.0 else 0.0
        return -((1.0 + s) * math.log(1.0 + s) - rest - 2.0 * s)

    return at(end) - at(start)


def test_unknown_profile_is_named() -> None:
    with pytest.raises(ValueError, match="'conical'; allowed are straight, crowned"):
        Profile("conical").drop_at(0.0, HALF, DIAMETER)


# --- load along the roller


@pytest.mark.parametrize("coupling", [None, LaminaCoupling()])
@pytest.mark.parametrize("kind", ["straight", "iso_16281", "fujiwara"])
def test_line_carries_its_load_and_turns_with_its_tilt(kind: str, coupling: LaminaCoupling | None) -> None:
    bearing = replace(HS, profile=profile(kind))
    up, aligned, down = (line_load(bearing, 1.0e4, tilt, coupling=coupling) for tilt in (1e-4, 0.0, -1e-4))
    pitch = bearing.effective_length / 30
    for line in (up, aligned, down):
        assert line.load_per_length.sum() * pitch == pytest.approx(1.0e4, rel=1e-9)
        assert line.moment == pytest.approx(
            float(line.load_per_length @ line.place) * pitch, rel=1e-9, abs=1e-9
        )
    assert up.moment > 1.0
    assert aligned.moment == pytest.approx(0.0, abs=1e-6)
    assert up.moment == pytest.approx(-down.moment, rel=1e-6)


def test_straight_aligned_line_without_coupling_is_loaded_evenly_at_the_hertz_pressure() -> None:
    """Derived: 787 MPa at 9.8 kN with the roller's radius; a cup is flatter, a cone more curved."""
    pressures = [line_load(HS, 9.8e3, ring=ring).pressure.mean() for ring in ("cup", "cone")]
    line = line_load(HS, 9.8e3)
    np.testing.assert_allclose(line.load_per_length, 9.8e3 / HS.effective_length, rtol=1e-9)
    assert pressures[0] < pressures[1]
    factor = line_contact_factor(HS.material, HS.effective_length)
    assert line.approach == pytest.approx((9.8e3 / factor) ** 0.9, rel=1e-9)


def test_tilted_straight_roller_is_pressed_on_its_edge() -> None:
    tilted = line_load(HS, 1.0e4, 1.0e-3)
    assert tilted.load_per_length[0] == 0.0
    assert tilted.load_per_length[-1] == tilted.load_per_length.max() > 4.0e5
    assert tilted.pressure.max() > 1.2e9


def test_pressure_of_lamina_loads_of_a_whole_bearing_keeps_its_shape() -> None:
    load = np.full((2, 17, 6), 9.8e3 / 6)
    pressure = lamina_pressure(HS, load, "cup")
    assert pressure.shape == load.shape
    np.testing.assert_allclose(
        pressure[0, 0], line_load(HS, 9.8e3, laminae=6).pressure, rtol=1e-9
    )  # fmt: skip


# --- stress concentration of rating life


@pytest.mark.parametrize("count", [2, 3, 30, 31])
def test_edge_concentration_is_even_largest_at_the_ends_and_one_in_the_middle(count: int) -> None:
    factor = edge_concentration(count)
    np.testing.assert_allclose(factor, factor[::-1], rtol=1e-12)
    assert factor[0] == pytest.approx(1.0 - 0.01 / math.log(0.9925), rel=1e-12)
    assert np.all(np.diff(factor[: (count + 1) // 2]) <= 0.0)
    assert np.all(factor >= 1.0)
    if count % 2:
        assert factor[count // 2] == 1.0


def test_one_lamina_has_no_ends() -> None:
    with pytest.raises(ValueError, match="at least 2"):
        edge_concentration(1)
