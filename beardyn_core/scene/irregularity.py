"""Which irregularity a rail has: a spectrum by name, a measured profile, a short-wave floor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

from beardyn_core.edge import At, refuse

# one-sided spectra that have a name; those without an alignment are vertical only
SPECTRA = (
    "german_low",
    "german_high",
    *(f"fra_{number}" for number in range(1, 7)),
    "sncf_good",
    "sncf_bad",
    "china_ballastless",
)
VERTICAL_ONLY = ("sncf_good", "sncf_bad")
MEASURED = ("csv", "density_csv")
IRREGULARITY_KINDS = (*SPECTRA, *MEASURED, "none")
SHORT_WAVES = ("iso_3095",)
DIRECTIONS = ("vertical", "lateral")


@dataclass(frozen=True)
class Irregularity:
    """Irregularity of the rail, drawn from a power spectral density or measured."""

    kind: A[
        str, At(one_of=IRREGULARITY_KINDS), "a spectrum by name, or a file of a profile or of a density"
    ] = "german_low"
    shortest_wavelength: A[float, At("m", gt=0.0, ge=0.02, le=50.0), "of the band of the spectrum"] = 0.1
    longest_wavelength: A[float, At("m", gt=0.0, ge=1.0, le=1000.0), "of the band of the spectrum"] = 150.0
    short_waves: A[
        str | None,
        At(one_of=SHORT_WAVES),
        "rail roughness between 1 cm and 0.5 m, at least that of the limit for test tracks",
    ] = None
    path: A[
        Path | None,
        "of a kind from a file, relative to the scene file; columns distance_m, vertical_mm and "
        "perhaps lateral_mm, or wavelength_m, vertical_mm2_m and perhaps lateral_mm2_m",
    ] = None

    def __post_init__(self) -> None:
        refuse(self, "irregularity")

    def rules(self) -> Iterator[str]:
        """Check that the band is not empty, and that a file is set exactly when one is needed."""
        if self.shortest_wavelength >= self.longest_wavelength:
            yield (
                f"shortest_wavelength_m is {self.shortest_wavelength:g}; it must be less than "
                f"longest_wavelength_m, {self.longest_wavelength:g}"
            )
        if self.kind in MEASURED and self.path is None:
            yield f"path is missing; kind {self.kind!r} needs the path of a CSV file"
        if self.kind not in MEASURED and self.path is not None:
            yield f"path is {str(self.path)!r}; it goes with kind {' or '.join(map(repr, MEASURED))}"
