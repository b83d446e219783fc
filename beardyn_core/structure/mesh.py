"""Tetrahedra of a box, by gmsh."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.structure.box import Box

EXTRA = "pip install beardyn[structure]"
CUP, HOUSING = 1, 2
_AXLE = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Mesh:
    """Tetrahedra with ten nodes each, in the axlebox frame."""

    nodes: A[Float, "shape [node, 3], [m]"]
    elements: A[NDArray[np.int64], "shape [element, 10], corners first, gmsh's order"]
    part: A[NDArray[np.int64], "shape [element], `CUP` or `HOUSING`"]


def mesh_of(box: Box, bearing: RollerBearing, size: float) -> Mesh:
    """Mesh an axlebox and the cup in it, which share the nodes of the bore.

    Parameters
    ----------
    size : float
        Largest edge, [m]; walls get at least two elements where they are thinner than that.

    Raises
    ------
    InputError
        gmsh is not installed, or the parts do not make one body.
    """
    try:
        import gmsh
    except (ImportError, OSError) as error:  # a wheel without the graphics libraries of the system
        raise InputError(f"meshing needs gmsh ({error}); {EXTRA}") from error
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        return _mesh_parts(gmsh.model, box, bearing, size, gmsh.option.setNumber)
    except InputError:
        raise
    except Exception as error:  # gmsh knows no other
        raise InputError(f"box {box.name!r} cannot be meshed: {error}") from error
    finally:
        gmsh.finalize()


def _mesh_parts(model: Any, box: Box, bearing: RollerBearing, size: float, option: Any) -> Mesh:
    occ = model.occ
    bore, race = 0.5 * bearing.outer_diameter, bearing.cup_radius
    if box.outer_diameter <= bearing.outer_diameter:
        raise InputError(
            f"box {box.name!r}: outer_diameter_mm is {1e3 * box.outer_diameter:g}; the cup of "
            f"{bearing.name} has {1e3 * bearing.outer_diameter:g}, the housing must be wider"
        )

    def cylinder(radius: float, length: float, begin: float | None = None) -> tuple[int, int]:
        start = -0.5 * length if begin is None else begin
        return 3, occ.addCylinder(0.0, start, 0.0, *(length * each for each in _AXLE), radius)

    parts = [cylinder(0.5 * box.outer_diameter, box.length)]
    if box.arc < 2.0 * math.pi - 1e-6:
        parts = _sector(occ, parts, box)
    for disc in box.discs:
        sign = -1.0 if disc.side == "inboard" else 1.0
        begin = 0.5 * box.length if sign > 0.0 else -0.5 * box.length - disc.thickness
        parts.append(cylinder(0.5 * box.outer_diameter, disc.thickness, begin))
    for block in box.blocks:
        corner = [centre - 0.5 * edge for centre, edge in zip(block.centre, block.size, strict=True)]
        parts.append((3, occ.addBox(*corner, *block.size)))
    housing = parts if len(parts) == 1 else occ.fuse(parts[:1], parts[1:])[0]
    housing, _ = occ.cut(housing, [cylinder(bore, max(box.length, bearing.width))])
    for disc in (each for each in box.discs if each.hole_diameter > 0.0):
        reach = 0.5 * box.length + disc.thickness
        begin = 0.0 if disc.side == "outboard" else -reach
        housing, _ = occ.cut(housing, [cylinder(0.5 * disc.hole_diameter, reach, begin)])
    cup = []
    for begin, end in pairwise(_edges(bearing)):  # a mesh that ends where the rollers end
        ring, _ = occ.cut([cylinder(bore, end - begin, begin)], [cylinder(race, end - begin, begin)])
        cup += ring
    _, origin = occ.fragment(cup, housing)
    occ.synchronize()
    solids = {tag: CUP for piece in origin[: len(cup)] for _, tag in piece}
    solids |= {tag: HOUSING for piece in origin[len(cup) :] for _, tag in piece}
    thin = min(bore - race, 0.5 * box.outer_diameter - bore)
    option("Mesh.MeshSizeMax", size)
    option("Mesh.MeshSizeMin", min(size, 0.5 * thin))
    option("Mesh.Algorithm3D", 1)
    option("Mesh.HighOrderOptimize", 0)
    model.mesh.generate(3)
    model.mesh.setOrder(2)
    return _collect_mesh(model, solids, box.name)


def _edges(bearing: RollerBearing) -> tuple[float, ...]:
    """Compute axial places at which cup and roller tracks begin and end, [m]."""
    half = 0.5 * bearing.effective_length
    tracks = [place + side for place in row_places(bearing) for side in (-half, half)]
    return (-0.5 * bearing.width, *tracks, 0.5 * bearing.width)


def row_places(bearing: RollerBearing) -> tuple[float, float]:
    """Compute axial places of the middles of both rows, inboard first, [m]."""
    return -0.5 * bearing.row_spacing, 0.5 * bearing.row_spacing


def _sector(occ: Any, parts: list[tuple[int, int]], box: Box) -> list[tuple[int, int]]:
    """Keep of a cylinder what lies within half the arc on either side of the top."""
    radius = 0.5 * box.outer_diameter
    wedge = occ.addCylinder(0.0, -0.5 * box.length, 0.0, 0.0, box.length, 0.0, 1.01 * radius, angle=box.arc)
    occ.synchronize()
    mass = occ.getCenterOfMass(3, wedge)
    occ.rotate([(3, wedge)], 0.0, 0.0, 0.0, *_AXLE, -math.atan2(mass[0], mass[2]))
    kept, _ = occ.intersect(parts, [(3, wedge)])
    return list(kept)


def _collect_mesh(model: Any, solids: dict[int, int], name: str) -> Mesh:
    tags, places, _ = model.mesh.getNodes()
    number = np.zeros(int(tags.max()) + 1, np.int64)
    number[tags.astype(np.int64)] = np.arange(len(tags))
    elements, part = [], []
    for solid, kind in solids.items():
        types, _, nodes = model.mesh.getElements(3, solid)
        if list(types) != [11]:
            raise InputError(f"box {name!r} cannot be meshed: a part has no volume")
        here = number[np.asarray(nodes[0], np.int64)].reshape(-1, 10)
        elements.append(here)
        part.append(np.full(len(here), kind))
    every = np.concatenate(elements)
    used, every = np.unique(every, return_inverse=True)
    mesh = Mesh(places.reshape(-1, 3)[used], every.reshape(-1, 10), np.concatenate(part))
    if _bodies(mesh) > 1:
        raise InputError(f"box {name!r} falls into {_bodies(mesh)} pieces; blocks must touch the housing")
    return mesh


def _bodies(mesh: Mesh) -> int:
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    corner = mesh.elements[:, :4]
    rows, columns = corner[:, [0, 0, 0]].ravel(), corner[:, 1:].ravel()
    count = len(mesh.nodes)
    graph = coo_matrix((np.ones(len(rows)), (rows, columns)), (count, count))
    found = connected_components(graph, directed=False)[1]
    return len(np.unique(found[corner[:, 0]]))
