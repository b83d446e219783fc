"""Closed geometry and roller inertia from first principles."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import (
    cage_speed,
    cage_speed_ratio,
    centrifugal_force,
    fault_frequencies,
    roller_cone_spin,
    roller_spin,
)
from beardyn_core.config import load_any_bearing, load_bearing, shipped_names

HS = load_bearing("HS130x230")
NAMES = ("HS130x230", "FR130x230x150", "AARK_6.5x9", "METRO120x220")


def bearings() -> st.SearchStrategy[Bearing]:
    """Healthy bearings around the shipped ones, angle and diameter varied."""
    return st.builds(
        lambda name, angle, diameter, ratio, height: dataclasses.replace(
            load_bearing(name),
            contact_angle=math.radians(angle),
            roller_diameter=load_bearing(name).roller_diameter * diameter,
            sphere_ratio=ratio,
            rib_contact_height=height * 1e-3,
            nominal_cup_angle=None,
            nominal_cone_angle=None,
        ),
        st.sampled_from(NAMES),
        st.floats(7.0, 14.0),
        st.floats(0.9, 1.02),
        st.floats(0.8, 0.95),
        st.floats(1.5, 3.5),
    )


def test_all_shipped_bearings_are_there_and_sound():
    assert set(NAMES) <= set(shipped_names("bearings"))
    for name in shipped_names("bearings"):
        assert check(load_any_bearing(name)) == []


@given(bearings())
@settings(max_examples=60, deadline=None)
def test_roller_touches_both_raceways_along_its_whole_generator(bearing):
    """A disc of the roller at any abscissa reaches exactly to both raceway cones through the apex."""
    axis = np.array([math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)])
    for x in np.linspace(-0.5, 0.5, 7) * bearing.roller_length:
        centre = (bearing.apex_distance + x) * axis
        radius = (bearing.apex_distance + x) * math.tan(bearing.half_angle)
        for sign, angle in ((1.0, bearing.cup_angle), (-1.0, bearing.cone_angle)):
            across = sign * np.array([-axis[1], axis[0]])
            point = centre + radius * across
            assert math.atan2(point[1], point[0]) == pytest.approx(angle, abs=1e-14)
    assert bearing.apex_distance * axis[1] == pytest.approx(0.5 * bearing.pitch_diameter, rel=1e-14)


@given(bearings(), st.floats(-300.0, 300.0))
@settings(max_examples=60, deadline=None)
def test_pure_rolling_without_slip_along_both_generators(bearing, shaft_speed):
    """Surface speeds of roller and raceway agree at both ends of both generators."""
    cage, spin = cage_speed(bearing, shaft_speed), roller_spin(bearing, shaft_speed)
    for x in (-0.5 * bearing.effective_length, 0.5 * bearing.effective_length):
        distance = bearing.apex_distance + x
        radius = distance * math.tan(bearing.half_angle)
        along = distance / math.cos(bearing.half_angle)
        cup, cone = along * math.sin(bearing.cup_angle), along * math.sin(bearing.cone_angle)
        # Seen from the cage the cup turns backwards and the cone forwards.
        assert spin * radius == pytest.approx(cage * cup, rel=1e-12, abs=1e-12)
        assert spin * radius == pytest.approx((shaft_speed - cage) * cone, rel=1e-12, abs=1e-12)


@given(bearings())
@settings(max_examples=60, deadline=None)
def test_cage_speed_of_the_cones_is_the_textbook_ftf(bearing):
    found = fault_frequencies(bearing)
    assert cage_speed_ratio(bearing) == pytest.approx(found.ftf, rel=1e-13)
    assert found.bpfo + found.bpfi == pytest.approx(bearing.roller_count, rel=1e-13)
    assert found.bsf == pytest.approx(roller_spin(bearing, 1.0), rel=1e-13)


def test_rib_slides_at_2_m_per_s_at_2000_rpm():
    """Derived: 829 rad/s x 2.5 mm = 2.1 m/s."""
    spin = roller_cone_spin(HS, 2000.0 * math.pi / 30.0)
    assert spin == pytest.approx(829.0, rel=2e-3)
    assert spin * HS.rib_contact_height == pytest.approx(2.1, rel=0.02)


@given(bearings())
@settings(max_examples=40, deadline=None)
def test_roller_inertia_is_that_of_the_truncated_cone(bearing):
    """Closed forms against quadrature over discs."""
    slope, density = math.tan(bearing.half_angle), bearing.material.density

    def over_discs(weight):
        half = 0.5 * bearing.roller_length
        return quad(
            lambda x: weight(x, (bearing.apex_distance + x) * slope), -half, half, epsabs=0, epsrel=1e-12
        )[0]

    mass = over_discs(lambda x, r: density * math.pi * r**2)
    first = over_discs(lambda x, r: density * math.pi * r**2 * x)
    axial = over_discs(lambda x, r: 0.5 * density * math.pi * r**4)
    second = over_discs(lambda x, r: density * math.pi * r**2 * (0.25 * r**2 + x**2))
    assert bearing.roller_mass == pytest.approx(mass, rel=1e-12)
    assert bearing.roller_mass_offset == pytest.approx(first / mass, rel=1e-9)
    assert bearing.roller_axial_inertia == pytest.approx(axial, rel=1e-12)
    # The parallel-axis term is a thousand times larger than what is left of it.
    assert bearing.roller_transverse_inertia == pytest.approx(second - first**2 / mass, rel=1e-9)


@given(bearings())
@settings(max_examples=60, deadline=None)
def test_end_sphere_passes_through_the_roller_edge_and_the_rib_contact(bearing):
    edge = np.array([0.5 * bearing.roller_length, bearing.large_end_radius])
    centre = np.array([bearing.sphere_centre, 0.0])
    assert np.linalg.norm(edge - centre) == pytest.approx(bearing.sphere_radius, rel=1e-13)
    below = bearing.sphere_radius * math.sin(bearing.rib_polar_angle)
    assert bearing.large_end_radius - below == pytest.approx(bearing.rib_contact_height, rel=1e-9)
    leaning = bearing.contact_angle - bearing.rib_polar_angle
    assert bearing.rib_angle + leaning == pytest.approx(0.5 * math.pi, rel=1e-14)


def test_sphere_of_ratio_one_is_centred_on_the_apex():
    bearing = dataclasses.replace(HS, sphere_ratio=1.0)
    assert bearing.sphere_centre == pytest.approx(-bearing.apex_distance, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "numbers"),
    [
        ({"roller_count": 22}, ("22", "26.33 mm", "26.7 mm")),
        ({"sphere_ratio": 1.0}, ("sphere_ratio is 1",)),
        ({"sphere_ratio": 1.2}, ("sphere_ratio is 1.2",)),
        ({"rib_contact_height": 14.1e-3}, ("14.1 mm", "14.03 mm")),
        ({"roller_length": 49e-3}, ("50 mm", "49 mm")),
        ({"nominal_cup_angle": math.radians(13.0)}, ("13 deg", "12.01 deg")),
        ({"nominal_cone_angle": math.radians(8.0)}, ("8 deg", "8.993 deg")),
        ({"row_spacing": 50e-3}, ("50 mm", "55.7")),
        ({"width": 120e-3}, ("120 mm", "131")),
        ({"pitch_diameter": -0.185}, ("pitch_diameter_mm is -185",)),
        ({"roller_diameter": float("nan")}, ("roller_diameter_mm is nan",)),
        ({"contact_angle": math.radians(60.0)}, ("contact_angle_deg is 60",)),
        ({"bore": 160e-3}, ("80 mm", "bore")),
        ({"outer_diameter": 205e-3}, ("102.5 mm", "outer_diameter")),
        ({"sphere_ratio": 0.02}, ("10.6", "14.03 mm")),
    ],
)
def test_contradiction_is_refused_with_the_numbers_that_contradict(change, numbers):
    problems = check(dataclasses.replace(HS, **change))
    assert problems
    text = "\n".join(problems)
    for number in numbers:
        assert number in text, text


def test_every_contradiction_is_reported_at_once():
    problems = check(dataclasses.replace(HS, row_spacing=40e-3, roller_count=30, bore=200e-3))
    assert len(problems) == 3
    problems = check(dataclasses.replace(HS, bore=-1.0, width=0.0, cup_mass=-3.0, sphere_ratio=2.0))
    assert len(problems) == 4


@given(bearings())
@settings(max_examples=60, deadline=None)
def test_radii_at_mid_length_are_those_of_pitch_circle_and_roller(bearing):
    """The contacts stand square on the raceways, at the roller's radius from mid-length: rounding."""
    across = bearing.apex_distance * math.tan(bearing.half_angle)
    half = 0.5 * bearing.pitch_diameter
    outwards, inwards = (across * math.cos(bearing.contact_angle) * side for side in (1.0, -1.0))
    assert bearing.cup_radius == pytest.approx(half + outwards, rel=1e-12)
    assert bearing.cone_radius == pytest.approx(half + inwards, rel=1e-12)
    assert abs(bearing.roller_orbit_radius / half - 1.0) < 5e-3
    # cone moved by half of the play along the axis, seen along the cup's normal
    assert bearing.normal_gap(2e-4) == pytest.approx(1e-4 * math.sin(bearing.cup_angle))
    force = bearing.roller_mass * cage_speed(bearing, -100.0) ** 2 * bearing.roller_orbit_radius
    assert centrifugal_force(bearing, 100.0) == pytest.approx(force)
