"""Closed forms of the nine contacts and of simple shapes, in plain NumPy."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import minimize_scalar

from beardyn_core.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory.nine_contacts import (
    Contact,
    RibFace,
    RollerPose,
    disc_radius,
    large_rib,
    pocket_line,
    small_rib,
)
from beardyn_core.laboratory.shapes import Arc, Circle, Cone, Shape, Straight, unit

_ROUNDS = 4
_AXIS = np.array([0.0, 0.0, 1.0])


def contact_gap(bearing: Bearing, pose: RollerPose, contact: Contact) -> float:
    """Return the gap of one of the nine contacts in closed form, [m]."""
    name = contact.name
    if name in ("Inner", "Outer"):
        return raceway_gap(bearing, pose, name, contact.abscissa)
    if name == "FR":
        centre = pose.centre + bearing.sphere_centre * pose.axis - pose.cone
        return sphere_rib_gap(centre, bearing.sphere_radius, large_rib(bearing))
    if name == "FL":
        end = pose.centre - 0.5 * bearing.roller_length * pose.axis - pose.cone
        return circle_rib_gap(end, pose.axis, bearing.small_end_radius, small_rib(bearing))
    line = pocket_line(bearing, name)
    if name == "C2.1":
        centre = pose.centre + bearing.sphere_centre * pose.axis
        return line_distance(line, centre) - bearing.sphere_radius
    if name in ("C3.1", "C3.2"):
        return disc_line_gap(pose.centre, pose.axis, disc_radius(bearing, 0.0), line)
    end = pose.centre - 0.5 * bearing.roller_length * pose.axis
    return end_line_gap(end, pose.axis, bearing.small_end_radius, line, ahead=name == "C4.1")


def raceway_gap(bearing: Bearing, pose: RollerPose, name: str, abscissa: float) -> float:
    """Compute disc edge and conical raceway: where the raceway's normal, made square to the axis, points.

    The azimuth of that normal is taken first at the centre of the disc, then at the point so found.
    """
    angle, side = (bearing.cone_angle, -1.0) if name == "Inner" else (bearing.cup_angle, 1.0)
    apex = 0.5 * bearing.row_spacing - bearing.apex_distance * math.cos(bearing.contact_angle)
    centre = pose.centre + abscissa * pose.axis - np.array([0.0, 0.0, apex])
    if name == "Inner":
        centre = centre - pose.cone
    sine, cosine, radius = math.sin(angle), math.cos(angle), disc_radius(bearing, abscissa)
    point = centre
    for _ in range(_ROUNDS):
        outward = np.array([point[0], point[1], 0.0]) / math.hypot(point[0], point[1])
        normal = side * (cosine * outward - sine * _AXIS)
        point = centre + radius * unit(normal - (normal @ pose.axis) * pose.axis)
    return float(side * (sine * point[2] - cosine * math.hypot(point[0], point[1])))


def sphere_rib_gap(centre: Float, radius: float, rib: RibFace) -> float:
    """Compute sphere and rib face; ``centre`` from the cone's origin, [m]."""
    outward = math.hypot(centre[0], centre[1])
    return float(rib.distance - radius - centre[2] * rib.normal_axial - outward * rib.normal_radial)


def circle_rib_gap(centre: Float, axis: Float, radius: float, rib: RibFace) -> float:
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
