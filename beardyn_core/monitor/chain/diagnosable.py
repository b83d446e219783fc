"""No fault can show in a signal that is too slow, dead, too coarse or clipped: it is not healthy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch

NOT_DIAGNOSABLE = "not_diagnosable"
_RATE_TOLERANCE = 1e-3  # of a rate that is known from time stamps
_FEWEST_STEPS = 16  # between the ends of a signal
_MOST_CLIPPED = 0.01  # share of the samples at the ends of the range


def live_axes(stretch: Stretch) -> tuple[Stretch, str]:
    """Leave out the axes whose signal does not change, and name them by their number from 1 on."""
    live = np.ptp(stretch.acceleration, axis=0) > 0.0
    if live.all():
        return stretch, ""
    dead = ", ".join(str(axis + 1) for axis in np.flatnonzero(~live))
    return replace(stretch, acceleration=stretch.acceleration[:, live]), dead


def unmeasured(stretch: Stretch, settings: MonitorSettings) -> str:
    """Say why nothing can be found in a stretch, empty when something can."""
    least = 2.0 * (settings.lowest_band + settings.narrowest_band)
    if stretch.rate < least * (1.0 - _RATE_TOLERANCE):
        return (
            f"the sampling rate is {stretch.rate:.6g} Hz; at least {least:g} Hz are needed for a band "
            f"above {settings.lowest_band:g} Hz"
        )
    if not np.isfinite(stretch.acceleration).all():
        return "the vibration has values that are no numbers"
    if not (np.ptp(stretch.acceleration, axis=0) > 0.0).any():
        return "the accelerometer is dead: its signal does not change"
    return ""


def doubt(stretch: Stretch) -> str:
    """Say why a stretch that shows no fault may hide one, empty when there is no such reason.

    A signal of a few steps holds nothing of what is smaller than a step, and one that is clipped has lost its
    strikes; faults that show all the same are called.
    """
    for axis in stretch.acceleration.T:
        steps = np.unique(axis)
        if len(steps) < _FEWEST_STEPS:
            return f"the signal has {len(steps)} steps only: what is smaller than one is lost"
        ends = (axis == steps[0]).sum(), (axis == steps[-1]).sum()
        if sum(ends) > _MOST_CLIPPED * len(axis):
            share = sum(ends) / len(axis)
            return f"the signal is clipped: {share:.1%} of its samples lie at the ends of its range"
    return ""
