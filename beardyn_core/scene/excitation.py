"""Excitation: irregularity; flats and waves of the wheel; joints, welds, crossings, corrugation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SEED, At, refuse

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
RAIL_LEVELS = ("good", "iso_3095", "average_network", "none")  # of roughness
DIRECTIONS = ("vertical", "lateral")
FLAT_SHAPES = ("fresh", "rounded")
AMPLITUDE = At("um", ge=0.0, le=2000.0)
POSITION = At("m", ge=0.0, le=1e6)

# a length and a depth are measured apart; they may disagree by this share
_TOLERANCE = 0.05


@dataclass(frozen=True)
class Irregularity:
    """Irregularity of the rail, drawn from a power spectral density or measured."""

    kind: A[
        str, At(one_of=IRREGULARITY_KINDS), "a spectrum by name, or a file of a profile or of a density"
    ] = "german_low"
    shortest_wavelength: A[
        float | None,
        At("m", gt=0.0, ge=0.004, le=50.0),
        "of the band; when left out 2 m with a spectrum by name, else the end of the file (from 4 mm)",
    ] = None
    longest_wavelength: A[
        float | None,
        At("m", gt=0.0, ge=1.0, le=1000.0),
        "of the band; when left out 150 m with a spectrum by name, else the end of the file",
    ] = None
    short_waves: A[
        str | None,
        At(one_of=RAIL_LEVELS),
        "level of the rail's roughness between 4 mm and 2 m; average_network with a spectrum, none with kind "
        "csv or none, that of the background where it has one, when left out",
    ] = None
    path: A[
        Path | None,
        "of a kind from a file, relative to the scene file; columns distance_m, vertical_mm and "
        "perhaps lateral_mm, or wavelength_m, vertical_mm2_m and perhaps lateral_mm2_m",
    ] = None

    @property
    def roughness(self) -> str:
        """Level of the rail's roughness, also where none is given."""
        if self.short_waves is not None:
            return self.short_waves
        return "none" if self.kind in ("csv", "none") else "average_network"

    @property
    def named_band(self) -> tuple[float, float]:
        """Shortest and longest wavelength of a spectrum by name, also where none is given, [m]."""
        shortest, longest = self.shortest_wavelength, self.longest_wavelength
        return 2.0 if shortest is None else shortest, 150.0 if longest is None else longest

    def __post_init__(self) -> None:
        refuse(self, "irregularity")

    def rules(self) -> Iterator[str]:
        """Check that the band is not empty, and that a file is set exactly when one is needed."""
        shortest, longest = self.shortest_wavelength, self.longest_wavelength
        if self.kind != "density_csv":
            shortest, longest = self.named_band
        if shortest is not None and longest is not None and shortest >= longest:
            yield (
                f"shortest_wavelength_m is {shortest:g}; it must be less than "
                f"longest_wavelength_m, {longest:g}"
            )
        if self.kind in MEASURED and self.path is None:
            yield f"path is missing; kind {self.kind!r} needs the path of a CSV file"
        if self.kind not in MEASURED and self.path is not None:
            yield f"path is {str(self.path)!r}; it goes with kind {' or '.join(map(repr, MEASURED))}"


@dataclass(frozen=True)
class WheelFlat:
    """A spot of the running surface ground flat by a sliding wheel.

    Notes
    -----
    Rolling on a rigid rail, the wheel turns about the sharp end of a fresh flat and then about the
    other: its centre sinks along x^2 / (2 R) and rises along the mirrored arc.

    References
    ----------
    Newton, Clark (1979), An investigation into the dynamic effects on the track of wheelflats on
    railway vehicles, J. Mech. Eng. Sci. 21; Wu, Thompson (2002), A hybrid model for the noise
    generation due to railway wheel flats, J. Sound Vib. 251: both shapes, depth L^2 / (8 R) of the
    fresh one. Zhai (2020), Vehicle-Track Coupled Dynamics: depth L^2 / (16 R) of the rounded one,
    as if a fresh flat of the same depth had become longer by the square root of 2.
    """

    kind: ClassVar[str] = "flat"

    length: A[
        float,
        At("mm", gt=0.0, ge=1.0, le=150.0),
        "along the circumference; of a rounded flat with its rounded ends",
    ]
    depth: A[
        float | None, At("mm", ge=0.0), "L^2 / (8 R) of a fresh, L^2 / (16 R) of a rounded flat when left out"
    ] = None
    shape: A[str, At(one_of=FLAT_SHAPES), "a chord with sharp ends, or rolled round (haversine)"] = "fresh"
    azimuth: A[
        float, At("deg"), "of its middle, from +z (the top) towards +x (forward) at the start of the run"
    ] = 0.0

    def usual_depth(self, wheel_radius: float) -> float:
        """Find the depth [m] that belongs to the length on a wheel of this radius [m]."""
        return self.length**2 / ((8.0 if self.shape == "fresh" else 16.0) * wheel_radius)

    def depth_on(self, wheel_radius: float) -> float:
        """Return the depth, derived from the length when none is set, [m]."""
        return self.usual_depth(wheel_radius) if self.depth is None else self.depth

    def contradictions(self, wheel_radius: float) -> Iterator[str]:
        """Check length and depth against a wheel of this radius [m].

        The depth of a fresh flat is that of its chord. Rolling round makes a flat longer, not deeper:
        at a given length no flat is deeper than the fresh one.
        """
        if self.depth is None:
            return
        chord = self.length**2 / (8.0 * wheel_radius)
        flat = (
            f"depth_mm is {1e3 * self.depth:g}; a flat of {1e3 * self.length:g} mm on a wheel of "
            f"{2e3 * wheel_radius:g} mm"
        )
        if self.shape == "fresh" and abs(self.depth - chord) > _TOLERANCE * chord:
            yield f"{flat} is {1e3 * chord:.3g} mm deep while fresh: leave the depth out or correct one"
        elif self.depth > (1.0 + _TOLERANCE) * chord:
            yield (
                f"{flat} can be at most {1e3 * chord:.3g} mm deep, its depth while fresh (usual once "
                f"rounded: {1e3 * self.usual_depth(wheel_radius):.3g} mm)"
            )


def _too_short(value: str, order: int, wheel_radius: float) -> Iterator[str]:
    """Report waves that are not longer than the contact patch."""
    highest = math.floor(2.0 * math.pi * wheel_radius / 0.02)
    if order > highest:
        yield f"{value}; at most {highest} waves of 20 mm fit on a wheel of {2e3 * wheel_radius:g} mm"


@dataclass(frozen=True)
class WheelPolygon:
    """A wheel that is out of round with a number of waves around its circumference."""

    kind: ClassVar[str] = "polygon"

    order: A[int, At(ge=1, le=100), "waves per circumference"]
    amplitude: A[float, AMPLITUDE, "about the mean radius, half of valley to crest"]
    azimuth: A[float, At("deg"), "of a crest, from +z towards +x at the start of the run"] = 0.0

    def contradictions(self, wheel_radius: float) -> Iterator[str]:
        """Check that the polygon is possible on a wheel of this radius [m]."""
        return _too_short(f"order is {self.order}", self.order, wheel_radius)


@dataclass(frozen=True)
class WheelOutOfRound:
    """A wheel with a whole spectrum of waves, as a roundness measurement gives it.

    References
    ----------
    Nielsen, Johansson (2000), Out-of-round railway wheels, a literature survey, Proc. IMechE F 214.
    """

    kind: ClassVar[str] = "out_of_round"

    amplitudes: A[
        tuple[float, ...], AMPLITUDE, At(size=(1, 100)), "of the orders 1, 2, 3 ..., about the mean radius"
    ]
    seed: A[int, SEED, "of the azimuths of the waves"] = 1

    def contradictions(self, wheel_radius: float) -> Iterator[str]:
        """Check that the waves are possible on a wheel of this radius [m]."""
        highest = len(self.amplitudes)
        return _too_short(f"amplitudes_um has {highest} orders", highest, wheel_radius)


@dataclass(frozen=True)
class DippedJoint:
    """A joint or weld whose two rail ends hang down and meet in a kink.

    References
    ----------
    Jenkins, Stephenson, Clayton, Morland, Lyon (1974), The effect of track and vehicle parameters on
    wheel/rail vertical dynamic forces, Railway Engineering Journal 3: each side a parabola.
    """

    kind: ClassVar[str] = "dipped_joint"

    position: A[float, POSITION, "of the kink, from the start of the run"]
    angle: A[float, At("mrad", ge=0.0, le=50.0), "between the two rail ends, twice the slope of each"]
    length: A[float, At("m", gt=0.0, ge=0.05, le=5.0), "of the dip, both sides together"] = 1.0
    spacing: A[float | None, At("m", gt=0.0), "to the next such joint; only one when left out"] = None

    @property
    def depth(self) -> float:
        """Depth of the kink below the intact rail, [m]."""
        return 0.125 * self.angle * self.length

    def rules(self) -> Iterator[str]:
        """Check that neighbouring joints do not overlap."""
        if self.spacing is not None and self.spacing < self.length:
            yield f"spacing_m is {self.spacing:g}; it must be at least length_m, {self.length:g}"


@dataclass(frozen=True)
class Corrugation:
    """Waves of one length on a stretch of rail."""

    kind: ClassVar[str] = "corrugation"

    wavelength: A[float, At("mm", gt=0.0, ge=20.0, le=2000.0), "of the waves along the rail"]
    amplitude: A[float, AMPLITUDE, "about the mean, half of valley to crest"]
    begin: A[float, POSITION, At(key="from"), "from the start of the run"] = 0.0
    end: A[float, At("m", gt=0.0, key="to", absent=True), "to the end of the run when left out"] = math.inf

    def rules(self) -> Iterator[str]:
        """Check that the stretch is long enough for its waves."""
        if self.end < self.begin + 4.0 * self.wavelength:
            yield (
                f"to_m is {self.end:g}; it must be at least four waves behind from_m, "
                f"{self.begin + 4.0 * self.wavelength:g}"
            )


@dataclass(frozen=True)
class DippedWeld:
    """A weld that has sunk: a long smooth hollow, and perhaps a short one in its middle.

    References
    ----------
    Zhai (2020), Vehicle-Track Coupled Dynamics, chapter 3: a cosine of about 1 m with one of about 0.1 m
    on it; Steenbergen, Esveld (2006), Rail weld geometry and assessment concepts, Proc. IMechE F 220.
    """

    kind: ClassVar[str] = "dipped_weld"

    position: A[float, POSITION, "of its middle, from the start of the run"]
    depth: A[float, At("mm", ge=0.0, le=5.0), "of the long hollow"]
    length: A[float, At("m", gt=0.0, ge=0.2, le=5.0), "of the long hollow"] = 1.0
    short_depth: A[float, At("mm", ge=0.0, le=1.0), "of the short hollow in its middle, which adds to it"] = (
        0.0
    )
    short_length: A[float, At("m", gt=0.0, ge=0.05, le=1.0), "of the short hollow"] = 0.1
    spacing: A[float | None, At("m", gt=0.0), "to the next such weld; only one when left out"] = None

    def rules(self) -> Iterator[str]:
        """Check that neighbouring welds do not overlap, and that the short hollow is the shorter one."""
        if self.spacing is not None and self.spacing < self.length:
            yield f"spacing_m is {self.spacing:g}; it must be at least length_m, {self.length:g}"
        if self.short_length > self.length:
            yield f"short_length_m is {self.short_length:g}; it must be at most length_m, {self.length:g}"


@dataclass(frozen=True)
class Crossing:
    """The fixed crossing of a turnout: the wheel sinks along the wing rail and is lifted by the nose.

    Notes
    -----
    The strike comes from the angle of the V, `angle`; the way across, and the change of the rail's
    stiffness at the casting, are neglected.

    References
    ----------
    Andersson, Dahlberg (1998), Wheel/rail impacts at a railway turnout crossing, Proc. IMechE F 212;
    Pletz, Daves, Ossberger (2012), A wheel set/crossing model regarding impact, sliding and deformation,
    Wear 294: V-shaped vertical way of the wheel, 1 to 4 mm deep.
    """

    kind: ClassVar[str] = "crossing"

    position: A[float, POSITION, "where the nose takes the wheel over, from the start of the run"]
    depth: A[float, At("mm", ge=0.0, le=10.0), "of the way of the wheel there"]
    wing_length: A[float, At("m", gt=0.0, ge=0.05, le=3.0), "from where the wheel begins to sink"] = 0.3
    nose_length: A[float, At("m", gt=0.0, ge=0.05, le=3.0), "to where the wheel is up again"] = 0.2

    @property
    def angle(self) -> float:
        """Angle between the falling and the rising path of the wheel, [rad]."""
        return self.depth / self.wing_length + self.depth / self.nose_length

    def rules(self) -> Iterator[str]:
        """Check that the crossing has a slope and is not a step."""
        if self.angle > 0.1:
            yield (
                f"depth_mm is {1e3 * self.depth:g}; with these lengths the way of the wheel turns by "
                f"{1e3 * self.angle:.3g} mrad, allowed are 100: make it shallower or longer"
            )


WheelDefect = WheelFlat | WheelPolygon | WheelOutOfRound
RailDefect = DippedJoint | DippedWeld | Crossing | Corrugation
