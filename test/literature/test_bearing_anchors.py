"""Bearing geometry, contact laws, kinematics and ratings against published numbers."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from beardyn_core.bearing.contact_law import (
    PointContact,
    line_contact_factor,
    rib_contact,
)
from beardyn_core.bearing.kinematics import fault_frequencies, frequencies
from beardyn_core.bearing.life import dynamic_rating, rating_factor
from beardyn_core.bearing.lubricant import gold_pressure_viscosity
from beardyn_core.bearing.profile import Profile
from beardyn_core.config import load_bearing, load_lubricant, shipped_names
from beardyn_core.physics.statics.roller_equilibrium import centrifugal_cup_load, roller_forces
from evidence.validation.ball_contact import curvature_difference, curvature_sum
from evidence.validation.load_zone import axial_integral, radial_integral
from test.kernels.naive_traction import roelands_viscosity

# Closed geometry and fault frequencies of the shipped bearings, derived: cone, cup and half angle
# [deg], apex distance, large end, small end, sphere radius [mm], rib angle [deg], roller mass [kg], Jx, Jy
# [kg m^2], zc [mm], gamma, FTF, BPFO, BPFI, BSF. None where no number was derived.
PRESETS = {
    "HS130x230": (
        *("8.993", "12.007", "1.5066", "507.58", "14.034", "12.666", "480.4", "80.88"),
        *("0.2282", "2.042e-5", "6.148e-5", "0.887", "0.1419", "0.4290", "7.294", "9.706", "3.395"),
    ),
    "FR130x230x150": (
        *("7.598", "10.068", "1.2345", "574.03", "12.866", "11.874", "537.5", "82.27"),
        *("0.1732", "1.329e-5", "3.714e-5", "0.614", "0.1387", "0.4307", "8.613", "11.387", "3.494"),
    ),
    "AARK_6.5x9": (
        *("7.813", "9.847", "1.0174", "664.48", None, None, "619.7", "82.07"),
        *("0.1645", None, None, None, "0.1143", "0.4428", "10.19", "12.81", "4.27"),
    ),
    "METRO120x220": (
        *(None, None, "1.535", None, None, None, "440.6", None),
        *("0.177", None, None, None, None, "0.4277", "7.271", "9.729", "3.329"),
    ),
}


def half_a_digit(printed: str) -> float:
    """Half a unit of the last digit printed."""
    digits, _, exponent = printed.partition("e")
    decimals = len(digits.partition(".")[2])
    return 0.5 * 10.0 ** (int(exponent or 0) - decimals)


@pytest.mark.parametrize("name", PRESETS)
def test_shipped_bearing_closes_to_the_derived_numbers(name):
    """Derived, to the last digit printed."""
    bearing = load_bearing(name)
    found = fault_frequencies(bearing)
    degrees = math.degrees
    values = (
        *(degrees(bearing.cone_angle), degrees(bearing.cup_angle), degrees(bearing.half_angle)),
        *(bearing.apex_distance * 1e3, bearing.large_end_radius * 1e3, bearing.small_end_radius * 1e3),
        *(bearing.sphere_radius * 1e3, degrees(bearing.rib_angle), bearing.roller_mass),
        *(bearing.roller_axial_inertia, bearing.roller_transverse_inertia, bearing.roller_mass_offset * 1e3),
        *(bearing.gamma, found.ftf, found.bpfo, found.bpfi, found.bsf),
    )
    for value, expected in zip(values, PRESETS[name], strict=True):
        if expected is not None:
            assert value == pytest.approx(float(expected), rel=1e-12, abs=half_a_digit(expected))


def test_closed_angles_of_the_high_speed_bearing_agree_with_its_catalogue():
    """Zhao et al. 2026, J. Braz. Soc. Mech. Sci. Eng. 48:241, Table 2: 9 and 12 deg."""
    bearing = load_bearing("HS130x230")
    assert math.degrees(bearing.cone_angle) == pytest.approx(9.0, abs=0.01)
    assert math.degrees(bearing.cup_angle) == pytest.approx(12.0, abs=0.01)


def test_fault_frequencies_of_the_cwru_bearing():
    """CWRU 6205 drive-end bearing (9 balls, 0.3126 and 1.537 in): 3.5848, 5.4152, 0.39828, 4.7135/2."""
    found = frequencies(9, 1.537, 0.3126, 0.0)
    assert found.bpfo == pytest.approx(3.5848, abs=1e-4)
    assert found.bpfi == pytest.approx(5.4152, abs=1e-4)
    assert found.ftf == pytest.approx(0.39828, abs=1e-4)
    assert 2.0 * found.bsf == pytest.approx(4.7135, abs=1e-4)


def test_line_contact_is_palmgren_per_contact_and_iso_is_two_in_series():
    """Palmgren 1959: delta = 3.84e-5 Q^0.9/L^0.8 (mm, N) for one contact, 0.5 % for the rounded constants.

    ISO/TS 16281: c_L = 35 948 L^(8/9) is for the roller between both raceways; one contact is 2^(10/9)
    stiffer, which leaves 4 % of rounding between the two standards' constants.
    """
    bearing = load_bearing("HS130x230")
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    load = 1.0e4
    approach = (load / factor) ** 0.9
    assert approach == pytest.approx(3.84e-8 * load**0.9 / 50.0**0.8, rel=5e-3)
    both = 35948.0 * 50.0 ** (8.0 / 9.0) * (2.0 * approach * 1e3) ** (10.0 / 9.0)
    assert both == pytest.approx(load, rel=0.04)


def test_hertz_point_contact_of_the_d_brain_unit_test():
    """D-BRAIN gtest Hertz0: 972.39 N, 1.6211 mm, 0.16553 mm with the same fit; exact integrals 955.1 N."""
    contact = PointContact(5.5289e-3, 189.645e-3, 228.571e9)
    load = contact.factor * 9.164e-6**1.5
    larger, smaller = contact.semi_axes(load)
    assert load == pytest.approx(972.39, rel=1e-4)
    assert larger == pytest.approx(1.6211e-3, rel=1e-4)
    assert smaller == pytest.approx(0.16553e-3, rel=1e-4)
    assert load == pytest.approx(955.1, rel=0.02)


def test_hertz_point_contact_of_the_textbook():
    """D-BRAIN gtest Hertz1 (textbook case): 50 N, 0.208 x 0.135 mm; 2.5 % for the fit of the integrals."""
    contact = PointContact(10.7e-3, 20.0e-3, 231e9)
    load = contact.factor * 1.89e-6**1.5
    larger, smaller = contact.semi_axes(load)
    assert load == pytest.approx(50.0, rel=0.025)
    assert larger == pytest.approx(0.208e-3, rel=0.025)
    assert smaller == pytest.approx(0.135e-3, rel=0.025)


@pytest.mark.parametrize("name", PRESETS)
def test_rib_stiffness_is_near_the_exact_hertz_solution(name):
    """Johnson, Contact Mechanics, 4.2: k from the elliptic integrals; 2.5 % for the fit at these radii."""
    contact = rib_contact(load_bearing(name))
    assert contact.factor == pytest.approx(exact_point_factor(contact), rel=0.025)


def test_hertz_fit_is_9_percent_too_stiff_for_a_circular_contact():
    """The known weak end of the Hamrock-Brewe fit; Hertz 1882 gives K = 4/3 E* sqrt(R) there."""
    sphere = PointContact(0.01, 0.01, 226.4e9)
    hertz = 4.0 / 3.0 * 113.2e9 * math.sqrt(0.01)
    assert exact_point_factor(sphere) == pytest.approx(hertz, rel=1e-6)
    assert sphere.factor / hertz == pytest.approx(1.087, abs=1e-3)
    assert PointContact(0.02, 0.01, 226.4e9).factor == PointContact(0.01, 0.02, 226.4e9).factor


def exact_point_factor(contact: PointContact) -> float:
    """K of a Hertzian point contact with exact elliptic integrals."""

    def integrals(ellipticity: float) -> tuple[float, float]:
        parameter = 1.0 - ellipticity**-2
        return float(ellipk(parameter)), float(ellipe(parameter))

    ratio = contact.radius_y / contact.radius_x

    def missing(ellipticity: float) -> float:
        first, second = integrals(ellipticity)
        return (ellipticity**2 * second - first) / (first - second) - ratio

    ellipticity = 1.0 if ratio == 1.0 else brentq(missing, 1.0 + 1e-6, 100.0)
    first, second = integrals(ellipticity)
    root = math.sqrt(contact.radius * second / (4.5 * first**3))
    return math.pi * ellipticity * contact.contact_modulus * root


def test_curvature_of_the_209_ball_bearing():
    """Harris, Rolling Bearing Analysis, 209 ball bearing: 0.202 1/mm, F(rho) 0.9399 and 0.9120.

    The sum is printed to three digits, hence 0.0005; the others within 0.1 %.
    """
    ball, pitch, groove = 12.7, 65.0, 0.52 * 12.7
    gamma = ball / pitch
    inner = (2 / ball, 2 / ball, 2 * gamma / (ball * (1 - gamma)), -1 / groove)
    outer = (2 / ball, 2 / ball, -2 * gamma / (ball * (1 + gamma)), -1 / groove)
    assert curvature_sum(inner) == pytest.approx(0.202, abs=5e-4)
    assert curvature_difference(inner) == pytest.approx(0.9399, rel=1e-3)
    assert curvature_difference(outer) == pytest.approx(0.9120, rel=1e-3)


def test_rib_contact_of_the_high_speed_bearing():
    """Derived: concave rib radius 542 mm, Ry about 4.2 m, K 2.0e11 N/m^1.5 (two digits)."""
    contact = rib_contact(load_bearing("HS130x230"))
    concave = 1.0 / (1.0 / contact.radius_x - 1.0 / contact.radius_y)
    assert concave == pytest.approx(0.542, rel=2e-3)
    assert contact.radius_y == pytest.approx(4.2, rel=0.02)
    assert contact.factor == pytest.approx(2.0e11, rel=0.025)


@pytest.mark.parametrize(
    ("extent", "radial", "axial", "thrust"),
    [(0.3, 0.2050, 0.2327, 0.881), (0.5, 0.2448, 0.3080, 0.795), (1.0, 0.2525, 0.4798, 0.526)],
)
def test_load_zone_integrals(extent, radial, axial, thrust):
    """Derived, exponent 10/9."""
    assert radial_integral(extent) == pytest.approx(radial, abs=1e-4)
    assert axial_integral(extent) == pytest.approx(axial, abs=1e-4)
    assert radial_integral(extent) / axial_integral(extent) == pytest.approx(thrust, abs=1e-3)


def test_load_zone_integrals_of_harris():
    """Harris, Rolling Bearing Analysis, line-contact table, exponent 1.1: 0.2453 and 0.3090."""
    assert radial_integral(0.5, 1.1) == pytest.approx(0.2453, abs=1e-3)
    assert axial_integral(0.5, 1.1) == pytest.approx(0.3090, abs=1e-3)


def test_force_triangle_of_the_double_row_bearing_of_zhang():
    """Zhang, Lv, Han, Li 2023, Sensors 23:4967, Table 3: Q_o 1304.8 gives Q_i 1119.3 and Q_f 198.9 N.

    HH926700, roller of 0.126 kg (the value of the paper) on 198.93 mm pitch diameter, cage at 1200 rpm.
    """
    cup, cone, rib = (math.radians(angle) for angle in (22.54, 16.24, 70.20))
    centrifugal = 0.126 * (1200.0 * math.pi / 30.0) ** 2 * 0.19893 / 2.0
    cone_load, rib_load = roller_forces(1304.8, cup, cone, rib, centrifugal)
    assert cone_load == pytest.approx(1119.3, rel=1e-3)
    assert rib_load == pytest.approx(198.9, rel=1e-3)
    alone = centrifugal_cup_load(centrifugal, cup, rib)
    assert roller_forces(alone, cup, cone, rib, centrifugal)[0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("gamma", "factor"), [(0.10, 84.2), (0.14, 87.7), (0.20, 88.7), (0.30, 83.8)])
def test_rating_factor_of_iso_281(gamma, factor):
    """ISO 281, table of f_c for radial roller bearings."""
    assert rating_factor(gamma) == pytest.approx(factor, rel=4e-3)


@pytest.mark.parametrize(
    ("name", "rating", "limit"),
    [("HS130x230", 977e3, 0.319), ("FR130x230x150", 923e3, 0.266), ("METRO120x220", 826e3, None)],
)
def test_dynamic_rating_of_the_shipped_bearings(name, rating, limit):
    """Derived, three digits printed.

    They take the mean angle in C_r where ISO 281 takes the cup angle: the test converts one into
    the other (0.4 to 0.5 %).
    """
    bearing = load_bearing(name)
    found = dynamic_rating(bearing)
    mean = bearing.gamma
    cup = mean * math.cos(bearing.cup_angle) / math.cos(bearing.contact_angle)
    converted = found.radial * (mean / cup) ** (7.0 / 9.0) * rating_factor(mean) / rating_factor(cup)
    assert converted == pytest.approx(rating, rel=1e-3)
    assert found.radial == pytest.approx(rating, rel=6e-3)
    if limit is not None:
        assert found.thrust_limit == pytest.approx(limit, abs=5e-4)


@pytest.mark.parametrize(
    ("name", "at_60", "at_80"),
    [
        ("EP220", 78.8, 35.6),
        ("LGEP2", 68.7, 30.3),
        ("RAIL100", 39.5, 19.3),
        ("FVA3", 37.9, 18.7),
        ("SHC100", 44.5, 23.5),
    ],
)
def test_viscosity_follows_walther(name, at_60, at_80):
    """Derived, Walther interpolation in mm^2/s, printed to 0.1."""
    lubricant = load_lubricant(name)
    assert lubricant.kinematic_viscosity(333.15) * 1e6 == pytest.approx(at_60, abs=0.06)
    assert lubricant.kinematic_viscosity(353.15) * 1e6 == pytest.approx(at_80, abs=0.06)
    assert lubricant.kinematic_viscosity(313.15) == pytest.approx(lubricant.kinematic_viscosity_40, rel=1e-12)
    assert lubricant.kinematic_viscosity(373.15) == pytest.approx(
        lubricant.kinematic_viscosity_100, rel=1e-12
    )


def test_dynamic_viscosity_of_the_reference_oil():
    """FVA reference oil 3: 50 mPa s at 50 deg C; 5 % for the recalled data sheet."""
    assert load_lubricant("FVA3").dynamic_viscosity(323.15) == pytest.approx(50e-3, rel=0.05)


@pytest.mark.parametrize(
    ("base_oil", "viscosity", "coefficient"),
    [("mineral", 1e-6, 9.90), ("pao", 1e-6, 7.38), ("mineral", 1e-4, 18.78)],
)
def test_pressure_viscosity_after_gold(base_oil, viscosity, coefficient):
    """Gold et al. (2001): 9.90 nu^0.139 and 7.38 nu^0.1335 1/GPa, nu in mm^2/s; 9.90 x 100^0.139 = 18.78."""
    assert gold_pressure_viscosity(viscosity, base_oil) * 1e9 == pytest.approx(coefficient, abs=5e-3)


@pytest.mark.parametrize("name", [name for name in shipped_names("lubricants") if name != "L055"])
def test_catalogue_has_the_pressure_viscosity_of_gold(name):
    """Every lubricant but L055, whose source gives its own; rounded to 0.01 1/GPa in the file."""
    oil = load_lubricant(name)
    viscosity = oil.kinematic_viscosity(oil.pressure_viscosity_temperature)
    found = gold_pressure_viscosity(viscosity, oil.base_oil)
    assert oil.pressure_viscosity * 1e9 == pytest.approx(found * 1e9, abs=5.1e-3)


def test_catalogue_states_a_source_for_every_number():
    for name in shipped_names("lubricants"):
        given = dict(load_lubricant(name).sources)
        assert len(given) == 7, name
        assert all(given.values())


def test_pressure_viscosity_falls_with_temperature_as_in_the_textbook():
    """Engineering Tribology, ch. 2: heavy mineral oil 23.7, 20.5, 15.8 1/GPa at 30, 60, 100 deg C.

    The grade of that oil is not stated, so only the ratios are compared, within 10 %.
    """
    oil = load_lubricant("EP220")
    at_30, at_60, at_100 = (oil.pressure_viscosity_at(273.15 + celsius) for celsius in (30, 60, 100))
    assert at_60 / at_30 == pytest.approx(20.5 / 23.7, rel=0.1)
    assert at_100 / at_30 == pytest.approx(15.8 / 23.7, rel=0.1)


def test_roelands_starts_at_ambient_with_the_barus_slope():
    """Roelands 1966: d(ln eta)/dp at ambient pressure is alpha."""
    oil = load_lubricant("FVA3")
    ambient, step = oil.dynamic_viscosity(333.15), 1.0e3
    assert roelands_viscosity(oil, 333.15, 0.0) == pytest.approx(ambient, rel=1e-12)
    slope = math.log(roelands_viscosity(oil, 333.15, step) / ambient) / step
    assert slope == pytest.approx(oil.pressure_viscosity_at(333.15), rel=1e-4)


def test_logarithmic_profile_for_3_gpa_is_that_of_iso_16281():
    """ISO/TS 16281: P = 0.00035 Dwe ln{1/[1 - (2x/L)^2]}; 1 % because 3.0 GPa is rounded."""
    length, diameter = 50.0e-3, 26.7e-3
    profile = Profile("logarithmic", design_pressure=3.0e9)
    x = np.array([0.0, 0.4, 0.8, 0.9, 0.98]) * 0.5 * length
    expected = -0.00035 * diameter * np.log(1.0 - (2.0 * x / length) ** 2)
    np.testing.assert_allclose(profile.drop_at(x, 0.5 * length, diameter, 226.4e9), expected, rtol=0.01)
    assert profile.drop_at(0.45 * length, 0.5 * length, diameter) == pytest.approx(15.5e-6, rel=0.01)


def test_every_number_of_a_shipped_bearing_has_a_source():
    for name in PRESETS:
        bearing = load_bearing(name)
        sourced = {key for key, _ in bearing.sources}
        numbers = {
            field.name
            for field in dataclasses.fields(bearing)
            if isinstance(getattr(bearing, field.name), int | float | tuple) and field.name != "sources"
        } - {"angle_tolerance", "forced"}
        missing = {key for key in numbers if not any(key.removeprefix("nominal_") == s for s in sourced)}
        assert not missing, f"{name}: {missing}"
        assert all(text.strip() for _, text in bearing.sources)
