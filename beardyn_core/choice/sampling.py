"""Sampling rate of a run of which no more is asked than some third octaves of its vibration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.choice.reference_solution import third_octave_end
from beardyn_core.scene.scene import Free, Scene
from beardyn_core.scene.sensor import PASSBAND, RATES, SLOW_RATES


@dataclass(frozen=True)
class RateChoice:
    """Rate of all sensors and of the force waveform, and why."""

    rate: A[float, "[Hz]"]
    reason: str


def rate_for(scene: Scene, free: Free) -> RateChoice | None:
    """Find the slowest rate that holds the third octaves which a scene asks for; `None` to leave the sensors.

    They keep their rates where one is written down, where ``vibration_to_Hz`` is not, and where no vibration
    is asked for: a monitor, and whoever looks at the waveforms, takes what they measure.
    """
    asked = scene.vibration_to
    if not (free.rates and free.anything) or asked is None or "vibration" not in scene.quantities:
        return None
    end = third_octave_end(asked)
    offered = (*SLOW_RATES, RATES[0])
    rate = next((each for each in offered if PASSBAND * each >= end), RATES[0])
    reason = (
        f"the third octave at {_kilohertz(asked)} ends at {_kilohertz(end)}, and {_kilohertz(rate)} measures "
        f"to {_kilohertz(PASSBAND * rate)}"
    )
    if rate > SLOW_RATES[0]:
        slower = offered[offered.index(rate) - 1]
        reason += f", {_kilohertz(slower)} to {_kilohertz(PASSBAND * slower)} only"
    return RateChoice(rate, reason)


def _kilohertz(frequency: float) -> str:
    return f"{1e-3 * frequency:.4g} kHz"
