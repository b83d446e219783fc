"""Published observations of spalled bearings, with their conditions, beside what the runs do."""

from __future__ import annotations

import numpy as np

from evidence.impact.cases import (
    BOTH,
    GROWING,
    OVER_SPEED,
    Case,
    across,
    healthy,
    over_area,
    over_range,
    over_width,
)
from evidence.impact.crossing import crossing
from evidence.impact.study import Measurement, loudness, received
from evidence.pages import render


def _span(values: list[float], form: str) -> str:
    return f"{min(values):{form}} to {max(values):{form}}"


def _power(values: list[float]) -> float:
    """Fit a power of the speed through values of `OVER_SPEED`."""
    return float(np.polyfit(np.log([case.speed for case in OVER_SPEED]), np.log(values), 1)[0])


def _over(name: str) -> list[float]:
    """List the rms of a line of `GROWING`."""
    return [loudness(over_range(case)).rms for case in GROWING[name]]


def _all(cases: list[Case]) -> list[Measurement]:
    return [received(case) for case in cases]


def published() -> str:
    """Write the section of published observations."""
    wide = [case for speed in BOTH for case in over_width(speed) if case.width >= 4e-3]
    whole = [case for speed in BOTH for case in across(speed)]
    areas = {speed: [received(case).rms for case in over_area(speed)] for speed in BOTH}
    parts = {
        part: [received(Case(speed=speed, on=part)).line for speed in BOTH] for part in ("cup", "roller")
    }
    lost = [1e3 * (case.width - crossing(case).spacing) for case in wide]
    bursts = {speed: [1e3 * crossing(case).burst for case in over_width(speed)] for speed in BOTH}
    levels = [received(case).rms for case in OVER_SPEED]
    spalled = _all(wide)
    speeds = [case.speed for case in over_range(Case())]
    freight, sound = received(Case(speed=90.0)), received(healthy(90.0))
    slow = [each.rms for each in spalled[:4]]
    values = {
        "lost": _span(lost, ".1f"),
        "pulses": _span([crossing(case).pulses for case in whole], ".1f"),
        "louder": _span([crossing(case).louder for case in whole], ".1f"),
        "ways_apart": max(abs(crossing(a).spacing - crossing(b).spacing) for a, b in _pairs()) * 1e3,
        "bursts_slow": _span(bursts[90.0], ".2f"),
        "bursts_fast": _span(bursts[200.0], ".2f"),
        "rms_within": max(slow) / min(slow) - 1.0,
        "speeds": _span(speeds, "g"),
        "one_length": _span(_over("25 mm long, 100 um"), ".0f"),
        "growing": _span(_over("twice as long, a tenth as deep"), ".0f"),
        "sound_rms": loudness(over_range(Case(0.0))).rms,
        "areas": "; ".join(
            f"{', '.join(f'{value:.0f}' for value in values)} m/s^2 at {speed:g} km/h"
            for speed, values in areas.items()
        ),
        "spalled_line": freight.line,
        "spalled_raw": freight.raw,
        "sound_raw": sound.raw,
        "kurtosis_slow": sound.kurtosis,
        "kurtosis_fast": received(healthy(200.0)).kurtosis,
        "kurtosis_spalled": _span([each.kurtosis for each in spalled], ".0f"),
        "kurtosis_by_width": " and ".join(
            f"{', '.join(f'{received(case).kurtosis:.0f}' for case in over_width(speed))} at {speed:g} km/h"
            for speed in BOTH
        ),
        "peak_power": _power([received(case).peak for case in OVER_SPEED]),
        "rms_power": _power(levels),
        "levels": ", ".join(f"{level:.1f}" for level in levels),
        "cup_slow": parts["cup"][0],
        "cup_fast": parts["cup"][1],
        "roller_slow": parts["roller"][0],
        "roller_fast": parts["roller"][1],
    }
    return render(__file__, values)


def _pairs() -> list[tuple[Case, Case]]:
    both = [[case for case in over_width(speed) if case.width >= 4e-3] for speed in BOTH]
    return list(zip(*both, strict=True))
