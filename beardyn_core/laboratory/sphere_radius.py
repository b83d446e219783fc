"""The roller end whose sphere is too large for its rib: where the general search puts the contact.

The rib face stays that of the healthy bearing; only the radius of the roller end grows, and the roller moves
along its axis until the sphere it is drawn with touches the face. The search knows neither the edges of the
rib face nor the rim of the roller end, so its contact wanders off both. The kernel of the twin bounds both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import Any

import numpy as np
from scipy.optimize import brentq

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry
from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory.closed_forms import rib_face_params
from beardyn_core.laboratory.nine_contacts import RibFace, RollerPose, end_sphere, large_rib, nominal_pose
from beardyn_core.laboratory.search import SURFACES, Pair, condition_number, search
from beardyn_core.physics.rib_gap import RibEndParams, RibWindowParams, rib_gap

SPHERE_RATIOS = (0.80, 0.85, 0.90, 0.95, 1.00, 1.05, 1.20)
PUSH = 10e-6  # how far the roller is pushed into the rib, [m]
SKEW = 0.5e-3  # of the roller, [rad]: at an even placement a search may sit on what it cannot hold
_ROUNDING = 0.2e-3
_SMALLEST_BEND = 0.01
_LONGEST_MOVE = 2e-3


@dataclass(frozen=True)
class SphereCase:
    """One radius of the roller end."""

    ratio: A[float, "sphere radius over the distance from the apex to the edge of the large end, [-]"]
    radius: A[float, "[m]"]
    search_height: A[float, "of the contact over the cone raceway, by the general search, [m]"]
    bounded_height: A[float, "the same by the bounded closed form, [m]"]
    search_gap: A[float, "of the general search with the roller pushed in, [m]"]
    search_converged: bool
    condition: A[float, "of its Jacobian"]
    on_face: A[bool, "whether its contact lies on the rib face"]
    in_rim: A[bool, "whether it lies within the rim of the roller end"]
    bounded_depth: A[float, "penetration of the bounded closed form, [m]"]
    carried_by: A[str, "what bears in the bounded closed form: ``face``, ``edge of the face`` or ``rim``"]
    refused: A[bool, "whether the consistency check of the bearing refuses this radius"]


@entry
def bounded_contact(centre: Any, axis: Any, rib: Any, window: Any, end: Any, out: Any) -> None:
    """Write depth, normal and arm of the rib contact with edges and rim to ``out`` [7]."""
    depth, normal, arm = rib_gap(
        (centre[0], centre[1], centre[2]), (axis[0], axis[1], axis[2]), (0.0, 0.0, 1.0), rib, window, end
    )
    out[0] = depth
    for i in range(3):
        out[1 + i], out[4 + i] = normal[i], arm[i]


def _contact_height(bearing: Bearing, pose: RollerPose, point: Float) -> float:
    """Return the height of a point over the cone raceway, square to the roller axis, [m]."""
    arm = point - pose.centre
    across = arm - (arm @ pose.axis) * pose.axis
    inwards = -float(across[0]) / math.hypot(pose.axis[2], 0.0)
    return bearing.large_end_radius - inwards


def _window(bearing: Bearing, face: RibFace) -> RibWindowParams:
    nominal = face.radial * face.normal_axial - face.axial * face.normal_radial
    along = 1.0 / math.cos(bearing.rib_polar_angle)
    low = nominal + (bearing.rib_undercut - bearing.rib_contact_height) * along + _ROUNDING
    high = nominal + (bearing.rib_height - bearing.rib_contact_height) * along - _ROUNDING
    return RibWindowParams(low, high, _ROUNDING)


def _end(bearing: Bearing, case: Bearing) -> RibEndParams:
    radius = bearing.large_end_radius - bearing.roller_chamfer
    ahead = math.sqrt(case.sphere_radius**2 - radius**2)
    return RibEndParams(
        radius=radius,
        place=case.sphere_centre + ahead,
        cosine=ahead / case.sphere_radius,
        smallest_bend=_SMALLEST_BEND * math.sin(bearing.rib_polar_angle),
        both=None,
    )


def sphere_case(bearing: Bearing, ratio: float) -> SphereCase:
    """Compare what both methods find for one sphere on the rib of a healthy bearing.

    The roller, skewed by `SKEW`, is moved along its axis until the bounded roller end just touches, then
    pushed in by `PUSH`.
    """
    # the rib would follow the sphere, so the face is that of the first bearing
    case = replace(bearing, sphere_ratio=ratio, forced=True)
    face = large_rib(bearing)
    rib = rib_face_params(face, case.sphere_radius, case.sphere_centre)
    window, end = _window(bearing, face), _end(bearing, case)
    nominal = nominal_pose(bearing)
    axis = nominal.axis + np.array([0.0, SKEW, 0.0])
    nominal = RollerPose(nominal.centre, axis / np.linalg.norm(axis), nominal.cone)
    out = np.zeros(7)

    def moved(along: float) -> RollerPose:
        return RollerPose(nominal.centre + along * nominal.axis, nominal.axis, nominal.cone)

    def depth(along: float) -> float:
        pose = moved(along)
        bounded_contact(pose.centre, pose.axis, rib, window, end, out)
        return float(out[0])

    touch = brentq(depth, -_LONGEST_MOVE, _LONGEST_MOVE, xtol=1e-15)
    pose = moved(float(touch) + PUSH)
    bounded = depth(float(touch) + PUSH)
    pair = Pair(end_sphere(case, pose), face.shape(pose.cone), SURFACES)
    found = search(pair, np.array([0.5 * math.pi - bearing.rib_polar_angle, math.pi, 0.0, 0.0]))
    height = _contact_height(bearing, pose, found.p)
    rim = bearing.large_end_radius - bearing.roller_chamfer
    arm = found.p - pose.centre
    off_axis = float(np.linalg.norm(arm - (arm @ pose.axis) * pose.axis))
    normal, place = out[1:4], out[4:7]
    at_edge = abs(normal[2] - face.normal_axial) > 1e-4
    carrier = "rim" if normal @ pose.axis < end.cosine else "edge of the face" if at_edge else "face"
    return SphereCase(
        ratio=ratio,
        radius=case.sphere_radius,
        search_height=height,
        bounded_height=_contact_height(bearing, pose, pose.centre + place),
        search_gap=found.gap,
        search_converged=found.converged,
        condition=condition_number(pair, found.parameters) if found.converged else math.inf,
        on_face=found.converged and bearing.rib_undercut <= height <= bearing.rib_height,
        in_rim=found.converged and off_axis <= rim,
        bounded_depth=bounded,
        carried_by=carrier,
        refused=bool(check(replace(case, forced=False))),
    )


def sphere_cases(bearing: Bearing) -> tuple[SphereCase, ...]:
    """Compare all of `SPHERE_RATIOS`."""
    return tuple(sphere_case(bearing, ratio) for ratio in SPHERE_RATIOS)
