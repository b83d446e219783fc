"""Rating life and share of life used under a load that is known, with intervals that carry every doubt.

What is not known of the service is assumed, named and varied: `LifeAssumptions` has it all.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite, log, nan, pi
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.life import LIFE_EXPONENT, reference_viscosity
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.known_load import NORMAL_90, KnownLoad
from beardyn_core.follow.life_assumptions import LifeAssumptions
from beardyn_core.follow.life_surface import LifeSurface, Lives

DRAWS, _SEED = 2000, 4
QUANTILES = (0.05, 0.5, 0.95)
_USUAL_END_PLAY, _END_PLAY_AROUND = 1.0e-4, 0.8e-4  # [m]
_CLEARANCE_AROUND = 0.4e-4  # of the radial clearance: half of a class of DIN 620, and the fits; assumed, [m]
_LATERAL_SHARE = 0.15  # half width of 90 % of the lateral load over the vertical one, where it is not known
_THROUGH = ("load", "lateral", "end_play", "temperature", "contamination", "viscosity", "swing")
_NAMES = {
    "load": "the known load",
    "lateral": "the lateral load",
    "end_play": "the play",
    "temperature": "the temperature",
    "contamination": "the contamination",
    "viscosity": "the age of the lubricant",
    "swing": "the swings of the load",
}


@dataclass(frozen=True)
class RatedLife:
    """Rating life under a known load; triples are 5, 50 and 95 of 100 draws."""

    load: KnownLoad
    lateral: A[tuple[float, float], "90 % interval of the lateral load, [N]"]
    lateral_is_estimated: bool
    speed: A[float, "of the shaft, [rad/s]"]
    temperature: A[tuple[float, float], "90 % interval of the lubricant, [K]"]
    temperature_is_stated: bool
    equivalent_load: A[tuple[float, float, float], "P of ISO 281, [N]"]
    basic: A[tuple[float, float, float], "L10 of ISO 281, [m]"]
    reference_basic: A[tuple[float, float, float], "L10r of ISO 16281, [m]"]
    reference_modified: A[tuple[float, float, float], "L10mr of ISO 16281, [m]"]
    parts: A[Mapping[str, float], "share of the variance of ln L10mr by what is not known, alone"]
    used: A[tuple[float, float, float], "share of L10mr that is used; NaN without mileage"]
    used_basic: A[tuple[float, float, float], "share of L10r that is used; NaN without mileage"]
    spans: A[tuple[tuple[float, float], ...], "mileage that each recording stands for, [m]"]
    assumptions: A[LifeAssumptions, "what no recording holds"] = field(default_factory=LifeAssumptions)

    @property
    def sentences(self) -> list[str]:
        """Write it in lines."""
        origin = "estimated" if self.lateral_is_estimated else "assumed"
        side = f"{self.lateral[0] / 1e3:.3g} to {self.lateral[1] / 1e3:.3g} kN ({origin})"
        most = max(self.parts, key=lambda name: self.parts[name])
        lines = [
            f"rating life at the known load of {self.load.value / 1e3:.3g} kN, lateral load {side}, which "
            "one in ten bearings does not reach:",
            "  with lubrication and contamination, L10mr of ISO 16281: "
            f"{_million_km(self.reference_modified)}",
            f"  basic, L10r of ISO 16281: {_million_km(self.reference_basic)}; L10 of ISO 281: "
            f"{_million_km(self.basic)}",
            f"most of this interval is from {_NAMES[most]} ({100 * self.parts[most]:.0f} %); "
            f"{self.assumptions.sentence(self.temperature_is_stated)}",
        ]
        if isfinite(self.used[1]):
            low, middle, high = (f"{100 * each:.3g}" for each in self.used)
            around = ", ".join(f"{begin / 1e3:,.0f} to {end / 1e3:,.0f} km" for begin, end in self.spans)
            stands = (
                f"the recording stands for {around}"
                if len(self.spans) == 1
                else f"the recordings stand for {around}"
            )
            lines.append(f"used of L10mr so far: {middle} %, 90 % interval {low} to {high} %; {stands}")
        return lines


def _million_km(life: tuple[float, float, float]) -> str:
    low, middle, high = (each / 1e9 for each in life)
    return f"{middle:.3g} million km, 90 % interval {low:.3g} to {high:.3g}"


@dataclass
class LifeCounter:
    """Adds up the life that recordings have used, after Palmgren and Miner.

    Every recording stands for the mileage from the middle of the way to the one before to the middle of the
    way to the next: the first one from mileage 0, the last one to the mileage reached. What is not known of
    the service is drawn once, the same for all recordings: errors that stay do not average out.
    """

    bearing: RollerBearing
    lubricant: Lubricant
    wheel_diameter: A[float, "[m]"]
    assumptions: LifeAssumptions = field(default_factory=LifeAssumptions)

    def __post_init__(self) -> None:
        random = np.random.default_rng(_SEED)
        self._normal = {name: random.normal(size=DRAWS) for name in (*_THROUGH, "between")}
        self._surface: LifeSurface | None = None
        self._begun: list[float] = []  # mileage at the begin of each recording, [m]
        self._reached: list[float] = []  # at its last stretch
        self._lives: list[tuple[Float, Float]] = []  # L10mr and L10r of each, shape [draw], [m]

    def begin(self, mileage: float) -> None:
        """Begin a recording at a mileage, [m]."""
        if len(self._lives) < len(self._begun):  # the one before has reported nothing
            self._begun.pop()
            self._reached.pop()
        self._begun.append(mileage)
        self._reached.append(mileage)

    def rate(
        self,
        load: KnownLoad,
        found: Estimates,
        mileage: float,
        temperature: tuple[float, float] | None = None,
    ) -> RatedLife | None:
        """Rate the life in the present recording, and add up what all have used.

        Parameters
        ----------
        load : KnownLoad
        found : Estimates
            Lateral load, end play and speed of the shaft.
        mileage : float
            Reached by now, [m].
        temperature : tuple of 2 floats, optional
            Measured, ends of 90 %, [K]; default assumed.

        Returns
        -------
        RatedLife or None
            None while the shaft stands.
        """
        speed = 2.0 * pi * found.shaft_frequency
        if not speed > 0.0:
            return None
        if not self._begun:
            self.begin(mileage)
        lateral, is_estimated = _lateral(found, load)
        play = _play(found, self.bearing)
        if self._surface is None or not self._surface.serves(load.value):
            self._surface = LifeSurface(self.bearing, load.value, usual_play(self.bearing), speed)
        warm = temperature or self.assumptions.temperature
        normal = self._normal
        whole = self._draw(load, lateral, play, warm, speed, normal)
        turn = pi * self.wheel_diameter
        lives = (whole.reference_modified * turn, whole.reference_basic * turn)
        self._reached[-1] = max(self._reached[-1], mileage)
        self._lives[len(self._begun) - 1 :] = [lives]
        used, used_basic, spans = self._used()
        return RatedLife(
            load, lateral, is_estimated, speed, warm, temperature is not None,
            quantiles(whole.equivalent_load), quantiles(whole.basic * turn), quantiles(lives[1]),
            quantiles(lives[0]), self._parts(load, lateral, play, warm, speed), used, used_basic, spans,
            self.assumptions,
        )  # fmt: skip

    def _draw(
        self,
        load: KnownLoad,
        lateral: tuple[float, float],
        play: tuple[float, float],
        warm: tuple[float, float],
        speed: float,
        normal: Mapping[str, Float],
    ) -> Lives:
        assert self._surface is not None
        known = self.assumptions
        vertical = load.value * np.exp(load.deviation * normal["load"])
        swing = np.clip(_between(known.swing, normal["swing"]), 0.0, None)
        # mean of F^(10/3) of a load that swings, to the second order, as a factor of F
        factor = (1.0 + 0.5 * LIFE_EXPONENT * (LIFE_EXPONENT - 1.0) * swing**2) ** (1.0 / LIFE_EXPONENT)
        ratio = np.array(
            [
                self.lubricant.kinematic_viscosity(float(each))
                for each in _between(warm, normal["temperature"])
            ]
        ) / reference_viscosity(self.bearing, speed)
        aged = np.exp(_between((log(known.viscosity[0]), log(known.viscosity[1])), normal["viscosity"]))
        assert self._surface is not None
        return self._surface.lives(
            vertical * factor,
            _between(lateral, normal["lateral"]) * factor,
            _between(play, normal["end_play"]),
            ratio * aged,
            np.clip(_between(known.contamination, normal["contamination"]), 0.05, 1.0),
        )

    def _parts(
        self,
        load: KnownLoad,
        lateral: tuple[float, float],
        play: tuple[float, float],
        warm: tuple[float, float],
        speed: float,
    ) -> dict[str, float]:
        """Compute the share of the variance of ln L10mr that each unknown has alone."""
        found = {}
        few = slice(0, 200)
        for name in _THROUGH:
            alone = {each: values[few] * float(each == name) for each, values in self._normal.items()}
            life = self._draw(load, lateral, play, warm, speed, alone).reference_modified
            found[name] = float(np.var(np.log(life)))
        whole = sum(found.values())
        return {name: part / whole if whole else 0.0 for name, part in found.items()}

    def _spans(self) -> tuple[tuple[float, float], ...]:
        begun, reached = self._begun, self._reached
        middles = [0.5 * (end + begin) for end, begin in zip(reached, begun[1:], strict=False)]
        return tuple(zip([0.0, *middles], [*middles, reached[-1]], strict=True))

    def _used(
        self,
    ) -> tuple[tuple[float, float, float], tuple[float, float, float], tuple[tuple[float, float], ...]]:
        """Add up the shares used: span over life, of all recordings, in every draw."""
        if not self._reached[-1] > 0.0:
            return (nan, nan, nan), (nan, nan, nan), ()
        spans = self._spans()
        # life falls by the power 10/3 of a load that differs from that in the recordings
        other = np.exp(
            LIFE_EXPONENT * log(1.0 + self.assumptions.between) / NORMAL_90 * self._normal["between"]
        )
        shares = [
            other
            * sum(
                ((end - begin) / lives[k] for (begin, end), lives in zip(spans, self._lives, strict=True)),
                np.zeros(DRAWS),
            )
            for k in (0, 1)
        ]
        return quantiles(shares[0]), quantiles(shares[1]), spans


def quantiles(values: Float) -> tuple[float, float, float]:
    """Give 5, 50 and 95 of 100."""
    low, middle, high = np.quantile(values, QUANTILES).tolist()
    return low, middle, high


def _between(ends: tuple[float, float], normal: Float) -> Float:
    """Turn standard normal draws into those of which 90 % lie between two ends."""
    low, high = ends
    return np.asarray(0.5 * (low + high) + 0.5 * (high - low) / NORMAL_90 * normal, np.float64)


def _estimate(found: Estimates, name: str) -> Estimate | None:
    return next((each for each in found.quantities if each.quantity.name == name), None)


def _lateral(found: Estimates, load: KnownLoad) -> tuple[tuple[float, float], bool]:
    """Give the 90 % interval of the lateral load, and whether it is estimated."""
    known = _estimate(found, "lateral_load")
    if known is not None and isfinite(known.value):
        return known.intervals[-1], True
    return (-_LATERAL_SHARE * load.value, _LATERAL_SHARE * load.value), False


def usual_play(bearing: RollerBearing) -> float:
    """Give the play that is assumed: end play, of cylinders and barrels the radial clearance drawn, [m]."""
    return bearing.radial_clearance if isinstance(bearing, RadialBearing) else _USUAL_END_PLAY


def _play(found: Estimates, bearing: RollerBearing) -> tuple[float, float]:
    known = _estimate(found, "end_play")
    if known is not None and isfinite(known.value):
        return known.intervals[-1]
    around = _CLEARANCE_AROUND if isinstance(bearing, RadialBearing) else _END_PLAY_AROUND
    return usual_play(bearing) - around, usual_play(bearing) + around
