"""Triangle meshes of the parts of a tapered, cylindrical or spherical bearing, from its recorded shape.

World axes: y along the bearing axis, azimuth from +z towards +x. Cup and cone meshes have their origin
at the bearing centre, a cage at the centre of its row, a roller at its mid-length with x along its axis
towards the large end and z facing the cup.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, pi, sin
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.record.description import BearingShape
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.patch import Patch

CUT_OPEN = (np.deg2rad(20.0), np.deg2rad(140.0))
ROW_SIDE = (-1.0, 1.0)
MARK_COLOUR = (0.30, 0.32, 0.36)
_ARC_POINTS = 9


@dataclass(frozen=True)
class Mesh:
    """Triangles."""

    vertices: A[Float, "shape [vertex, 3], [m]"]
    normals: A[Float, "shape [vertex, 3]"]
    triangles: A[NDArray[np.int64], "shape [triangle, 3]"]
    shades: A[Float, "shape [vertex, 3], factor on the part's colour, 0 to 1"]


def join_meshes(*meshes: Mesh) -> Mesh:
    """Join several meshes to one."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, starts, strict=False)]),
        np.concatenate([mesh.shades for mesh in meshes]),
    )


def revolve(profile: Float, azimuth: Float) -> Mesh:
    """Sweep a polyline about the y axis to a surface, every edge of the polyline a band of its own.

    The profile, shape [point, 2], is axial position and radius [m]: the outside is to the left when it is
    walked with y to the right and the radius upwards. The azimuth is from +z towards +x, [rad].
    """
    vertices, normals, triangles, start = [], [], [], 0
    radial = np.stack((np.sin(azimuth), np.zeros_like(azimuth), np.cos(azimuth)), axis=1)
    axial = np.array([0.0, 1.0, 0.0])
    count = len(azimuth)
    index = np.arange(count - 1)
    for (y0, r0), (y1, r1) in pairwise(profile):
        length = np.hypot(y1 - y0, r1 - r0)
        if length == 0.0:
            continue
        normal = (y1 - y0) / length * radial - (r1 - r0) / length * axial
        vertices += [y0 * axial + r0 * radial, y1 * axial + r1 * radial]
        normals += [normal, normal]
        a, b = start + index, start + count + index
        triangles += [np.stack((a, b, a + 1), axis=1), np.stack((b, b + 1, a + 1), axis=1)]
        start += 2 * count
    points = np.concatenate(vertices)
    return Mesh(points, np.concatenate(normals), np.concatenate(triangles), np.ones_like(points))


def section(profile: Float, azimuth: float, facing: float) -> Mesh:
    """Cut flat through a convex closed profile at an azimuth.

    Parameters
    ----------
    profile : float64 array, shape [point, 2]
    azimuth : float
        [rad].
    facing : float
        +1: the normal points towards growing azimuth; -1: the other way.
    """
    radial = np.array([sin(azimuth), 0.0, cos(azimuth)])
    points = profile[:, :1] * np.array([0.0, 1.0, 0.0]) + profile[:, 1:] * radial
    centre = points[:-1].mean(axis=0)
    vertices = np.vstack((points, centre))
    count = len(points)
    index = np.arange(count - 1)
    triangles = np.stack((index, index + 1, np.full(count - 1, count)), axis=1)
    normal = facing * np.array([cos(azimuth), 0.0, -sin(azimuth)])
    normals = np.broadcast_to(normal, vertices.shape).copy()
    return Mesh(vertices, normals, triangles, np.full_like(vertices, 0.72))


def raceway_radius(shape: BearingShape, ring: str, distance: float) -> tuple[float, float]:
    """Compute axial distance from the row centre (towards the large end) and radius on a raceway, [m].

    The raceway is that of ``cup`` or ``cone``, the distance [m] that along the roller axis from its middle,
    towards the large end.
    """
    y, r = _on_pitch_cone(shape, distance)
    out = shape.radius_at(distance) * (1.0 if ring == "cup" else -1.0)
    return y - out * sin(shape.slant), r + out * cos(shape.slant)


def raceway_points(shape: BearingShape, ring: str, first: float, last: float) -> list[tuple[float, float]]:
    """Compute `raceway_radius` at both ends of a stretch of a raceway, of barrels along its arc."""
    count = _ARC_POINTS if shape.is_spherical else 2
    return [raceway_radius(shape, ring, float(place)) for place in np.linspace(first, last, count)]


def cup(shape: BearingShape) -> Mesh:
    """Build the cup with its ribs, cut open over `CUT_OPEN`."""
    azimuth = np.linspace(CUT_OPEN[1], CUT_OPEN[0] + 2.0 * pi, 121)
    if shape.is_cylindrical:
        raceway = raceway_radius(shape, "cup", 0.0)[1]
        ring = (-0.5 * shape.width, 0.5 * shape.width, raceway, 0.5 * shape.outer_diameter)
        ribs = _ribs(shape, shape.cup_ribs, raceway - shape.cup_rib_height, raceway)
        return join_meshes(*(_sector(_rectangle(*each), azimuth) for each in (ring, *ribs)))
    half = shape.roller_length / 2.0
    inner = raceway_points(shape, "cup", -1.06 * half, 1.30 * half)
    inner_large = inner[-1]
    middle = shape.row_spacing / 2.0
    outer = shape.outer_diameter / 2.0
    edge, chamfer = middle + inner_large[0], 0.03 * outer
    right = [
        (edge, outer - chamfer),
        *((max(middle + y, 0.0), r) for y, r in reversed(inner)),
    ]
    left = [(-y, r) for y, r in reversed(right)]
    profile = np.array([*left, (-edge + chamfer, outer), (edge - chamfer, outer), *right, left[0]])
    return join_meshes(
        revolve(profile, azimuth), section(profile, CUT_OPEN[1], -1.0), section(profile, CUT_OPEN[0], 1.0)
    )


def cone(shape: BearingShape) -> Mesh:
    """Build both cones with their ribs and the spacer, with a dark mark that shows the rotation."""
    azimuth = np.linspace(0.0, 2.0 * pi, 145)
    if shape.is_cylindrical:
        radius = raceway_radius(shape, "cone", 0.0)[1]
        ring = (-0.5 * shape.width, 0.5 * shape.width, 0.5 * shape.bore, radius)
        height = shape.cone_rib_height or 2.2 * shape.rib_contact_height
        ribs = _ribs(shape, shape.cone_ribs, radius, radius + height)
        mesh = join_meshes(*(revolve(_rectangle(*each), azimuth) for each in (ring, *ribs)))
        return mark_vertices(mesh, _in_sector(mesh, 0.06))
    half = shape.roller_length / 2.0
    bore, middle = shape.bore / 2.0, shape.row_spacing / 2.0
    raceway = raceway_points(shape, "cone", -1.04 * half, 1.01 * half)
    small, large = raceway[0], raceway[-1]
    rib = large[1] + 2.2 * shape.rib_contact_height
    land = small[1] + 0.6 * shape.rib_contact_height
    end = max(shape.width / 2.0, middle + large[0] + 0.004)
    right = [
        (max(middle + small[0] - 0.05 * half, 0.002), land - 0.5 * (land - bore)),
        (max(middle + small[0] - 0.05 * half, 0.002), land),
        (middle + small[0], land),
        *((middle + y, r) for y, r in raceway),
        (middle + large[0] - 0.18 * (rib - large[1]), rib),
        (min(middle + large[0] + 0.008, end), rib),
        (min(middle + large[0] + 0.008, end), bore + 0.45 * (rib - bore)),
        (end, bore + 0.45 * (rib - bore)),
        (end, bore),
    ]
    left = [(-y, r) for y, r in reversed(right)]
    mesh = revolve(np.array([*left, *right, left[0]]), azimuth)
    return mark_vertices(mesh, _in_sector(mesh, 0.06))


def roller(shape: BearingShape, segments: int = 40) -> Mesh:
    """Build a roller with a dark sector that shows its spin."""
    half, chamfer = shape.roller_length / 2.0, 0.04 * shape.roller_diameter
    large, small = shape.large_end_radius, shape.small_end_radius
    places = np.linspace(chamfer - half, half - chamfer, _ARC_POINTS if shape.is_spherical else 2)
    profile = np.array(
        [
            (-half, 0.0),
            (-half, 0.35 * small),
            (-half, small - chamfer),
            *((float(place), shape.radius_at(float(place))) for place in places),
            (half, large - chamfer),
            (half, 0.35 * large),
            (half, 0.0),
        ]
    )
    mesh = revolve(profile, np.linspace(0.0, 2.0 * pi, segments + 1))
    at_end = np.abs(np.abs(mesh.vertices[:, 1]) - half) < 1e-9
    outside = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 2]) > 0.3 * small
    mesh = mark_vertices(mesh, _in_sector(mesh, 0.45) & at_end & outside)
    # y becomes the roller's own x; z stays, so the mark faces the cup at zero spin.
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return replace(mesh, vertices=mesh.vertices @ turn.T, normals=mesh.normals @ turn.T)


def cage(shape: BearingShape, row: int) -> Mesh:
    """Build the cage of a row: a ring at either end of the rollers and a bar between every two."""
    half = shape.roller_length / 2.0
    gap = 2.0 * pi / shape.roller_count
    rings = []
    for at, radius in ((-half, shape.small_end_radius), (half, shape.large_end_radius)):
        outwards = 1.0 if at > 0 else -1.0
        y0, r0 = _on_pitch_cone(shape, at + outwards * 0.0008)
        y1, r1 = _on_pitch_cone(shape, at + outwards * 0.0048)
        thick = 0.26 * radius
        (y0, r0), (y1, r1) = sorted(((y0, r0), (y1, r1)))
        ring = [(y0, r0 - thick), (y0, r0 + thick), (y1, r1 + thick), (y1, r1 - thick), (y0, r0 - thick)]
        rings.append(revolve(np.array(ring), np.linspace(0.0, 2.0 * pi, 121)))
    bars = []
    for k in range(shape.roller_count):
        # A roller's chord fills most of the pitch: the bar sits in what is left, outside the pitch cone.
        y0, r0 = _on_pitch_cone(shape, -half - 0.001)
        y1, r1 = _on_pitch_cone(shape, half + 0.001)
        lift = 0.30 * shape.roller_diameter / 2.0
        profile = np.array([(y0, r0 + 0.1 * lift), (y0, r0 + lift), (y1, r1 + lift), (y1, r1 + 0.1 * lift)])
        free = gap - shape.roller_diameter / (shape.pitch_diameter / 2.0)
        width = max(0.8 * free, 0.12 * gap)
        middle = (k + 0.5) * gap
        closed = np.vstack((profile, profile[:1]))
        bars.append(_sector(closed, np.linspace(middle - width / 2.0, middle + width / 2.0, 4)))
    mesh = join_meshes(*rings, *bars)
    return _on_side(replace(mesh, shades=np.ones_like(mesh.vertices)), row)


def spall(shape: BearingShape, defect: Patch | FieldSpall) -> Mesh:
    """Build a spall on a raceway of the cup or the cone, slightly raised so that it is visible."""
    if isinstance(defect, FieldSpall):
        radius = raceway_radius(shape, defect.on, 0.0)[1]
        return join_meshes(*(spall(shape, patch) for patch in defect.patches_at(radius)))
    lift = -4e-4 if defect.on == "cup" else 4e-4
    ends = [
        raceway_radius(shape, defect.on, defect.offset + sign * defect.length / 2.0) for sign in (-1.0, 1.0)
    ]
    profile = np.array([(shape.row_spacing / 2.0 + y, r + lift) for y, r in ends])
    half = max(defect.width / 2.0 / float(profile[:, 1].mean()), 0.004)
    mesh = revolve(profile, np.linspace(defect.azimuth - half, defect.azimuth + half, 12))
    return _on_side(mesh, defect.row)


def _ribs(
    shape: BearingShape, sides: str, low: float, high: float
) -> list[tuple[float, float, float, float]]:
    """List where ribs of a cylindrical ring stand in both rows: from and to along y, and in radius, [m]."""
    face, edge, middle = 0.505 * shape.roller_length, 0.5 * shape.width, 0.5 * shape.row_spacing
    inner_edge = max(2.0 * middle - edge, 0.0)  # of the ring of a row
    found = []
    if sides in ("outer", "both"):
        found.append((middle + face, edge))
    if sides in ("inner", "both"):
        found.append((inner_edge, middle - face))
    rows = [*found, *((-end, -begin) for begin, end in found)]
    return [(begin, end, low, high) for begin, end in rows if end > begin and high > low]


def _rectangle(begin: float, end: float, low: float, high: float) -> Float:
    """Make the closed profile of a ring for `revolve`."""
    return np.array([(begin, low), (begin, high), (end, high), (end, low), (begin, low)])


def mark_vertices(mesh: Mesh, where: NDArray[np.bool_]) -> Mesh:
    """Darken some vertices of a mesh."""
    shades = mesh.shades.copy()
    shades[where] *= np.array(MARK_COLOUR)
    return replace(mesh, shades=shades)


def _sector(profile: Float, azimuth: Float) -> Mesh:
    """Revolve a closed profile over a part of the circle, with both cuts."""
    return join_meshes(
        revolve(profile, azimuth), section(profile, azimuth[0], -1.0), section(profile, azimuth[-1], 1.0)
    )


def _on_side(mesh: Mesh, row: int) -> Mesh:
    """Mirror a mesh that is made for positive y to the side of a row."""
    mirror = np.array([1.0, ROW_SIDE[row], 1.0])
    return replace(mesh, vertices=mesh.vertices * mirror, normals=mesh.normals * mirror)


def _in_sector(mesh: Mesh, half: float) -> NDArray[np.bool_]:
    """Find the vertices of a mesh around azimuth 0."""
    return np.asarray(np.abs(np.arctan2(mesh.vertices[:, 0], mesh.vertices[:, 2])) < half)


def _on_pitch_cone(shape: BearingShape, distance: float) -> tuple[float, float]:
    angle = shape.slant
    return distance * cos(angle), 0.5 * shape.pitch_diameter + distance * sin(angle)
