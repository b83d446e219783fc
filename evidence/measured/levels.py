"""Levels of measured bearings, healthy and faulty, next to the twin's, as far as they compare.

``python -m evidence.measured.levels --cwru DIR --mfpt DIR --pronostia DIR`` writes docs/evidence/levels.md. A
motor is no axlebox: compared are ratios of faulty to healthy, powers of the load, kurtosis. Widths and
lengths of faults are those of CWRU over the size of the contact, shafts turn as fast.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated as A

import numpy as np
from scipy import stats

from beardyn_core.base.arrays import Float
from beardyn_core.config import load_bearing
from beardyn_core.scene.surface import SHORTEST_WAVE
from evidence.impact.cases import BEARING, DEEP, LOADS, WHEEL_RADIUS, WHOLE, Case
from evidence.impact.elastic import cup_radius
from evidence.impact.study import RATE, RINGING, passed, run
from evidence.measured.cases import (
    CWRU_12_DRIVE,
    CWRU_12_FAN,
    CWRU_SOUND,
    MFPT,
    Listening,
    listenings,
    records,
)
from evidence.pages import REPORTS

PAGE = REPORTS / "levels.md"
G = 9.80665
INCH = 25.4e-6  # a thousandth of it, [m]
LOW = (100.0, 5600.0)  # what records of 12 kHz hold, [Hz]
BALL_LOAD = (
    40.0  # of the heaviest ball of CWRU's 6205: half of a rotor of 16 kg, five times over nine balls [N]
)
CONFORMITY = 0.515  # of the groove over the ball, assumed
HEAVIEST = 1e4  # load of our heaviest roller under 80 kN, about [N]
SHALLOW = 5e-6  # a roller rests on such a floor, [m]
SHAFT = 29.2  # of CWRU, [Hz]
MFPT_SHAFT = 25.0
SHAFTS_OF_PRONOSTIA = {"1": 30.0, "2": 27.5, "3": 25.0}  # by the first number of a run
FIRST_RECORDS = slice(5, 45)  # of a run to failure, run in and still sound


@dataclass(frozen=True)
class Level:
    """What one record, or several, is like."""

    rms: A[float, "in `LOW`, [m/s^2]"]
    kurtosis: A[float, "of all of it"]
    ringing: A[float, "rms in `RINGING` as far as the rate goes, NaN without, [m/s^2]"]
    ringing_kurtosis: A[float, "there"]


def level(signal: Float, rate: float) -> Level:
    """Measure a signal [m/s^2] of a rate [Hz]."""
    high = min(RINGING[1], 0.47 * rate)
    rings = np.array([math.nan])
    if high > 2.0 * RINGING[0]:
        rings = passed(signal, (RINGING[0], high), rate)
    low = passed(signal - signal.mean(), LOW, rate)
    return Level(float(low.std()), kurtosis(signal), float(rings.std()), kurtosis(rings))


def kurtosis(signal: Float) -> float:
    """Compute the kurtosis, 3 for noise."""
    return float(stats.kurtosis(signal) + 3.0)


def contact_of_ball(load: float, ball: float, pitch: float) -> tuple[float, float]:
    """Compute width and length of a ball's contact with the outer race, [m].

    Parameters
    ----------
    load : float
        [N].
    ball, pitch : float
        Diameters, [m].

    References
    ----------
    Hamrock, Brewe (1983), Simplified solution for stresses and deformations, ASME J. Lubr. Technol. 105, 171.
    """
    along = 1.0 / (2.0 / ball - 2.0 / (pitch + ball))
    across = 1.0 / (2.0 / ball - 1.0 / (CONFORMITY * ball))
    ratio = across / along
    ellipse, second = ratio ** (2.0 / math.pi), 1.0 + (math.pi / 2.0 - 1.0) / ratio
    radius, modulus = 1.0 / (1.0 / along + 1.0 / across), 208e9 / (1.0 - 0.3**2)
    length = 2.0 * (6.0 * ellipse**2 * second * load * radius / (math.pi * modulus)) ** (1.0 / 3.0)
    return length / ellipse, length


def contact_of_roller(load: float) -> float:
    """Compute the width of the contact of our roller with the cup, [m]."""
    bearing = load_bearing(BEARING)
    modulus = 0.5 * bearing.material.contact_modulus
    return 2.0 * math.sqrt(4.0 * load / WHOLE * cup_radius(bearing) / (math.pi * modulus))


def alike(thousandths: int, load: float = 8e4, depth: float = DEEP, waves: bool = True) -> Case:
    """Make the case whose spall is as large beside its contact as a fault of CWRU of a diameter is."""
    width, length = contact_of_ball(BALL_LOAD, 7.94e-3, 39.04e-3)
    fault = thousandths * INCH
    return Case(
        width=fault / width * contact_of_roller(HEAVIEST),
        length=min(fault / length, 1.0) * WHOLE,
        depth=depth,
        speed=SHAFT * 2.0 * math.pi * WHEEL_RADIUS * 3.6,
        load=load,
        waves=waves,
    )


@cache
def ours(case: Case) -> Level:
    """Measure one of our runs."""
    made = run(case)
    assert made.status == "fine", made.status
    return level(made.signal, RATE)


def power_of_load(loads: Sequence[float], levels: Sequence[float]) -> float:
    """Fit the power of the load with which levels grow."""
    return float(np.polyfit(np.log(loads), np.log(levels), 1)[0])


def ours_over_load(depth: float = DEEP) -> float:
    """Fit the power of the load for a spall like CWRU's middle one of a depth [m], 40 to 120 kN."""
    return power_of_load(LOADS, [ours(alike(14, load, depth)).rms for load in LOADS])


def ratio(thousandths: int, waves: bool = True) -> float:
    """Compute rms with a spall like one of CWRU over that of a healthy one, races with waves or without."""
    return ours(alike(thousandths, waves=waves)).rms / ours(alike(0, waves=waves)).rms


def _load_of(record: Listening) -> float:
    from scipy.io import loadmat

    return float(loadmat(record.record.path, squeeze_me=True)["bearing"]["load"].item())


def first_records(folder: Path) -> Level:
    """Measure the first records of a run to failure of PRONOSTIA, medians."""
    files = sorted(folder.glob("acc_*.csv"))[FIRST_RECORDS]
    signals = [np.loadtxt(file, delimiter=",")[:, 4] * G for file in files]
    each = [level(signal, 25_600.0) for signal in signals]
    names = ("rms", "kurtosis", "ringing", "ringing_kurtosis")
    return Level(*(float(np.median([getattr(one, name) for one in each])) for name in names))


HEAD = """# Levels of measured bearings and of the twin

Written by `python -m evidence.measured.levels --cwru DIR --mfpt DIR --pronostia DIR` from public records that
are not part of this repository (CWRU, MFPT and PRONOSTIA). No public record of an axlebox bearing with a
spall of known size was found, and papers on them were at hand as abstracts. These are ball bearings of a
motor and of rigs: what can be compared are ratios, powers and kurtosis. Ours are of [impact.md](impact.md),
tier `full` in the box `high_speed`, 80 kN.

## Healthy bearings

Rms from 0.1 to 5.6 kHz; kurtosis of everything, then from 5 to 16 kHz or to 0.47 of the rate. *To 1 mm*:
the waves of raceways and rollers end there (`scatter: {{shortest_wave_mm: 1}}`); in shipped scenes they go on
to 0.2 mm.

| bearing | shaft Hz | rms | kurtosis | 5-16 kHz: rms | kurtosis |
|---|--:|--:|--:|--:|--:|
"""
FAULTS = """
**Measured healthy bearings are Gaussian from 5 kHz on; ours of tier `full` are not at low speed where their
waves end at 1 mm.**

## Faults of the outer race over healthy bearings

CWRU cut round faults of 0.18, 0.36 and 0.53 mm. Under {ball:g} N, which is assumed, a ball's contact is
{width:.2f} by {length:.2f} mm (Hamrock and Brewe), under 10 kN our roller's {ours_width:.2f} by
{whole:.0f} mm; ours are as wide and long relative to it, 400 um deep, in the middle of the load zone;
the shaft turns with {shaft:g} Hz. *Smooth*: ours with raceways and rollers without waves. Rms from 0.1 to 5.6
kHz over that of the healthy bearing at the same end; least, middle and most of all records of that size, at
every place on the clock.

| fault mm | records | measured | kurtosis | ours mm | ours | kurtosis | within | smooth |
|--:|--:|---|---|---|--:|--:|---|--:|
"""
LOADED = """
Size does not order the levels of single bearings: the same one is as silent as none at one end of the
machine, and as loud as any at the other. In the median the rms grows {grown:.1f} times from 0.18 to 0.53 mm,
ours {our_growth:.1f} times. The smallest fault is no louder than the waves of our raceways, whose height is
assumed: over smooth ones it stands out as on the motor.

## Load

MFPT loaded bearings with a fault of one race by {low:.0f} to {high:.0f} lbf, shaft {mfpt:g} Hz. Power of the
load with which the rms grows:

| | power |
|---|--:|
"""


AFTER = """
A deep spall takes from a roller what it carries; one in which the roller rests on the floor takes from it the
depth times the stiffness of the contact, whatever it carries. The depth of MFPT's faults is not stated.
"""


def write(cwru: Path, mfpt: Path, pronostia: Path) -> str:
    """Write the page."""
    received = {record: next(listenings(record)) for record in records(cwru, mfpt)}
    sound_records = [one for record in received if record.group == CWRU_SOUND for one in listenings(record)]
    sound = {one.end: level(one.acceleration, one.rate) for one in sound_records}
    rows = [
        (f"CWRU, motor, {end}", one.shaft_frequency, sound[end]) for one in sound_records for end in [one.end]
    ]
    for folder in sorted((pronostia / "Learning_set").iterdir()):
        turns = SHAFTS_OF_PRONOSTIA[folder.name[len("Bearing")]]
        rows.append((f"PRONOSTIA {folder.name}, first records", turns, first_records(folder)))
    for name, wave in (("as shipped", SHORTEST_WAVE), ("to 1 mm", 1e-3)):
        for speed in (90.0, 200.0, 300.0):
            turns = speed / 3.6 / WHEEL_RADIUS / (2.0 * math.pi)
            case = Case(0.0, speed, shortest_wave=wave)
            rows.append((f"ours, {speed:g} km/h, waves {name}", turns, ours(case)))
    text = HEAD.format()
    for name, turns, found in rows:
        text += (
            f"| {name} | {turns:.1f} | {found.rms:.2f} | {found.kurtosis:.1f} | {found.ringing:.2f} | "
            f"{found.ringing_kurtosis:.1f} |\n"
        )
    width, length = contact_of_ball(BALL_LOAD, 7.94e-3, 39.04e-3)
    text += FAULTS.format(
        ball=BALL_LOAD, width=1e3 * width, length=1e3 * length, whole=1e3 * WHOLE, shaft=SHAFT,
        ours_width=1e3 * contact_of_roller(HEAVIEST),
    )  # fmt: skip
    middles = []
    for size in (7, 14, 21):
        each = [
            (level(one.acceleration, one.rate).rms / sound[one.end].rms, kurtosis(one.acceleration))
            for record, one in received.items()
            if record.group in (CWRU_12_DRIVE, CWRU_12_FAN)
            and record.part == "cup"
            and record.diameter == size
        ]
        ratios, tails = np.array(each).T
        middles.append(float(np.median(ratios)))
        case, mine = alike(size), ratio(size)
        text += (
            f"| {1e3 * size * INCH:.2f} | {len(each)} | {_three(ratios)} | {_three(tails)} | "
            f"{1e3 * case.width:.2f} x {1e3 * case.length:.0f} | {mine:.1f} | {ours(case).kurtosis:.1f} | "
            f"{'yes' if ratios.min() <= mine <= ratios.max() else 'no'} | {ratio(size, waves=False):.1f} |\n"
        )
    rigs = [(one, _load_of(one)) for record, one in received.items() if record.group == MFPT]
    text += LOADED.format(
        grown=middles[-1] / middles[0], our_growth=ratio(21) / ratio(7), mfpt=MFPT_SHAFT,
        low=min(load for _, load in rigs), high=max(load for _, load in rigs),
    )  # fmt: skip
    for part, race in (("cup", "outer"), ("cone", "inner")):
        line = [
            (load, level(one.acceleration, one.rate).rms)
            for one, load in rigs
            if one.part == part and load > 0.0
        ]
        power = power_of_load(*zip(*line, strict=True))
        text += f"| MFPT, fault of the {race} race, {len(line)} records | {power:.2f} |\n"
    for depth in (DEEP, SHALLOW):
        name = f"ours, like a fault of 0.36 mm, {1e6 * depth:g} um deep, 40 to 120 kN"
        text += f"| {name} | {ours_over_load(depth):.2f} |\n"
    text += AFTER
    return text


def _three(values: Float) -> str:
    return f"{values.min():.1f}, {np.median(values):.1f}, {values.max():.1f}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cwru", "mfpt", "pronostia"):
        parser.add_argument(f"--{name}", type=Path, required=True, metavar="DIR")
    given = parser.parse_args(arguments)
    PAGE.write_text(write(given.cwru, given.mfpt, given.pronostia), encoding="utf-8")
    print(f"{PAGE} written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
