"""Static loads of spherical roller bearings: Hertz in slices, self-alignment, rows under thrust."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.contact_law import barrel_ellipse
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.modal_body import bending_rings
from beardyn_core.physics.statics import barrel_contacts
from beardyn_core.physics.statics.roller_contacts import ConePose, ContactSet, contact_model
from beardyn_core.physics.statics.roller_equilibrium import RollerState, solve_rollers
from beardyn_core.physics.statics.static import StaticSolution, solve
from evidence.validation.kind_solutions import half_space_load, hertz_of, hertz_rows, sliced_load
from evidence.validation.roller_kinds import moment_of_grooves
from test.bearings import SPHERICAL
from test.kernels.naive import Float

LAMINAE = 30


def shipped(name: str = "SRB120x260") -> SphericalBearing:
    bearing = load_any_bearing(name)
    assert isinstance(bearing, SphericalBearing)
    return bearing


def rest(bearing: SphericalBearing, *force: float, laminae: int = LAMINAE) -> StaticSolution:
    return solve(bearing, force, end_play=None, laminae=laminae)


@pytest.mark.parametrize("name", SPHERICAL)
@pytest.mark.parametrize("ring", ["cup", "cone"])
@pytest.mark.parametrize("share", [0.3, 0.6, 0.95])
def test_slices_have_load_and_length_of_hertz(name: str, ring: str, share: float) -> None:
    """Ellipses of a share of the roller's length."""
    bearing = shipped(name)
    exact, law = hertz_of(bearing, ring), barrel_ellipse(bearing, ring)
    approach = (0.5 * share * bearing.effective_length / law.reach) ** 2
    place = ((np.arange(2000) + 0.5) / 2000 - 0.5) * bearing.effective_length
    loads = law.stiffness * np.maximum(approach - (place / law.reach) ** 2, 0.0)
    load = exact.factor * approach**1.5
    assert loads.mean() * bearing.effective_length == pytest.approx(load, rel=1e-5)
    assert np.abs(place[loads > 0.0]).max() == pytest.approx(exact.semi_axes(load)[0], rel=2e-3)


@pytest.mark.parametrize(("load", "within"), [(5e3, 0.005), (15e3, 0.005), (30e3, 0.03)])
@pytest.mark.parametrize("ring", ["cup", "cone"])
def test_slices_are_those_of_the_half_space(ring: str, load: float, within: float) -> None:
    """Pressures on a grid; the ellipse of 30 kN is 1.2 times as long as the roller."""
    bearing = shipped()
    approach = (load / hertz_of(bearing, ring).factor) ** (2.0 / 3.0)
    expected = half_space_load(bearing, ring, load, approach)
    assert sliced_load(bearing, ring, approach) == pytest.approx(expected, rel=within)


def pose_of(tilt_x: float, tilt_z: float, shift: Float) -> ConePose:
    angle = math.hypot(tilt_x, tilt_z)
    cross = np.array([[0.0, -tilt_z, 0.0], [tilt_z, 0.0, -tilt_x], [0.0, tilt_x, 0.0]])
    if angle == 0.0:
        return ConePose(shift, np.eye(3))
    turned = np.eye(3) + np.sin(angle) / angle * cross
    turned += (1.0 - np.cos(angle)) / angle**2 * cross @ cross
    return ConePose(turned @ shift, turned)


def moment_about_sphere(bearing: SphericalBearing, state: RollerState, pose: ConePose) -> Float:
    """Moment of the rollers on the cone about the middle of the sphere, components x and z, [N m]."""
    force, about_cone = state.cone_force[:3], np.zeros(3)
    about_cone[[0, 2]] = state.cone_force[3:5]
    return np.asarray((about_cone + np.cross(pose.displacement, force))[[0, 2]])


@pytest.mark.parametrize("tilt", [(0.02, 0.0), (-0.01, 0.03)])
def test_tilt_changes_no_load_and_meets_no_moment(tilt: tuple[float, float]) -> None:
    """Self-alignment: cone and rollers turn in the sphere; 20 mrad, an axle bends by 1."""
    bearing, shift = shipped(), np.array([2e-5, 9e-5, 11e-5])
    model = contact_model(bearing, 0.0, LAMINAE, 0.0, 0.1)
    straight, turned = (pose_of(*each, shift) for each in ((0.0, 0.0), tilt))
    before, after = solve_rollers(model, straight, None), solve_rollers(model, turned, None)
    heaviest = before.cup.force.sum(axis=-1).max()
    assert heaviest > 5e3
    assert_allclose(after.cup.force, before.cup.force, atol=1e-7 * heaviest)
    assert_allclose(after.cone.force, before.cone.force, atol=1e-7 * heaviest)
    size = np.linalg.norm(before.cone_force[:3]) * bearing.sphere_radius
    for state, pose in ((before, straight), (after, turned)):
        assert np.abs(moment_about_sphere(bearing, state, pose)).max() < 1e-9 * size


@pytest.mark.parametrize("force", [(0.0, 0.0, 80e3), (0.0, 15e3, 60e3)])
def test_grooves_press_the_cone_through_the_middle_of_the_sphere(force: tuple[float, float, float]) -> None:
    """To 1e-4 of load times radius: a cage holds rollers that lie next to the load line by as much."""
    assert moment_of_grooves(*force) < 1e-4


@pytest.mark.parametrize("change", [2e-6, -3e-6])
def test_a_roller_of_another_size_takes_another_load(change: float) -> None:
    bearing = shipped()
    oversize = np.zeros((2, bearing.roller_count))
    oversize[1, 0] = change
    force = (0.0, 0.0, 60e3)
    plain, changed = (
        rest(bearing, *force),
        solve(bearing, force, end_play=None, laminae=LAMINAE, oversize=oversize),
    )
    assert bool(changed.cup_load[1, 0] > plain.cup_load[1, 0]) is (change > 0.0)
    assert changed.cup_load[1, 0] != pytest.approx(plain.cup_load[1, 0], rel=0.02)


def test_tilt_has_no_stiffness() -> None:
    """Of the tilt about the sphere's middle, the cone not displaced otherwise."""
    model = contact_model(replace(shipped(), radial_clearance=-4e-5), 0.0, LAMINAE, 0.0, 0.0)
    state = solve_rollers(model, ConePose(np.zeros(3), np.eye(3)), None)
    along = state.cone_stiffness[2, 2]
    lever = 0.1
    assert along > 1e8
    assert np.abs(state.cone_stiffness[3:5, :5]).max() < 1e-9 * along * lever**2


def test_changes_of_approach_are_the_derivatives_of_the_gaps() -> None:
    bearing = shipped()
    body = bending_rings(bearing, "elastic")
    model = contact_model(bearing, 0.0, 11, 0.0, 0.3, body=body)
    assert body is not None
    generator = np.random.default_rng(3)
    roller = generator.normal(size=(2, bearing.roller_count, 3)) * np.array([2e-5, 2e-5, 2e-4])
    shift, tilt = np.array([3e-5, -2e-5, 5e-5]), (2e-3, -1e-3)
    bend = generator.normal(size=body.rate.size) * 1e-5

    def pose(change: Float) -> ConePose:
        base = pose_of(*tilt, np.zeros(3)).rotation
        small = pose_of(change[3], change[4], np.zeros(3)).rotation
        return ConePose(shift + change[:3], small @ base, bend + change[5:])

    def cup(q: Float, change: Float) -> ContactSet:
        return barrel_contacts.cup_contacts(model, q, pose(change))

    nothing = np.zeros(5 + bend.size)
    found = cup(roller, nothing)
    step = 1e-7
    for k in range(nothing.size):
        change = np.zeros(nothing.size)
        change[k] = step
        slope = (cup(roller, change).approach - cup(roller, -change).approach) / (2.0 * step)
        scale = np.abs(slope).max() + 1e-3
        assert_allclose(found.by_cone[..., k], slope, atol=2e-5 * scale)
    cone = barrel_contacts.cone_contacts(model, roller)
    for k in range(3):
        change = np.zeros(3)
        change[k] = step
        for contact, at in ((found, cup), (cone, None)):
            ahead, behind = (
                barrel_contacts.cone_contacts(model, roller + sign * change)
                if at is None
                else at(roller + sign * change, nothing)
                for sign in (1.0, -1.0)
            )
            slope = (ahead.approach - behind.approach) / (2.0 * step)
            assert_allclose(contact.by_roller[..., k], slope, atol=2e-5 * (np.abs(slope).max() + 1e-3))


@pytest.mark.parametrize("name", SPHERICAL)
@pytest.mark.parametrize("force", [(0.0, 0.0, 60e3), (0.0, 8e3, 40e3), (10e3, -12e3, 30e3), (0.0, 0.0, 20e3)])
def test_load_distribution_is_that_of_hertz_along_the_contact_lines(
    name: str, force: tuple[float, float, float]
) -> None:
    """To 3 % of the heaviest roller: rollers shift and tilt a little in the grooves, which springs do not.

    Loads with no ellipse longer than a roller: there Hertz is too stiff.
    """
    bearing = shipped(name)
    expected = hertz_rows(bearing, np.array(force))
    found = rest(bearing, *force).cup_load
    assert found.max() == pytest.approx(expected.max(), rel=0.03)
    assert_allclose(found, expected, atol=0.03 * expected.max())


def test_thrust_loads_one_row_more_and_beyond_the_limit_alone() -> None:
    bearing, radial = shipped(), 40e3
    tangent = math.tan(bearing.contact_angle)
    shares = []
    for axial in (0.0, 0.5 * tangent * radial, 3.0 * tangent * radial):
        rows = rest(bearing, 0.0, axial, radial).cup_load.sum(axis=1)
        shares.append(rows[0] / rows.sum())
    assert shares[0] == pytest.approx(0.5, abs=1e-9)
    assert 0.0 < shares[1] < 0.45
    assert shares[2] == pytest.approx(0.0, abs=1e-3)


def test_free_travel_of_the_cone_is_the_radial_clearance() -> None:
    bearing = replace(shipped(), radial_clearance=2e-4)
    light = rest(bearing, 0.0, 0.0, 1.0).displacement[2]
    assert light == pytest.approx(1e-4, rel=0.02)


def test_stiffness_is_the_slope_of_load_over_displacement() -> None:
    bearing, step = shipped(), 50.0
    force = np.array([0.0, 10e3, 80e3])
    fine = 200
    middle = rest(bearing, *force, laminae=fine)
    slopes = np.zeros((3, 3))
    for axis in range(3):
        change = np.zeros(3)
        change[axis] = step
        ahead, behind = (rest(bearing, *(force + sign * change), laminae=fine) for sign in (1.0, -1.0))
        slopes[:, axis] = (ahead.displacement - behind.displacement) / (2.0 * step)
    assert_allclose(slopes @ middle.stiffness_tilt_held, np.eye(3), atol=0.01)
    assert_allclose(middle.stiffness_tilt_free, middle.stiffness_tilt_held)


@pytest.mark.parametrize(
    "force", [(0.0, 60e3, 5e3), (0.0, 0.0, 100.0), (50e3, -20e3, -90e3), (0.0, 5e3, 700e3), (0.0, 40e3, 0.0)]
)
@pytest.mark.parametrize("speed", [0.0, 100.0])
def test_hard_cases_converge(force: tuple[float, float, float], speed: float) -> None:
    found = solve(shipped(), force, end_play=None, laminae=LAMINAE, speed=speed)
    assert found.residual < 1e-6 * np.linalg.norm(force)


def test_what_a_self_aligning_bearing_cannot_have_is_refused() -> None:
    bearing = shipped()
    with pytest.raises(InputError) as caught:
        solve(
            bearing,
            (0.0, 0.0, 8e4),
            (100.0, 0.0, 0.0),
            end_play=None,
            laminae=3,
            coupling=LaminaCoupling(),
        )
    text = str(caught.value)
    for part in ("self-aligning", "laminae is 3", "cannot be coupled"):
        assert part in text
