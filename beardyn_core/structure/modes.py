"""The modes of an axlebox as its bearing, its sensors and its springs see them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.structure.cup import Cup

WAVES = 8  # most waves around a raceway
RESIDUAL_WAVES = 3  # around a row, of the loads that residual modes answer
FIELDS = ("radial", "tangential", "axial")
_MOST_DAMPED = 0.95  # over the critical one: a mode that rings no more
_DEPENDENT = 1e-8  # of the largest: directions that other loads have given already


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes of a free box with unit modal mass; they move neither its centre of mass nor its principal axes.

    A displacement around the raceway of a row is the series a0 + sum of a_n cos(n t) + b_n sin(n t) of the
    azimuth t, which runs from +z towards +x as everywhere; its coefficients stand in the order a0, a1 ... a8,
    b1 ... b8.
    """

    name: A[str, "of the box"]
    description: A[str, "what it is, where it comes from"]
    frequency: A[Float, "shape [mode], [Hz]"]
    damping_ratio: A[Float, "shape [mode], over the critical one"]
    raceway: A[Float, "shape [mode, row, field, 2 WAVES + 1], inboard row first, [1/sqrt(kg)]"]
    seats: A[dict[str, Float], "name -> shape [mode, 3], along x, y, z, [1/sqrt(kg)]"]
    places: A[dict[str, tuple[float, float, float]], "name -> from the bearing centre along x, y, z, [m]"]
    mass: A[float, "of box and cup, [kg]"]
    centre: A[tuple[float, float, float], "of mass, from the bearing centre, [m]"]
    inertia: A[
        tuple[float, float, float], "of box and cup about x, y, z through the bearing centre, [kg m^2]"
    ]
    free_count: A[int, "of the modes are free ones, the first; the rest are residual"]
    cup: A[Cup, "in the box"]
    products: A[tuple[float, float, float], "xy, xz, yz of the same matrix of inertia, [kg m^2]"] = (
        0.0,
        0.0,
        0.0,
    )
    suspension: A[tuple[str, ...], "names of the seats of springs and links; none: they bend nothing"] = ()
    made_from: A[str, "digest of box and cup that were meshed; empty for modes of another program"] = ""

    def __repr__(self) -> str:
        """Give name, mass and how many modes there are up to where, in one line."""
        bending = (
            f"{self.free_count} free modes to {self.frequency[: self.free_count].max(initial=0.0):.0f} Hz"
        )
        return f"Modes {self.name}: {self.mass:.4g} kg with the cup of {self.cup.bearing}, {bending}"

    @property
    def reads(self) -> Float:
        """Everything that is read of each mode in one matrix, shape [read, mode]."""
        count = len(self.frequency)
        return np.concatenate(
            [self.raceway.reshape(count, -1).T, *(shape.T for shape in self.seats.values())]
        )

    def below(self, highest: float) -> Modes:
        """Condense what lies above a frequency [Hz] to residual modes with the same static bending.

        The loads are those that residual modes of a table answer: on the raceways with up to
        `RESIDUAL_WAVES` waves around, thrust, and at the seats.
        """
        kept = (self.frequency <= highest) & (np.arange(len(self.frequency)) < self.free_count)
        squares = (2.0 * np.pi * self.frequency[~kept]) ** 2
        static = self._loads()[~kept] / squares[:, None]
        static = static[:, np.abs(static).max(axis=0, initial=0.0) > 0.0]
        turn, size, _ = np.linalg.svd(static / np.linalg.norm(static, axis=0), full_matrices=False)
        turn = turn[:, size > _DEPENDENT * size.max(initial=0.0)]
        turn = turn @ np.linalg.eigh(turn.T @ (squares[:, None] * turn))[1]
        mix = np.zeros((len(kept), turn.shape[1]))
        mix[~kept] = turn
        count = int(np.count_nonzero(kept))
        return replace(self._of(np.concatenate([np.eye(len(kept))[:, kept], mix], axis=1)), free_count=count)

    def scaled(self, stiffness: float, damping: float) -> Modes:
        """Make every mode stiffer and more damped by a factor each; shapes and masses stay."""
        return replace(
            self,
            frequency=self.frequency * np.sqrt(stiffness),
            damping_ratio=np.minimum(
                self.damping_ratio * damping, np.maximum(self.damping_ratio, _MOST_DAMPED)
            ),
        )

    def _of(self, mix: Float) -> Modes:
        """Mix modes to others with unit modal mass, shape [mode, new]."""
        return replace(
            self,
            frequency=np.sqrt(self.frequency**2 @ mix**2),
            damping_ratio=self.damping_ratio @ mix**2,
            raceway=np.tensordot(mix.T, self.raceway, 1),
            seats={name: mix.T @ shape for name, shape in self.seats.items()},
        )

    def _loads(self) -> Float:
        """Give the forces of unit loads on raceways and seats on each mode, shape [mode, load]."""
        series = [0, *range(1, RESIDUAL_WAVES + 1), *range(WAVES + 1, WAVES + RESIDUAL_WAVES + 1)]
        radial = self.raceway[:, :, 0, series].reshape(len(self.frequency), -1)
        return np.concatenate([radial, self.raceway[:, :, 2, 0], *self.seats.values()], axis=1)

    def yielding(self, one: Float, other: Float) -> float:
        """Compute how far the place of a unit load yields under another, without rigid motion, [m/N].

        Parameters
        ----------
        one, other : array, shape [read]
            What of `reads` each load acts on.
        """
        squares = (2.0 * np.pi * self.frequency) ** 2
        return float((one @ self.reads) / squares @ (self.reads.T @ other))

    def response(self, one: Float, other: Float, frequency: Float) -> Float:
        """Compute the elastic part of a receptance, the complex displacement under a unit force.

        Parameters
        ----------
        one, other : array, shape [read]
            Where it is read and where the force acts.
        frequency : array, shape [line]
            [Hz].

        Returns
        -------
        array, shape [line]
            Complex, [m/N].
        """
        natural, line = 2.0 * np.pi * self.frequency, 2.0 * np.pi * np.asarray(frequency)[:, None]
        strength = (one @ self.reads) * (other @ self.reads)
        return (strength / (natural**2 - line**2 + 2j * self.damping_ratio * natural * line)).sum(axis=1)
