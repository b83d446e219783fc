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
from evidence.impact.study import Heard, heard, loudness

TITLE = """
## Published, and ours

*Abstract*: the text that was read; *quoted*: measured figures quoted in
github.com/bersamin12/nebulax (rail_phm.md); *from memory*: the source was not at hand. No source found gives
a level, a bearing and a spall together that could be run as they are, so what is compared are relations.

| source and conditions | what it says | ours |
|---|---|---|
"""


def _span(values: list[float], form: str) -> str:
    return f"{min(values):{form}} to {max(values):{form}}"


def _power(values: list[float]) -> float:
    """Fit a power of the speed through values of `OVER_SPEED`."""
    return float(np.polyfit(np.log([case.speed for case in OVER_SPEED]), np.log(values), 1)[0])


def _over(name: str) -> list[float]:
    """List the rms of a line of `GROWING`."""
    return [loudness(over_range(case)).rms for case in GROWING[name]]


def _all(cases: list[Case]) -> list[Heard]:
    return [heard(case) for case in cases]


def published() -> str:
    """Write the section of published observations."""
    wide = [case for speed in BOTH for case in over_width(speed) if case.width >= 4e-3]
    whole = [case for speed in BOTH for case in across(speed)]
    areas = {speed: [heard(case).rms for case in over_area(speed)] for speed in BOTH}
    parts = {part: [heard(Case(speed=speed, on=part)).line for speed in BOTH] for part in ("cup", "roller")}
    lost = [1e3 * (case.width - crossing(case).spacing) for case in wide]
    bursts = {speed: [1e3 * crossing(case).burst for case in over_width(speed)] for speed in BOTH}
    levels = [heard(case).rms for case in OVER_SPEED]
    spalled = _all(wide)
    freight = [heard(Case(speed=90.0)), heard(healthy(90.0))]
    rows = (
        (
            "Sawalhi and Randall 2011, MSSP 25, 846, notched ball bearing (from memory). Sawalhi and others "
            "2017, Adv. Mech. Eng. 9(5), spalls of a high-speed rig (abstract)",
            "two events: weak step of the entry, impulse at the trailing edge; their spacing gives the width "
            "where rollers do not bridge it",
            f"two events from 3 mm on; the way between them is the width less {_span(lost, '.1f')} mm, "
            "which is where a roller gives up and takes up its load",
        ),
        (
            "Singh, Koepke, Howard, Petersen 2014, JSV 333, 5356; explicit finite elements of a ball bearing "
            "(abstract)",
            "re-stressing near the end of the defect gives a burst of short impulses",
            f"whole contact: {_span([crossing(case).pulses for case in whole], '.1f')} pulses an exit, "
            f"{_span([crossing(case).louder for case in whole], '.1f')} times as loud as the entry",
        ),
        (
            "Kogan, Klein, Bortman 2017, Nonlinear Dyn. 87, 219; model of a radially loaded ball bearing "
            "(abstract)",
            "time to impact gives the width; load and gravity matter where contact is lost",
            "the same way at 90 and 200 km/h to "
            + f"{max(abs(crossing(a).spacing - crossing(b).spacing) for a, b in _pairs()) * 1e3:.2f} mm",
        ),
        (
            "Al-Ghamd and Mba 2006, MSSP 20, 1537; roller bearing, seeded outer race, acoustic emission "
            "(abstract; duration from memory)",
            "duration of the burst tells the size, vibration levels do not",
            f"bursts of {_span(bursts[90.0], '.2f')} ms at 90 and {_span(bursts[200.0], '.2f')} ms at 200 "
            "km/h from 1 to 15 mm; rms from 4 to 15 mm stays within "
            f"{max(each.rms for each in spalled[:4]) / min(each.rms for each in spalled[:4]) - 1.0:.0%} at "
            "90 km/h",
        ),
        (
            "Rao and Ratnam 2015, Tribol. Ind. 37, 176; cylindrical roller bearing, defect of the outer race "
            "seeded larger and larger (abstract)",
            "vibration tells a defect when it has become severe; earlier work, with defects of several "
            "kinds, found no relation of size and level",
            f"over {_span([case.speed for case in over_range(Case())], 'g')} km/h rms "
            f"{_span(_over('25 mm long, 100 um'), '.0f')} m/s^2 from 1 to 10 mm of one length, "
            f"{_span(_over('twice as long, a tenth as deep'), '.0f')} m/s^2 from 1 to 15 mm where length and "
            f"depth grow, {loudness(over_range(Case(0.0))).rms:.0f} sound",
        ),
        (
            "Tarawneh and others, freight axlebox bearings on a rig (from memory); Rail. Eng. Sci. 2021 "
            "(abstract): spalls below 12.9 cm2 found by vibration thresholds",
            "rms grows with the area of the spall",
            "0.3, 1.2 and 7.5 cm2: "
            + "; ".join(
                f"{', '.join(f'{value:.0f}' for value in values)} m/s^2 at {speed:g} km/h"
                for speed, values in areas.items()
            ),
        ),
        (
            "Vibration of defective freight bearings, Pueblo 1999, ASME RTD 2002, 95; adapters of a train, "
            "48 kHz (abstract)",
            "fault lines in the spectrum of the envelope, none to speak of in that of the signal",
            f"6 mm at 90 km/h: {freight[0].line:.0f} dB in the envelope, {freight[0].raw:.0f} in the signal, "
            f"where a sound bearing has {freight[1].raw:.0f}",
        ),
        (
            "Dyer and Stewart 1978, J. Mech. Des. 100, 229 (from memory)",
            "kurtosis 3 of sound bearings, above 3 of damaged ones",
            f"{heard(healthy(90.0)).kurtosis:.1f} and {heard(healthy(200.0)).kurtosis:.1f} sound at 90 and "
            f"200 km/h; {_span([each.kurtosis for each in spalled], '.0f')} from 4 mm on",
        ),
        (
            "Jain and Bhosle 2022, Int. J. Adv. Technol. Eng. Explor. 9(90); ball bearings of a motor at "
            "29 Hz (quoted)",
            "sound: kurtosis 2.76 to 2.96; spalls of the inner race from 0.2 to 0.7 mm: 5.6, 21.7, 8.1, 3.3",
            "sound as above; cup spalls from 1 to 15 mm "
            + " and ".join(
                f"{', '.join(f'{heard(case).kurtosis:.0f}' for case in over_width(speed))} at {speed:g} km/h"
                for speed in BOTH
            ),
        ),
        (
            "Saruhan and others 2014, J. Appl. Res. Technol. 12, 384; spalled races of a small rig, 17 to "
            "41 Hz (quoted)",
            "peaks grow with the speed to the power of 1.0 to 1.3",
            "6 mm, 40 to 300 km/h: peak to the power of "
            f"{_power([heard(case).peak for case in OVER_SPEED]):.1f}, rms of {_power(levels):.1f}",
        ),
        (
            "Tandon and Choudhury 1999, Tribol. Int. 32, 469, review (from memory)",
            "levels of a defect grow with speed",
            f"rms {', '.join(f'{level:.1f}' for level in levels)} m/s^2 at 40, 90, 200 and 300 km/h, 6 mm",
        ),
        (
            "Smith and Randall 2015, MSSP 64-65, 100; CWRU, ball bearings of a motor (from memory)",
            "outer races are found easily, rolling elements hardly",
            f"envelope line of the cup {parts['cup'][0]:.0f} and {parts['cup'][1]:.0f} dB, of a roller "
            f"{parts['roller'][0]:.0f} and {parts['roller'][1]:.0f} dB, at 90 and 200 km/h",
        ),
    )
    return TITLE + "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _pairs() -> list[tuple[Case, Case]]:
    both = [[case for case in over_width(speed) if case.width >= 4e-3] for speed in BOTH]
    return list(zip(*both, strict=True))
