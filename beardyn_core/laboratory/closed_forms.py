"""Closed forms of the nine contacts and of simple shapes, in plain NumPy and compiled.

Compiled are the raceways by `physics.generator_line.generator_line`, one evaluation for all discs of a
roller, and both ribs by `physics.rib_gap.rib_gap`. The pocket lines of the text are no walls of the
twin, and are worked out here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory import nine_contacts
from beardyn_core.laboratory.shapes import Arc, Circle, Cone, Shape, Straight, unit
from beardyn_core.physics.generator_line import generator_line
from beardyn_core.physics.lamina_table import lamina_places
from beardyn_core.physics.lanes.vectors import add_scaled, dot, subtract
from beardyn_core.physics.rib import RibParams
from beardyn_core.physics.rib_gap import RibEndParams, rib_gap
from beardyn_core.physics.tiers.parameters import RacewayParams, RollerParams

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


def rib_face_params(face: nine_contacts.RibFace, sphere_radius: float, sphere_place: float) -> RibParams:
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
        lines = [nine_contacts.pocket_line(bearing, name).place for name in ("C2.1", "C3.1", "C3.2", "C4.1")]
        self._constants = (
            RollerParams(
                mass=0.0,
                axial_inertia=0.0,
                transverse_inertia=0.0,
                radius=nine_contacts.disc_radius(bearing, 0.0),
                taper=math.tan(bearing.half_angle),
                apex=bearing.apex_place,
                half_length=half,
                mass_offset=0.0,
            ),
            RacewayParams(math.sin(bearing.cone_angle), math.cos(bearing.cone_angle), -1.0, 0.0),
            RacewayParams(math.sin(bearing.cup_angle), math.cos(bearing.cup_angle), 1.0, 0.0),
            lamina_places(bearing, nine_contacts.SLICES),
            rib_face_params(nine_contacts.large_rib(bearing), bearing.sphere_radius, bearing.sphere_centre),
            rib_face_params(nine_contacts.small_rib(bearing), bearing.small_end_radius, -half),
            RibEndParams(bearing.small_end_radius, -half, _ALWAYS_THE_RIM, 1e-4, None),
            np.array([np.concatenate([line.origin, line.pole]) for line in lines]),
            np.array([bearing.sphere_centre, bearing.sphere_radius, -half, bearing.small_end_radius]),
        )

    def gaps(self, poses: Sequence[nine_contacts.RollerPose]) -> Float:
        """Return the gaps, shape [roller, search], [m]."""
        out = np.zeros((len(poses), nine_contacts.SEARCHES_PER_ROLLER))
        self.gaps_into(pose_rows(poses), out)
        return out

    def gaps_into(self, rows: Float, out: Float) -> None:
        """Write the same into an array that exists, for timing; ``rows`` from `pose_rows`."""
        closed_gaps(rows, *self._constants, out)


def pose_rows(poses: Sequence[nine_contacts.RollerPose]) -> Float:
    """Return poses as an array, shape [roller, 9]."""
    return np.array([np.concatenate([pose.centre, pose.axis, pose.cone]) for pose in poses])


_ROUNDS = 4
_AXIS = np.array([0.0, 0.0, 1.0])


def contact_gap(bearing: Bearing, pose: nine_contacts.RollerPose, contact: nine_contacts.Contact) -> float:
    """Return the gap of one of the nine contacts in closed form, [m]."""
    name = contact.name
    if name in ("Inner", "Outer"):
        return raceway_gap(bearing, pose, name, contact.abscissa)
    if name == "FR":
        centre = pose.centre + bearing.sphere_centre * pose.axis - pose.cone
        return sphere_rib_gap(centre, bearing.sphere_radius, nine_contacts.large_rib(bearing))
    if name == "FL":
        end = pose.centre - 0.5 * bearing.roller_length * pose.axis - pose.cone
        return circle_rib_gap(end, pose.axis, bearing.small_end_radius, nine_contacts.small_rib(bearing))
    line = nine_contacts.pocket_line(bearing, name)
    if name == "C2.1":
        centre = pose.centre + bearing.sphere_centre * pose.axis
        return line_distance(line, centre) - bearing.sphere_radius
    if name in ("C3.1", "C3.2"):
        return disc_line_gap(pose.centre, pose.axis, nine_contacts.disc_radius(bearing, 0.0), line)
    end = pose.centre - 0.5 * bearing.roller_length * pose.axis
    return end_line_gap(end, pose.axis, bearing.small_end_radius, line, ahead=name == "C4.1")


def raceway_gap(bearing: Bearing, pose: nine_contacts.RollerPose, name: str, abscissa: float) -> float:
    """Compute disc edge and conical raceway: where the raceway's normal, made square to the axis, points.

    The azimuth of that normal is taken first at the centre of the disc, then at the point so found.
    """
    angle, side = (bearing.cone_angle, -1.0) if name == "Inner" else (bearing.cup_angle, 1.0)
    apex = bearing.apex_place
    centre = pose.centre + abscissa * pose.axis - np.array([0.0, 0.0, apex])
    if name == "Inner":
        centre = centre - pose.cone
    sine, cosine, radius = math.sin(angle), math.cos(angle), nine_contacts.disc_radius(bearing, abscissa)
    point = centre
    for _ in range(_ROUNDS):
        outward = np.array([point[0], point[1], 0.0]) / math.hypot(point[0], point[1])
        normal = side * (cosine * outward - sine * _AXIS)
        point = centre + radius * unit(normal - (normal @ pose.axis) * pose.axis)
    return float(side * (sine * point[2] - cosine * math.hypot(point[0], point[1])))


def sphere_rib_gap(centre: Float, radius: float, rib: nine_contacts.RibFace) -> float:
    """Compute sphere and rib face; ``centre`` from the cone's origin, [m]."""
    outward = math.hypot(centre[0], centre[1])
    return float(rib.distance - radius - centre[2] * rib.normal_axial - outward * rib.normal_radial)


def circle_rib_gap(centre: Float, axis: Float, radius: float, rib: nine_contacts.RibFace) -> float:
    """Compute edge of a flat end and rib face: Newton's iteration for the deepest point along the edge."""
    outward = np.array([centre[0], centre[1], 0.0]) / math.hypot(centre[0], centre[1])
    normal = rib.normal_radial * outward + rib.normal_axial * _AXIS
    radial = unit(normal - (normal @ axis) * axis)
    for _ in range(2 * _ROUNDS):
        ahead = np.cross(axis, radial)
        point = centre + radius * radial
        distance = math.hypot(point[0], point[1])
        outward = np.array([point[0], point[1], 0.0]) / distance
        normal = rib.normal_radial * outward + rib.normal_axial * _AXIS
        across = 1.0 - ahead[2] ** 2 - float(ahead @ outward) ** 2
        bend = normal @ radial - rib.normal_radial * radius * across / distance
        radial = unit(radial + (normal @ ahead) / bend * ahead)
    point = centre + radius * radial
    height = math.hypot(point[0], point[1]) * rib.normal_radial + point[2] * rib.normal_axial
    return float(rib.distance - height)


def line_distance(line: Shape, point: Float) -> float:
    """Return the distance of a point from the pole of a shape, [m]."""
    arm = point - line.place.origin
    across = arm - (arm @ line.place.pole) * line.place.pole
    return float(np.sqrt(across @ across))


def disc_line_gap(centre: Float, axis: Float, radius: float, line: Straight) -> float:
    """Compute disc and point where a line crosses its plane."""
    here = line.place
    along = ((centre - here.origin) @ axis) / (here.pole @ axis)
    arm = here.origin + along * here.pole - centre
    return float(np.sqrt(arm @ arm)) - radius


def end_line_gap(centre: Float, axis: Float, radius: float, line: Straight, *, ahead: bool) -> float:
    """Compute flat end and a line across it, along the roller axis over one of two places on its edge."""
    here = line.place
    arm = here.origin - centre
    flat_arm, flat_pole = arm - (arm @ axis) * axis, here.pole - (here.pole @ axis) * axis
    a, b, c = flat_pole @ flat_pole, flat_arm @ flat_pole, flat_arm @ flat_arm - radius**2
    root = math.sqrt(b * b - a * c)
    along = (-b + root if ahead else -b - root) / a
    return float(-(arm + along * here.pole) @ axis)


def sphere_sphere_gap(p: Arc, q: Arc) -> float:
    """Return the gap of two spheres apart."""
    arm = p.place.origin - q.place.origin
    return float(np.sqrt(arm @ arm)) - p.radius - q.radius


def sphere_cylinder_gap(p: Arc, q: Cone) -> float:
    """Return the gap of a sphere outside a cylinder."""
    return line_distance(q, p.place.origin) - p.radius - q.radius


def lines_gap(p: Shape, q: Shape) -> float:
    """Return the least distance of two poles that are not parallel."""
    normal = unit(np.cross(p.place.pole, q.place.pole))
    return float(abs((p.place.origin - q.place.origin) @ normal))


def cylinders_gap(p: Cone, q: Cone) -> float:
    """Return the gap of two cylinders without ends, axes not parallel."""
    return lines_gap(p, q) - p.radius - q.radius


def circle_distance(circle: Circle, point: Float) -> float:
    """Return the distance of a point from a circle, [m]."""
    arm = point - circle.place.origin
    along = float(arm @ circle.place.pole)
    across = arm - along * circle.place.pole
    return math.hypot(along, float(np.sqrt(across @ across)) - circle.radius)


def least_along(p: Circle, distance: Callable[[Float], float], count: int = 360) -> float:
    """Find the smallest value of a function of the points of a circle: a scan, refined by Brent's method.

    Independent of the search: for pairs that have no closed form.
    """
    angles = np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)

    def at(angle: float) -> float:
        return float(distance(p.frame(np.array([angle])).point))

    values = np.array([at(float(angle)) for angle in angles])
    best, width = float(angles[int(np.argmin(values))]), 2.0 * math.pi / count
    bounds = (best - width, best + width)
    found = minimize_scalar(at, bounds=bounds, method="bounded", options={"xatol": 1e-12})
    return float(min(found.fun, values.min()))
