"""Slow, obvious reference of a roller over a pit: pressures on a grid of an elastic half-space."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.signal import fftconvolve

from test.kernels.naive import Float

Shape = Callable[[Float, Float], Float]  # rolling and axial place [m] -> depth of the surface [m]

TOLERANCE = 1e-5


def rectangle_sink(x: Float, y: Float, a: float, b: float, contact_modulus: float) -> Float:
    """Sink at (x, y) of both bodies under a pressure of 1 Pa on a rectangle of 2 a by 2 b, [m/Pa].

    Love (1929); Johnson, Contact Mechanics, eq. 3.25. ``contact_modulus`` is E' with 2/E' = 2 (1 - nu^2)/E.
    """

    def corner(p: Float, q: Float) -> Float:
        return np.asarray(p * np.arcsinh(q / np.maximum(np.abs(p), 1e-30)))

    total = np.zeros(np.broadcast(x, y).shape)
    for p, q in ((x + a, y + b), (y + b, x + a)):
        total += corner(p, q)
    for p, q in ((x - a, y - b), (y - b, x - a)):
        total += corner(p, q)
    for p, q in ((x + a, y - b), (y - b, x + a), (x - a, y + b), (y + b, x - a)):
        total -= corner(p, q)
    return total / (math.pi * 0.5 * contact_modulus)


class HalfSpace:
    """A cylinder of a radius and a length on a plane half-space, on a grid.

    The end faces are left out: the half-space goes on beyond the ends of the cylinder.
    """

    def __init__(
        self, radius: float, length: float, contact_modulus: float, half_width: float, cells: tuple[int, int]
    ) -> None:
        across, along = cells
        self.cell = (2.0 * half_width / across, length / along)
        self.x = (np.arange(across) + 0.5) * self.cell[0] - half_width
        self.y = (np.arange(along) + 0.5) * self.cell[1] - 0.5 * length
        near_x = np.arange(1.0 - across, across) * self.cell[0]
        near_y = np.arange(1.0 - along, along) * self.cell[1]
        self._kernel = rectangle_sink(
            near_x[:, None], near_y[None, :], 0.5 * self.cell[0], 0.5 * self.cell[1], contact_modulus
        )
        self._profile = np.broadcast_to((self.x**2 / (2.0 * radius))[:, None], cells)

    def _sink(self, pressure: Float) -> Float:
        rows, columns = pressure.shape
        whole = fftconvolve(pressure, self._kernel)
        return np.asarray(whole[rows - 1 : 2 * rows - 1, columns - 1 : 2 * columns - 1])

    def pressure(self, approach: float, pit: Float | float = 0.0, first: Float | None = None) -> Float:
        """Pressure at an approach [m], the surface lower by ``pit`` [m], shape [rolling, axial], [Pa].

        Conjugate gradients on the cells that touch (Polonsky and Keer 1999, at a held approach).
        """
        gap = self._profile + pit - approach  # what the sink has to open
        pressure = np.where(gap < 0.0, 1e8, 0.0) if first is None else first.copy()
        direction, before = np.zeros_like(pressure), 1.0
        for _ in range(2000):
            residual = self._sink(pressure) + gap  # 0 where they touch, > 0 where they are apart
            touching = pressure > 0.0
            # cells that would go into each other press as well
            square = float(np.sum(residual[touching] ** 2))
            direction = np.where(touching, residual + square / before * direction, 0.0)
            before = square
            turned = self._sink(direction)
            step = float(np.sum((residual * direction)[touching]) / np.sum((turned * direction)[touching]))
            moved = np.maximum(np.where(touching, pressure - step * direction, pressure), 0.0)
            overlap = (moved <= 0.0) & (residual < 0.0)
            if np.any(overlap):
                before = math.inf
                moved = np.where(overlap, pressure - step * residual, moved)
            if np.sum(np.abs(moved - pressure)) <= TOLERANCE * np.sum(moved) and not np.any(overlap):
                return np.asarray(moved)
            pressure = moved
        raise AssertionError("no balance of the pressures was found")

    def load(self, pressure: Float) -> float:
        """Load of pressures, [N]."""
        return float(np.sum(pressure)) * self.cell[0] * self.cell[1]
