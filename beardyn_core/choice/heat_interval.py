"""Steady temperatures as an interval: what is assumed about grease, seals and air, varied over its range."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import Any

from beardyn_core.choice.steady_heat import SteadyHeat, steady_heat
from beardyn_core.effects import Thermal
from beardyn_core.scene.scene import Scene

# lowest and highest value of each assumed input: between them lie nine of ten axleboxes, by judgement
RANGES: dict[str, dict[str, tuple[str | float, str | float]]] = {
    "film": {"supply": ("channelled", "fresh")},
    "drag": {"fill": (0.005, 0.05)},
    "seal": {"torque": (0.05, 1.2)},
    "thermal": {
        "air_speed": (0.1, 0.6),
        "box_area": (0.4, 0.8),
        "axle_heat_transfer": (10.0, 60.0),
        "still_air": (6.0, 12.0),
    },
}


@dataclass(frozen=True)
class VariedInput:
    """An assumed input at both ends of its range, everything else as in the scene."""

    effect: A[str, "whose option it is"]
    option: A[str, "its name"]
    values: A[tuple[str | float, str | float], "low and high, SI"]
    found: A[tuple[SteadyHeat, SteadyHeat], "the steady state with either"]


@dataclass(frozen=True)
class HeatInterval:
    """Steady temperatures of a scene, with the interval that its assumed inputs leave."""

    usual: A[SteadyHeat, "as in the scene"]
    inputs: A[tuple[VariedInput, ...], "each varied by itself"]

    def rise(self, part: str) -> tuple[float, float, float]:
        """Compute how far a part of `NODES` is above the air: least, usual and most, [K].

        A 90 % interval where each range holds nine of ten axleboxes: the logarithms of the ratios add by
        their squares. Infinite where an input alone makes the bearing run away.
        """
        usual = self.usual.rise(part)
        if not self.usual.settles:
            return usual, math.inf, math.inf
        down = up = 0.0
        for varied in self.inputs:
            changes = [
                math.log(found.rise(part) / usual) if found.settles else math.inf for found in varied.found
            ]
            down += min(0.0, *changes) ** 2
            up += max(0.0, *changes) ** 2
        return usual * math.exp(-math.sqrt(down)), usual, usual * math.exp(math.sqrt(up))

    def warm_from(self, air: float) -> float:
        """Compute the temperature of the axlebox that no healthy one of ten exceeds in air of [K], [K].

        For `MonitorSettings.warm`.
        """
        return air + self.rise("axlebox")[2]


def heat_interval(scene: Scene) -> HeatInterval:
    """Find the steady temperatures of a scene, and the interval that grease, seals and air leave.

    Parameters
    ----------
    scene : Scene
        As of `steady_heat`. Only inputs of effects that it has, and of the surroundings, are varied.

    Returns
    -------
    HeatInterval
        Of 15 steady states where every effect is on.

    Raises
    ------
    ValidityError
        The load has no static equilibrium.

    Notes
    -----
    The ranges are judgements: channelled to fresh grease, seals of 0.05 to 1.2 N m, 10 to 60 % of the train's
    speed at the box. Dirt, faults and an end play that was mounted too small are none of them.
    """
    return HeatInterval(steady_heat(scene), tuple(_varied(scene)))


def _varied(scene: Scene) -> Iterator[VariedInput]:
    for effect, options in RANGES.items():
        given: Any = getattr(scene.effects, effect)
        if given is None and effect != "thermal":
            continue
        if getattr(given, "million_revolutions", None) is not None:  # the age of the grease is known
            continue
        for option, values in options.items():
            low, high = (_with_option(scene, effect, given or Thermal(), option, value) for value in values)
            yield VariedInput(effect, option, values, (low, high))


def _with_option(scene: Scene, effect: str, given: Any, option: str, value: str | float) -> SteadyHeat:
    varied: Any = {effect: replace(given, **{option: value})}
    return steady_heat(replace(scene, effects=replace(scene.effects, **varied)))
