"""A bearing of the catalogue: its data, boundary dimensions, maker and sources."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import Annotated as A

from beardyn_core.bearing.name_plate import NamePlate

KINDS = (
    "deep groove ball",
    "angular contact ball",
    "four-point contact ball",
    "self-aligning ball",
    "insert ball",
    "cylindrical roller",
    "spherical roller",
    "tapered roller",
    "tapered unit",
    "other",
)


@dataclass(frozen=True)
class CatalogueEntry:
    """A bearing of the catalogue."""

    plate: A[NamePlate, "its data; the name is the designation"]
    kind: A[str, "one of `KINDS`; a tapered unit has two rows and sits on an axle"]
    rows: A[int, "of rolling elements"]
    maker: A[str, "whose list or data sheet the numbers are from; empty where not stated"]
    source: A[str, "of inner dimensions or factors"]
    place: A[str, "where they are in that source"]
    bore: A[float, "NaN where not stated, [m]"] = nan
    outer_diameter: A[float, "NaN where not stated, [m]"] = nan
    width: A[float, "of the inner ring, NaN where not stated, [m]"] = nan
    size_source: A[str, "of the three"] = ""
    also_in: A[tuple[str, ...], "makers that list the same factors"] = ()
    about: A[str, "what else distinguishes it"] = ""

    @property
    def name(self) -> str:
        """Its designation."""
        return self.plate.name
