"""Manufacturing scatter: what one bearing of a lot differs by from its drawing, from a grade and a seed."""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import SEED, At, write_noun
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.scene.waviness import Waviness, band_amplitudes

_ROWS = 2
# A deviation is normal with a quarter of the lot's variation, cut at half of it: sorting takes the rest out.
CUT = 2.0
_TRIES = 24  # draws for each number; 0.0455^24 is no chance
# Orders whose rms is given, and the last one unless `shortest_wave` says which: contacts, 0.3 mm wide, pass
# on less of what is shorter than that, under 1 mm, and at 300 km/h it is beyond the band of the waveforms.
RACEWAY_ORDERS, ROLLER_ORDERS = (2, 300, 600), (2, 60, 120)
HALF_CONTACT = 1.5e-4  # [m]
_SHAPES = {"cup": RACEWAY_ORDERS, "cone": RACEWAY_ORDERS, "roller": ROLLER_ORDERS}
_MICRON = 1e-6

# Rollers of the lot Gn vary by n um in diameter, as in the grades of ISO 12297-1 (cylindrical rollers), ISO
# 3096 (needle rollers: of G2 SKF states 2 um of gauge and 1 um of circularity). The waviness of a roller is
# two fifths of that circularity, peak to valley being about four rms. All other numbers are assumed, in
# proportion.
_OF_G1 = {
    "roller_diameter": 1.0,
    "roller_length": 5.0,
    "profile": 1.0,
    "pocket_place": 30.0,
    "pocket_clearance": 30.0,
    "row_clearance": 5.0,
    "raceway_waviness": 0.15,
    "roller_waviness": 0.05,
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

    A grade gives every variation; a key beside it takes the place of one of them. A variation is largest less
    smallest of what sorting lets through: deviations are normal, four standard deviations wide, and cut
    there. Each quantity and row draws from the seed by itself, so that one more key changes no other number.
    """

    grade: A[str, At(one_of=tuple(GRADES)), "of every variation that has no key of its own"] = "none"
    seed: A[int, SEED, "which bearing of the lot"] = 1
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
        "rms of cup and cone, orders 2 to 300; amplitudes fall with 1/order, up to order 600",
    ] = None
    roller_waviness: A[
        float | None,
        _variation(20.0),
        "rms of every roller, orders 2 to 60; amplitudes fall with 1/order, up to order 120",
    ] = None
    shortest_wave: A[
        float | None,
        At("mm", ge=0.1, le=10.0),
        "where the waves of all surfaces end, as far as contacts 0.3 mm wide pass them on, "
        "instead of with orders 600 and 120",
    ] = None

    def variation(self, name: str) -> float:
        """Take the variation of a quantity (rms of a waviness): its own key, or that of the grade, [m]."""
        own: float | None = getattr(self, name)
        return GRADES[self.grade][name] * _MICRON if own is None else own

    @property
    def absent(self) -> bool:
        """Tell whether nothing scatters."""
        return not any(self.variation(name) for name in _OF_G1)

    def contradictions(self, bearing: Bearing) -> Iterator[str]:
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

    def deviations(self, bearing: Bearing) -> Deviations:
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

    def waves(self, bearing: Bearing) -> tuple[Waviness, ...]:
        """Make the waviness of all surfaces, with phases from the seed.

        Grinding leaves waves of every length, by one law from waviness to roughness; it is followed to waves
        about 1 mm long. Without the short ones a bearing would be silent above a few kilohertz, and what
        little it has there, of rollers that enter the load zone, would stand out like a fault.

        With `shortest_wave` they go on, and what a wave moves is weakened as the width of a contact weakens
        it, see `passed_on`. All waves are taken to be the same along the generator line, which for short ones
        is an upper bound: grinding leaves scratches that are narrower than a roller is long.

        References
        ----------
        Sayles, Thomas (1978), Surface topography as a nonstationary random process, Nature 271, 431: power
        falls with the square of the wavenumber, over eight decades of wavelength.
        """
        found = []
        for on, (first, last, bridged) in _SHAPES.items():
            rms = self.variation("roller_waviness" if on == "roller" else "raceway_waviness")
            if rms:
                longest = first * band_amplitudes(first, last, rms)[0]
                amplitudes = longest / np.arange(first, bridged + 1)
                if self.shortest_wave is not None:
                    around = _circumference(on, bearing)
                    order = np.arange(first, max(first, int(around / self.shortest_wave)) + 1)
                    amplitudes = longest / order * passed_on(around / order)
                orders = tuple(range(first, first + len(amplitudes)))
                heights = tuple(amplitudes.tolist())
                found += [Waviness(on, row, orders, heights, None, self._wave_seed(on)) for row in (0, 1)]
        return tuple(found)

    def _wave_seed(self, on: str) -> int:
        """Make the seed of the phases of a surface, apart from those that a scene gives its own waves."""
        words = np.random.SeedSequence([self.seed, zlib.crc32(f"{on}_waviness".encode())])
        return int(words.generate_state(1)[0])

    def truth(self, bearing: Bearing) -> dict[str, Any]:
        """Write grade, seed and all deviations, [m]."""
        own: dict[str, Any] = {name: self.variation(name) for name in _OF_G1}
        full = replace(self, **own)
        return {**write_noun(full), "deviations_m": self.deviations(bearing).by_name()}


def passed_on(wavelength: Float, half_contact: float = HALF_CONTACT) -> Float:
    """Compute which part of a wave's amplitude moves the bodies of a contact of finite width.

    Parameters
    ----------
    wavelength : array
        [m].
    half_contact : float
        Half width of the contact, [m].

    Returns
    -------
    array
        1 for long waves; for short ones the envelope of a Bessel function, `sqrt(2 / (pi k b))`.

    Notes
    -----
    Of an elastic contact that carries a given load, a small gap moves the bodies by its mean, weighted by the
    pressure under a flat rigid punch as wide as the contact (by reciprocity): for a wave that is `J0(k b)`.
    Its zeros are at other wavelengths under every roller, therefore the envelope.

    References
    ----------
    Johnson (1985), Contact mechanics, equation 2.64: the pressure under a flat rigid punch.
    """
    turns = 2.0 * np.pi * half_contact / wavelength
    return np.asarray((1.0 + (0.5 * np.pi * turns) ** 2) ** -0.25)


def _circumference(on: str, bearing: Bearing) -> float:
    diameter = {
        "cup": bearing.pitch_diameter + bearing.roller_diameter,
        "cone": bearing.pitch_diameter - bearing.roller_diameter,
        "roller": bearing.roller_diameter,
    }[on]
    return math.pi * diameter
