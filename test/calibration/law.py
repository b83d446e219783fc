"""A twin whose spectrum follows from the unknowns by a law that is written down here."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.calibration.fitting import Fitter
from beardyn_core.calibration.spectra import Reception, Ride
from beardyn_core.calibration.twin import Beside, Values
from beardyn_core.calibration.unknowns import BY_NAME

RECEPTION = Reception(("y", "z"), 25_600.0, 1.0)
MODES_HZ, DAMPING = (640.0, 1100.0, 2300.0), 0.03
BASES = {"frequency": 1.0, "damping": 1.0, "background": 1.0, "noise": 3e-4, "end_play": 0.1}
QUIET = 1e-4  # [m^2/s^4], of a band far from every mode


@dataclass
class Law(Beside):
    """Rings at three modes; the background is received below 500 Hz, end play above 3 kHz."""

    scatter: float = 0.5  # [dB], of a band from seed to seed
    silent: tuple[str, ...] = ()  # unknowns that nothing follows from
    alike: bool = False  # whether damping is received as the background is
    interrupted_after: int = 10**9
    most_damping: float = float("inf")  # beyond which twins end early
    _random: dict[int, Float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Need no scene."""

    def power(self, values: Values, seed: int) -> Float:
        """Follow the law."""
        self.runs += 1
        if self.runs > self.interrupted_after:
            raise KeyboardInterrupt
        if values.get("damping", 1.0) > self.most_damping:
            raise ValidityError("the twin ended early")
        received = {
            name: BASES[name] if name in self.silent else values.get(name, BASES[name]) for name in BASES
        }
        middles = np.array(self.reception.middles)
        power = np.full((2, len(middles)), QUIET)
        for k, mode in enumerate(MODES_HZ):
            at = middles / (mode * received["frequency"])
            damping = DAMPING * (1.0 if self.alike else received["damping"])
            power[k % 2] += 1.0 / ((1.0 - at**2) ** 2 + (2.0 * damping * at) ** 2) * 0.01
        power *= np.where(middles < 500.0, received["background"] ** 2, 1.0)
        if self.alike:
            power *= np.where(middles < 500.0, received["damping"] ** 2, 1.0)
        power *= 10.0 ** np.where(middles > 3000.0, 4.0 * (received["end_play"] - BASES["end_play"]), 0.0)
        if seed not in self._random:
            self._random[seed] = np.random.default_rng(seed).normal(0.0, self.scatter, power.shape)
        return (power * 10.0 ** (0.1 * self._random[seed]))[None]


def law(rides: tuple[Ride, ...] = (), **options: Any) -> Law:
    scene: Any = SimpleNamespace(sensors=[SimpleNamespace(noise_density=BASES["noise"])])
    return Law(scene, RECEPTION, 0, rides, **options)


def fitter(
    truth: dict[str, float], budget: int = 60, names: tuple[str, ...] = tuple(BASES), **options: Any
) -> Fitter:
    """Make the fit of an axlebox that follows the law at the truth, with a seed of its own."""
    whole = {**BASES, **truth}
    played = law(**{name: value for name, value in options.items() if name != "interrupted_after"})
    received = played.levels(played.power(whole, 99), whole["noise"])
    own = np.random.default_rng(5).normal(0.0, 0.3, (4, *received.shape[1:]))
    beside = law((Ride(20.0, received + own),), **options)
    unknowns = tuple(BY_NAME[name] for name in names)
    return Fitter(beside, unknowns, tuple(BASES[name] for name in names), budget)
