"""Strikes that a wrong speed puts on whole orders, where lines are taken for those of the wheel."""

from __future__ import annotations

from math import ceil, floor

import numpy as np

from beardyn_core.monitor.chain.explanations import explanations
from beardyn_core.monitor.chain.fault_lines import FAULTS, SHAFT_REACH, Pattern
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.verdict import UNEXPLAINED, Verdict

_APART = 3.0  # of the reach about a whole order, by which its lines move at another speed
_LARGEST = 0.5  # of the doubt about the speed, by which another one differs
_RPM = 60.0  # of a hertz


def other_speeds(
    stretch: Stretch, patterns: tuple[Pattern, ...], settings: MonitorSettings
) -> tuple[Stretch, ...]:
    """Turn the shaft of a stretch a little slower or faster, to where a fault on a whole order would be seen.

    Each is nearer to a speed within the doubt at which a part of the bearing has a whole order.
    """
    slowest, fastest = 1.0 - settings.speed_doubt, 1.0 + settings.speed_doubt
    towards, lowest = set(), np.inf
    for each in patterns:
        for whole in range(ceil(each.order * slowest), floor(each.order * fastest) + 1):
            towards.add(-1.0 if whole < each.order else 1.0)
            lowest = min(lowest, whole)
    change = min(_APART * SHAFT_REACH / (stretch.revolutions * lowest), _LARGEST * settings.speed_doubt)
    return tuple(stretch.at_speed(1.0 + side * change) for side in sorted(towards))


def fault_on_the_shaft(
    there: Verdict,
    other: Stretch,
    stretch: Stretch,
    patterns: tuple[Pattern, ...],
    settings: MonitorSettings,
) -> str:
    """Say which part shows at another speed and has a whole order at the stated one; empty where none does.

    Parameters
    ----------
    there : Verdict
        At another speed of the shaft.
    other, stretch : Stretch
        At that speed, and at the stated one.
    """
    if there.name not in (*FAULTS, UNEXPLAINED):
        return ""
    shown = there.comb or there.best
    order = shown.order * other.shaft_frequency / stretch.shaft_frequency
    if abs(order - round(order)) > SHAFT_REACH / stretch.revolutions:
        return ""
    fits = explanations(order, patterns, stretch.shaft_frequency, settings.speed_doubt, shown.pattern.fault)
    own = [each.sentence(stretch.shaft_frequency) for each in fits if not each.bearing]
    if not own:
        return ""
    return (
        f"a comb of order {order:.3f} ({order * stretch.shaft_frequency:.2f} Hz) strikes: at the stated "
        f"{_RPM * stretch.shaft_frequency:.5g} rpm it turns with the shaft and may be the wheel's, or it is "
        f"{' or '.join(own)}; give a tachometer, or the speed more exactly"
    )
