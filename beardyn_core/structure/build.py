"""From a box in figures to its modes, with what shows that they are right."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.structure.box import Box
from beardyn_core.structure.cup import Cup
from beardyn_core.structure.damping import damping_ratios
from beardyn_core.structure.elastic import Elastic, elastic_body, stack_functionals
from beardyn_core.structure.mesh import mesh_of
from beardyn_core.structure.modes import RESIDUAL_WAVES, WAVES, Modes
from beardyn_core.structure.reduction import reduce_body

MESH = 0.015
HIGHEST = 12_800.0
_ZONE = 0.35 * np.pi  # half of a usual load zone


@dataclass(frozen=True)
class Built:
    """Modes of a box and what their finite elements were."""

    modes: Modes
    body: Elastic
    elements: A[int, "tetrahedra with ten nodes"]
    unknowns: int
    shapes: A[Float, "shape [free mode, corner, 3], of the body's surface, [1/sqrt(kg)]"]
    yielding: A[tuple[float, float], "of the raceway under a load zone: finite elements, modes, [m/N]"]

    @property
    def static_error(self) -> float:
        """How far the modes are from the finite elements under a load zone, share of them."""
        return self.yielding[1] / self.yielding[0] - 1.0


def modes_of(
    box: Box,
    bearing: RollerBearing,
    *,
    mesh: float = MESH,
    highest: float = HIGHEST,
    waves: int = RESIDUAL_WAVES,
    progress: Callable[[str], None] = lambda _: None,
) -> Built:
    """Mesh a box, solve it and reduce it.

    Parameters
    ----------
    mesh : float, optional
        Largest edge of a tetrahedron, [m].
    highest : float, optional
        Free modes up to here, [Hz].
    waves : int, optional
        Residual modes answer radial loads with up to so many waves around a row.
    progress : callable, optional
        Called with a few words before each stage.

    Raises
    ------
    InputError
        A library is missing, or the box cannot be meshed.
    """
    progress("meshing")
    tetrahedra = mesh_of(box, bearing, mesh)
    progress(f"assembling {len(tetrahedra.elements)} elements")
    body = elastic_body(box, bearing, tetrahedra)
    names = tuple(seat.name for seat in (*box.sensors, *box.suspension))
    progress(f"solving {body.stiffness.shape[0]} unknowns")
    found = reduce_body(body, names, highest, waves)
    count = len(found.frequency)
    series = 2 * 3 * (2 * WAVES + 1)
    inertia = body.rigid_mass
    seats = found.seen[series:].reshape(len(names), 3, count)
    modes = Modes(
        box.name,
        f"{box.description}; finite elements, edges of {1e3 * mesh:g} mm".removeprefix("; "),
        found.frequency,
        damping_ratios(box.damping_ratio, found.frequency),
        found.seen[:series].T.reshape(count, 2, 3, 2 * WAVES + 1),
        {name: seats[i].T for i, name in enumerate(names)},
        {seat.name: seat.position for seat in (*box.sensors, *box.suspension)},
        float(inertia[0, 0]),
        _centre(inertia),
        (float(inertia[3, 3]), float(inertia[4, 4]), float(inertia[5, 5])),
        found.free.shape[1],
        Cup.of(bearing),
        (float(inertia[3, 4]), float(inertia[3, 5]), float(inertia[4, 5])),
        tuple(seat.name for seat in box.suspension),
        digest(box, bearing),
    )
    zone = load_zone(len(stack_functionals(body, names)))
    loads = stack_functionals(body, names).T @ zone
    exact = float(loads @ body.bent(loads[:, None])[:, 0])
    return Built(
        modes,
        body,
        len(tetrahedra.elements),
        body.stiffness.shape[0],
        np.moveaxis(found.free[body.surface.unknowns], 2, 0),
        (exact, modes.yielding(zone, zone)),
    )


def digest(box: Box, bearing: RollerBearing) -> str:
    """Make a short word of all that a box and its cup are meshed from; names, words and sources left out."""
    cup = bearing.material
    figures = replace(box, name="", description="", bearing="", sources=())
    shape = (bearing.outer_diameter, bearing.width, bearing.row_spacing, bearing.effective_length)
    text = repr((figures, shape, bearing.cup_radius, cup.youngs_modulus, cup.poisson_ratio, cup.density))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def load_zone(reads: int) -> Float:
    """Give a load of 1 N on both rows as rollers share it at the top, [share of each functional].

    Parameters
    ----------
    reads : int
        Number of functionals, those of the raceways first.
    """
    azimuth = np.linspace(-_ZONE, _ZONE, 41)
    share = np.cos(0.5 * np.pi * azimuth / _ZONE)
    share *= 0.5 / (share * np.cos(azimuth)).sum()  # of each row, upwards
    order = np.arange(1, WAVES + 1)[:, None]
    found = np.zeros((2, 3, 2 * WAVES + 1))
    found[:, 0, 0] = share.sum()
    found[:, 0, 1 : WAVES + 1] = (share * np.cos(order * azimuth)).sum(axis=1)
    found[:, 0, WAVES + 1 :] = (share * np.sin(order * azimuth)).sum(axis=1)
    return np.concatenate([found.ravel(), np.zeros(reads - found.size)])


def _centre(inertia: Float) -> tuple[float, float, float]:
    mass = inertia[0, 0]
    x, y, z = inertia[1, 5] / mass, inertia[2, 3] / mass, inertia[0, 4] / mass
    return float(x), float(y), float(z)
