"""Contacts of the static model: gaps against brute force, inertia loads against first principles."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.config import load_bearing
from beardyn_core.physics.statics.roller_contacts import (
    ConePose,
    cone_contacts,
    contact_model,
    cup_contacts,
    rib_contacts,
)
from beardyn_core.physics.statics.static import _rotation

HS = load_bearing("HS130x230")


def test_gyroscopic_moment_is_that_of_a_body_precessing_with_the_cage():
    """The moment against a numerical derivative of the angular momentum of the spinning, orbiting roller."""
    speed = 2000.0 * math.pi / 30.0
    model = contact_model(HS, 0.0, 2, speed, 0.0)
    cage = cage_speed(HS, speed)
    spin = cage * math.sin(HS.cup_angle) / math.sin(HS.half_angle)

    def momentum(time_):
        azimuth = cage * time_
        radial = np.array([math.sin(azimuth), 0.0, math.cos(azimuth)])
        axis = math.cos(HS.contact_angle) * np.array([0.0, 1.0, 0.0]) + math.sin(HS.contact_angle) * radial
        rate = np.array([0.0, cage, 0.0]) - spin * axis
        along = (rate @ axis) * axis
        return HS.roller_axial_inertia * along + HS.roller_transverse_inertia * (rate - along)

    step = 1e-5
    needed = (momentum(step) - momentum(-step)) / (2.0 * step)
    gyroscopic = -float(needed @ model.tilt_axis[1, 0])
    offset = model.inertia_load[0] * HS.roller_mass_offset * math.cos(HS.contact_angle)
    assert model.inertia_load[2] == pytest.approx(gyroscopic + offset, rel=1e-6)
    # Derived: 0.24 N m from the spin alone; the turning of the roller with the cage adds a quarter.
    leading = HS.roller_axial_inertia * spin * cage * math.sin(HS.contact_angle)
    assert leading == pytest.approx(0.24, abs=5e-3)
    assert 1.0 < gyroscopic / leading < 1.3


@given(
    displacement=st.tuples(*[st.floats(-1e-4, 1e-4)] * 3),
    tilt=st.tuples(st.floats(-2e-3, 2e-3), st.floats(-2e-3, 2e-3)),
    roller=st.tuples(st.floats(-5e-5, 5e-5), st.floats(-1e-4, 1e-4), st.floats(-2e-3, 2e-3)),
    index=st.integers(0, HS.roller_count - 1),
    row=st.integers(0, 1),
)
@settings(max_examples=40, deadline=None)
def test_gaps_are_the_smallest_distances_found_by_brute_force(displacement, tilt, roller, index, row):
    """Every rim point of a lamina against both cones, searched over the rim; 0.1 nm (one pass)."""
    model = contact_model(HS, 1e-4, 5, 0.0, 0.1)
    pose = ConePose(np.array(displacement), _rotation(*tilt))
    position = np.broadcast_to(np.array(roller), (2, HS.roller_count, 3))
    found_cup = -cup_contacts(model, position).approach[row, index]
    found_cone = -cone_contacts(model, position, pose).approach[row, index]
    side = -1.0 if row == 0 else 1.0
    radial, axial = model.radial[row, index], model.axial[row, index]
    centre = (
        0.5 * HS.row_spacing * axial
        + 0.5 * HS.pitch_diameter * radial
        + roller[0] * radial
        + roller[1] * axial
    )
    angle = HS.contact_angle + roller[2]
    axis = math.cos(angle) * axial + math.sin(angle) * radial
    first = -math.sin(angle) * axial + math.cos(angle) * radial
    second = np.cross(axis, first)
    apex = 0.5 * HS.row_spacing - HS.apex_distance * math.cos(HS.contact_angle)

    def cup_gap(point):
        distance = np.hypot(point[..., 0], point[..., 2])
        height = side * point[..., 1] - apex
        return height * math.sin(HS.cup_angle) - distance * math.cos(HS.cup_angle) + model.clearance

    def cone_gap(point):
        seen = (point - pose.displacement) @ pose.rotation
        distance = np.hypot(seen[..., 0], seen[..., 2])
        return distance * math.cos(HS.cone_angle) - (side * seen[..., 1] - apex) * math.sin(HS.cone_angle)

    for lamina, x in enumerate(model.abscissa):
        for gap, middle, found in ((cup_gap, 0.0, found_cup), (cone_gap, math.pi, found_cone)):
            best = middle
            for width in (0.1, 1e-3, 1e-5):
                around = best + np.linspace(-width, width, 401)[:, None]
                rim = (
                    centre
                    + x * axis
                    + model.radius[row, index, lamina] * (np.cos(around) * first + np.sin(around) * second)
                )
                values = gap(rim)
                best = float(around[int(values.argmin()), 0])
            assert found[lamina] == pytest.approx(float(values.min()), abs=1e-10)


@given(
    displacement=st.tuples(*[st.floats(-1e-4, 1e-4)] * 3),
    roller=st.tuples(st.floats(-5e-5, 5e-5), st.floats(-1e-4, 1e-4), st.floats(-2e-3, 2e-3)),
)
@settings(max_examples=20, deadline=None)
def test_changes_of_approach_are_the_derivatives_of_the_gaps(displacement, roller):
    """Central differences; 1e-6 of a unit direction, from the one pass of the closed form."""
    model = contact_model(HS, 1e-4, 3, 0.0, 0.1)
    step = 1e-7
    unknowns = np.array([*displacement, 1e-3, -5e-4])

    def approaches(pose_unknowns, position):
        pose = ConePose(pose_unknowns[:3], _rotation(pose_unknowns[3], pose_unknowns[4]))
        sets = (cup_contacts(model, position), cone_contacts(model, position, pose))
        return *sets, rib_contacts(model, position, pose)

    position = np.broadcast_to(np.array(roller), (2, HS.roller_count, 3))
    at = approaches(unknowns, position)
    for kind, contact in enumerate(at):
        for axis in range(3):
            shift = step * np.eye(3)[axis]
            ahead, behind = (
                approaches(unknowns, position + shift)[kind],
                approaches(unknowns, position - shift)[kind],
            )
            slope = (ahead.approach - behind.approach) / (2.0 * step)
            np.testing.assert_allclose(contact.by_roller[..., axis], slope, atol=1e-6)
        for axis in range(5):
            shift = step * np.eye(5)[axis]
            ahead, behind = (
                approaches(unknowns + shift, position)[kind],
                approaches(unknowns - shift, position)[kind],
            )
            slope = (ahead.approach - behind.approach) / (2.0 * step)
            # A rotation vector turns a turned body by slightly more than itself: first order in the tilt.
            np.testing.assert_allclose(contact.by_cone[..., axis], slope, atol=1e-6 if axis < 3 else 2e-4)
