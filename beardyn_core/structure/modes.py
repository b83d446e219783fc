"""The modes of an axlebox as its bearing, its sensors and its springs see them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float

WAVES = 8  # most waves around a raceway
FIELDS = ("radial", "tangential", "axial")


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
    products: A[tuple[float, float, float], "xy, xz, yz of the same matrix of inertia, [kg m^2]"] = (
        0.0,
        0.0,
        0.0,
    )
    suspension: A[tuple[str, ...], "names of the seats of springs and links; none: they bend nothing"] = ()
    made_from: A[str, "digest of box and cup that were meshed; empty for modes of another program"] = ""

    @property
    def reads(self) -> Float:
        """Everything that is read of each mode in one matrix, shape [read, mode]."""
        count = len(self.frequency)
        return np.concatenate(
            [self.raceway.reshape(count, -1).T, *(shape.T for shape in self.seats.values())]
        )

    def below(self, highest: float) -> Modes:
        """Leave out free modes above a frequency [Hz]; residual modes stay, so that the rest still yields."""
        kept = (self.frequency <= highest) | (np.arange(len(self.frequency)) >= self.free_count)
        return replace(
            self,
            frequency=self.frequency[kept],
            damping_ratio=self.damping_ratio[kept],
            raceway=self.raceway[kept],
            seats={name: shape[kept] for name, shape in self.seats.items()},
            free_count=int(np.count_nonzero(kept[: self.free_count])),
        )

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
