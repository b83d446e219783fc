"""Rib in statics and in closed formulas: window, refusals, ellipse, film, friction torque."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ellipe, ellipk

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.consistency import check, require_sound
from beardyn_core.bearing.contact_law import (
    ExactPointContact,
    PointContact,
    complete_elliptic,
    exact_rib_contact,
    rib_contact,
    rib_curvature_radius,
    rib_ellipse,
    rib_truncation,
)
from beardyn_core.bearing.film_thickness import rib_film_thickness
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed, roller_cone_spin
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.effects import Rib, RibMixedFilm, RibShearedFilm
from beardyn_core.effects.rib import RibLubrication
from beardyn_core.physics.rib import rib_params
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model, rib_contacts
from beardyn_core.physics.statics.roller_equilibrium import roller_forces
from beardyn_core.physics.statics.static import _rotation, solve
from beardyn_core.physics.statics.torque import rib_torque
from test.bearings import TAPERED

HS = load_bearing("HS130x230")


# --- validation


@pytest.mark.parametrize(
    ("change", "numbers"),
    [
        ({"sphere_ratio": 1.0}, ("sphere_ratio is 1",)),
        ({"sphere_ratio": 1.02}, ("sphere_ratio is 1.02",)),
        ({"rib_contact_height": 0.0}, ("rib_contact_height_mm is 0",)),
        ({"rib_contact_height": 0.8e-3}, ("rib_contact_height 0.8 mm", "rib_undercut 1 mm")),
        ({"rib_contact_height": 5.2e-3}, ("rib_contact_height 5.2 mm", "rib_height 5 mm")),
        ({"roller_chamfer": 3e-3}, ("rib_contact_height 2.5 mm", "roller_chamfer 3 mm")),
        ({"rib_height": -1e-3}, ("rib_height_mm is -1",)),
        ({"small_rib_clearance": -1e-4}, ("small_rib_clearance_mm is -0.1",)),
        ({"small_rib_height": 13e-3}, ("small_rib_height 13 mm", "small-end radius 12.67 mm")),
    ],
)
def test_rib_that_cannot_be_is_refused_with_its_numbers(
    change: dict[str, Any], numbers: tuple[str, ...]
) -> None:
    spoilt = replace(HS, **change)
    (problem,) = check(spoilt)
    for number in numbers:
        assert number in problem
    with pytest.raises(InputError):
        solve(spoilt, (0.0, 0.0, 8e4), end_play=0.0)


def test_sphere_beyond_the_curvature_of_the_rib_is_refused() -> None:
    """Large heights make the rib's own radius smaller than the sphere's before the ratio reaches 1."""
    ratios = np.linspace(0.9, 0.999, 100)
    bearings = [replace(HS, sphere_ratio=float(r)) for r in ratios]
    for bearing in bearings:
        beyond = bearing.sphere_radius >= rib_curvature_radius(bearing)
        assert any("radius of curvature" in text for text in check(bearing)) == beyond


def test_forced_bearing_is_not_refused_but_still_checked() -> None:
    forced = replace(HS, sphere_ratio=1.02, forced=True)
    assert check(forced)
    require_sound(forced)


# --- static contacts


@settings(deadline=None, max_examples=30)
@given(tilt=st.floats(-0.02, 0.02), cone=st.floats(-2e-3, 2e-3), axial=st.floats(-1e-4, 1e-4))
def test_static_rib_follows_the_distance_over_both_edges(tilt: float, cone: float, axial: float) -> None:
    """Tilt moves the contact 0.48 mm a mrad, so over the whole face and beyond; central differences."""
    model = contact_model(HS, 0.0, 3, 0.0, 0.1)
    pose = ConePose(np.array([2e-5, -1e-5, 3e-5]), _rotation(cone, -0.5 * cone))
    position = np.broadcast_to(np.array([1e-5, axial, tilt]), (2, HS.roller_count, 3))
    found = rib_contacts(model, position, pose)
    step = 1e-7
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        ahead = rib_contacts(model, position + shift, pose).approach
        behind = rib_contacts(model, position - shift, pose).approach
        np.testing.assert_allclose(found.by_roller[..., axis], (ahead - behind) / (2 * step), atol=1e-6)


def test_static_rib_leaves_the_cone_beyond_the_edges_only() -> None:
    """Sharp truncated cone: e^2 / 2 R_s less than the unlimited one at e beyond the edge."""
    model = contact_model(HS, 0.0, 3, 0.0, 0.1)
    pose = ConePose(np.zeros(3), np.eye(3))

    def approach(bearing: Bearing, tilt: float) -> float:
        position = np.broadcast_to(np.array([0.0, 0.0, tilt]), (2, HS.roller_count, 3))
        return float(rib_contacts(replace(model, bearing=bearing), position, pose).approach[0, 0, 0])

    endless = replace(HS, rib_height=0.5, rib_undercut=-0.5)
    assert approach(HS, 2e-3) == approach(endless, 2e-3)
    # large end outwards: the sphere's centre, on the other side of mid-length, and the contact move inwards
    for tilt, room in ((10e-3, 1.5e-3), (-8e-3, 2.5e-3)):
        moved = -HS.sphere_centre * abs(tilt)
        lost = approach(endless, tilt) - approach(HS, tilt)
        assert lost == pytest.approx((moved - room) ** 2 / (2.0 * HS.sphere_radius), rel=0.02)


@pytest.mark.parametrize("name", TAPERED)
@pytest.mark.parametrize("force", [(0.0, 0.0, 8e4), (0.0, 18e3, 8e4), (0.0, 6e4, 6e4)])
def test_static_rib_contacts_of_shipped_bearings_stay_on_the_face(
    name: str, force: tuple[float, float, float]
) -> None:
    """Where an unlimited cone and the face give the same, to the last bit."""
    bearing = load_bearing(name)
    endless = replace(bearing, rib_height=0.5, rib_undercut=-0.5, forced=True)
    found, unlimited = (
        solve(which, force, end_play=0.0, laminae=6, speed=122.0) for which in (bearing, endless)
    )
    np.testing.assert_array_equal(found.rib_load, unlimited.rib_load)
    assert found.rib_load.max() > 100.0


# --- ellipse


def test_complete_elliptic_integrals_are_those_of_scipy() -> None:
    for parameter in (0.0, 1e-9, 0.3, 0.9, 0.999999):
        first, second = complete_elliptic(parameter)
        assert first == pytest.approx(float(ellipk(parameter)), rel=1e-13)
        assert second == pytest.approx(float(ellipe(parameter)), rel=1e-13)


@pytest.mark.parametrize("ratio", [1.0, 1.3, 3.0, 8.8, 100.0])
def test_exact_ellipse_satisfies_the_equations_of_hertz(ratio: float) -> None:
    """Johnson (1985), Eqs. 4.25 and 4.26: both curvatures from the pressure, approach from K."""
    load, radius, modulus = 500.0, 0.48, 226.4e9
    contact = ExactPointContact(radius, ratio * radius, modulus)
    larger, smaller = contact.semi_axes(load)
    pressure, plane = 1.5 * load / (math.pi * larger * smaller), 0.5 * modulus
    parameter = 1.0 - (smaller / larger) ** 2
    first, second = float(ellipk(parameter)), float(ellipe(parameter))
    approach = pressure * smaller / plane * first
    assert contact.factor == pytest.approx(load / approach**1.5, rel=1e-7)
    if ratio > 1.0:
        scale = pressure * smaller / (plane * parameter * larger**2)
        assert scale * (first - second) == pytest.approx(0.5 / contact.radius_y, rel=1e-6)
        assert scale * ((larger / smaller) ** 2 * second - first) == pytest.approx(0.5 / radius, rel=1e-6)


def test_fit_of_hamrock_and_brewe_is_within_1_percent_for_ribs() -> None:
    for ratio in np.linspace(3.0, 10.0, 15):
        fitted, exact = PointContact(0.48, 0.48 * ratio, 226e9), ExactPointContact(0.48, 0.48 * ratio, 226e9)
        assert fitted.factor == pytest.approx(exact.factor, rel=0.01)
    assert exact_rib_contact(HS).factor == pytest.approx(rib_contact(HS).factor, rel=0.01)


def test_ellipse_of_the_main_bearing_at_10_kN() -> None:
    """Derived: 6.6 x 1.6 mm and 97 MPa under the 530 N of a 10 kN roller."""
    ellipse = rib_ellipse(HS, 526.0)
    assert 2e3 * ellipse.around == pytest.approx(6.6, rel=0.01)
    assert 2e3 * ellipse.along == pytest.approx(1.6, rel=0.02)
    assert ellipse.largest_pressure == pytest.approx(97e6, rel=0.01)


def test_ellipse_beyond_face_and_rim_is_reported_with_numbers() -> None:
    assert rib_truncation(HS, 1000.0) == []
    down, sideways = rib_truncation(HS, 8000.0)
    assert "below rib_undercut 1 mm" in down
    assert "rim of the roller end at 7.08 mm" in sideways
    (up, *_) = rib_truncation(replace(HS, rib_contact_height=4.5e-3), 800.0)
    assert "above rib_height 5 mm" in up


# --- friction and film


def test_power_of_the_rib_is_54_W_per_10_kN_roller() -> None:
    """Zhao et al. 2026, T = mu Q_f h R_o/Dm, at 2000 rpm and mu = 0.05."""
    speed = 2000.0 * math.pi / 30.0
    _, rib_load = roller_forces(1e4, HS.cup_angle, HS.cone_angle, HS.rib_angle)
    sliding = roller_cone_spin(HS, speed) * HS.rib_contact_height
    power = 0.05 * rib_load * sliding
    assert sliding == pytest.approx(2.1, rel=0.02)
    assert power == pytest.approx(54.0, rel=0.02)
    cup_radius = 0.5 * (HS.pitch_diameter + HS.roller_diameter * math.cos(HS.contact_angle))
    torque = 0.05 * rib_load * HS.rib_contact_height * cup_radius / HS.roller_diameter
    assert torque * speed == pytest.approx(power, rel=0.02)


def test_film_of_the_rib_grows_with_speed_and_hardly_falls_with_load() -> None:
    """Expected order: full film in a warm bearing at speed, mixed at a crawl."""
    oil = load_lubricant("L055")
    orbit = cage_speed(HS, 122.0)
    speed = (122.0 - orbit) * 0.085
    viscosity, alpha = oil.dynamic_viscosity(343.15), oil.pressure_viscosity_at(343.15)
    fast = rib_film_thickness(HS, 500.0, speed, viscosity, alpha)
    assert 1e-6 < fast < 6e-6
    assert rib_film_thickness(HS, 500.0, speed / 100.0, viscosity, alpha) / fast == pytest.approx(
        0.01**0.67, rel=1e-9
    )
    assert rib_film_thickness(HS, 1000.0, speed, viscosity, alpha) / fast == pytest.approx(
        2.0**-0.067, rel=1e-9
    )


@pytest.mark.parametrize("rpm", [60.0, 1165.0])
@pytest.mark.parametrize("lubrication", [None, RibMixedFilm(), RibShearedFilm()])
def test_torque_of_the_ribs_is_that_of_the_formulas(lubrication: RibLubrication | None, rpm: float) -> None:
    """Asperities and film share the load, and the film shears: formula by formula; logarithms of 1e-10."""
    rib, oil = Rib(lubrication=lubrication), load_lubricant("L055")
    kelvin, speed = 343.15, rpm * math.pi / 30.0
    viscosity, alpha = oil.dynamic_viscosity(kelvin), oil.pressure_viscosity_at(kelvin)
    static = solve(HS, (0.0, 0.0, 80e3), end_play=HS.end_play)
    slip = roller_cone_spin(HS, speed) * HS.rib_contact_height
    radius = HS.end_sphere[0] + HS.sphere_radius * math.sin(HS.rib_lean)
    entrainment = (speed - cage_speed(HS, speed)) * radius - 0.5 * slip + 1e-3
    friction, mixed = 0.0, 0.0
    for load in static.rib_load[static.rib_load > 0.0].tolist():
        if lubrication is None:
            friction += rib.friction * load
            continue
        film = lubrication.starvation * rib_film_thickness(HS, load, entrainment, viscosity, alpha)
        asperities = math.exp(-1.8 * (film / HS.rib_roughness) ** 1.2)
        boundary = lubrication.boundary_friction * load
        if isinstance(lubrication, RibMixedFilm):
            wet = lubrication.film_friction * load
        else:
            area = math.pi * math.prod(rib_contact(HS).semi_axes(load))
            newtonian = viscosity * math.exp(alpha * load / area) * slip / film
            limit = lubrication.limiting_shear * load / area
            # force against the corner of dry friction, which the film has not
            wet = area * newtonian * limit / math.hypot(newtonian, limit)
            wet *= math.hypot(slip, rib.regularisation_speed) / slip
        friction += wet + (boundary - wet) * asperities
        mixed += boundary
    expected = friction * slip / math.hypot(slip, rib.regularisation_speed) * slip / speed
    found = rib_torque(HS, static, speed, rib_params(HS, rib, oil, kelvin))
    assert found == pytest.approx(expected, rel=1e-7)
    if isinstance(lubrication, RibShearedFilm) and rpm > 1000.0:
        assert friction < 0.6 * mixed  # and not as dry as asperities alone
