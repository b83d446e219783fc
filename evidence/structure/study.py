"""How far the modes of a box are from its finite elements, and these from finer ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh

from beardyn_core.base.arrays import Float
from beardyn_core.config import load_bearing, load_box
from beardyn_core.structure.box import Box
from beardyn_core.structure.build import Built, load_zone, modes_of
from beardyn_core.structure.elastic import factor_matrix, stack_functionals
from beardyn_core.structure.modes import Modes

BOX = "high_speed"
MESHES = (0.036, 0.025, 0.018)  # largest edges, [m]
HIGHEST = 12_800.0
LINES = np.geomspace(200.0, 8000.0, 40)  # [Hz]
SPRINGS = (1e8, 1e9, 5e9)  # between raceway and ground, [N/m]
_LOSS = 0.04  # of the stiffness: a damping ratio of 0.02


@dataclass(frozen=True)
class Meshed:
    """One mesh."""

    mesh: A[float, "largest edge, [m]"]
    built: Built


@dataclass(frozen=True)
class Answer:
    """Answer of the sensor to a load zone on both rows, vertical, elastic part, [m/N]."""

    elements: A[Float, "shape [line], of the finite elements"]
    modes: A[Float, "shape [line], of free and residual modes"]
    free: A[Float, "shape [line], of the free modes alone"]

    def worst(self, found: Float) -> float:
        """Give the largest difference of a level from that of the finite elements, [dB]."""
        return float(np.max(np.abs(20.0 * np.log10(np.abs(found) / np.abs(self.elements)))))


def meshes() -> Iterator[Meshed]:
    """Build the box with finer and finer meshes."""
    box = load_box(BOX)
    assert isinstance(box, Box)
    bearing = load_bearing(box.bearing)
    for mesh in MESHES:
        yield Meshed(mesh, modes_of(box, bearing, mesh=mesh, highest=HIGHEST))


def unit(modes: Modes, name: str, axis: int) -> Float:
    """Give what reads a seat along an axis, [share of each functional]."""
    names = list(modes.seats)
    found = np.zeros(len(modes.reads))
    found[len(found) - 3 * (len(names) - names.index(name)) + axis] = 1.0
    return found


def answers(built: Built) -> Answer:
    """Shake a box by its raceways, with finite elements and with modes; structural damping in both."""
    body, modes = built.body, built.modes
    read = stack_functionals(body, tuple(modes.seats))
    zone, vertical = load_zone(len(read)), unit(modes, "axlebox_top", 2)
    load = read.T @ zone
    balanced = load - body.mass @ body.rigid @ np.linalg.solve(body.rigid_mass, body.rigid.T @ load)
    exact = []
    for line in LINES:
        square = (2.0 * np.pi * line) ** 2
        moved = factor_matrix((1.0 + 1j * _LOSS) * body.stiffness - square * body.mass).solve(
            balanced.astype(complex)
        )
        exact.append(complex(vertical @ (read @ moved)))
    strength = (vertical @ modes.reads) * (zone @ modes.reads)
    natural = (2.0 * np.pi * modes.frequency) ** 2

    def response(count: int) -> Float:
        below = strength[:count] / (
            (1.0 + 1j * _LOSS) * natural[:count] - (2.0 * np.pi * LINES[:, None]) ** 2
        )
        return below.sum(axis=1)

    return Answer(np.array(exact), response(len(natural)), response(modes.free_count))


def on_springs(built: Built, stiffness: float, count: int = 8) -> tuple[Float, Float]:
    """Hold the load zones of both rows to the ground and compute the lowest modes that bend.

    Returns
    -------
    tuple
        Frequencies by finite elements and by the modes, rigid motion among them, [Hz].
    """
    body, modes = built.body, built.modes
    read = stack_functionals(body, tuple(modes.seats))
    zone = load_zone(len(read))
    held = csc_matrix((read.T @ zone)[:, None])
    exact = eigsh(
        csc_matrix(body.stiffness + stiffness * (held @ held.T)),
        k=count + 6,
        M=body.mass,
        sigma=-((2.0 * np.pi * 300.0) ** 2),
        return_eigenvectors=False,
    )
    # rigid motion with the true mass, and the modes, which do not move it
    rigid = (read @ body.rigid).T @ zone
    shape = np.concatenate([rigid, modes.reads.T @ zone])
    size = len(shape)
    springs = np.zeros((size, size))
    springs[6:, 6:] = np.diag((2.0 * np.pi * modes.frequency) ** 2)
    springs += stiffness * np.outer(shape, shape)
    masses = np.eye(size)
    masses[:6, :6] = body.rigid_mass
    found = eigh(springs, masses, eigvals_only=True, subset_by_index=(0, count + 5))
    hertz = [np.sqrt(np.maximum(np.sort(each), 0.0)) / (2.0 * np.pi) for each in (exact, found)]
    return hertz[0][5:], hertz[1][5:]
