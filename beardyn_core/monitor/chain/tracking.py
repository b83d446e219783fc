"""Order tracking: power over equal steps of the shaft angle, less what the wheel does."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.wheel import struck_sectors, without_wheel
from beardyn_core.monitor.features import resample_by_angle

_FLOOR = 0.1  # of the mean power, below which silence is as quiet as any other


def by_angle(power: Float, stretch: Stretch, settings: MonitorSettings) -> Float:
    """Resample power over equal steps of the shaft angle, whole revolutions, less the wheel's own part.

    Parameters
    ----------
    power : float64 array, shape [sample]
        Squared envelope.

    Returns
    -------
    float64 array, shape [step]
    """
    steps = _revolutions(power, stretch, settings)
    return without_wheel(steps, struck_sectors(stretch, settings)).reshape(-1)


def logarithm_by_angle(power: Float, stretch: Stretch, settings: MonitorSettings) -> Float:
    """Resample power as `by_angle` does, and take its logarithm.

    A squared envelope is ruled by its few loudest moments: knocks of track and wheel make lines by chance
    that are as strong as those of a fault. In the logarithm each strike counts once, loud or not.

    References
    ----------
    Borghesani, Shahriar (2017), Cyclostationary analysis with logarithmic variance stabilisation, Mech. Syst.
    Signal Process. 95.
    """
    steps = _revolutions(power, stretch, settings)
    mean = steps.mean()
    loud = np.log(steps / mean + _FLOOR) if mean > 0.0 else steps
    return without_wheel(steps, struck_sectors(stretch, settings), loud).reshape(-1)


def _revolutions(power: Float, stretch: Stretch, settings: MonitorSettings) -> Float:
    """Resample power over the angle, shape [revolution, step]."""
    count = settings.samples_per_revolution
    steps = resample_by_angle(power, stretch.shaft_angle, count)
    whole = len(steps) // count
    return steps[: whole * count].reshape(whole, count)
