"""How loud a spall is over its width, over speed and load: means over a range of speeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from beardyn_core.config import load_bearing
from evidence.impact.cases import BEARING, GROWING, LOADED, SPEED_RANGE, Case, over_range
from evidence.impact.edges import sound_depth
from evidence.impact.elastic import cup_radius
from evidence.impact.study import loudness, received
from evidence.pages import render

HEAVIEST = 1e4  # load of the roller in the middle of the load zone under 80 kN, about [N]
CLEARLY = 1.05  # times the kurtosis of a healthy bearing


def loud_row(name: str, cases: tuple[Case, ...], sound: tuple[Case, ...]) -> tuple[str, ...]:
    """List the levels of a case over `SPEED_RANGE`."""
    found = loudness(cases)
    ratio = min(
        received(one).kurtosis / received(other).kurtosis for one, other in zip(cases, sound, strict=True)
    )
    return (
        name,
        f"{1e3 * cases[0].width:g}",
        f"{1e-3 * cases[0].load:g}",
        f"{found.peak:.0f}",
        f"{found.rms:.1f}",
        f"{found.ringing:.1f}",
        f"{found.with_speed:.2f}",
        f"{ratio:.1f}",
    )


def loud() -> str:
    """Write how levels grow with width, speed and load."""
    sound = over_range(Case(0.0))
    rows = [loud_row("none", sound, sound)]
    for name, line in (*GROWING.items(), *LOADED.items()):
        rows += [loud_row(name, over_range(case), sound) for case in line]
    deep, floor, natural, half = ([loudness(over_range(case)) for case in line] for line in GROWING.values())
    widths = [1e3 * case.width for case in GROWING["twice as long, a tenth as deep"]]
    impulsive = [
        width
        for width, case in zip(widths, GROWING["twice as long, a tenth as deep"], strict=True)
        if all(
            received(one).kurtosis > CLEARLY * received(other).kurtosis
            for one, other in zip(over_range(case), sound, strict=True)
        )
    ]
    halves = [1e3 * case.width for case in GROWING["25 mm long, 100 um"]]
    depth = 2.0 * float(sound_depth(load_bearing(BEARING), HEAVIEST))
    bridged = 1e3 * float(np.sqrt(2.0 * cup_radius(load_bearing(BEARING)) * depth))
    values = {
        "speeds": listed(SPEED_RANGE, "g"),
        "rows": rows,
        "natural_first": f"{widths[0]:g}",
        "natural_last": f"{widths[-1]:g}",
        "natural": natural[-1].rms / natural[0].rms,
        "impulsive": f"{min(impulsive):g}",
        "bridged": bridged,
        "deep": deep[-1].rms / deep[0].rms,
        "deep_ring": deep[-1].ringing / deep[0].ringing,
        "still": listed([each.rms for each in deep[2:4]], ".0f"),
        "floor": listed([each.rms for each in floor], ".0f"),
        "half": listed([each.rms for each in half], ".0f"),
        "halves": listed(halves, "g"),
        "by_load": listed([_with_load(line) for line in LOADED.values()], ".2f"),
        "by_speed": f"{min(_powers()):.1f} to {max(_powers()):.1f}",
    }
    return render(__file__, values)


def _with_load(line: tuple[Case, ...]) -> float:
    levels = [loudness(over_range(case)).rms for case in line]
    return float(np.polyfit(np.log([case.load for case in line]), np.log(levels), 1)[0])


def _powers() -> list[float]:
    kinds = [loudness(over_range(case)) for line in GROWING.values() for case in line]
    return [each.with_speed for each in kinds]


def listed(values: Sequence[float], form: str) -> str:
    """Write numbers one after the other, the last with an "and"."""
    texts = [format(value, form) for value in values]
    return f"{', '.join(texts[:-1])} and {texts[-1]}"
