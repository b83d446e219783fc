"""Which irregularity a rail has: a spectrum by name, a measured profile, a short-wave floor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from beardyn_core.scene.ranges import outside, refuse

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
    """Irregularity of the rail, drawn from a power spectral density or measured.

    Parameters
    ----------
    kind : str
        One of `IRREGULARITY_KINDS`: a spectrum by name, ``csv`` (a measured profile over the distance),
        ``density_csv`` (a table of a density over the wavelength) or ``none``.
    shortest_wavelength, longest_wavelength : float
        Band of the spectrum that is synthesised, [m]; a measured profile is taken as it is.
    short_waves : str or None
        ``iso_3095``: the density between 1 cm and 0.5 m is at least that of the rail roughness limit.
    path : Path or None
        Of the file of a measured kind.
    """

    kind: str = "german_low"
    shortest_wavelength: float = 0.1
    longest_wavelength: float = 150.0
    short_waves: str | None = None
    path: Path | None = None

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        if self.kind not in IRREGULARITY_KINDS:
            yield f"irregularity: kind is {self.kind!r}; allowed are {', '.join(IRREGULARITY_KINDS)}"
        if self.short_waves is not None and self.short_waves not in SHORT_WAVES:
            yield f"irregularity: short_waves is {self.short_waves!r}; allowed are {', '.join(SHORT_WAVES)}"
        if (self.path is not None) != (self.kind in MEASURED):
            yield (
                f"irregularity: path is {self.path}, kind is {self.kind!r}; a path is for "
                f"{' and '.join(MEASURED)}, which need one"
            )
        yield from outside("irregularity", "shortest_wavelength", self.shortest_wavelength, 0.02, 50.0, "m")
        yield from outside("irregularity", "longest_wavelength", self.longest_wavelength, 1.0, 1000.0, "m")
        if self.shortest_wavelength >= self.longest_wavelength:
            yield (
                f"irregularity: shortest_wavelength {self.shortest_wavelength:g} m must be less than "
                f"longest_wavelength {self.longest_wavelength:g} m"
            )

    @property
    def has_alignment(self) -> bool:
        """Whether its source has a lateral irregularity too; of a file only the file can tell."""
        return self.kind not in (*VERTICAL_ONLY, "none")
