"""A bearing file that gives five numbers: all others are derived from them, each with its source."""

from __future__ import annotations

import math
from collections.abc import Mapping
from numbers import Real
from typing import Any

from pydantic import Field, StrictBool

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.config.file_model import SourcedModel, split_sources
from beardyn_core.config.keys import reads

_STEEL_DENSITY = 7830.0  # [kg/m^3]
# A file that lacks one of them is refused; the number here only stands in for it until then, so that the
# message names that key and not all that would follow from it.
_STAND_INS = {
    "pitch_diameter_mm": 180.0,
    "roller_diameter_mm": 24.0,
    "roller_length_mm": 45.0,
    "contact_angle_deg": 10.0,
}


@reads(Bearing)
class BearingFile(SourcedModel):
    """A tapered bearing, whose file may leave most numbers to be derived."""

    derive: StrictBool = Field(
        False,
        description="derive every number that is not given from roller_count, pitch_diameter_mm, "
        "roller_diameter_mm, roller_length_mm and contact_angle_deg; `sources` has the origin of each",
    )

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        given = super()._prepare(data)
        return with_derived_numbers(given) if given.get("derive") is True else given


def with_derived_numbers(given: Mapping[str, Any]) -> dict[str, Any]:
    """Add the keys that a bearing file lacks, and the source of each.

    Parameters
    ----------
    given : mapping
        Keys of the file in its units, without sources but for the key ``sources``.
    """
    needed = {key: _usable(given.get(key), stand_in) for key, stand_in in _STAND_INS.items()}
    derived, sources = split_sources(_derive_keys(**needed))
    found = {**derived, **given}
    parts = given.get("cage")
    if isinstance(parts, Mapping):
        found["cage"] = {**derived["cage"], **parts}
    known = given.get("sources", {})
    if isinstance(known, Mapping):
        added = {name: text for name, text in sources.items() if not _is_given(name, given)}
        found["sources"] = {**added, **known}
    return found


def _usable(value: Any, stand_in: float) -> float:
    """Take a number that can be computed with; what is none is refused as the file is read."""
    fits = isinstance(value, Real) and not isinstance(value, bool) and 0.0 < float(value) < math.inf
    return float(value) if fits else stand_in


def _is_given(name: str, given: Mapping[str, Any]) -> bool:
    """Tell whether the file gives the key with this name without its unit, such as ``cage.mass``."""
    owner, _, stem = name.rpartition(".")
    keys = given.get(owner, {}) if owner else given
    return isinstance(keys, Mapping) and any(key == stem or key.startswith(f"{stem}_") for key in keys)


def _derive_keys(
    *,
    pitch_diameter_mm: float,
    roller_diameter_mm: float,
    roller_length_mm: float,
    contact_angle_deg: float,
) -> dict[str, Any]:
    """Derive all other keys of a bearing file, each with its source.

    The proportions are those of the four shipped tapered bearings.
    """
    pitch, roller, length = pitch_diameter_mm, roller_diameter_mm, roller_length_mm
    row_spacing, outer, bore = length + 25.0, pitch + 1.7 * roller, pitch - 2.0 * roller
    width = row_spacing + length + 35.0
    raceway = pitch + roller * math.cos(math.radians(contact_angle_deg))
    cup = _ring(raceway, outer, width)
    cone = _ring(bore, pitch - roller, 2.0 * length + 20.0)
    cage_mass = 2.0e-3 * pitch
    turned = cage_mass * (0.5e-3 * pitch) ** 2
    assumed, derived = "assumed: as in the shipped bearings", "derived: proportions of the shipped bearings"
    steel = "derived: solid ring of steel"
    return {
        "name": "bearing",
        "description": f"derived from {pitch:g} mm pitch diameter, {roller:g} mm rollers",
        "effective_length_mm": _with_source(length - 2.0, "assumed: 1 mm at each end is no contact"),
        "row_spacing_mm": _with_source(row_spacing, derived),
        "sphere_ratio": _with_source(0.9, assumed),
        "rib_contact_height_mm": _with_source(2.5, assumed),
        "bore_mm": _with_source(round(bore, 3), derived),
        "outer_diameter_mm": _with_source(round(outer, 3), derived),
        "width_mm": _with_source(width, derived),
        "end_play_mm": _with_source(0.2, assumed),
        "raceway_roughness_um": _with_source(0.3, assumed),
        "rib_roughness_um": _with_source(0.42, assumed),
        "cup_mass_kg": _with_source(round(cup[0], 4), steel),
        "cup_inertia_kg_m2": _with_source([round(cup[2], 6), round(cup[1], 6), round(cup[2], 6)], steel),
        "cone_mass_kg": _with_source(round(cone[0], 4), steel),
        "cage": {
            "mass_kg": _with_source(round(cage_mass, 4), derived),
            "polar_inertia_kg_m2": _with_source(round(turned, 8), "derived: thin ring on the pitch circle"),
            "transverse_inertia_kg_m2": _with_source(round(0.52 * turned, 8), "derived: thin ring"),
            "circumferential_clearance_mm": _with_source(0.25, assumed),
            "axial_clearance_mm": _with_source(0.3, assumed),
            "stiffness_MN_per_m": _with_source(20.0, assumed),
            "damping_N_s_per_m": _with_source(300.0, assumed),
        },
    }


def _with_source(value: Any, source: str) -> dict[str, Any]:
    return {"value": value, "source": source}


def _ring(inner_mm: float, outer_mm: float, width_mm: float) -> tuple[float, float, float]:
    """Give mass [kg], polar and transverse inertia [kg m^2] of a solid steel ring."""
    inner, outer, width = 0.5e-3 * inner_mm, 0.5e-3 * outer_mm, 1e-3 * width_mm
    mass = math.pi * _STEEL_DENSITY * width * max(outer**2 - inner**2, 1e-6)
    polar = 0.5 * mass * (outer**2 + inner**2)
    return mass, polar, 0.5 * polar + mass * width**2 / 12.0
