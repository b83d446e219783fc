"""Free modes of a wheelset from its dimensions: a Timoshenko beam with wheels and discs as rigid masses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.wheelset import Wheelset

# steel of axles (EN 13261), [Pa], [Pa], [kg/m^3]
YOUNG, SHEAR, DENSITY = 2.06e11, 7.92e10, 7850.0
# half the distance of the rolling circles, where the wheels stand; cant is measured over twice of it
HALF_GAUGE = 0.75
_LONGEST_ELEMENT = 0.025
_LEAST_WHEEL = 100.0
# modes below this are kept, [Hz]
_HIGHEST = 1500.0


@dataclass(frozen=True)
class Modes:
    """Free elastic modes of one kind, of a half wheelset; the other half mirrors it.

    Bending modes have the mass of the half wheelset, so that a mode's coordinate is a displacement; torsion
    modes have the polar inertia of the half wheelset, and their coordinate is an angle.
    """

    frequency: A[Float, "shape [mode], [Hz]"]
    wheel: A[Float, "shape [mode], displacement at the wheel, or turn, per unit of the coordinate"]
    wheel_slope: A[Float, "shape [mode], tilt of the wheel, [1/m]; in torsion zero"]
    journal: A[Float, "shape [mode], displacement at the bearing's centre, or turn"]
    journal_slope: A[Float, "shape [mode], tilt of the journal there, [1/m]; in torsion zero"]
    mass: A[float, "of each mode, [kg], in torsion [kg m^2]"]
    rigid: A[float, "what moves as a rigid body: half mass, half inertia in roll or about the axle"]

    damping_ratio: A[float, "of each mode"]

    def __len__(self) -> int:
        return len(self.frequency)

    @property
    def stiffness(self) -> Float:
        """Stiffness of each mode, shape [mode], [N/m], in torsion [N m/rad]."""
        return np.asarray(self.mass * (2.0 * np.pi * self.frequency) ** 2)

    @property
    def damping(self) -> Float:
        """Damping of each mode, shape [mode], [N s/m], in torsion [N m s/rad]."""
        return np.asarray(4.0 * np.pi * self.damping_ratio * self.mass * self.frequency)

    def first(self, count: int) -> Modes:
        """Keep the lowest modes."""
        return replace(
            self,
            frequency=self.frequency[:count],
            wheel=self.wheel[:count],
            wheel_slope=self.wheel_slope[:count],
            journal=self.journal[:count],
            journal_slope=self.journal_slope[:count],
        )

    def below(self, highest: float) -> Modes:
        """Keep the modes below a frequency [Hz]."""
        return self.first(int(np.searchsorted(self.frequency, highest)))

    def condense(self, highest: float, forces: tuple[str, ...] = ("wheel", "journal")) -> Modes:
        """Keep the modes below a frequency [Hz], and few that yield as all the others do to steady forces.

        By default one force acts at the wheel, one at the journal; a moment there is a force on
        ``journal_slope``. The further shapes are orthogonal to the modes kept and to each other, so that
        they are modes like these, with frequencies of their own.

        References
        ----------
        Rubin (1975), Improved component-mode representation for structural dynamic analysis, AIAA J. 13, 995:
        residual attachment modes.
        """
        count = int(np.searchsorted(self.frequency, highest))
        if count in (0, len(self)):
            return self.first(count)
        square = (2.0 * np.pi * self.frequency[count:]) ** 2
        yielding = np.stack([getattr(self, each)[count:] for each in forces], axis=1) / square[:, None]
        yielding /= np.linalg.norm(yielding, axis=0)
        left, mixed = eigh(yielding.T @ (square[:, None] * yielding), yielding.T @ yielding)

        def with_few(shape: Float) -> Float:
            return np.concatenate([shape[:count], shape[count:] @ yielding @ mixed])

        return replace(
            self,
            frequency=np.concatenate([self.frequency[:count], np.sqrt(left) / (2.0 * np.pi)]),
            wheel=with_few(self.wheel),
            wheel_slope=with_few(self.wheel_slope),
            journal=with_few(self.journal),
            journal_slope=with_few(self.journal_slope),
        )


def bending_modes(
    operation: QuarterVehicleOperation, mounting: Mounting, bearing: RollerBearing | None = None
) -> Modes | None:
    """Compute the modes of a wheelset in which both wheels move alike; ``None`` when it is rigid.

    ``bearing``: with its cones on the journal, and right at rest also under a moment there.
    """
    cones = 0.0 if bearing is None else bearing.cone_mass
    half = half_shaft(operation, mounting, cones)
    if half is None:
        return None
    forces = ("wheel", "journal") if bearing is None else ("wheel", "journal", "journal_slope")
    modes = bending(half, mounting.journal_mass + cones, symmetric=True).condense(_HIGHEST, forces)
    return modes if len(modes) else None


def half_shaft(operation: QuarterVehicleOperation, mounting: Mounting, box_mass: float) -> Shaft | None:
    """Build half of a vehicle's axle, with an axlebox [kg] on it; ``None`` when the wheelset is rigid."""
    wheelset = operation.vehicle.wheelset
    if wheelset is None or operation.wheelset == "rigid":
        return None
    arm = 0.5 * operation.vehicle.guidance.axlebox_spacing
    return shaft(wheelset, mounting.journal_mass, 0.5 * operation.wheel_diameter, arm, box_mass)


@dataclass(frozen=True)
class Shaft:
    """Half an axle as elements, and the rigid bodies on it."""

    node: A[Float, "shape [node], from the middle outwards, [m]"]
    outer: A[Float, "shape [element], diameter, [m]"]
    bore: A[float, "[m]"]
    damping_ratio: A[float, "of each mode"]
    place: A[NDArray[np.int64], "shape [body], nodes of the rigid bodies"]
    mass: A[Float, "shape [body], what belongs to this half, [kg]"]
    polar: A[Float, "shape [body], inertia about the axle, [kg m^2]"]
    wheel: A[int, "node of the wheel"]
    journal: A[int, "node of the bearing's centre"]


def shaft(wheelset: Wheelset, half_mass: float, radius: float, arm: float, box_mass: float = 0.0) -> Shaft:
    """Build half of an axle with what sits on it.

    Parameters
    ----------
    half_mass : float
        Of half the wheelset: the wheel has what axle and discs leave, [kg].
    radius : float
        Of the wheel, [m].
    arm : float
        From the middle to the bearing's centre, [m].
    box_mass : float, optional
        Of an axlebox that moves with the journal, [kg].

    Raises
    ------
    InputError
        When too little is left for the wheel, or the bearing is not outside of it.
    """
    seat = (HALF_GAUGE - 0.5 * wheelset.seat_length, HALF_GAUGE + 0.5 * wheelset.seat_length)
    if arm <= seat[1]:
        raise InputError(
            f"guidance.axlebox_spacing_m of the vehicle is {2.0 * arm:g}; with wheelset: elastic it must be "
            f"above {2.0 * seat[1]:g}, where the wheel seats end: axles with inboard bearings are not "
            "modelled; take wheelset: rigid"
        )
    journal = (max(arm - 0.5 * wheelset.journal_length, seat[1]), arm + 0.5 * wheelset.journal_length)
    discs = wheelset.disc_places
    marks = sorted({0.0, *discs, seat[0], HALF_GAUGE, seat[1], journal[0], arm, journal[1]})
    node = np.unique(np.concatenate([_between_nodes(one, two) for one, two in pairwise(marks)]))
    middle = 0.5 * (node[:-1] + node[1:])
    outer = np.full(len(middle), wheelset.axle_diameter)
    for begin, diameter in (
        (seat[0], wheelset.seat_diameter),
        (seat[1], wheelset.collar_diameter),
        (journal[0], wheelset.journal_diameter),
    ):
        outer[middle > begin] = diameter
    area = 0.25 * np.pi * (outer**2 - wheelset.bore_diameter**2)
    axle = float(np.sum(DENSITY * area * np.diff(node)))
    # a disc in the middle belongs to both halves
    shares = np.array([0.5 if place == 0.0 else 1.0 for place in discs])
    wheel = half_mass - axle - float(shares.sum()) * wheelset.disc_mass
    if wheel < _LEAST_WHEEL:
        raise InputError(
            f"mounting.journal_mass_kg is {half_mass:g}; half the axle and its discs weigh "
            f"{half_mass - wheel:.0f} kg, which leaves {wheel:.0f} kg for a wheel: it must be at least "
            f"{_LEAST_WHEEL:g} kg; give a heavier half wheelset or change wheelset of the vehicle"
        )
    at = np.array([*discs, HALF_GAUGE, arm])
    mass = np.array([*(shares * wheelset.disc_mass), wheel, box_mass])
    gyration = np.array([wheelset.disc_gyration] * len(discs) + [wheelset.wheel_gyration * radius, 0.0])
    place = np.searchsorted(node, at - 1e-9).astype(np.int64)
    return Shaft(
        node,
        outer,
        wheelset.bore_diameter,
        wheelset.damping_ratio,
        place,
        mass,
        mass * gyration**2,
        int(place[-2]),
        int(place[-1]),
    )


def bending(half: Shaft, half_mass: float, symmetric: bool) -> Modes:
    """Compute the free bending modes of a wheelset in one plane.

    Parameters
    ----------
    half_mass : float
        What the modes are scaled to, [kg].
    symmetric : bool
        Both wheels move alike; else against each other.

    References
    ----------
    Przemieniecki (1968), Theory of Matrix Structural Analysis, sections 5.6 and 11.3: stiffness and
    consistent mass of a beam with shear and rotary inertia. Cowper (1966), J. Appl. Mech. 33: the area of a
    ring that shears.
    """
    stiffness, mass = beam_matrices(half)
    # by symmetry the middle does not tilt, or does not move
    keep = np.delete(np.arange(len(mass)), 1 if symmetric else 0)
    square, shape = eigh(stiffness[np.ix_(keep, keep)], mass[np.ix_(keep, keep)])
    whole = np.zeros((len(mass), len(keep) - 1))
    whole[keep] = shape[:, 1:] * np.sqrt(half_mass)  # the first one is rigid
    whole *= np.where(whole[2 * half.wheel] < 0.0, -1.0, 1.0)
    moves = np.zeros(len(mass))
    moves[0::2] = 1.0 if symmetric else half.node
    moves[1::2] = 0.0 if symmetric else 1.0
    wheel, journal = 2 * half.wheel, 2 * half.journal
    return Modes(
        np.sqrt(square[1:]) / (2.0 * np.pi),
        whole[wheel],
        whole[wheel + 1],
        whole[journal],
        whole[journal + 1],
        half_mass,
        float(moves @ mass @ moves),
        half.damping_ratio,
    )


def torsion(half: Shaft) -> Modes:
    """Compute the free torsion modes in which the wheels turn against each other."""
    stiffness, mass = torsion_matrices(half)
    # the middle does not turn
    square, shape = eigh(stiffness[1:, 1:], mass[1:, 1:])
    inertia = float(mass.sum())
    whole = np.vstack([np.zeros(len(square)), shape]) * np.sqrt(inertia)
    none = np.zeros(len(square))
    frequency = np.sqrt(square) / (2.0 * np.pi)
    shapes = whole[half.wheel], none, whole[half.journal], none
    return Modes(frequency, *shapes, inertia, inertia, half.damping_ratio)


def beam_matrices(half: Shaft) -> tuple[Float, Float]:
    """Assemble stiffness and mass, each node with its displacement and tilt, shape [2 node, 2 node]."""
    count = 2 * len(half.node)
    stiffness, mass = np.zeros((count, count)), np.zeros((count, count))
    for element, length in enumerate(np.diff(half.node)):
        outer, inner = half.outer[element], half.bore
        area = 0.25 * np.pi * (outer**2 - inner**2)
        second = np.pi / 64.0 * (outer**4 - inner**4)
        part = slice(2 * element, 2 * element + 4)
        own = _beam_element(float(length), area, second, _shear_share(inner / outer))
        stiffness[part, part] += own[0]
        mass[part, part] += own[1]
    for node, body, polar in zip(half.place, half.mass, half.polar, strict=True):
        mass[2 * node, 2 * node] += body
        mass[2 * node + 1, 2 * node + 1] += 0.5 * polar  # thin discs
    return stiffness, mass


def torsion_matrices(half: Shaft) -> tuple[Float, Float]:
    """Assemble stiffness and inertia in torsion, shape [node, node]."""
    count = len(half.node)
    stiffness, mass = np.zeros((count, count)), np.zeros((count, count))
    for element, length in enumerate(np.diff(half.node)):
        polar = np.pi / 32.0 * (half.outer[element] ** 4 - half.bore**4)
        part = slice(element, element + 2)
        stiffness[part, part] += SHEAR * polar / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
        mass[part, part] += DENSITY * polar * length / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
    np.add.at(mass, (half.place, half.place), half.polar)
    return stiffness, mass


def _between_nodes(one: float, two: float) -> Float:
    return np.linspace(one, two, int(np.ceil((two - one) / _LONGEST_ELEMENT)) + 1)


def _shear_share(hollow: float) -> float:
    """Compute the share of a ring's area that shears, from its inner over its outer diameter."""
    poisson, square = YOUNG / (2.0 * SHEAR) - 1.0, hollow**2
    above = 6.0 * (1.0 + poisson) * (1.0 + square) ** 2
    return above / ((7.0 + 6.0 * poisson) * (1.0 + square) ** 2 + (20.0 + 12.0 * poisson) * square)


def _beam_element(length: float, area: float, second: float, shear_share: float) -> tuple[Float, Float]:
    """Build stiffness and mass of one element: displacement and tilt at both ends, shape [4, 4]."""
    soft = 12.0 * YOUNG * second / (SHEAR * shear_share * area * length**2)
    bend = YOUNG * second / (length**3 * (1.0 + soft))
    over = length**2
    stiffness = bend * np.array(
        [
            [12.0, 6.0 * length, -12.0, 6.0 * length],
            [6.0 * length, (4.0 + soft) * over, -6.0 * length, (2.0 - soft) * over],
            [-12.0, -6.0 * length, 12.0, -6.0 * length],
            [6.0 * length, (2.0 - soft) * over, -6.0 * length, (4.0 + soft) * over],
        ]
    )
    # displacement and tilt along the element for unit values at its ends, at Gauss points
    point, weight = np.polynomial.legendre.leggauss(4)
    mass = np.zeros((4, 4))
    for x, w in zip(0.5 * (point + 1.0), 0.5 * length * weight, strict=True):
        moved = np.array(
            [
                1.0 - 3.0 * x**2 + 2.0 * x**3 + soft * (1.0 - x),
                length * (x - 2.0 * x**2 + x**3 + 0.5 * soft * (x - x**2)),
                3.0 * x**2 - 2.0 * x**3 + soft * x,
                length * (x**3 - x**2 + 0.5 * soft * (x**2 - x)),
            ]
        )
        tilted = np.array(
            [
                6.0 * (x**2 - x) / length,
                1.0 - 4.0 * x + 3.0 * x**2 + soft * (1.0 - x),
                6.0 * (x - x**2) / length,
                3.0 * x**2 - 2.0 * x + soft * x,
            ]
        )
        mass += w * DENSITY * (area * np.outer(moved, moved) + second * np.outer(tilted, tilted))
    return stiffness, mass / (1.0 + soft) ** 2
