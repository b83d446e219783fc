"""Static equilibrium of the double row against published and dossier numbers."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from beardyn_core.bearing.kinematics import cage_speed_ratio
from beardyn_core.bearing.load_zone import axial_integral, radial_integral
from beardyn_core.config import load_bearing
from beardyn_core.integrate.static import solve

HALF_PITCH = math.pi / 17


def test_largest_roller_load_of_the_high_speed_bearing():
    """Issue and physics dossier D7: 9.83 kN with a roller on the load line, 9.63 kN half a pitch further."""
    bearing = load_bearing("HS130x230")
    on_line = solve(bearing, (0, 0, 80e3), end_play=0.0)
    between = solve(bearing, (0, 0, 80e3), end_play=0.0, roller_phase=HALF_PITCH)
    assert on_line.largest_roller_load == pytest.approx(9.83e3, rel=5e-3)
    assert between.largest_roller_load == pytest.approx(9.63e3, rel=5e-3)
    assert np.unravel_index(on_line.cup_load.argmax(), on_line.cup_load.shape)[1] == 0


def test_largest_roller_load_is_stribecks_number():
    """Stribeck for line contact, zero clearance: Q_max = 4.08 F_r/(i Z cos(alpha)) = 9.81 kN."""
    bearing = load_bearing("HS130x230")
    expected = 4.08 * 80e3 / (2 * 17 * math.cos(bearing.cup_angle))
    assert solve(bearing, (0, 0, 80e3), end_play=0.0).largest_roller_load == pytest.approx(expected, rel=5e-3)


# Physics dossier D, end: load [N], tilt, loaded rollers, Q_max of each row [N], radial and axial
# displacement [um], radial and axial stiffness [GN/m], tilt held.
STATIC_TABLE = [
    ((0, 0, 80e3), "locked", {9}, (9835, 9835), 13.9, 0.0, 6.38, 0.58),
    ((0, 15e3, 80e3), "free", {17, 7}, (11875, 11652), 16.4, 47.5, 9.35, 0.79),
    ((0, 0, 5e3), "locked", {9}, (615, 615), 1.1, 0.0, 4.84, 0.44),
]


@pytest.mark.parametrize(
    ("load", "tilt", "loaded", "largest", "radial", "axial", "stiff", "soft"), STATIC_TABLE
)
def test_static_table_of_the_dossier(load, tilt, loaded, largest, radial, axial, stiff, soft):
    """Loads within 0.1 %: they hardly depend on the stiffness.

    Displacement and stiffness within 3.5 %: the dossier used the ISO constant, whose contact is 3.7 % softer
    than Palmgren's at equal load (77 652 against 80 589), hence 3.4 % more displacement, and took two
    contacts in series along one normal where here the roller is wedged between cup, cone and a yielding rib.
    """
    solution = solve(load_bearing("HS130x230"), load, end_play=0.0, tilt=tilt)
    assert set(solution.loaded_roller_count) == loaded
    assert sorted(solution.cup_load.max(axis=1)) == pytest.approx(sorted(largest), rel=1e-3)
    assert solution.displacement[2] * 1e6 == pytest.approx(radial, rel=0.035)
    assert solution.displacement[1] * 1e6 == pytest.approx(axial, rel=0.035, abs=1e-6)
    assert solution.stiffness_tilt_held[2, 2] == pytest.approx(stiff * 1e9, rel=0.035)
    assert solution.stiffness_tilt_held[1, 1] == pytest.approx(soft * 1e9, rel=0.035)


def test_large_roller_count_approaches_the_load_zone_integrals():
    """J_r(0.5) and J_a(0.5): with many rollers the sum becomes the integral; 0.2 % for the rib's 3/2 law."""
    bearing = dataclasses.replace(
        load_bearing("HS130x230"),
        roller_count=110,
        roller_diameter=5.0e-3,
        rib_contact_height=1.0e-3,
        rib_undercut=0.5e-3,
        nominal_cup_angle=None,
        nominal_cone_angle=None,
        cage=dataclasses.replace(load_bearing("HS130x230").cage, circumferential_clearance=0.1e-3),
    )
    solution = solve(bearing, (0, 0, 80e3), end_play=0.0)
    count, angle = bearing.roller_count, bearing.cup_angle
    largest = 80e3 / (2 * count * math.cos(angle) * radial_integral(0.5))
    assert solution.largest_roller_load == pytest.approx(largest, rel=2e-3)
    thrust = float(solution.cup_load[1].sum()) * math.sin(angle)
    assert thrust == pytest.approx(count * largest * math.sin(angle) * axial_integral(0.5), rel=2e-3)


ZHANG = [(1500.0, 5000.0, 1304.8), (8000.0, 3000.0, 1731.3)]


@pytest.mark.parametrize(("radial", "axial", "published"), ZHANG)
def test_published_model_of_zhang_gives_its_printed_roller_load(radial, axial, published):
    """Zhang, Lv, Han, Li 2023, Sensors 23:4967, Table 3: 1304.8 and 1731.3 N, HH926700.

    The published model written out naively: cup loads along one normal, K delta^(10/9), not below the load
    that the centrifugal force alone gives. Its second case (1084.6 N) cannot be reproduced by anyone known:
    the published model gives 1126 N there.
    """
    assert _zhang(radial, axial) == pytest.approx(published, abs=0.1)


@pytest.mark.parametrize(("radial", "axial", "published"), ZHANG)
def test_static_equilibrium_agrees_with_the_published_model_of_zhang(radial, axial, published):
    """The same cases with rollers between cup, cone and rib, 0.5 %.

    The bearing is closed on its apex (22.59 and 16.19 deg instead of 22.54 and 16.24) with a rib that touches
    the roller end where it can (73.7 instead of 70.2 deg). The density makes the roller weigh the 0.126 kg of
    the paper.
    """
    bearing = _hh926700()
    speed = 1200.0 * math.pi / 30.0 / cage_speed_ratio(bearing)

    def preload_missing(end_play: float) -> float:
        solution = solve(bearing, (0, 0, 0), end_play=end_play)
        return float(solution.cup_load[0].sum()) * math.sin(bearing.cup_angle) - 100.0

    end_play = brentq(preload_missing, -2.0e-5, 0.0, xtol=1e-12)
    solution = solve(bearing, (0, axial, radial), (-20.0, 0, 0), end_play=end_play, tilt="free", speed=speed)
    assert solution.largest_roller_load == pytest.approx(published, rel=5e-3)


def _hh926700():
    model = load_bearing("HS130x230")
    bearing = dataclasses.replace(
        model,
        name="HH926700",
        roller_count=14,
        pitch_diameter=198.93e-3,
        roller_diameter=0.5 * (30.27e-3 + 36.74e-3),
        effective_length=57.02e-3,
        roller_length=58.8e-3,
        contact_angle=math.radians(0.5 * (22.54 + 16.24)),
        row_spacing=75.96e-3,
        bore=110e-3,
        outer_diameter=280e-3,
        width=190e-3,
        nominal_cup_angle=math.radians(22.54),
        nominal_cone_angle=math.radians(16.24),
        angle_tolerance=math.radians(0.06),
        material=dataclasses.replace(model.material, youngs_modulus=2.1e11),
    )
    density = bearing.material.density * 0.126 / bearing.roller_mass
    return dataclasses.replace(bearing, material=dataclasses.replace(bearing.material, density=density))


def _zhang(radial: float, axial: float) -> float:
    """Largest cup load of the published model; x along the radial load, z along the axle."""
    count, pitch_radius, offset, factor = 14, 0.19893 / 2, 0.07596 / 2, 6.0e9
    cup, rib = math.radians(22.54), math.radians(70.20)
    centrifugal = 0.126 * (1200.0 * math.pi / 30.0) ** 2 * pitch_radius
    least = centrifugal * math.sin(rib) / math.sin(cup + rib)
    preload = (100.0 / (count * factor * math.sin(cup))) ** 0.9
    angle = 2.0 * math.pi * np.arange(count) / count
    rows = []
    for position, sign in ((-offset, 1.0), (offset, -1.0)):
        ones = np.ones(count)
        normal = np.stack(
            [math.cos(cup) * np.cos(angle), math.cos(cup) * np.sin(angle), sign * math.sin(cup) * ones],
            axis=1,
        )
        point = np.stack(
            [pitch_radius * np.cos(angle), pitch_radius * np.sin(angle), position * ones], axis=1
        )
        rows.append(np.hstack([normal, np.cross(point, normal)[:, :2] / pitch_radius]))
    direction = np.vstack(rows)
    load = np.array([radial, 0.0, axial, 0.0, -20.0 / pitch_radius])
    floor = (least / factor) ** 0.9

    def at(unknowns):
        approach = direction @ unknowns + preload
        force = factor * np.maximum(approach, floor) ** (10.0 / 9.0)
        energy = 9.0 / 19.0 * force * np.maximum(approach, floor) + least * np.minimum(approach - floor, 0.0)
        stiffness = np.where(approach > floor, 10.0 / 9.0 * force / np.maximum(approach, floor), 0.0)
        hessian = (direction.T * stiffness) @ direction
        return energy.sum() - load @ unknowns, direction.T @ force - load, hessian, force

    unknowns, damping = np.zeros(5), 1.0e9
    energy, gradient, hessian, force = at(unknowns)
    for _ in range(200):
        if np.abs(gradient).max() < 1.0e-7:
            return float(force.max())
        moved = unknowns - np.linalg.solve(hessian + damping * np.eye(5), gradient)
        trial = at(moved)
        if trial[0] < energy or np.abs(trial[1]).max() < np.abs(gradient).max():
            unknowns, (energy, gradient, hessian, force) = moved, trial
            damping = max(0.2 * damping, 1.0)
        else:
            damping *= 5.0
    raise AssertionError("the published model did not converge")
