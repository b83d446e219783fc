"""Waviness of raceways and rollers: harmonics around the circumference."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_SURFACES = ("cup", "cone", "roller")


@dataclass(frozen=True)
class Waviness:
    """Deviation from the circle, a sum of ``a_k cos(k theta + psi_k)`` with phases from a seed.

    Parameters
    ----------
    on : str
        ``cup``, ``cone`` or ``roller``.
    row : int
        0 inboard, 1 outboard.
    orders : tuple of int
        Waves per circumference.
    amplitudes : tuple of float
        Amplitude of each order, [m].
    roller : int or None
        Which roller; ``None``: all of the row, each with phases of its own.
    seed : int
        Of the phases.

    Notes
    -----
    The same all along the generator line. Positive is away from the other body (a gap).
    """

    on: str
    row: int
    orders: tuple[int, ...]
    amplitudes: tuple[float, ...]
    roller: int | None = None
    seed: int = 1

    def phases(self, roller: int = 0) -> NDArray[np.float64]:
        """Phase of each order; the rollers differ, shape [order], [rad]."""
        draw = np.random.default_rng([self.seed, _SURFACES.index(self.on), self.row, roller])
        return draw.uniform(0.0, 2.0 * math.pi, len(self.orders))

    def gap(self, azimuth: NDArray[np.float64], roller: int = 0) -> NDArray[np.float64]:
        """Gap at azimuths [rad] of the body, [m]."""
        angle = np.multiply.outer(azimuth, np.array(self.orders)) + self.phases(roller)
        return np.asarray(np.cos(angle) @ np.array(self.amplitudes))

    def described(self) -> str:
        """What it is, in a few words."""
        rms = math.sqrt(0.5 * sum(a * a for a in self.amplitudes))
        first, last = min(self.orders), max(self.orders)
        span = f"order {first}" if first == last else f"orders {first} to {last}"
        which = "" if self.roller is None else f" {self.roller}"
        return f"waviness of the {self.on}{which}, row {self.row}, {span}, {rms * 1e6:.2f} µm rms"


def band_amplitudes(first: int, last: int, rms: float, exponent: float = 1.0) -> tuple[float, ...]:
    """Amplitudes of the orders of a band that fall as ``k^-exponent``, of a given rms sum [m].

    References
    ----------
    Bands of waves per circumference as in ISO 15242; amplitudes falling with 1/k: Wardle (1988), Part 2.
    """
    shape = np.arange(first, last + 1, dtype=float) ** -exponent
    return tuple(float(a) for a in shape * rms * math.sqrt(2.0 / float(shape @ shape)))
