"""Arguments of static answers: bearing, play, lubricant, load, speed, temperature, film, in SI."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable
from numbers import Real
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS

if TYPE_CHECKING:
    from beardyn_core.bearing.cylindrical import CylindricalBearing
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.effects import LineFilm

_KN, _MM, _RPM = 1e3, 1e3, math.pi / 30.0
LIMITS = {"temperature_C": (-60.0, 200.0, " degrees Celsius"), "contamination": (0.0, 1.0, "")}


def find_bearing(bearing: RollerBearing | str) -> RollerBearing:
    """Find a bearing of any kind by its name or file."""
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.config import load_any_bearing

    return bearing if isinstance(bearing, RollerBearing) else load_any_bearing(bearing)


def find_with_lines(bearing: RollerBearing | str, what: str) -> Bearing | CylindricalBearing:
    """Find a bearing with line contacts; refuse others for what is asked."""
    from beardyn_core.bearing.any_bearing import refuse_kind
    from beardyn_core.bearing.cylindrical import CylindricalBearing
    from beardyn_core.bearing.geometry import Bearing

    chosen = find_bearing(bearing)
    if not isinstance(chosen, Bearing | CylindricalBearing):
        refuse_kind(chosen.name, chosen.kind, what, kinds=(Bearing.kind, CylindricalBearing.kind))
    return chosen


def find_with_play(
    bearing: RollerBearing | str, end_play_mm: float | None, radial_clearance_mm: float | None
) -> tuple[RollerBearing, float | None]:
    """Find the bearing with the radial clearance, and the end play in metres, that are asked for."""
    from beardyn_core.bearing.any_bearing import change_play

    end_play = None if end_play_mm is None else end_play_mm / _MM
    clearance = None if radial_clearance_mm is None else radial_clearance_mm / _MM
    return change_play(find_bearing(bearing), end_play, clearance)


def find_lubricant(lubricant: Lubricant | str) -> Lubricant:
    """Find a lubricant by its name or file."""
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.config import load_lubricant

    return lubricant if isinstance(lubricant, Lubricant) else load_lubricant(lubricant)


def read_force(bearing: RollerBearing, load_kN: Any) -> tuple[float, float, float]:
    """Turn a load into newtons; refuse what no bearing can be meant to carry, warn of what is unusual."""
    from beardyn_core.bearing.life import load_doubts

    several = (0.0, 0.0, load_kN) if isinstance(load_kN, Real) else load_kN
    if not isinstance(several, Iterable) or isinstance(several, str):
        several = ()
    numbers = [float(each) * _KN for each in several if isinstance(each, Real)]
    if len(numbers) != 3:
        raise InputError(f"load_kN is {load_kN!r}; give one number, upwards, or three along x, y, z")
    problem, doubt = load_doubts(bearing, numbers)
    if problem:
        raise InputError(f"load_kN: {problem}")
    if doubt:
        warnings.warn(f"load_kN: {doubt}", stacklevel=4)
    return numbers[0], numbers[1], numbers[2]


def read_shaft_speed(speed_rpm: float) -> float:
    """Turn a shaft speed into [rad/s]; refuse what a scene refuses."""
    from beardyn_core.scene.operation import MOST_RPM

    if not isinstance(speed_rpm, Real) or not abs(speed_rpm) <= MOST_RPM:
        raise InputError(f"speed_rpm is {speed_rpm!r}; give a number from {-MOST_RPM:g} to {MOST_RPM:g}")
    return float(speed_rpm) * _RPM


def answer_each(name: str, values: Any, answer: Callable[[float], Any]) -> Any:
    """Answer for a number, or for each of a sequence; refuse what is no number."""
    import numpy as np

    several = list(values) if np.ndim(values) else [values]
    for value in several:
        if not isinstance(value, Real):
            raise InputError(f"{name} is {value!r}; give a number or a sequence of numbers")
    answers = [answer(float(value)) for value in several]
    return np.array(answers) if np.ndim(values) else answers[0]


def limit_problem(name: str, value: float, shown: str = "") -> str:
    """Say why an argument cannot have a value, empty where it can; it can be `shown` by another name."""
    least, most, unit = LIMITS[name]
    return (
        ""
        if least <= value <= most
        else f"{shown or name} is {value:g}; it must be from {least:g} to {most:g}{unit}"
    )


def read_temperature(temperature_C: float) -> float:
    """Turn a temperature into kelvins; refuse one beyond `LIMITS`."""
    if problem := limit_problem("temperature_C", temperature_C):
        raise InputError(problem)
    return temperature_C + ZERO_CELSIUS


def read_film(supply: str) -> LineFilm:
    """Give the film of a supply with grease; refuse one that is not known."""
    from beardyn_core.effects import LineFilm
    from beardyn_core.effects.grease import LAYERS

    if supply not in LAYERS:
        raise InputError(f"supply is {supply!r}; allowed are {', '.join(LAYERS)}")
    return LineFilm(supply=supply)
