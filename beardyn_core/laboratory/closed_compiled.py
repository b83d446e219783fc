"""Closed forms of the nine contacts compiled, with the kernels of the twin where it has the contact.

Raceways: `kernels.generator_line.generator_line`, one evaluation for all discs of a roller. Both ribs:
`kernels.rib.rib_gap`. The pocket lines of the text are no walls of the twin, and are worked out here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.jit import entry, inline
from beardyn_core.kernels.generator_line import generator_line
from beardyn_core.kernels.rib import rib_gap
from beardyn_core.kernels.vectors import add_scaled, dot, subtract
from beardyn_core.laboratory.nine_contacts import (
    SEARCHES_PER_ROLLER,
    RibFace,
    RollerPose,
    abscissae,
    disc_radius,
    large_rib,
    pocket_line,
    small_rib,
)
from beardyn_core.model.parameters import RacewayParams, RollerParams
from beardyn_core.model.ribs import RibEndParams, RibParams

_UP = (0.0, 0.0, 1.0)
_ALWAYS_THE_RIM = 2.0  # no cosine is larger


@inline
def _three(row: Any, at: Any) -> Any:
    return row[at], row[at + 1], row[at + 2]


@inline
def _disc_line(centre: Any, axis: Any, radius: Any, origin: Any, pole: Any) -> Any:
    along = dot(subtract(centre, origin), axis) / dot(pole, axis)
    arm = subtract(add_scaled(origin, along, pole), centre)
    return math.sqrt(dot(arm, arm)) - radius


@inline
def _end_lines(centre: Any, axis: Any, radius: Any, origin: Any, pole: Any) -> Any:
    """Return the gaps over both places of the edge of an end under a line."""
    arm = subtract(origin, centre)
    flat_arm = add_scaled(arm, -dot(arm, axis), axis)
    flat_pole = add_scaled(pole, -dot(pole, axis), axis)
    a, b = dot(flat_pole, flat_pole), dot(flat_arm, flat_pole)
    root = math.sqrt(b * b - a * (dot(flat_arm, flat_arm) - radius * radius))
    ahead = add_scaled(arm, (root - b) / a, pole)
    behind = add_scaled(arm, -(root + b) / a, pole)
    return -dot(ahead, axis), -dot(behind, axis)


@entry
def closed_gaps(
    poses: Any,
    roller: Any,
    cone: Any,
    cup: Any,
    places: Any,
    large: Any,
    small: Any,
    end: Any,
    lines: Any,
    sizes: Any,
    out: Any,
) -> None:
    """Write the gaps of all searches of many rollers.

    Parameters
    ----------
    poses : float64 array, shape [roller, 9]
        Centre, axis, displacement of the cone.
    roller, cone, cup, large, small, end : named tuples of the model
        The centre of the roller is its mid-length; the end is the edge of the small one.
    places : float64 array, shape [disc], [m]
    lines : float64 array, shape [4, 6]
        Origin and direction of the lines of C2.1, C3.1, C3.2, C4.
    sizes : float64 array, shape [4]
        Place of the sphere's centre, its radius, place and radius of the small end, [m].
    out : float64 array, shape [roller, search], [m]
    """
    count = len(places)
    for i in range(len(poses)):
        centre, axis = _three(poses[i], 0), _three(poses[i], 3)
        on_cone = subtract(centre, _three(poses[i], 6))
        inner = generator_line(on_cone, axis, _UP, 0.0, cone, roller)[5]
        outer = generator_line(centre, axis, _UP, 0.0, cup, roller)[5]
        for k in range(count):
            x = places[k]
            out[i, k] = -(inner[0] + x * (inner[1] + x * (inner[2] + x * inner[3])))
            out[i, count + k] = -(outer[0] + x * (outer[1] + x * (outer[2] + x * outer[3])))
        at = 2 * count
        out[i, at] = -rib_gap(on_cone, axis, _UP, large, None, None)[0]
        out[i, at + 1] = -rib_gap(on_cone, axis, _UP, small, None, end)[0]
        sphere = add_scaled(centre, sizes[0], axis)
        arm = subtract(sphere, _three(lines[0], 0))
        pole = _three(lines[0], 3)
        arm = add_scaled(arm, -dot(arm, pole), pole)
        out[i, at + 2] = math.sqrt(dot(arm, arm)) - sizes[1]
        for k in range(2):
            line = lines[1 + k]
            out[i, at + 3 + k] = _disc_line(centre, axis, roller.radius, _three(line, 0), _three(line, 3))
        small_end = add_scaled(centre, sizes[2], axis)
        ahead, behind = _end_lines(small_end, axis, sizes[3], _three(lines[3], 0), _three(lines[3], 3))
        out[i, at + 5], out[i, at + 6] = ahead, behind


def rib_face_params(face: RibFace, sphere_radius: float, sphere_place: float) -> RibParams:
    """Build the geometry of a rib for `rib_gap`; what belongs to its force is zero."""
    return RibParams(
        stiffness=0.0,
        sphere_radius=sphere_radius,
        sphere_place=sphere_place,
        normal_axial=face.normal_axial,
        normal_radial=face.normal_radial,
        distance=face.distance,
        friction=0.0,
        regularisation=0.0,
        window=None,
        end=None,
        film=None,
        drilling=None,
    )


class ClosedForms:
    """Compiled closed forms of a bearing."""

    def __init__(self, bearing: Bearing) -> None:
        half = 0.5 * bearing.roller_length
        lines = [pocket_line(bearing, name).place for name in ("C2.1", "C3.1", "C3.2", "C4.1")]
        self._constants = (
            RollerParams(
                mass=0.0,
                axial_inertia=0.0,
                transverse_inertia=0.0,
                radius=disc_radius(bearing, 0.0),
                taper=math.tan(bearing.half_angle),
                apex=0.5 * bearing.row_spacing - bearing.apex_distance * math.cos(bearing.contact_angle),
                half_length=half,
                mass_offset=0.0,
            ),
            RacewayParams(math.sin(bearing.cone_angle), math.cos(bearing.cone_angle), -1.0, 0.0),
            RacewayParams(math.sin(bearing.cup_angle), math.cos(bearing.cup_angle), 1.0, 0.0),
            abscissae(bearing),
            rib_face_params(large_rib(bearing), bearing.sphere_radius, bearing.sphere_centre),
            rib_face_params(small_rib(bearing), bearing.small_end_radius, -half),
            RibEndParams(bearing.small_end_radius, -half, _ALWAYS_THE_RIM, 1e-4),
            np.array([np.concatenate([line.origin, line.pole]) for line in lines]),
            np.array([bearing.sphere_centre, bearing.sphere_radius, -half, bearing.small_end_radius]),
        )

    def gaps(self, poses: Sequence[RollerPose]) -> Float:
        """Return the gaps, shape [roller, search], [m]."""
        out = np.zeros((len(poses), SEARCHES_PER_ROLLER))
        self.gaps_into(pose_rows(poses), out)
        return out

    def gaps_into(self, rows: Float, out: Float) -> None:
        """Write the same into an array that exists, for timing; ``rows`` from `pose_rows`."""
        closed_gaps(rows, *self._constants, out)


def pose_rows(poses: Sequence[RollerPose]) -> Float:
    """Return poses as an array, shape [roller, 9]."""
    return np.array([np.concatenate([pose.centre, pose.axis, pose.cone]) for pose in poses])
