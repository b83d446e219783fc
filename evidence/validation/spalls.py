"""Impacts of spalls as a ringing axlebox receives them.

References and tolerances were chosen before the runs of `evidence.impact.cases`. Seen before that: about
thirty single crossings at 90 and 200 km/h, from which the way between the events was known to follow the
width, and the kurtosis of one healthy and one spalled run at 200 km/h. Ours of the measured levels
was known before their rows were written; what they allow is what was measured, from the least to the most.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from beardyn_core.scene.surface import SHORTEST_WAVE
from evidence.impact.cases import (
    BOTH,
    HALF,
    OVER_SPEED,
    TIMES,
    Case,
    across,
    healthy,
    over_area,
    over_load,
    over_width,
)
from evidence.impact.crossing import crossing
from evidence.impact.study import received, run
from evidence.measured.levels import INCH, ours_over_load, ratio
from evidence.validation.anchor import HOLDS_FROM, Anchor, Finding, Trend, rises

TOPIC, MEASURED_LEVELS = "impact", "measured level"
SAWALHI = (
    "Sawalhi and Randall 2011, Mech. Syst. Signal Process. 25, 846, from memory; Sawalhi and others 2017, "
    "Adv. Mech. Eng. 9(5), abstract: weak steps of the entry, prominent impulses at the trailing edge"
)
SINGH = (
    "Singh, Koepke, Howard, Petersen 2014, J. Sound Vib. 333, 5356, abstract: re-stressing near the end of a "
    "cup defect generates a burst of multiple short force impulses; explicit finite elements, ball bearing"
)
MBA = (
    "Al-Ghamd and Mba 2006, Mech. Syst. Signal Process. 20, 1537, acoustic emission of seeded defects of a "
    "roller bearing's outer race, the duration from memory"
)
DYER = "Dyer and Stewart 1978, J. Mech. Des. 100, 229, from memory: 3 for any healthy bearing"
CREST = (
    "Jain and Bhosle 2022, Int. J. Adv. Technol. Eng. Explor. 9(90): 4.22 to 5.59 of healthy ball bearings "
    "of a motor at four speeds, as quoted in github.com/bersamin12/nebulax (rail_phm.md)"
)
TARAWNEH = (
    "Tarawneh and others, University of Texas: rms against spall area of freight axlebox bearings on a rig, "
    "from memory; Rail. Eng. Sci. 2021, abstract: defects below 12.9 cm2 found by vibration thresholds"
)
TANDON = "Tandon and Choudhury 1999, Tribol. Int. 32, 469, review of measurements, from memory"
FEW_PULSES = (
    "the assumed damping of the contacts, 5 us: at 2.5 us, the lower end of its quoted range, every spall "
    "has more than two"
)
STILL = "as of noise alone: no background with knocks of its own lies under it"
PRONOSTIA = (
    "first records of six runs to failure of PRONOSTIA, vertical, 5 to 12 kHz, medians of 3.0 to 3.3 "
    "(docs/evidence/levels.md)"
)
UNCOVERED = (
    "waves shorter than 1 mm are left out here, and nothing covers the strikes of rollers at the ends of the "
    "load zone (docs/evidence/impact.md)"
)
CWRU = (
    "CWRU, 12 kHz, outer races of 6205 and 6203 over the healthy bearing at the same end, least to largest "
    "of all records of the size (docs/evidence/levels.md)"
)
OUR_WAVES = "the waves of our raceways, whose height is assumed: over smooth ones it is 3.4"
MFPT_LOADS = (
    "MFPT, fault of the outer and of the inner race, 0 to 300 lbf: 0.07 and 0.28 (docs/evidence/levels.md)"
)
DEEP_ONES = (
    "the depth, 400 um by assumption: on floors of 2.5 and 5 um, on which rollers rest, it is 0.04 and 0.31; "
    "the source states none"
)
# least and largest rms of a fault of so many thousandths of an inch, over that of a healthy bearing
FAULTS_OF_CWRU = {7: (1.3, 12.7), 14: (1.4, 12.7), 21: (1.8, 11.4)}
SATURATES = (
    "from about 2 mm on a roller carries nothing over the length of the spall, whose growth is the row "
    "above; and over 1 mm it takes the load up again as soon as it has given it up, one stroke of twice the "
    "change, which an elastic half-space has, too (docs/evidence/impact.md)"
)
SHORTEST = (
    "3 mm at 200 km/h alone, by 0.4 ms over 4 mm, for which no cause was looked for; without it bursts last "
    "longer from wider spalls at both speeds"
)
AS_SHARP = (
    "at 90 km/h the force changes 10 to 30 % faster at the entry, for which no cause was looked for; at "
    "200 km/h 1.4 to 1.8 times as fast at the exit"
)
WIDE = 4e-3  # from here on the two events of a crossing are apart [m]
IMPULSIVE = 3e-3  # from here on a spall must be more impulsive than a healthy bearing [m]


def way_per_width(speed: float) -> float:
    """Fit the way between entry and exit over the width of the spall, at a speed [km/h], [-]."""
    cases = [case for case in over_width(speed) if case.width >= WIDE]
    return float(np.polyfit([case.width for case in cases], [crossing(case).spacing for case in cases], 1)[0])


def sound_kurtosis(speed: float) -> float:
    """Return the kurtosis of a healthy bearing at a speed [km/h]."""
    return received(healthy(speed)).kurtosis


def sound_ringing(speed: float, shortest_wave: float = SHORTEST_WAVE) -> float:
    """Return the kurtosis of a healthy bearing from 5 to 16 kHz at a speed [km/h]."""
    return received(replace(healthy(speed), shortest_wave=shortest_wave)).ringing


def sound_crest(speed: float) -> float:
    """Return the crest factor of healthy bearings at a speed [km/h], median of nine of a lot.

    The largest value of one run is a matter of chance.
    """
    signals = [run(replace(healthy(speed), bearing=bearing)).signal for bearing in range(1, 10)]
    return float(np.median([np.abs(each).max() / np.sqrt(np.mean(each**2)) for each in signals]))


def shown(values: Sequence[float], form: str = ".3g") -> str:
    """Write some values as text."""
    return ", ".join(format(value, form) for value in values)


def at_both(sentence: str, found: Mapping[float, Sequence[float]], holds: bool) -> Finding:
    """Say what was found at both speeds."""
    parts = "; ".join(f"{shown(values)} at {speed:g} km/h" for speed, values in found.items())
    return Finding(holds, f"{sentence}: {parts}.")


def widths(cases: Sequence[Case]) -> str:
    """Write widths as text."""
    return shown([1e3 * case.width for case in cases], "g") + " mm"


def exit_is_louder() -> Finding:
    """Compare acceleration at exit and entry of spalls that unload the whole roller."""
    found = {speed: [crossing(case).louder for case in across(speed)] for speed in BOTH}
    holds = all(value > 1.0 + HOLDS_FROM for values in found.values() for value in values)
    return at_both(
        f"Largest acceleration at the exit over that at the entry, spalls of {widths(across(90.0))} over the "
        "whole contact",
        found,
        holds,
    )


def exit_is_a_burst() -> Finding:
    """Count pulses of the force at the exit of spalls that unload the whole roller."""
    found = {speed: [crossing(case).pulses for case in across(speed)] for speed in BOTH}
    holds = all(value >= 2.0 for values in found.values() for value in values)
    said = at_both(
        f"Pulses of the force at an exit, spalls of {widths(across(90.0))} over the whole contact",
        found,
        holds,
    )
    quick = {speed: [crossing(case).pulses for case in across(speed, TIMES[0])] for speed in BOTH}
    beside = at_both(f"With contacts damped for {1e6 * TIMES[0]:g} us", quick, holds)
    return Finding(holds, f"{said.sentence} {beside.sentence}")


def exit_is_sharper() -> Finding:
    """Compare how fast the force changes at exit and entry."""
    cases = {speed: [case for case in over_width(speed) if case.width >= WIDE] for speed in BOTH}
    found = {speed: [crossing(case).sharper for case in each] for speed, each in cases.items()}
    holds = all(value > 1.0 + HOLDS_FROM for values in found.values() for value in values)
    return at_both(
        f"Fastest change of the force at the exit over that at the entry, spalls of {widths(cases[90.0])}, "
        f"{1e3 * HALF:g} mm long",
        found,
        holds,
    )


def burst_grows() -> Finding:
    """Follow the duration of a burst over the width."""
    found = {speed: [1e3 * crossing(case).burst for case in over_width(speed)] for speed in BOTH}
    holds = all(rises(values) for values in found.values())
    return at_both(f"ms of the burst over {widths(over_width(90.0))}", found, holds)


def more_impulsive(part: str) -> Finding:
    """Compare the kurtosis of spalls and healthy bearings, of the whole signal or of its ringing band."""
    found, holds = {}, True
    for speed in BOTH:
        sound = getattr(received(healthy(speed)), part)
        cases = [case for case in over_width(speed) if case.width >= IMPULSIVE]
        values = [getattr(received(case), part) for case in cases]
        holds = holds and all(value > (1.0 + HOLDS_FROM) * sound for value in values)
        found[speed] = [sound, *values]
    return at_both(f"Kurtosis of a healthy bearing, then of spalls of {widths(cases)}", found, holds)


def grows(over: str, cases: Mapping[float, Sequence[Case]]) -> Finding:
    """Follow rms and peak over a line of cases; both must rise."""
    sentences, holds = [], True
    for speed, line in cases.items():
        rms, peak = ([getattr(received(case), what) for case in line] for what in ("rms", "peak"))
        holds = holds and rises(rms) and rises(peak)
        where = f" at {speed:g} km/h" if speed else ""
        sentences.append(f"rms {shown(rms)} and peak {shown(peak)} m/s^2{where}")
    return Finding(holds, f"Over {over}: {'; '.join(sentences)}.")


def width_counts() -> Finding:
    """Follow rms and peak over the width."""
    return grows(widths(over_width(90.0)), lines(over_width))


def lines(make: object) -> dict[float, Sequence[Case]]:
    """Make a line of cases at both speeds."""
    assert callable(make)
    return {speed: make(speed) for speed in BOTH}


ANCHORS = (
    *(
        Anchor(
            MEASURED_LEVELS,
            f"kurtosis of a healthy bearing from 5 kHz on, {speed:g} km/h{words}",
            3.1,
            "",
            PRONOSTIA,
            partial(sound_ringing, speed, wave),
            absolute=0.3,
            misses=UNCOVERED if wave > SHORTEST_WAVE else "",
            slow=True,
            measured=True,
        )
        for speed, wave, words in (
            (90.0, 1e-3, ", waves to 1 mm"),
            (90.0, SHORTEST_WAVE, ""),
            (300.0, SHORTEST_WAVE, ""),
        )
    ),
    *(
        Anchor(
            MEASURED_LEVELS,
            f"rms of a fault of {1e3 * size * INCH:.2f} mm in the outer race over that of a healthy bearing",
            0.5 * (least + most),
            "",
            CWRU,
            partial(ratio, size),
            absolute=0.5 * (most - least),
            misses=OUR_WAVES if size == 7 else "",
            slow=True,
            measured=True,
        )
        for size, (least, most) in FAULTS_OF_CWRU.items()
    ),
    Anchor(
        MEASURED_LEVELS,
        "power of the load with which the rms of a fault grows",
        0.175,
        "",
        MFPT_LOADS,
        ours_over_load,
        absolute=0.105,
        misses=DEEP_ONES,
        slow=True,
        measured=True,
    ),
    *(
        Anchor(
            TOPIC,
            f"slope of the way from entry to exit over the width of a cup spall, 4 to 15 mm, {speed:g} km/h",
            1.0,
            "",
            SAWALHI,
            partial(way_per_width, speed),
            tolerance=0.1,
            slow=True,
        )
        for speed in BOTH
    ),
    *(
        Anchor(
            TOPIC,
            f"kurtosis of a healthy bearing, {speed:g} km/h",
            3.0,
            "",
            DYER,
            partial(sound_kurtosis, speed),
            tolerance=0.1,
            slow=True,
            measured=True,
        )
        for speed in BOTH
    ),
    *(
        Anchor(
            TOPIC,
            f"crest factor of healthy bearings, {speed:g} km/h",
            4.9,
            "",
            CREST,
            partial(sound_crest, speed),
            absolute=0.7,
            misses=STILL if speed == min(BOTH) else "",
            slow=True,
            measured=True,
            by_chance=0.08,  # of a median of nine that scatter by 0.2
        )
        for speed in BOTH
    ),
)

TRENDS = (
    Trend(TOPIC, "the exit is louder than the entry", SINGH, exit_is_louder),
    Trend(TOPIC, "the exit is a burst of several pulses", SINGH, exit_is_a_burst, misses=FEW_PULSES),
    Trend(TOPIC, "the entry is a soft step, the exit sharper", SAWALHI, exit_is_sharper, misses=AS_SHARP),
    Trend(TOPIC, "bursts last longer from wider spalls", MBA, burst_grows, misses=SHORTEST),
    Trend(
        TOPIC, "a spall from 3 mm is more impulsive than a healthy bearing", DYER,
        partial(more_impulsive, "kurtosis"),
    ),
    Trend(TOPIC, "and so it is from 5 to 16 kHz", DYER, partial(more_impulsive, "ringing")),
    Trend(
        TOPIC, "vibration grows with the area of the spall", TARAWNEH,
        lambda: grows("30, 120 and 750 mm2", lines(over_area)),
    ),
    Trend(
        TOPIC, "vibration grows with the width of the spall", TANDON,
        width_counts, misses=SATURATES,
    ),
    Trend(
        TOPIC, "vibration of a spall grows with the speed", TANDON,
        lambda: grows("40, 90, 200 and 300 km/h", {0.0: OVER_SPEED}),
    ),
    Trend(
        TOPIC, "vibration of a spall grows with the load", TANDON,
        lambda: grows("40, 80 and 120 kN", lines(over_load)),
    ),
)  # fmt: skip
