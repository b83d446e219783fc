"""Bending of the axlebox as kernel parameters: thin rings or the modes of a table, as one modal body."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.ring_bending import cup_ring, housing_ring
from beardyn_core.config.structure import modes_of_effects, require_cup, seat_of
from beardyn_core.effects import RingStructure, Structure
from beardyn_core.model.arrangement import Arrangement, aligned_zeros
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.modes import FIELDS, Modes

RINGS = ("elastic", "rigid")  # of a bearing that is asked about without a scene
WAVES_SEEN = 6  # of a table: those with 7 and 8 waves change what yields to one roller by up to 0.2 % of it
WAVES_OF_SLIP = 2  # around and along the cone, where only friction works: a third wave brings no more
_RESOLVED = 0.5 * math.pi  # rate of a mode times the step up to which its motion is exact: four steps a turn
_RADIAL, _TANGENTIAL, _AXIAL = range(len(FIELDS))
_ROWS = 2


class StructureParams(NamedTuple):
    """Modes with unit modal mass, whose free motion is exact from step to step."""

    # [mode, read], of each row the series of the opening, around and along the cone, axial outwards, then
    # motion of the bearing centre that stretches the springs alike [1/sqrt(kg)]; zeros fill up to multiples
    # of 4 and 8
    shapes: Any
    rows: int
    series: int  # terms of the opening
    slips: int  # terms around, and as many along
    taper: float  # tangent of the cup's cone angle
    stiffness: Any  # [mode], square of the rate [1/s^2]
    damping: Any  # [mode], [1/s]
    inertia: Any  # [mode], of the step, with the damper's half step [-]
    mass: Any  # [mode], inertia without the damper [-]
    seats: Any  # [6 + 3 x sensor, mode], those of the suspension as above, then of the sensors [1/sqrt(kg)]
    sides: Any  # [group, 2, lane], 1 in lanes of row 0, and 1 in lanes of the other row


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
    bearing: Bearing, structure: Structure, modes: Modes | None, mounting: Mounting, rows: int
) -> ModalBody:
    if isinstance(structure, RingStructure):
        return rings(bearing, structure, rows)
    assert modes is not None
    require_cup(modes, bearing)
    here = mounting.box_mass + bearing.cup_mass
    if abs(here - modes.mass) > 1e-3 * modes.mass:
        raise InputError(
            f"the mounting's box has {here:g} kg with the cup, the box {modes.name} has {modes.mass:g} kg: "
            "take its mass, centre of mass and inertia (beardyn_core.config.structure.mounting_of)"
        )
    raceway = modes.raceway[:, :rows].copy()
    raceway[:, 0, _AXIAL] *= -1.0  # row 0 is the mirror image: its outer side lies towards -y
    suspended = mounting.cup == "suspended" and modes.suspension
    return ModalBody(
        2.0 * math.pi * modes.frequency,
        modes.damping_ratio,
        _first_waves(raceway, WAVES_SEEN),
        math.tan(bearing.cup_angle),
        _suspension(modes) if suspended else None,
        modes,
    )


def bending_rings(bearing: Bearing, how: str) -> ModalBody | None:
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


def rings(bearing: Bearing, structure: RingStructure, rows: int) -> ModalBody:
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
        math.tan(bearing.cup_angle),
    )


def structure_params(
    body: ModalBody | None, scene: Scene, arrangement: Arrangement, step: float
) -> StructureParams | None:
    """Work out the parameters of a modal body for a time step [s]."""
    if body is None:
        return None
    slip = _first_waves(body.raceway[:, :, 1:], WAVES_OF_SLIP)
    count, rows, _, slips = slip.shape
    parts = [np.concatenate([body.opening, slip.reshape(count, rows, -1)], axis=2).reshape(count, -1)]
    parts.append(np.zeros((count, 6)) if body.suspension is None else body.suspension.T)
    reads = np.concatenate(parts, axis=1)
    modes = -(-count // 4) * 4
    shapes = np.zeros((modes, -(-reads.shape[1] // 8) * 8))
    shapes[:count, : reads.shape[1]] = reads

    def filled(values: Float, rest: float = 0.0) -> Float:
        return np.concatenate([values, np.full(modes - count, rest)])

    mass, damping, inertia = exact_oscillators(body.rate, body.damping_ratio, step)
    seats = np.zeros((6, modes))
    seats[:, :count] = 0.0 if body.suspension is None else body.suspension
    if body.modes is not None:
        read = [body.modes.seats[seat_of(sensor, body.modes)] for sensor in scene.sensors]
        sensors = np.zeros((3 * len(read), modes))
        sensors[:, :count] = np.concatenate(read, axis=1).T
        seats = np.concatenate([seats, sensors])
    sides = aligned_zeros(arrangement.group_count, 2, arrangement.width)
    for group in range(arrangement.group_count):
        for lane in range(arrangement.width):
            row = group if arrangement.width == 1 else arrangement.rows * lane // arrangement.width
            sides[group, row, lane] = 1.0
    return StructureParams(
        shapes,
        rows,
        body.raceway.shape[-1],
        slips,
        body.taper,
        filled(body.stiffness),
        filled(damping),
        filled(inertia, 1.0),
        filled(mass, 1.0),
        seats,
        sides,
    )


def exact_oscillators(rate: Float, damping_ratio: Float, step: float) -> tuple[Float, Float, Float]:
    """Find masses and dampers with which steps of unit modal masses have the exact free motion.

    Parameters
    ----------
    rate, damping_ratio : array, shape [mode]
        Undamped rate, [rad/s].
    step : float
        [s].

    Returns
    -------
    mass, damping, inertia : arrays, shape [mode]
        Damping in [1/s]; inertia is the mass with half a step of the damping.

    Notes
    -----
    With velocities half a step after positions and the damper in the middle, q obeys q+ = q + (q - q-) r^2 -
    k (q - F/w^2) for the roots z = r exp(+-i t) when k = 1 + r^2 - 2 r cos(t): r = exp(-d x) and t =
    x sqrt(1 - d^2), x = w h, are the exact ones, and a constant force F moves the mode by F/w^2. A mode with
    less than four steps a turn gets the mass x^2 / 2 and rings with four: right at rest, late, and far enough
    from the limit k = 4 that contacts, which add to it, leave it stable.
    """
    x, ratio = rate * step, np.minimum(damping_ratio, 1.0)
    resolved = x < _RESOLVED
    x = np.where(resolved, x, 1.0)
    decay = np.exp(-2.0 * ratio * x)
    turn = 1.0 + decay - 2.0 * np.sqrt(decay) * np.cos(x * np.sqrt(1.0 - ratio**2))
    inertia = np.where(resolved, x**2 / turn, ratio * rate * step + 0.5 * (rate * step) ** 2)
    half = np.where(resolved, inertia * 0.5 * (1.0 - decay), ratio * rate * step)
    return inertia - half, 2.0 * half / step, inertia


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


def _first_waves(raceway: Float, seen: int) -> Float:
    """Leave out waves beyond the first ones, and the highest ones where nothing has them."""
    waves = raceway.shape[-1] // 2
    there = np.abs(raceway).max(axis=(0, 1, 2), initial=0.0) > 0.0
    most = max((n for n in range(1, min(seen, waves) + 1) if there[n] or there[waves + n]), default=0)
    columns = [*range(most + 1), *range(waves + 1, waves + 1 + most)]
    return np.ascontiguousarray(raceway[..., columns])
