"""Meshes of the bearing's parts as STL files, computed from its own dimensions."""

from __future__ import annotations

import hashlib
import os
from math import pi
from pathlib import Path

import numpy as np

from beardyn_core.base.cache_root import cache_root
from beardyn_core.record import meshes
from beardyn_core.record.description import BearingShape
from beardyn_core.record.meshes import CUT_OPEN, Mesh

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_DARK = 0.6
HOUSING_WALL = 0.15  # of the outer diameter of the bearing


def mesh_folder() -> Path:
    """Name the folder of meshes."""
    return cache_root() / "meshes"


def part_meshes(shape: BearingShape) -> dict[str, Mesh]:
    """Build the meshes of a bearing and its box; ``<part>_mark`` is what shows that it turns.

    Parameters
    ----------
    shape : BearingShape

    Returns
    -------
    dict of str to Mesh
        Each in its own axes; see `beardyn_core.record.meshes`.
    """
    found: dict[str, Mesh] = {"box": housing(shape), "cup": meshes.cup(shape)}
    for name, mesh in (
        ("cone", meshes.cone(shape)),
        ("roller", meshes.roller(shape)),
        ("cage_0", meshes.cage(shape, 0)),
        ("cage_1", meshes.cage(shape, 1)),
    ):
        dark = mesh.shades[mesh.triangles].mean(axis=(1, 2)) < _DARK
        found[name] = _part(mesh, ~dark)
        if dark.any():
            found[f"{name}_mark"] = _part(mesh, dark)
    return found


def housing(shape: BearingShape) -> Mesh:
    """Build the box as a ring around the cup, cut open where the cup is."""
    half, inner = 0.55 * shape.width, shape.outer_diameter / 2.0
    outer = inner + HOUSING_WALL * shape.outer_diameter
    profile = np.array([(-half, outer), (half, outer), (half, inner), (-half, inner), (-half, outer)])
    return meshes.joined(
        meshes.revolve(profile, np.linspace(CUT_OPEN[1], CUT_OPEN[0] + 2.0 * pi, 73)),
        meshes.section(profile, CUT_OPEN[1], -1.0),
        meshes.section(profile, CUT_OPEN[0], 1.0),
    )


def _part(mesh: Mesh, chosen: np.ndarray) -> Mesh:
    return Mesh(mesh.vertices, mesh.normals, mesh.triangles[chosen], mesh.shades)


def stl_bytes(mesh: Mesh) -> bytes:
    """Write a mesh as binary STL, [m], every facet with its corners counterclockwise seen from outside.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    bytes
    """
    corners = mesh.vertices[mesh.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inwards = np.einsum("ij,ij->i", normal, mesh.normals[mesh.triangles].sum(axis=1)) < 0.0
    corners[inwards] = corners[inwards][:, ::-1]
    normal[inwards] *= -1.0
    size = np.linalg.norm(normal, axis=1)
    whole = size > 0.0
    facets = np.zeros(int(whole.sum()), _FACET)
    facets["normal"], facets["corners"] = normal[whole] / size[whole, None], corners[whole]
    return b"beardyn".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()


def write_meshes(shape: BearingShape, folder: Path) -> dict[str, Path]:
    """Write the meshes of a bearing into a folder, named after their content; what is there stays.

    Parameters
    ----------
    shape : BearingShape
    folder : Path
        Is made when it does not exist.

    Returns
    -------
    dict of str to Path
        Absolute, by part.

    Raises
    ------
    OSError
        The folder cannot be written.
    """
    folder = folder.expanduser().resolve()
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, mesh in part_meshes(shape).items():
        content = stl_bytes(mesh)
        path = folder / f"{name}_{hashlib.sha256(content).hexdigest()[:12]}.stl"
        if not path.is_file():
            # several twins may write the same file at once
            draft = path.with_suffix(f".{os.getpid()}")
            draft.write_bytes(content)
            draft.replace(path)
        files[name] = path
    return files
