"""Discrete wheel-rail excitation: flats and waves of the wheel; joints, welds, crossings, corrugation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import not_finite, outside

FLAT_SHAPES = ("fresh", "rounded")

# a length and a depth are measured apart; they may disagree by this share
_TOLERANCE = 0.05


@dataclass(frozen=True)
class WheelFlat:
    """A spot of the running surface ground flat by a sliding wheel.

    Parameters
    ----------
    length : float
        Along the circumference; of a rounded flat with its rounded ends, [m].
    depth : float or None
        In the middle, [m]; ``None``: as the length and the wheel have it, see `usual_depth`.
    shape : str
        ``fresh``: a chord with sharp ends; ``rounded``: its ends are rolled round, a haversine.
    azimuth : float
        Middle of the flat, from +z (the top) towards +x (forward) at the start of the run, [rad]. At
        pi it is on the rail.

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

    length: float
    depth: float | None = None
    shape: str = "fresh"
    azimuth: float = 0.0

    def usual_depth(self, wheel_radius: float) -> float:
        """Depth that belongs to the length, [m].

        Parameters
        ----------
        wheel_radius : float
            [m].
        """
        return self.length**2 / ((8.0 if self.shape == "fresh" else 16.0) * wheel_radius)

    def depth_on(self, wheel_radius: float) -> float:
        """Depth as given, or as the length has it, [m]."""
        return self.usual_depth(wheel_radius) if self.depth is None else self.depth

    def contradiction(self, wheel_radius: float) -> str | None:
        """What is wrong between length, depth and wheel; ``None`` when they agree.

        The depth of a fresh flat is that of its chord. Rolling round makes a flat longer, not deeper:
        at a given length no flat is deeper than the fresh one.
        """
        if self.depth is None:
            return None
        chord = self.length**2 / (8.0 * wheel_radius)
        flat = f"a flat of {1e3 * self.length:g} mm on a wheel of {2e3 * wheel_radius:g} mm"
        if self.shape == "fresh" and abs(self.depth - chord) > _TOLERANCE * chord:
            return f"{flat} is {1e3 * chord:.3g} mm deep while fresh: leave the depth out or correct one"
        if self.depth > (1.0 + _TOLERANCE) * chord:
            return (
                f"{flat} can be at most {1e3 * chord:.3g} mm deep, its depth while fresh (usual once "
                f"rounded: {1e3 * self.usual_depth(wheel_radius):.3g} mm)"
            )
        return None

    def problems(self, wheel_radius: float) -> Iterator[str]:
        """What is wrong with it on a wheel of this radius [m]."""
        yield from outside("flat", "length", self.length, 1e-3, 0.15, "m")
        yield from not_finite("flat", "azimuth", (self.azimuth,))
        if self.shape not in FLAT_SHAPES:
            yield f"flat: shape is {self.shape!r}; allowed are {', '.join(FLAT_SHAPES)}"
        if self.depth is not None and not 0.0 <= self.depth < math.inf:
            yield f"flat: depth is {self.depth:g} m; it must be a finite number, not negative"
        elif problem := self.contradiction(wheel_radius):
            assert self.depth is not None
            yield f"flat: depth is {1e3 * self.depth:g} mm; {problem}"


@dataclass(frozen=True)
class WheelPolygon:
    """A wheel that is out of round with a number of waves around its circumference.

    Parameters
    ----------
    order : int
        Waves per circumference; 1 is eccentricity.
    amplitude : float
        Of the radius about its mean, half of what a gauge reads from valley to crest, [m].
    azimuth : float
        Of a crest, from +z towards +x at the start of the run, [rad].
    """

    order: int
    amplitude: float
    azimuth: float = 0.0

    def contradiction(self, wheel_radius: float) -> str | None:
        """What is wrong between order and wheel: a wave must be longer than the contact patch."""
        highest = math.floor(2.0 * math.pi * wheel_radius / 0.02)
        if self.order <= highest:
            return None
        return f"at most {highest} waves of 20 mm fit on a wheel of {2e3 * wheel_radius:g} mm"

    def problems(self, wheel_radius: float) -> Iterator[str]:
        """What is wrong with it on a wheel of this radius [m]."""
        yield from outside("polygon", "order", self.order, 1, 100, "waves")
        yield from outside("polygon", "amplitude", self.amplitude, 0.0, 2e-3, "m")
        yield from not_finite("polygon", "azimuth", (self.azimuth,))
        if problem := self.contradiction(wheel_radius):
            yield f"polygon: order is {self.order}; {problem}"


@dataclass(frozen=True)
class WheelOutOfRound:
    """A wheel with a whole spectrum of waves, as a roundness measurement gives it.

    Parameters
    ----------
    amplitudes : tuple of float
        Of the orders 1, 2, 3 ..., about the mean radius, [m].
    seed : int
        Of the azimuths, which such a spectrum does not tell.

    References
    ----------
    Nielsen, Johansson (2000), Out-of-round railway wheels, a literature survey, Proc. IMechE F 214.
    """

    amplitudes: tuple[float, ...]
    seed: int = 1

    def contradiction(self, wheel_radius: float) -> str | None:
        """What is wrong between the highest order and the wheel."""
        return WheelPolygon(len(self.amplitudes), 0.0).contradiction(wheel_radius)

    def problems(self, wheel_radius: float) -> Iterator[str]:
        """What is wrong with it on a wheel of this radius [m]."""
        if not 1 <= len(self.amplitudes) <= 100:
            yield f"out of round: {len(self.amplitudes)} amplitudes; allowed are 1 to 100, one an order"
        for order, amplitude in enumerate(self.amplitudes, start=1):
            yield from outside("out of round", f"amplitude of order {order}", amplitude, 0.0, 2e-3, "m")
        if problem := self.contradiction(wheel_radius):
            yield f"out of round: {len(self.amplitudes)} orders; {problem}"


@dataclass(frozen=True)
class DippedJoint:
    """A joint or weld whose two rail ends hang down and meet in a kink.

    Parameters
    ----------
    position : float
        Of the kink, from the start of the run, [m].
    angle : float
        Between the two rail ends, twice the slope of each, [rad].
    length : float
        Of the dip, both sides together, [m].
    spacing : float or None
        To the next such joint, and so on; ``None``: there is only this one, [m].

    References
    ----------
    Jenkins, Stephenson, Clayton, Morland, Lyon (1974), The effect of track and vehicle parameters on
    wheel/rail vertical dynamic forces, Railway Engineering Journal 3: each side a parabola.
    """

    position: float
    angle: float
    length: float = 1.0
    spacing: float | None = None

    @property
    def depth(self) -> float:
        """Of the kink below the sound rail, [m]."""
        return 0.125 * self.angle * self.length

    def problems(self) -> Iterator[str]:
        """What is wrong with it."""
        yield from outside("dipped joint", "position", self.position, 0.0, 1e6, "m")
        yield from outside("dipped joint", "angle", self.angle, 0.0, 0.05, "rad")
        yield from outside("dipped joint", "length", self.length, 0.05, 5.0, "m")
        if self.spacing is not None and not self.length <= self.spacing < math.inf:
            yield (
                f"dipped joint: spacing is {self.spacing:g} m; it must be at least the length of the dip, "
                f"{self.length:g} m"
            )


@dataclass(frozen=True)
class Corrugation:
    """Waves of one length on a stretch of rail.

    Parameters
    ----------
    wavelength : float
        [m].
    amplitude : float
        About the mean, half of what a gauge reads from valley to crest, [m].
    begin, end : float
        Of the stretch, from the start of the run, [m]; it grows and fades within two waves.
    """

    wavelength: float
    amplitude: float
    begin: float = 0.0
    end: float = math.inf

    def problems(self) -> Iterator[str]:
        """What is wrong with it."""
        yield from outside("corrugation", "wavelength", self.wavelength, 0.02, 2.0, "m")
        yield from outside("corrugation", "amplitude", self.amplitude, 0.0, 2e-3, "m")
        yield from outside("corrugation", "begin", self.begin, 0.0, 1e6, "m")
        if not self.end >= self.begin + 4.0 * self.wavelength:
            yield (
                f"corrugation: end is {self.end:g} m; it must be at least four waves behind begin, "
                f"{self.begin:g} m"
            )


@dataclass(frozen=True)
class DippedWeld:
    """A weld that has sunk: a long smooth hollow, and perhaps a short one in its middle.

    Parameters
    ----------
    position : float
        Of its middle, from the start of the run, [m].
    depth, length : float
        Of the long hollow, [m].
    short_depth, short_length : float
        Of the short hollow in the softened zone, which adds to it, [m].
    spacing : float or None
        To the next such weld, and so on; ``None``: there is only this one, [m].

    References
    ----------
    Zhai (2020), Vehicle-Track Coupled Dynamics, chapter 3: a cosine of about 1 m with one of about 0.1 m
    on it; Steenbergen, Esveld (2006), Rail weld geometry and assessment concepts, Proc. IMechE F 220.
    """

    position: float
    depth: float
    length: float = 1.0
    short_depth: float = 0.0
    short_length: float = 0.1
    spacing: float | None = None

    def problems(self) -> Iterator[str]:
        """What is wrong with it."""
        yield from outside("dipped weld", "position", self.position, 0.0, 1e6, "m")
        yield from outside("dipped weld", "depth", self.depth, 0.0, 5e-3, "m")
        yield from outside("dipped weld", "length", self.length, 0.2, 5.0, "m")
        yield from outside("dipped weld", "short_depth", self.short_depth, 0.0, 1e-3, "m")
        yield from outside("dipped weld", "short_length", self.short_length, 0.05, self.length, "m")
        if self.spacing is not None and not self.length <= self.spacing < math.inf:
            yield (
                f"dipped weld: spacing is {self.spacing:g} m; it must be at least the length of the dip, "
                f"{self.length:g} m"
            )


@dataclass(frozen=True)
class Crossing:
    """The fixed crossing of a turnout: the wheel sinks along the wing rail and is lifted by the nose.

    Parameters
    ----------
    position : float
        Where the nose takes the wheel over, from the start of the run, [m].
    depth : float
        Of the way of the wheel at that place, [m].
    wing_length, nose_length : float
        From where it begins to sink, and to where it is up again, [m]. Run over against the nose; with
        the two exchanged it is run over from the nose.

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

    position: float
    depth: float
    wing_length: float = 0.3
    nose_length: float = 0.2

    @property
    def angle(self) -> float:
        """Between falling and rising way of the wheel, [rad]."""
        return self.depth / self.wing_length + self.depth / self.nose_length

    def problems(self) -> Iterator[str]:
        """What is wrong with it."""
        yield from outside("crossing", "position", self.position, 0.0, 1e6, "m")
        yield from outside("crossing", "depth", self.depth, 0.0, 0.01, "m")
        yield from outside("crossing", "wing_length", self.wing_length, 0.05, 3.0, "m")
        yield from outside("crossing", "nose_length", self.nose_length, 0.05, 3.0, "m")
        if self.angle > 0.1:
            yield (
                f"crossing: the way of the wheel turns by {1e3 * self.angle:.3g} mrad; allowed are 100 mrad: "
                "make it shallower or longer"
            )


WheelDefect = WheelFlat | WheelPolygon | WheelOutOfRound
RailDefect = DippedJoint | DippedWeld | Crossing | Corrugation
