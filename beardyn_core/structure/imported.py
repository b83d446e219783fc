"""Modes of another program, shapes at nodes, as the bearing, the sensors and the springs see them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At, Vector, refuse
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.structure.box import Seat
from beardyn_core.structure.cup import Cup
from beardyn_core.structure.damping import DAMPING, DampingTable, damping_ratios
from beardyn_core.structure.mesh import row_places
from beardyn_core.structure.modes import WAVES, Modes
from beardyn_core.structure.nastran import read_nastran
from beardyn_core.structure.universal import read_universal

_AXIS = At(one_of=("x", "-x", "y", "-y", "z", "-z"))
_PUNCH = (".pch", ".pun")
_RIGID_HZ = 1.0
_SAME_PLACE = np.radians(3.0)
_ROUNDING = 0.01  # of moments of inertia as one writes them
_CONDITION = 10.0  # of the fit: how much it makes of what is not in the shapes


@dataclass(frozen=True)
class ModeFile:
    """A file with modes of a free box, the cup in it, and how its nodes lie in the axlebox."""

    name: A[str, At(longest=80), "of the box"]
    bearing: A[str, At(longest=200), "shipped bearing or path of its file, whose cup is in the box"]
    modes: A[
        Path,
        "relative to this file: Universal file with nodes (15 or 2411) and normal modes (55), or punch file "
        "of Nastran (.pch) with the eigenvectors",
    ]
    mass: A[float, At("kg", gt=0.0), "of box and cup"]
    inertia: A[Vector, At("kg_m2", gt=0.0), "of box and cup about x, y, z through the bearing centre"]
    products: A[
        Vector,
        At("kg_m2"),
        "xy, xz, yz of the same matrix of inertia: minus the sum of mass times x y and so on; no file has "
        "them, and 0 is for a box that is its own mirror image",
    ]
    sensors: A[tuple[Seat, ...], "where accelerometers may sit"]
    description: A[str, At(usual=""), "what it is, in a few words"] = ""
    centre: A[Vector, At("mm"), "of mass, from the bearing centre along x, y, z"] = (0.0, 0.0, 0.0)
    suspension: A[tuple[Seat, ...], "where springs, links and dampers hold the box"] = ()
    grid: A[
        Path | None,
        "relative to this file: bulk data file with the grid points of a punch file, which has none",
    ] = None
    length_unit: A[str, At(one_of=("m", "mm")), "of the nodes"] = "m"
    mass_unit: A[str, At(one_of=("kg", "t")), "of the modal masses; Nastran in mm, N and s has t"] = "kg"
    forward: A[str, _AXIS, "axis of the file that is x forward"] = "x"
    left: A[str, _AXIS, "axis of the file that is y left along the axle"] = "y"
    up: A[str, _AXIS, "axis of the file that is z up"] = "z"
    origin: A[Vector, At("mm"), "bearing centre in the axes of the file"] = (0.0, 0.0, 0.0)
    seat_diameter: A[
        float | None,
        At("mm", gt=0.0, le=800.0),
        "of the cylinder whose nodes are taken for the raceways; that of the cup's raceway when left out",
    ] = None
    tolerance: A[float, At("mm", gt=0.0, le=20.0), "how far from that cylinder a node may lie"] = 1.0e-3
    damping_ratio: A[
        float | DampingTable,
        DAMPING,
        "of modes for which the file has none, one for all or a table over the frequency",
    ] = 0.02
    sources: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        refuse(self, f"box {self.name!r}")

    def rules(self) -> Iterator[str]:
        """Check that the three axes are right-handed."""
        if abs(np.linalg.det(self.turn) - 1.0) > 1e-9:
            yield (
                f"forward, left and up are {self.forward}, {self.left}, {self.up}; they must be three axes "
                "of the file that follow each other as x, y and z do"
            )
        if self.punched != (self.grid is not None):
            yield (
                "grid is the bulk data file of a punch file: "
                f"{'give it' if self.punched else 'leave it out'} with modes {self.modes.name}"
            )
        xy, xz, yz = self.products
        about = np.diag(self.inertia) + np.array([[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]])
        about -= self.mass * (
            np.dot(self.centre, self.centre) * np.eye(3) - np.outer(self.centre, self.centre)
        )
        least, middle, most = np.linalg.eigvalsh(about)
        if least <= 0.0 or least + middle < (1.0 - _ROUNDING) * most:
            shown = ", ".join(f"{each:.3g}" for each in (least, middle, most))
            yield (
                "inertia_kg_m2, products_kg_m2 and centre_mm are of no body: about the centre of mass its "
                f"principal moments are {shown} kg m^2; none may be 0 or less, or more than the sum of the "
                "others"
            )

    @property
    def punched(self) -> bool:
        """Whether the modes are in a punch file of Nastran."""
        return self.modes.suffix.lower() in _PUNCH

    @property
    def turn(self) -> Float:
        """Rotation from the axes of the file to the axlebox frame, shape [3, 3]."""
        found = np.zeros((3, 3))
        for row, word in enumerate((self.forward, self.left, self.up)):
            found[row, "xyz".index(word[-1])] = -1.0 if word.startswith("-") else 1.0
        return found


def modes_of_file(box: ModeFile, bearing: RollerBearing) -> Modes:
    """Read the modes of a file as the bearing, sensors and springs see them; rigid motion is left out.

    Raises
    ------
    InputError
        With every mistake in the file, and where it has no nodes.
    """
    found = read_universal(box.modes) if box.grid is None else read_nastran(box.modes, box.grid)
    unit = 1e-3 if box.length_unit == "mm" else 1.0
    nodes = (unit * found.nodes - np.array(box.origin)) @ box.turn.T
    bending = np.argsort(found.frequency)
    bending = bending[found.frequency[bending] > _RIGID_HZ]
    shape = found.shape[bending] @ box.turn.T / np.sqrt(1e3 if box.mass_unit == "t" else 1.0)
    seats = (*box.sensors, *box.suspension)
    problems: list[str] = []
    raceway = np.zeros((len(bending), 2, 3, 2 * WAVES + 1))
    for row, name in enumerate(("inboard", "outboard")):
        problems += _fit_row(raceway[:, row], nodes, shape, box, bearing, row, name)
    read = {}
    for seat in seats:
        distance = np.linalg.norm(nodes - np.array(seat.position), axis=1)
        if distance.min() > seat.radius:
            problems.append(
                f"no node within radius_mm {1e3 * seat.radius:g} of the seat {seat.name!r}; the nearest is "
                f"{1e3 * distance.min():.0f} mm away"
            )
        else:
            read[seat.name] = shape[:, distance <= seat.radius].mean(axis=1)
    if problems:
        raise InputError([f"{box.modes}: {problem}" for problem in problems])
    damping = found.damping_ratio[bending]
    return Modes(
        box.name,
        f"{box.description}; modes of {box.modes.name}".removeprefix("; "),
        found.frequency[bending],
        np.where(damping > 0.0, damping, damping_ratios(box.damping_ratio, found.frequency[bending])),
        raceway,
        read,
        {seat.name: seat.position for seat in seats},
        box.mass,
        box.centre,
        box.inertia,
        len(bending),
        Cup.of(bearing),
        box.products,
        suspension=tuple(seat.name for seat in box.suspension),
    )


def _fit_row(
    target: Float, nodes: Float, shape: Float, box: ModeFile, bearing: RollerBearing, row: int, name: str
) -> Iterator[str]:
    """Fit the series around one row to the nodes under it; yields what is wrong with them."""
    radius = bearing.cup_radius if box.seat_diameter is None else 0.5 * box.seat_diameter
    distance = np.hypot(nodes[:, 0], nodes[:, 2])
    along = np.abs(nodes[:, 1] - row_places(bearing)[row]) <= 0.5 * bearing.effective_length
    near = along & (np.abs(distance - radius) <= box.tolerance)
    angle = np.arctan2(nodes[near, 0], nodes[near, 2])
    around = len(np.unique(np.round(angle / _SAME_PLACE)))
    waves = min(WAVES, (around - 1) // 3)  # three nodes a wave: two would take a shorter wave for a longer
    if waves < 2:
        yield (
            f"nodes lie at {around} azimuths on the cylinder of {2e3 * radius:.1f} mm under the {name} row; "
            "at least 7 are needed: check origin_mm, forward, left, up and seat_diameter_mm"
        )
        return
    order = np.arange(1, waves + 1) * angle[:, None]
    basis = np.concatenate([np.ones((len(angle), 1)), np.cos(order), np.sin(order)], axis=1)
    if np.linalg.cond(basis) > _CONDITION:
        gap = np.degrees(np.diff(np.sort(angle), append=angle.min() + 2.0 * np.pi).max())
        yield (
            f"nodes under the {name} row leave {gap:.0f} degrees of the circle empty: {waves} waves around "
            "it cannot be distinguished; give nodes all round"
        )
        return
    columns = [*range(waves + 1), *range(WAVES + 1, WAVES + 1 + waves)]
    sine, cosine = np.sin(angle), np.cos(angle)
    x, y, z = np.moveaxis(shape[:, near], 2, 0)
    for field, values in enumerate((x * sine + z * cosine, x * cosine - z * sine, y)):
        target[:, field, columns] = np.linalg.lstsq(basis, values.T, rcond=None)[0].T
