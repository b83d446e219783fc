"""How loud a spall is over its width, over speed and load: means over a range of speeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from beardyn_core.config import load_bearing
from evidence.impact.cases import BEARING, GROWING, LOADED, SPEED_RANGE, Case, over_range
from evidence.impact.edges import sound_depth
from evidence.impact.elastic import cup_radius
from evidence.impact.study import heard, loudness

HEAVIEST = 1e4  # load of the roller in the middle of the load zone under 80 kN, about [N]
CLEARLY = 1.05  # times the kurtosis of a sound bearing

LOUD = """
## Width, speed and load

At one speed the strokes of entry and exit add up or cancel in each mode of the box, as the way between them
takes half or whole periods; what is published are levels of a rig over its speeds. So each number here is
the geometric mean over {speeds} km/h. *Ring*: rms from 5 to 16 kHz. *Power*: of the
speed with which the peak grows. *Kurtosis*: over that of a sound bearing at one speed, least of the five.

| spall | width mm | kN | peak | rms | ring | power | kurtosis |
|---|--:|--:|--:|--:|--:|--:|--:|
{rows}

- **A spall that grows in both directions gets louder all the way**, in rms {natural:.1f} times from
  {natural_first} to {natural_last} mm. At each speed it is more impulsive than a sound bearing from
  {impulsive} mm on. Its depth, a tenth of the width and at most 400 um, is assumed.
- **Over the whole contact** a roller has given up all its load {bridged:.1f} mm inside of the edge (80 kN).
  Up to twice that width it gives up ever more. Beyond, it flies, and meets the far edge where that is
  steeper: from 1 to 6 mm rms grows {deep:.1f} times, the ring {deep_ring:.1f} times. From 3 to 4 mm rms
  stands still ({still}), for which no cause was looked for. On a floor of 100 um growth ends
  ({floor} at 4, 6 and 10 mm).
- **Of one length, 25 mm**, rms is {half} at {halves} mm: it does not grow,
  see below.
- **Load**: rms grows with the power {by_load} of it over the whole contact and over 25 mm, 40 to
  120 kN. **Speed**: peaks grow with the power {by_speed} of it.
"""


def loud_row(name: str, cases: tuple[Case, ...], sound: tuple[Case, ...]) -> str:
    """Write the levels of a case over `SPEED_RANGE`."""
    found = loudness(cases)
    ratio = min(heard(one).kurtosis / heard(other).kurtosis for one, other in zip(cases, sound, strict=True))
    return (
        f"| {name} | {1e3 * cases[0].width:g} | {1e-3 * cases[0].load:g} | {found.peak:.0f} | "
        f"{found.rms:.1f} | {found.ringing:.1f} | {found.with_speed:.2f} | {ratio:.1f} |"
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
            heard(one).kurtosis > CLEARLY * heard(other).kurtosis
            for one, other in zip(over_range(case), sound, strict=True)
        )
    ]
    halves = [1e3 * case.width for case in GROWING["25 mm long, 100 um"]]
    depth = 2.0 * float(sound_depth(load_bearing(BEARING), HEAVIEST))
    bridged = 1e3 * float(np.sqrt(2.0 * cup_radius(load_bearing(BEARING)) * depth))
    return LOUD.format(
        speeds=listed(SPEED_RANGE, "g"),
        rows="\n".join(rows),
        natural_first=f"{widths[0]:g}",
        natural_last=f"{widths[-1]:g}",
        natural=natural[-1].rms / natural[0].rms,
        impulsive=f"{min(impulsive):g}",
        bridged=bridged,
        deep=deep[-1].rms / deep[0].rms,
        deep_ring=deep[-1].ringing / deep[0].ringing,
        still=listed([each.rms for each in deep[2:4]], ".0f"),
        floor=listed([each.rms for each in floor], ".0f"),
        half=listed([each.rms for each in half], ".0f"),
        halves=listed(halves, "g"),
        by_load=listed([_with_load(line) for line in LOADED.values()], ".2f"),
        by_speed=f"{min(_powers()):.1f} to {max(_powers()):.1f}",
    )


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
