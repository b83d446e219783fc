"""Manufacturing scatter: what one bearing of a lot differs by from its drawing, from a grade and a seed."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import SEED, At, write_noun
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.surface import (
    FACTORS,
    FIRST_ORDER,
    GROUND,
    SHORTEST_WAVE,
    circumference,
    order_amplitudes,
    share_felt,
    stated_rms,
)
from beardyn_core.scene.waviness import Waviness

_ROWS = 2
# A deviation is normal with a quarter of the lot's variation, cut at half of it: sorting takes the rest out.
CUT = 2.0
_TRIES = 24  # draws for each number; 0.0455^24 is no chance
_MICRON = 1e-6

# Rollers of the lot Gn vary by n um in diameter, as in the grades of ISO 12297-1 (cylindrical rollers), ISO
# 3096 (needle rollers: of G2 SKF states 2 um of gauge). All other numbers are assumed, in proportion.
_OF_G1 = {
    "roller_diameter": 1.0,
    "roller_length": 5.0,
    "profile": 1.0,
    "pocket_place": 30.0,
    "pocket_clearance": 30.0,
    "row_clearance": 5.0,
}
GRADES = {
    "none": dict.fromkeys(_OF_G1, 0.0),
    **{f"G{n}": {name: n * each for name, each in _OF_G1.items()} for n in (1, 2, 3, 5)},
}


def _variation(most: float) -> At:
    return At("um", ge=0.0, le=most)


@dataclass(frozen=True)
class Deviations:
    """What one bearing differs by from its drawing."""

    roller_diameter: A[Float, "[row, roller], mean diameter of each roller [m]"]
    roller_length: A[Float, "[row, roller], at the small end [m]"]
    profile: A[Float, "[row, roller], drop of the crown at both ends [m]"]
    pocket_place: A[Float, "[row, roller], of each pocket along the pitch circle [m]"]
    pocket_clearance: A[Float, "[row, roller], of each pocket along the pitch circle [m]"]
    row_clearance: A[Float, "[row], diametral clearance of the row [m]"]

    def by_name(self) -> dict[str, list[Any]]:
        """List every deviation, [m]."""
        return {field.name: getattr(self, field.name).tolist() for field in fields(self)}


@dataclass(frozen=True)
class Scatter:
    """Manufacturing scatter of one bearing of a lot.

    A grade gives every variation; a key next to it takes the place of one of them. A variation is largest
    less smallest of what sorting lets through: deviations are normal, four standard deviations wide, and cut
    there. Each quantity and row draws from the seed by itself, so that one more key changes no other number.
    The heights of the waves depend on `surface` and on no grade.
    """

    grade: A[str, At(one_of=tuple(GRADES)), "of every variation that has no key of its own"] = "none"
    seed: A[int, SEED, "which bearing of the lot"] = 1
    surface: A[
        str | None,
        At(one_of=tuple(FACTORS)),
        "heights of the waves of raceways and rollers: 0, 0.3, 1 or 3 times typical ones; "
        "typical with a grade, else none",
    ] = None
    roller_diameter: A[float | None, _variation(50.0), "variation over the rollers"] = None
    roller_length: A[float | None, _variation(200.0), "variation over the rollers, at the small end"] = None
    profile: A[float | None, _variation(50.0), "variation of the crown's drop at the ends"] = None
    pocket_place: A[float | None, _variation(500.0), "variation along the pitch circle"] = None
    pocket_clearance: A[float | None, _variation(500.0), "variation along the pitch circle"] = None
    row_clearance: A[
        float | None,
        _variation(100.0),
        "variation of the rows' diametral clearance; its mean is in the end play",
    ] = None
    raceway_waviness: A[
        float | None,
        _variation(20.0),
        "rms of cup and cone as made, orders 2 to 300, instead of that of the surface",
    ] = None
    roller_waviness: A[
        float | None,
        _variation(20.0),
        "rms of every roller as made, orders 2 to 60, instead of that of the surface",
    ] = None
    shortest_wave: A[float, At("mm", ge=0.1, le=10.0), "where the waves of all surfaces end"] = SHORTEST_WAVE

    def variation(self, name: str) -> float:
        """Take the variation of a quantity: its own key, or that of the grade, [m]."""
        own: float | None = getattr(self, name)
        return GRADES[self.grade][name] * _MICRON if own is None else own

    @property
    def absent(self) -> bool:
        """Tell whether nothing scatters."""
        waves = self.made_surface != "none", self.raceway_waviness, self.roller_waviness
        return not any((*waves, *(self.variation(name) for name in _OF_G1)))

    @property
    def made_surface(self) -> str:
        """Take the surface: its own key, or the typical one of any grade."""
        return self.surface or ("none" if self.grade == "none" else "typical")

    def surface_factor(self, on: str, bearing: RollerBearing) -> float:
        """Work out the heights of a surface over those of a typical one, [-]."""
        own = self.roller_waviness if on == "roller" else self.raceway_waviness
        return FACTORS[self.made_surface] if own is None else own / stated_rms(on, circumference(on, bearing))

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that pockets keep room for their rollers."""
        room = bearing.cage.circumferential_clearance
        taken = self.variation("pocket_clearance") + self.variation("pocket_place")
        if taken >= 2.0 * room:
            yield (
                f"pocket_place_um and pocket_clearance_um together are {taken / _MICRON:g}; they must be "
                f"below {2.0 * room / _MICRON:g}, twice the clearance of a pocket"
            )
        longer = self.variation("roller_length")
        if longer >= 2.0 * bearing.cage.axial_clearance:
            yield (
                f"roller_length_um is {longer / _MICRON:g}; it must be below "
                f"{2.0 * bearing.cage.axial_clearance / _MICRON:g}, twice the axial clearance of a pocket"
            )

    def _draw_deviations(self, name: str, row: int, count: int) -> Float:
        """Draw the deviations of a quantity in one row, shape [count], [m]."""
        draw = np.random.default_rng(np.random.SeedSequence([self.seed, zlib.crc32(name.encode()), row]))
        tries = draw.standard_normal((count, _TRIES))
        first = np.argmax(np.abs(tries) <= CUT, axis=1)
        return 0.5 / CUT * self.variation(name) * tries[np.arange(count), first]

    def deviations(self, bearing: RollerBearing) -> Deviations:
        """Draw what a bearing differs by from its drawing."""
        each = {
            field.name: np.stack(
                [self._draw_deviations(field.name, row, bearing.roller_count) for row in range(_ROWS)]
            )
            for field in fields(Deviations)
            if field.name != "row_clearance"
        }
        rows = np.concatenate([self._draw_deviations("row_clearance", row, 1) for row in range(_ROWS)])
        return Deviations(**each, row_clearance=rows)

    def waves(self, bearing: RollerBearing) -> tuple[Waviness, ...]:
        """Make the waves of all surfaces as they move a straight roller, with phases from the seed.

        One law gives the waves of every length. Without the short ones a bearing would be silent above a few
        kilohertz, and what little it has there, of rollers that enter the load zone, would stand out like a
        fault.
        """
        found = []
        for on in GROUND:
            factor = self.surface_factor(on, bearing)
            if factor:
                around = circumference(on, bearing)
                orders = range(FIRST_ORDER, max(FIRST_ORDER, int(around / self.shortest_wave)) + 1)
                order = np.array(orders, dtype=float)
                felt = share_felt(on, around / order, bearing.effective_length)
                heights = (factor * felt * order_amplitudes(on, around, order)).tolist()
                wave = Waviness(on, 0, tuple(orders), tuple(heights), None, self._wave_seed(on))
                found += [replace(wave, row=row) for row in range(_ROWS)]
        return tuple(found)

    def _wave_seed(self, on: str) -> int:
        """Make the seed of the phases of a surface, apart from those that a scene gives its own waves."""
        words = np.random.SeedSequence([self.seed, zlib.crc32(f"{on}_waviness".encode())])
        return int(words.generate_state(1)[0])

    def truth(self, bearing: RollerBearing) -> dict[str, Any]:
        """Write grade, seed, surface and all deviations, [m]."""
        own: dict[str, Any] = {name: self.variation(name) for name in _OF_G1}
        full = replace(self, surface=self.made_surface, **own)
        return {
            **write_noun(full),
            "surface_factor": {on: self.surface_factor(on, bearing) for on in GROUND},
            "deviations_m": self.deviations(bearing).by_name(),
        }
