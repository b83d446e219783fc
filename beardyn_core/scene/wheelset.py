"""A wheelset that bends and twists: the axle's dimensions and what sits on it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.edge import At, refuse


@dataclass(frozen=True)
class Wheelset:
    """Axle, wheels and brake discs, alike in both halves.

    The mass of the half wheelset is that of the mounting; the wheel has what axle and discs leave of it.
    """

    axle_diameter: A[float, At("mm", gt=0.0, ge=80.0, le=300.0), "between the wheels"]
    seat_diameter: A[float, At("mm", gt=0.0, ge=80.0, le=320.0), "of the wheel seats"]
    collar_diameter: A[float, At("mm", gt=0.0, ge=60.0, le=300.0), "between wheel seat and journal"]
    journal_diameter: A[float, At("mm", gt=0.0, ge=60.0, le=260.0), "of the journals"]
    bore_diameter: A[float, At("mm", ge=0.0, le=120.0), "of a hollow axle; 0 for a solid one"] = 0.0
    seat_length: A[float, At("mm", gt=0.0, ge=100.0, le=300.0), "of a wheel seat"] = 0.18
    journal_length: A[
        float, At("mm", gt=0.0, ge=50.0, le=300.0), "of a journal, half of it on either side of the bearing"
    ] = 0.2
    wheel_gyration: A[
        float, At(ge=0.5, le=0.95), "radius of gyration of a wheel about its axle, over its radius"
    ] = 0.72
    disc_places: A[
        tuple[float, ...],
        At("mm"),
        "brake discs of one half, from the middle of the axle; one at 0 belongs to both halves",
    ] = ()
    disc_mass: A[float, At("kg", ge=0.0, le=400.0), "of one brake disc with its hub"] = 0.0
    disc_gyration: A[
        float, At("mm", gt=0.0, ge=50.0, le=500.0), "radius of gyration of a brake disc about the axle"
    ] = 0.24
    damping_ratio: A[float, At(ge=0.0, le=0.2), "share of critical damping of each mode"] = 0.01

    def __post_init__(self) -> None:
        refuse(self, "wheelset")

    def rules(self) -> Iterator[str]:
        """Check the diameters and the places of the discs against each other."""
        least = min(self.axle_diameter, self.seat_diameter, self.collar_diameter, self.journal_diameter)
        if self.bore_diameter >= 0.8 * least:
            yield (
                f"bore_diameter_mm is {1e3 * self.bore_diameter:g}; it must be below {800.0 * least:g}, "
                "0.8 of the thinnest diameter"
            )
        widest = 0.75 - 0.5 * self.seat_length
        for index, place in enumerate(self.disc_places):
            if not 0.0 <= place < widest:
                yield (
                    f"disc_places_mm[{index}] is {1e3 * place:g}; it must be at least 0 and below "
                    f"{1e3 * widest:g}, where the wheel seat begins"
                )
        if self.disc_places and self.disc_mass == 0.0:
            yield "disc_mass_kg is missing; there are disc_places_mm"
