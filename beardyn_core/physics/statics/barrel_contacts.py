"""Contacts of barrels between a spherical cup and the grooves of a cone, for a pose of cone and rollers.

Rollers move in meridian planes of the cone, which guides them, and their places are counted from it: when the
cone turns about the middle of the sphere, everything turns with it and no gap changes.

All profiles are arcs. Two of them are closest on the line through their centres, which gives the approach of
the ellipse's middle and its place on the roller; the slices are `contact_law.SlicedEllipse`. The arc that
faces the sphere lies in the plane of the roller's axis and the sphere's middle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import barrel_ellipse, power_law
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.physics.statics.roller_contacts import ConePose, ContactModel, ContactSet

SLICE_EXPONENT = 1.0
# arcs whose centres are this close have no line through them; they are far out of contact there [m]
_CONCENTRIC = 1.0e-9
_NOT_ASKED = np.empty(0)


class _Barrels(NamedTuple):
    """Rollers in their meridian planes; components radial and axial outwards."""

    centre: Float  # [row, roller, 2], from the bearing centre [m]
    axis: Float  # [row, roller, 2]
    across: Float  # [row, roller, 2], square to the axis, away from the bearing axis


class _Middle(NamedTuple):
    """Middle of the ellipse of every roller; `by` is a change with motions, [row, roller, motion]."""

    approach: Float  # [row, roller], [m]
    approach_by_roller: Float
    approach_by_cone: Float
    place: Float  # [row, roller], on the roller from mid-length [m]
    place_by_roller: Float
    place_by_cone: Float


def cup_contacts(model: ContactModel, roller: Float, pose: ConePose, by_cone: bool = True) -> ContactSet:
    """Work out the slices on the spherical cup; `roller` is radial, axial, tilt, shape [row, roller, 3]."""
    bearing = _spherical(model)
    barrels = _place(bearing, roller)

    def turned(plane: Float) -> Float:
        in_cone: Float = plane[..., 0:1] * model.radial + plane[..., 1:2] * model.axial
        return in_cone @ pose.rotation.T

    from_cone, axis, across = turned(barrels.centre), turned(barrels.axis), turned(barrels.across)
    from_cup = from_cone + pose.displacement
    lever = bearing.roller_profile_radius - 0.5 * bearing.roller_diameter
    along = _dot(from_cup, axis)
    facing = from_cup - along[..., None] * axis
    facing = facing / np.linalg.norm(facing, axis=-1, keepdims=True)
    between = from_cup - lever * facing
    distance = np.maximum(np.linalg.norm(between, axis=-1), _CONCENTRIC)
    normal = between / distance[..., None]
    tilt_axis = model.tilt_axis @ pose.rotation.T
    moves = np.stack([turned(np.array([1.0, 0.0])), turned(np.array([0.0, 1.0]))], axis=-2)
    by_roller = np.empty(roller.shape)
    by_roller[..., :2] = np.einsum("ijkn,ijn->ijk", moves, normal)
    by_roller[..., 2] = -lever * _dot(np.cross(tilt_axis, facing), normal)
    along_by = np.empty(roller.shape)
    along_by[..., :2] = np.einsum("ijkn,ijn->ijk", moves, axis)
    along_by[..., 2] = _dot(from_cup, across)
    following = along_by_cone = _NOT_ASKED
    if by_cone:
        following = np.zeros((*roller.shape[:2], 5 + model.bending.shape[-1]))
        along_by_cone = np.zeros_like(following)
        turning = np.cross(between - pose.displacement, normal)
        along_turning = -np.cross(pose.displacement, axis)
        following[..., :3], along_by_cone[..., :3] = normal, axis
        following[..., 3:5], along_by_cone[..., 3:5] = turning[..., [0, 2]], along_turning[..., [0, 2]]
    approach = distance + bearing.roller_profile_radius - bearing.sphere_radius
    middle = _middle(bearing, approach, distance, along, (by_roller, following), (along_by, along_by_cone))
    if by_cone:
        middle.approach_by_cone[..., 5:] = -math.cos(bearing.cup_angle) * model.bending
    if pose.bending.size:
        opened = math.cos(bearing.cup_angle) * (model.bending @ pose.bending)
        middle = middle._replace(approach=middle.approach - opened)
    return _slices(model, "cup", middle)


def cone_contacts(model: ContactModel, roller: Float, by_cone: bool = True) -> ContactSet:
    """Work out the slices on the grooves of the cone, in its own axes; see `cup_contacts`."""
    bearing = _spherical(model)
    barrels, at_rest = _place(bearing, roller), _place(bearing, np.zeros((1, 1, 3)))
    radius = 0.5 * bearing.roller_diameter
    arc, groove = bearing.roller_profile_radius, bearing.cone_profile_radius
    from_groove = barrels.centre - at_rest.centre - (groove - radius) * at_rest.across
    between = from_groove + (arc - radius) * barrels.across
    distance = np.maximum(np.linalg.norm(between, axis=-1), _CONCENTRIC)
    normal = between / distance[..., None]
    by_roller, along_by = np.empty(roller.shape), np.empty(roller.shape)
    by_roller[..., :2], along_by[..., :2] = normal, barrels.axis
    by_roller[..., 2] = -(arc - radius) * _dot(barrels.axis, normal)
    along_by[..., 2] = _dot(from_groove, barrels.across)
    still = np.zeros((*roller.shape[:2], 5 + model.bending.shape[-1])) if by_cone else _NOT_ASKED
    along = _dot(from_groove, barrels.axis)
    middle = _middle(bearing, distance + arc - groove, distance, along, (by_roller, still), (along_by, still))
    return _slices(model, "cone", middle)


def _spherical(model: ContactModel) -> SphericalBearing:
    assert isinstance(model.bearing, SphericalBearing)
    return model.bearing


def _dot(one: Float, other: Float) -> Float:
    product: Float = np.sum(one * other, axis=-1)
    return product


def _place(bearing: SphericalBearing, roller: Float) -> _Barrels:
    """Place the rollers: outer ends lean towards the bearing axis, a positive tilt turns them outwards."""
    distance, angle = bearing.centre_distance, bearing.contact_angle
    centre = distance * np.array([math.cos(angle), math.sin(angle)]) + roller[..., :2]
    lean = roller[..., 2] - angle
    axis = np.stack([np.sin(lean), np.cos(lean)], axis=-1)
    across = np.stack([np.cos(lean), -np.sin(lean)], axis=-1)
    return _Barrels(centre, axis, across)


def _middle(
    bearing: SphericalBearing,
    approach: Float,
    distance: Float,
    along: Float,
    approach_by: tuple[Float, Float],
    along_by: tuple[Float, Float],
) -> _Middle:
    """Find the middle of the ellipse: where the line through the centres of both arcs meets the roller.

    Parameters
    ----------
    approach, distance, along : float64 arrays, shape [row, roller]
        Of the arcs; of their centres from each other, and that along the roller, [m].
    approach_by, along_by : pairs of float64 arrays
        Changes with the motion of roller and cone.
    """
    place = bearing.roller_profile_radius * along / distance
    scale = (bearing.roller_profile_radius / distance)[..., None]
    lean = (along / distance)[..., None]
    by_roller, by_cone = (
        scale * (each - lean * other) if each.size else _NOT_ASKED
        for each, other in zip(along_by, approach_by, strict=True)
    )
    return _Middle(approach, *approach_by, place, by_roller, by_cone)


def _slices(model: ContactModel, ring: str, middle: _Middle) -> ContactSet:
    """Press the slices of every roller; the nearer to the ellipse's middle, the deeper."""
    bearing = _spherical(model)
    law = barrel_ellipse(bearing, ring)
    from_middle = model.abscissa - middle.place[..., None]
    approach = middle.approach[..., None] - (from_middle / law.reach) ** 2 - model.drop + model.oversize
    slope = (2.0 / law.reach**2) * from_middle[..., None]

    def changes(of_approach: Float, of_place: Float) -> Float:
        if not of_approach.size:
            return _NOT_ASKED
        return np.asarray(of_approach[:, :, None, :] + slope * of_place[:, :, None, :])

    width = bearing.effective_length / model.abscissa.size
    force, stiffness, energy = power_law(approach, law.stiffness * width, SLICE_EXPONENT)
    return ContactSet(
        approach,
        force,
        stiffness,
        energy,
        changes(middle.approach_by_roller, middle.place_by_roller),
        changes(middle.approach_by_cone, middle.place_by_cone),
    )
