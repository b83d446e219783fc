"""Ribs of both rings before the ends of cylinders, against searches that know nothing of the closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from beardyn_core.base.jit import plain
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.kinematics import cage_speed, roller_spin
from beardyn_core.config import load_any_bearing, load_lubricant
from beardyn_core.effects import Rib
from beardyn_core.physics.flanges import Flange, FlangeParams, flange_params, flange_torque
from beardyn_core.physics.rib_gap import sphere_point
from beardyn_core.physics.tiers.massless_flanges import ThrustPathParams, _share, thrust_params

RIBS = ("cone_outer", "cone_inner", "cup_outer", "cup_inner")
DRY = Rib(friction=0.05, window=False, roller_end=False)


@cache
def pair() -> CylindricalBearing:
    """A pair with ribs at both sides of both rings."""
    bearing = load_any_bearing("WJ130x240")
    assert isinstance(bearing, CylindricalBearing)
    return replace(bearing, cone_ribs="both")


@cache
def flanges(rib: Rib = DRY) -> FlangeParams:
    found = flange_params(pair(), rib, load_lubricant("L055"), 343.15)
    assert found is not None
    return found


def flange(name: str) -> Flange:
    found: Flange = getattr(flanges(), name)
    return found


def along(name: str) -> float:
    return 1.0 if name.endswith("outer") else -1.0


def searched_depth(name: str, centre: np.ndarray, axis: np.ndarray) -> float:
    """Deepest point of the crowned end behind the face of a rib, by a search over the end.

    From the drawing: the face stands square to the axle at the contact height but for its opening, the end is
    a sphere through the middle of the end face, and ribs leave the play of rollers and axle.
    """
    bearing = pair()
    height, opening = bearing.rib_contact_height, bearing.rib_opening
    half_length, radius = 0.5 * bearing.roller_length, bearing.end_radius
    on_cone = name.startswith("cone")
    play = 0.5 * (bearing.end_play - bearing.roller_play if on_cone else bearing.roller_play)
    place = bearing.cone_radius + height if on_cone else bearing.cup_radius - height
    # where the nominal end is at the contact height, and the face a play beyond
    sag = radius - math.sqrt(radius**2 - (0.5 * bearing.roller_diameter - height) ** 2)
    face = 0.5 * bearing.row_spacing + along(name) * (half_length - sag + play)
    middle = centre + along(name) * (half_length - radius) * axis
    upright = np.array([1.0, 0.0, 0.0]) - axis[0] * axis
    upright /= np.linalg.norm(upright)
    aside = np.cross(axis, upright)

    def depth(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        out = np.sqrt(radius**2 - u**2 - v**2)
        point = (
            middle[:, None] + along(name) * out * axis[:, None] + u * upright[:, None] + v * aside[:, None]
        )
        from_axle = np.hypot(point[0], point[1])
        # faces open away from their raceway: those of the cone outwards, those of the cup inwards
        open_by = math.tan(opening) * (from_axle - place) * (1.0 if on_cone else -1.0)
        found: np.ndarray = along(name) * (point[2] - face) - open_by
        return found

    u0 = v0 = 0.0
    width = 0.4 * bearing.roller_diameter * 2.0
    for _ in range(12):
        grid = np.linspace(-width, width, 41)
        u, v = (each.ravel() for each in np.meshgrid(u0 + grid, v0 + grid))
        value = depth(u, v)
        best = int(np.argmax(value))
        u0, v0, width = u[best], v[best], 0.15 * width
    return float(value.max() * math.cos(opening))


@pytest.mark.parametrize("name", RIBS)
@settings(max_examples=25, deadline=None)
@given(
    st.tuples(*[st.floats(-1.0, 1.0)] * 3),
    st.floats(-2e-3, 2e-3),
    st.floats(-2e-3, 2e-3),
)
def test_depth_behind_a_rib_is_that_of_a_search(
    name: str, off: tuple[float, float, float], tilt: float, skew: float
) -> None:
    """Places within 0.1 mm, tilt and skew within 2 mrad: within 1 nm."""
    bearing, rib = pair(), flange(name).rib
    place = np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])
    centre = place + 1e-4 * np.array(off)
    axis = np.array([tilt, skew, 1.0])
    axis /= np.linalg.norm(axis)
    turned = along(name)
    point = plain(sphere_point)(tuple(centre), tuple(turned * axis), (0.0, 0.0, turned), rib, rib.window)
    assert float(point.depth) == pytest.approx(searched_depth(name, centre, axis), abs=1e-9)
    outward = np.array([float(each) for each in point.normal])
    assert turned * outward[2] > 0.99  # into the rib, at its end


@pytest.mark.parametrize("name", RIBS)
def test_torque_of_a_rib_is_friction_times_the_slip_of_rolling(name: str) -> None:
    """Slip from the speeds of both surfaces at the contact height, in the frame of the cage."""
    bearing, speed, load = pair(), 80.0, 600.0
    cage, spin = cage_speed(bearing, speed), roller_spin(bearing, speed)
    height = bearing.rib_contact_height
    from_axis = 0.5 * bearing.roller_diameter - height
    if name.startswith("cone"):
        ring = (speed - cage) * (bearing.cone_radius + height)
        slip = ring - spin * from_axis
    else:
        slip = cage * (bearing.cup_radius - height) - spin * from_axis
    power = DRY.friction * load * slip**2 / math.sqrt(slip**2 + DRY.regularisation_speed**2)
    found = float(plain(flange_torque)(np.array([load]), speed, flange(name))[0])
    assert found * speed == pytest.approx(power, rel=1e-6)


@settings(max_examples=60, deadline=None)
@given(st.floats(1e-8, 5e-5), st.floats(2e-6, 1e-4))
def test_share_of_thrust_is_the_root_of_its_way(way: float, depth: float) -> None:
    """Two contacts in series and a lean: by a bracketed search, within 0.5 %; the tangent by differences."""
    thrust = thrust_params(pair(), 30)
    assert thrust is not None
    path = thrust.inwards
    assert isinstance(path, ThrustPathParams)
    x = math.log2(depth)
    lean = 2.0 ** (thrust.level + x * (thrust.by_depth + x * thrust.depth_squared))
    root = brentq(lambda force: path.softness * force ** (2.0 / 3.0) + lean * force - way, 0.0, 1e7)

    def share(at: float) -> tuple[float, float]:
        force, tangent, _ = plain(_share)(np.array([at]), np.array([depth]), path, thrust)
        return float(force[0]), float(tangent[0])

    force, tangent = share(way)
    assert force == pytest.approx(root, rel=5e-3)
    step = 1e-4 * way
    assert tangent == pytest.approx((share(way + step)[0] - share(way - step)[0]) / (2.0 * step), rel=0.02)


def test_a_roller_that_leans_through_its_clearance_carries_nothing_before() -> None:
    thrust = thrust_params(pair(), 30)
    assert thrust is not None
    open_by, path = np.array([-5e-5]), thrust.inwards
    lost = thrust.tip * 5e-5
    for way, carries in ((0.9 * lost, False), (1.5 * lost, True)):
        force = plain(_share)(np.array([way]), open_by, path, thrust)[0]
        assert (float(force[0]) > 0.0) is carries


def added(way: float, depth: float) -> tuple[float, float]:
    """Axial force and what a roller adds to its raceways, [N]."""
    thrust = thrust_params(pair(), 30)
    assert thrust is not None
    force, _, more = plain(_share)(np.array([way]), np.array([depth]), thrust.inwards, thrust)
    return float(force[0]), float(more[0])


@pytest.mark.parametrize(
    ("way", "depth"), [(2e-6, 4e-5), (5e-6, 6e-5), (1e-5, 3e-5), (9e-5, -5e-5), (2e-4, -1e-4)]
)
def test_a_leaning_roller_presses_its_raceways_by_what_its_spring_gains_with_depth(
    way: float, depth: float
) -> None:
    """Energy: force over way, integrated, at two depths; a roller that is pressed all along blends."""
    thrust = thrust_params(pair(), 30)
    assert thrust is not None
    ways, step = np.linspace(0.0, way, 20_001), 1e-8
    energy = [
        np.trapezoid(plain(_share)(ways, np.full_like(ways, at), thrust.inwards, thrust)[0], ways)
        for at in (depth - step, depth + step)
    ]
    gained = float(energy[1] - energy[0]) / (2.0 * step)
    force, more = added(way, depth)
    expected = gained if depth < 0.0 else gained / (1.0 + gained / (thrust.tip * force))
    assert more == pytest.approx(expected, rel=2e-3)


def test_a_roller_that_touches_with_its_ends_alone_has_the_couple_of_its_ribs_over_its_length() -> None:
    bearing = pair()
    force, more = added(3e-4, -1e-4)
    assert more == pytest.approx(
        force * (bearing.roller_diameter - 2.0 * bearing.rib_contact_height) / bearing.effective_length
    )
    # none leaps as the raceways of a roller close
    assert added(3e-4, -1e-12)[1] == pytest.approx(added(3e-4, 1e-12)[1], rel=1e-3)
