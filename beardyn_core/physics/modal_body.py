"""How the axlebox bends: thin rings or the modes of a table, as one modal body with unit modal masses.

Series stand as in a table of modes: mean, cosines, sines; of each row that of the opening w, then with fewer
waves those of the slip: around, and along the cone, named by its axial part u towards the outer side of the
row (radially it is u tan(alpha)). The normal force works on w alone, and only friction on the slip.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.ring_bending import cup_ring, housing_ring
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import RingStructure, Structure
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.modes import FIELDS, Modes
from beardyn_core.structure.mounted_box import modes_of_effects, require_cup

RINGS = ("elastic", "rigid")  # of a bearing that is asked about without a scene
WAVES_SEEN = 6  # of a table: those with 7 and 8 waves change what yields to one roller by up to 0.2 % of it
_RADIAL, _TANGENTIAL, _AXIAL = range(len(FIELDS))
_ROWS = 2


@dataclass(frozen=True, eq=False)
class ModalBody:
    """How an axlebox bends: modes with unit modal mass; one object for one box, so that it can be a key."""

    rate: A[Float, "shape [mode], of the undamped modes, [rad/s]"]
    damping_ratio: A[Float, "shape [mode]"]
    raceway: A[Float, "shape [mode, row, field, series], axial outwards along the row, [1/sqrt(kg)]"]
    taper: A[float, "tangent of the cup's cone angle"]
    suspension: A[Float | None, "shape [6, mode]; ``None``: the springs do not bend the box"] = None
    modes: A[Modes | None, "of the table, ``None`` of rings"] = None

    @property
    def stiffness(self) -> Float:
        """Stiffness of the unit modal masses, shape [mode], [1/s^2]."""
        return self.rate**2

    @property
    def opening(self) -> Float:
        """How far each raceway gives way in the gap, as radial displacement, shape [mode, row, series]."""
        return self.raceway[:, :, _RADIAL] - self.taper * self.raceway[:, :, _AXIAL]

    def openings(self, azimuth: Float) -> Float:
        """Evaluate `opening` at azimuths [rad] of each row, shapes [place] -> [row, place, mode]."""
        order = np.arange(1, self.raceway.shape[-1] // 2 + 1) * np.asarray(azimuth)[:, None]
        basis = np.concatenate([np.ones((len(order), 1)), np.cos(order), np.sin(order)], axis=1)
        return np.asarray(np.einsum("mrs,ps->rpm", self.opening, basis))


def body_of(scene: Scene) -> ModalBody | None:
    """Make the modal body of a scene; ``None`` where its box is rigid.

    Raises
    ------
    InputError
        When the table has mistakes, or its box is not that of the mounting.
    """
    structure, modes = scene.effects.structure, modes_of_effects(scene.effects)
    if structure is None:
        return None
    return _body(scene.bearing, structure, modes, scene.mounting, scene.rows)


@lru_cache(maxsize=32)
def _body(
    bearing: RollerBearing, structure: Structure, modes: Modes | None, mounting: Mounting, rows: int
) -> ModalBody:
    if isinstance(structure, RingStructure):
        return rings(bearing, structure, rows)
    assert modes is not None
    require_cup(modes, bearing)
    here = mounting.box_mass + bearing.cup_mass
    if abs(here - modes.mass) > 1e-3 * modes.mass:
        raise InputError(
            f"the mounting's box has {here:g} kg with the cup, the box {modes.name} has {modes.mass:g} kg: "
            "take its mass, centre of mass and inertia (beardyn_core.structure.mounted_box.mounting_of)"
        )
    raceway = modes.raceway[:, :rows].copy()
    raceway[:, 0, _AXIAL] *= -1.0  # row 0 is the mirror image: its outer side lies towards -y
    suspended = mounting.cup == "suspended" and modes.suspension
    return ModalBody(
        2.0 * math.pi * modes.frequency,
        modes.damping_ratio,
        first_waves(raceway, WAVES_SEEN),
        math.tan(bearing.cup_slant),
        _suspension(modes) if suspended else None,
        modes,
    )


def bending_rings(bearing: RollerBearing, how: str) -> ModalBody | None:
    """Make the rings of a bearing that is asked about without a scene.

    Parameters
    ----------
    how : str
        ``elastic``: the cup bends in a housing, as `RingStructure` has them; ``rigid``: only contacts yield.

    Returns
    -------
    ModalBody or None
        ``None`` where they are rigid.

    Raises
    ------
    InputError
        It is neither.
    """
    if how not in RINGS:
        raise InputError(f"rings is {how!r}; allowed are {', '.join(RINGS)}")
    return rings(bearing, RingStructure(), _ROWS) if how == "elastic" else None


def rings(bearing: RollerBearing, structure: RingStructure, rows: int) -> ModalBody:
    """Make the modal body of the cup and the housing wall around it: both directions of each wave."""
    parts = [cup_ring(bearing)]
    if structure.housing_wall > 0.0:
        wall = (structure.housing_wall, structure.housing_modulus, structure.housing_density)
        parts.append(housing_ring(bearing, *wall))
    most = structure.highest_mode
    orders = [n for n in range(2, most + 1) for _ in range(2)]
    stiffness = np.array(
        [structure.stiffness_factor * sum(part.modal_stiffness(n) for part in parts) for n in orders]
    )
    mass = np.array([sum([part.modal_mass(n) for part in parts]) for n in orders])
    raceway = np.zeros((len(orders), rows, len(FIELDS), 2 * most + 1))
    for m, n in enumerate(orders):
        # w = a cos + b sin, and v = (b cos - a sin) / n keeps the length of the ring
        shape, around = (n, most + n) if m % 2 == 0 else (most + n, n)
        raceway[m, :, _RADIAL, shape] = 1.0 / math.sqrt(mass[m])
        raceway[m, :, _TANGENTIAL, around] = (-1.0 if m % 2 == 0 else 1.0) / (n * math.sqrt(mass[m]))
    return ModalBody(
        np.sqrt(stiffness / mass),
        np.full(len(orders), structure.damping_ratio),
        raceway,
        math.tan(bearing.cup_slant),
    )


def _suspension(modes: Modes) -> Float:
    """Share a wrench on the box among its springs' seats, with the least forces, and see what it bends.

    Gives shape [6, mode]. A moment about a line through all seats, which no forces at them make, bends
    nothing.
    """
    places = np.array([modes.places[name] for name in modes.suspension])
    middle = places.mean(axis=0)

    def arms(points: Float) -> Float:
        x, y, z = points.T
        zero = np.zeros_like(x)
        cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]])  # [3, 3, point]
        return np.moveaxis(cross, 2, 0)

    turn = arms(places - middle)
    balance = np.concatenate(
        [np.concatenate([np.eye(3) for _ in places], axis=1), np.concatenate(list(turn), axis=1)]
    )
    to_middle = np.eye(6)
    to_middle[3:, :3] = -arms(middle[None])[0]
    share = np.linalg.pinv(balance, rcond=1e-6) @ to_middle  # [3 x seat, 6]
    shapes = np.concatenate([modes.seats[name] for name in modes.suspension], axis=1)  # [mode, 3 x seat]
    return np.asarray((shapes @ share).T)


def first_waves(raceway: Float, seen: int) -> Float:
    """Leave out waves beyond the first ones, and the highest ones where nothing has them."""
    waves = raceway.shape[-1] // 2
    there = np.abs(raceway).max(axis=(0, 1, 2), initial=0.0) > 0.0
    most = max((n for n in range(1, min(seen, waves) + 1) if there[n] or there[waves + n]), default=0)
    columns = [*range(most + 1), *range(waves + 1, waves + 1 + most)]
    return np.ascontiguousarray(raceway[..., columns])
