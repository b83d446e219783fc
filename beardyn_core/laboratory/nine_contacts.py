"""The nine contacts of a tapered roller as pairs of shapes.

Inner, Outer, FR, FL, C2.1, C3.1, C3.2, C4.1, C4.2 as Santos (2017) names them. Frame of a roller: x
outwards at its azimuth, y around, z along the bearing axis towards the large end, origin at the bearing
centre. The roller is cut into discs for the raceways, so it has 19 searches.

The cage is centred and its pocket lines follow the nominal roller; the face of the small rib, which the
bearing's data do not give, leans by `SMALL_RIB_RELIEF` from the small end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory.search import LINES_ALONG_NORMAL, SURFACE_LINE, SURFACES, Form, Pair
from beardyn_core.laboratory.shapes import Arc, Circle, Cone, FaceCircle, Shape, Straight, place_along, unit
from beardyn_core.physics.lamina_table import lamina_places

SLICES = 6
SMALL_RIB_RELIEF = math.radians(1.0)
NAMES = ("Inner", "Outer", "FR", "FL", "C2.1", "C3.1", "C3.2", "C4.1", "C4.2")
SEARCHES_PER_ROLLER = 2 * SLICES + len(NAMES) - 2

PAIRINGS: dict[str, tuple[str, Form]] = {
    "Inner": ("disc of the roller, cone raceway", SURFACE_LINE),
    "Outer": ("disc of the roller, cup raceway", SURFACE_LINE),
    "FR": ("spherical large end, face of the large rib", SURFACES),
    "FL": ("edge of the small end, face of the small rib", SURFACE_LINE),
    "C2.1": ("spherical large end, pocket line", SURFACE_LINE),
    "C3.1": ("disc of the roller, bar ahead", LINES_ALONG_NORMAL),
    "C3.2": ("disc of the roller, bar behind", LINES_ALONG_NORMAL),
    "C4.1": ("edge of the small end, pocket line, ahead", LINES_ALONG_NORMAL),
    "C4.2": ("edge of the small end, pocket line, behind", LINES_ALONG_NORMAL),
}


@dataclass(frozen=True)
class RollerPose:
    """Where a roller and the cone are, in the frame of the roller's azimuth."""

    centre: A[Float, "shape [3], mid-length of the roller, [m]"]
    axis: A[Float, "shape [3], unit vector to the large end"]
    cone: A[Float, "shape [3], displacement of the cone against the cup, [m]"]


@dataclass(frozen=True)
class Contact:
    """One contact search of a roller."""

    name: A[str, "one of `NAMES`"]
    abscissa: A[float, "of the disc from mid-length, [m]; 0 where there is none"]
    pair: Pair
    start: A[Float, "parameters of the nominal roller"]


def nominal_axis(bearing: Bearing) -> Float:
    """Return the axis of the roller in its place, shape [3]."""
    return np.array([math.sin(bearing.contact_angle), 0.0, math.cos(bearing.contact_angle)])


def nominal_centre(bearing: Bearing) -> Float:
    """Return the mid-length of the roller in its place, shape [3], [m]."""
    return np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])


def nominal_pose(bearing: Bearing) -> RollerPose:
    """Put the roller in its place: it touches both raceways and the large rib."""
    return RollerPose(nominal_centre(bearing), nominal_axis(bearing), np.zeros(3))


def disc_radius(bearing: Bearing, abscissa: float) -> float:
    """Return the radius of the roller cone, [m]."""
    return (bearing.apex_distance + abscissa) * math.tan(bearing.half_angle)


@dataclass(frozen=True)
class RibFace:
    """Face of a rib as a cone: components of the normal into the rib, and a point of the face."""

    normal_axial: float
    normal_radial: float
    axial: A[float, "[m]"]
    radial: A[float, "[m]"]

    @property
    def distance(self) -> float:
        """Of the face along its normal, [m]."""
        return self.axial * self.normal_axial + self.radial * self.normal_radial

    def shape(self, cone: Float) -> Cone:
        """Return the face with the cone displaced."""
        angle = math.atan2(-self.normal_axial, self.normal_radial)
        return Cone(place_along(cone + np.array([0.0, 0.0, self.axial]), (0, 0, 1)), self.radial, angle, -1.0)


def large_rib(bearing: Bearing) -> RibFace:
    """Build the face of the large rib through the nominal contact."""
    lean = bearing.rib_lean
    centre = nominal_centre(bearing) + bearing.sphere_centre * nominal_axis(bearing)
    return RibFace(
        math.cos(lean),
        math.sin(lean),
        centre[2] + bearing.sphere_radius * math.cos(lean),
        centre[0] + bearing.sphere_radius * math.sin(lean),
    )


def small_rib(bearing: Bearing) -> RibFace:
    """Build the face of the small rib: through the lowest point of the small end, less the clearance."""
    lean = bearing.contact_angle + SMALL_RIB_RELIEF
    along = -0.5 * bearing.roller_length - bearing.small_rib_clearance
    point = nominal_centre(bearing) + along * nominal_axis(bearing)
    below = bearing.small_end_radius
    return RibFace(
        -math.cos(lean),
        -math.sin(lean),
        point[2] + below * math.sin(bearing.contact_angle),
        point[0] - below * math.cos(bearing.contact_angle),
    )


def end_sphere(bearing: Bearing, pose: RollerPose) -> Arc:
    """Build the spherical large end, swept about the roller axis as in the text."""
    centre = pose.centre + bearing.sphere_centre * pose.axis
    return Arc(place_along(centre, pose.axis), 0.0, bearing.sphere_radius)


def disc(bearing: Bearing, pose: RollerPose, abscissa: float) -> Circle:
    """Build the edge of a disc of the roller."""
    return Circle(place_along(pose.centre + abscissa * pose.axis, pose.axis), disc_radius(bearing, abscissa))


def pocket_line(bearing: Bearing, name: str) -> Straight:
    """Build the line of the pocket that a contact of the cage meets."""
    centre, axis = nominal_centre(bearing), nominal_axis(bearing)
    ahead = np.array([0.0, 1.0, 0.0])
    if name in ("C3.1", "C3.2"):
        side = 1.0 if name == "C3.1" else -1.0
        reach = disc_radius(bearing, 0.0) + 0.5 * bearing.cage.circumferential_clearance
        slope = side * math.tan(bearing.half_angle)
        return Straight(place_along(centre + side * reach * ahead, axis + slope * ahead, -side * ahead))
    play = 0.5 * bearing.cage.axial_clearance
    if name == "C2.1":
        place = bearing.sphere_centre + bearing.sphere_radius + play
        return Straight(place_along(centre + place * axis, ahead, -axis))
    return Straight(place_along(centre - (0.5 * bearing.roller_length + play) * axis, ahead, axis))


def contacts_of(bearing: Bearing, pose: RollerPose, surfaces: Form = SURFACES) -> list[Contact]:
    """List all contact searches of a roller, from the parameters of the nominal roller.

    Parameters
    ----------
    bearing : Bearing
    pose : RollerPose
    surfaces : Form
        Conditions for the one surface-surface contact, FR.
    """
    found: list[Contact] = []

    def add(name: str, p: Shape, q: Shape, *start: float, abscissa: float = 0.0) -> None:
        form = surfaces if name == "FR" else PAIRINGS[name][1]
        found.append(Contact(name, abscissa, Pair(p, q, form), np.array(start)))

    apex = bearing.apex_place
    # the angle pi of a placement with east = x is the side of the bearing axis
    for name, slope, side, shift, azimuth in (
        ("Inner", bearing.cone_angle, 1.0, pose.cone, math.pi),
        ("Outer", bearing.cup_angle, -1.0, 0.0, 0.0),
    ):
        raceway = Cone(place_along(np.array([0.0, 0.0, apex]) + shift, (0, 0, 1)), 0.0, slope, side)
        for x in lamina_places(bearing, SLICES).tolist():
            along = (bearing.apex_distance + x) / math.cos(bearing.half_angle)
            add(name, disc(bearing, pose, x), raceway, azimuth, along, 0.0, abscissa=x)
    sphere = end_sphere(bearing, pose)
    polar = 0.5 * math.pi - bearing.rib_polar_angle
    add("FR", sphere, large_rib(bearing).shape(pose.cone), polar, math.pi, 0.0, 0.0)
    end = place_along(pose.centre - 0.5 * bearing.roller_length * pose.axis, pose.axis)
    radius = bearing.small_end_radius
    add("FL", Circle(end, radius), small_rib(bearing).shape(pose.cone), math.pi, 0.0, 0.0)
    # swept about an axis across the roller: at its crown the other sphere has a pole
    crown = replace(sphere, place=place_along(sphere.place.origin, (0.0, 1.0, 0.0), pose.axis))
    add("C2.1", pocket_line(bearing, "C2.1"), crown, 0.0, 0.0, 0.0)
    for name, side in (("C3.1", 1.0), ("C3.2", -1.0)):
        add(name, pocket_line(bearing, name), disc(bearing, pose, 0.0), 0.0, side * 0.5 * math.pi)
    for name, side in (("C4.1", 1.0), ("C4.2", -1.0)):
        face = FaceCircle(end, radius, -1.0)  # the end looks away from the large end
        add(name, pocket_line(bearing, name), face, side * radius, side * 0.5 * math.pi)
    return found


def turn_pose(pose: RollerPose, tilt: float, skew: float) -> RollerPose:
    """Turn the axis of a pose in the meridian plane (+: large end outwards) and out of it (+: y)."""
    across = np.cross(np.array([0.0, 1.0, 0.0]), pose.axis)
    axis = unit(pose.axis + tilt * across + skew * np.array([0.0, 1.0, 0.0]))
    return RollerPose(pose.centre, axis, pose.cone)
