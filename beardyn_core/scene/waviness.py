"""Waviness of raceways and rollers: harmonics around the circumference."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.edge import ROW, SEED, At, WorkedOut, write_noun
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.patch import no_such, not_on_a_roller

_SURFACES = ("cup", "cone", "roller")


@dataclass(frozen=True)
class Band:
    """A band of orders whose amplitudes fall with a power of the order."""

    first: A[int, At(ge=1, le=1000), "lowest order, waves per circumference"]
    last: A[int, At(ge=1, le=1000), "highest order"]
    rms: A[float, At("um", ge=0.0, le=50.0), "of the whole band"]
    exponent: A[float, At(ge=0.0, le=4.0), "power of the order with which the amplitudes fall"] = 1.0

    def rules(self) -> Iterator[str]:
        """Check that the band contains an order."""
        if self.last < self.first:
            yield f"last is {self.last}; it must be at least first, {self.first}"

    @property
    def orders(self) -> tuple[int, ...]:
        """Waves per circumference."""
        return tuple(range(self.first, self.last + 1))

    @property
    def amplitudes(self) -> WorkedOut:
        """Amplitude of each order, [m]."""
        return WorkedOut(band_amplitudes(self.first, self.last, self.rms, self.exponent), self)


@dataclass(frozen=True)
class Waviness:
    """Harmonics around a raceway or the rollers: single orders or a band.

    The deviation from the circle is a sum of ``a_k cos(k theta + psi_k)`` with phases from a seed, of each
    roller its own, the same all along the generator line. Positive is away from the other body (a gap).
    """

    on: A[str, At(one_of=_SURFACES), "the surface it is on"]
    row: A[int, ROW, "0 inboard, 1 outboard"]
    orders: A[tuple[int, ...], At(ge=1, le=1000, size=(1, None), optional=True), "waves per circumference"]
    amplitudes: A[
        tuple[float, ...],
        At("um", ge=0.0, le=50.0, key="amplitude", optional=True),
        "of each order: one for all, or one an order",
    ]
    roller: A[int | None, At(ge=0), "which roller, with `on: roller`; all of the row when left out"] = None
    seed: A[int, SEED, "of the phases"] = 1

    def rules(self) -> Iterator[str]:
        """Check that a roller number is set only for rollers, and that amplitudes match the orders."""
        if self.on != "roller" and self.roller is not None:
            yield not_on_a_roller(self.roller, self.on)
        if len(self.orders) != len(self.amplitudes):
            yield (
                f"amplitude_um has {len(self.amplitudes)} entries; it must have one, or one for each of the "
                f"{len(self.orders)} orders"
            )

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that the waviness is possible in the bearing."""
        return no_such("roller", self.roller or 0, bearing)

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Write a band by its limits, and equal amplitudes as one number."""
        band = getattr(self.amplitudes, "source", None)
        if band is not None and band.orders == self.orders:
            del keys["orders"], keys["amplitude_um"]
            return {**keys, "band": write_noun(band)}
        if len(set(self.amplitudes)) == 1:
            keys["amplitude_um"] = keys["amplitude_um"][0]
        return keys

    def phases(self, roller: int = 0) -> NDArray[np.float64]:
        """Draw the phase of each order; the rollers differ, shape [order], [rad]."""
        draw = np.random.default_rng([self.seed, _SURFACES.index(self.on), self.row, roller])
        return draw.uniform(0.0, 2.0 * math.pi, len(self.orders))

    def gap(self, azimuth: NDArray[np.float64], roller: int = 0) -> NDArray[np.float64]:
        """Compute the gap at azimuths [rad] of the body, [m]."""
        angle = np.multiply.outer(azimuth, np.array(self.orders)) + self.phases(roller)
        return np.asarray(np.cos(angle) @ np.array(self.amplitudes))

    def described(self) -> str:
        """Describe the waviness in a few words."""
        rms = math.sqrt(0.5 * sum(a * a for a in self.amplitudes))
        first, last = min(self.orders), max(self.orders)
        span = f"order {first}" if first == last else f"orders {first} to {last}"
        which = "" if self.roller is None else f" {self.roller}"
        return f"waviness of the {self.on}{which}, row {self.row}, {span}, {rms * 1e6:.2f} µm rms"


def band_amplitudes(first: int, last: int, rms: float, exponent: float = 1.0) -> tuple[float, ...]:
    """Compute the amplitudes of a band's orders, which fall as ``k^-exponent``, from their rms sum [m].

    References
    ----------
    Bands of waves per circumference as in ISO 15242; amplitudes falling with 1/k: Wardle (1988), Part 2.
    """
    shape = np.arange(first, last + 1, dtype=float) ** -exponent
    return tuple(float(a) for a in shape * rms * math.sqrt(2.0 / float(shape @ shape)))
