"""Largest Hertz pressure wherever a roller load is: closed forms, an independent integral, slices, runs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import beardyn_core as bd
from beardyn_core.bearing.contact_law import ExactPointContact, rib_ellipse
from beardyn_core.physics.hertz_pressure import largest_pressure, pressure_law

TAPERED, CYLINDER, BARREL = "HS130x230", "WJ130x240", "SRB120x260"


def line_pressure(bearing: bd.Bearing, load: float, ring: str) -> float:
    """Johnson (1985), Eqs. 4.43 and 4.45, by the half-width: p0 = 2 q / (pi b), b^2 = 4 q R / (pi E*)."""
    roller = bearing.apex_distance * math.tan(bearing.half_angle) / math.cos(bearing.half_angle)
    angle = bearing.cup_angle if ring == "cup" else bearing.cone_angle
    raceway = bearing.contact_distance * math.tan(angle)
    radius = 1.0 / (1.0 / roller + (-1.0 if ring == "cup" else 1.0) / raceway)
    steel = bearing.material
    modulus = 0.5 * steel.youngs_modulus / (1.0 - steel.poisson_ratio**2)
    per_length = load / bearing.effective_length
    return 2.0 * per_length / (math.pi * math.sqrt(4.0 * per_length * radius / (math.pi * modulus)))


@given(st.floats(1.0, 1e6), st.sampled_from(["cup", "cone"]))
def test_a_raceway_has_the_pressure_of_a_line_contact(load: float, ring: str) -> None:
    bearing = bd.bearing(TAPERED)
    found = float(pressure_law(bearing, ring).of(np.array(load)))
    assert found == pytest.approx(line_pressure(bearing, load, ring), rel=1e-9)


def test_a_pressure_carries_its_load() -> None:
    """The half-ellipse of pressure over the band of contact adds up to the load."""
    bearing, load = bd.bearing(TAPERED), 1.0e4
    largest = line_pressure(bearing, load, "cone")
    width = 2.0 * load / bearing.effective_length / (math.pi * largest)
    place = np.linspace(-width, width, 200_001)
    over = largest * np.sqrt(np.maximum(1.0 - (place / width) ** 2, 0.0))
    assert np.trapezoid(over, place) * bearing.effective_length == pytest.approx(load, rel=1e-6)


@given(st.floats(1.0, 1e5))
def test_a_rib_has_the_pressure_of_its_ellipse(load: float) -> None:
    bearing = bd.bearing(TAPERED)
    found = float(pressure_law(bearing, "rib").of(np.array(load)))
    assert found == pytest.approx(rib_ellipse(bearing, load).largest_pressure, rel=1e-9)


def test_what_has_no_pressure_is_not_a_number() -> None:
    assert math.isnan(float(pressure_law(bd.bearing(TAPERED), "pocket").of(np.array(5.0))))
    assert math.isnan(float(pressure_law(bd.bearing(BARREL), "rib").of(np.array(5.0))))


def test_the_statics_of_one_slice_spread_the_load_evenly() -> None:
    bearing, found = bd.bearing(TAPERED), bd.equilibrium(TAPERED, (0, 10, 80))
    for ring, load, pressure in (
        ("cup", found.cup_load, found.cup_pressure),
        ("cone", found.cone_load, found.cone_pressure),
        ("rib", found.rib_load, found.rib_pressure),
    ):
        np.testing.assert_allclose(pressure, pressure_law(bearing, ring).of(load), rtol=1e-9)
    assert found.largest_pressure == found.cone_pressure.max() > found.cup_pressure.max() > 5e8
    assert found.largest_pressure == largest_pressure(bearing, found.cup_load.max(), found.cone_load.max())
    assert f"{found.largest_pressure * 1e-9:.3g} GPa" in repr(found)


def test_slices_show_the_pressure_that_a_profile_adds() -> None:
    bearing = bd.bearing(TAPERED, profile={"kind": "lundberg", "design_pressure_MPa": 700})
    even, sliced = (bd.equilibrium(bearing, 80, laminae=count) for count in (1, 40))
    np.testing.assert_allclose(sliced.cup_load.max(), even.cup_load.max(), rtol=0.05)
    assert sliced.largest_pressure > 1.03 * even.largest_pressure


@pytest.mark.parametrize("load", [20, 80, 160, 210])
@pytest.mark.parametrize(
    "bearing",
    [
        bd.bearing(CYLINDER),
        bd.bearing("WJ120x240"),
        bd.bearing(TAPERED, profile={"kind": "lundberg", "design_pressure_MPa": 2000}),
    ],
    ids=["WJ130x240", "WJ120x240", "lundberg"],
)
def test_the_law_of_a_profile_is_that_of_the_slices_of_the_statics(
    bearing: bd.Bearing | bd.CylindricalBearing, load: float
) -> None:
    """Every roller of rigid rings; a tapered one tilts a little against its rib, 1.1 % at most."""
    found = bd.equilibrium(bearing, load, laminae=30, rings="rigid")
    for ring, loads, sliced in (
        ("cup", found.cup_load, found.cup_pressure),
        ("cone", found.cone_load, found.cone_pressure),
    ):
        np.testing.assert_allclose(pressure_law(bearing, ring).of(loads), sliced, rtol=0.02)
    straight = pressure_law(bd.bearing(bearing, profile={"kind": "straight"}), "cone")
    assert found.largest_pressure > 1.025 * straight.of(found.cone_load.max())


@pytest.mark.slow
@pytest.mark.parametrize("load", [80, 160, 210])
def test_a_run_of_cylinders_has_the_pressure_of_the_statics(load: float) -> None:
    scene = bd.scene(bearing=CYLINDER, load_kN=load, speed_rpm=60, effects="standard", tier="quasistatic")
    contacts = bd.simulate(scene, duration=0.6, rings="rigid").contacts
    static = bd.equilibrium(CYLINDER, load, rings="rigid")
    settled = contacts.pressure[len(contacts) // 2 :]
    for ring, expected in (("cup", static.cup_pressure), ("cone", static.cone_pressure)):
        assert settled[..., contacts.of(ring)].max() == pytest.approx(expected.max(), rel=0.02)


@given(st.floats(1.0, 5e5), st.floats(1.0, 2.0))
def test_a_profile_gives_more_pressure_to_more_load_and_none_to_none(load: float, times: float) -> None:
    law = pressure_law(bd.bearing(CYLINDER), "cup")
    less, more = law.of(np.array([load, times * load]))
    assert less <= more <= less * times
    unloaded = law.of(np.array([0.0, math.nan]))
    assert unloaded[0] == 0.0
    assert math.isnan(unloaded[1])


@pytest.mark.parametrize("name", [CYLINDER, BARREL])
def test_other_kinds_have_pressures_too(name: str) -> None:
    found = bd.equilibrium(name, 80)
    assert found.cup_pressure.shape == found.cup_load.shape
    assert ((found.cup_pressure > 0.0) == (found.cup_load > 0.0)).all()
    assert 0.5e9 < found.largest_pressure < 2.5e9


def test_a_barrel_has_the_pressure_of_its_ellipse_by_slices_too() -> None:
    """Hertz (Johnson, Eq. 4.24) against many slices, each a line contact: within what slices neglect."""
    bearing = bd.bearing(BARREL)
    found = bd.equilibrium(bearing, 40, laminae=100)
    contact = ExactPointContact(
        bearing.rolling_radius("cup"), bearing.profile_radius("cup"), bearing.material.contact_modulus
    )
    load = found.cup_load.max()
    larger, smaller = contact.semi_axes(load)
    assert larger < 0.5 * bearing.effective_length
    assert found.cup_pressure.max() == pytest.approx(1.5 * load / (math.pi * larger * smaller), rel=0.1)
