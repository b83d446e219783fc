"""Measured records with a wrong speed or a wrong bearing: what the monitor answers.

``python -m evidence.measured.wrong_inputs --cwru DIR --mfpt DIR --hit DIR`` writes
docs/evidence/monitor_wrong_inputs.md. Records are the clearly faulty ones: grades Y1 and Y2 of CWRU, all of
MFPT and HIT-SM. One analysis of up to 60 revolutions for each record and each answer.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from beardyn_core.bearing.kinematics import FaultFrequencies, frequencies
from beardyn_core.config import load_plate
from beardyn_core.measured.stated_speed import UNCERTAINTY
from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorSettings, Stretch
from evidence.measured.cases import DRIVE, FAN, HIT, MFPT, PLATES, Listening, Record, listenings, records
from evidence.pages import REPORTS, render
from evidence.runner import KeptResults

PAGE = REPORTS / "monitor_wrong_inputs.md"
ERRORS = tuple(range(-8, 9))  # of the stated speed, [%]
REVOLUTIONS, LONGEST_S = 60.0, 20.0
# rolling elements, their diameter and their circle [mm]; 6204 and 6206 are assumed from common tables
BEARINGS = {
    "6203": None,
    "6204": (8, 7.938, 33.5),
    "6205": None,
    "6206": (9, 9.525, 46.0),
}
ANSWERS = ("right", "unexplained", "not_diagnosable", "another part", "healthy")
HEALTHY_CASES = ("in a healthy machine", "next to a faulty one", "next to a faulty one, named")
ROW_ANSWERS = {"not_diagnosable": "not diagnosable"}


def orders_of(name: str) -> tuple[FaultFrequencies, int]:
    """Give the orders and the number of rolling elements of a bearing."""
    numbers = BEARINGS[name]
    if numbers is None:
        plate = load_plate(name)
        return plate.frequencies, plate.roller_count
    count, ball, circle = numbers
    return frequencies(count, circle, ball, 0.0), count


def answer(
    listening: Listening, orders: FaultFrequencies, count: int, error: float, settings: MonitorSettings
) -> str:
    """Analyse the beginning of a record with a stated speed that is off by an error, [-]."""
    samples = min(
        len(listening.acceleration),
        round(min(REVOLUTIONS / listening.shaft_frequency, LONGEST_S) * listening.rate),
    )
    turns_a_sample = listening.shaft_frequency * (1.0 + error) / listening.rate
    turned = np.asarray(2.0 * np.pi * turns_a_sample * np.arange(samples), np.float64)
    stretch = Stretch(listening.rate, listening.acceleration[:samples], turned, np.nan, 0)
    return REFERENCE(stretch, orders, count, settings).verdict


def is_clear(listening: Listening) -> bool:
    """Tell whether the bearing is clearly faulty."""
    record = listening.record
    return bool(listening.part) and (record.grade in ("Y1", "Y2") or record.group in (MFPT, HIT))


def cases(listening: Listening) -> Iterator[tuple[str, str]]:
    """Answer a faulty record for every wrong speed and bearing, a healthy one for the right ones."""
    settings = MonitorSettings(speed_uncertainty=UNCERTAINTY)
    plate = listening.plate
    if is_clear(listening):
        for error in ERRORS:
            yield (
                f"{error:+d} %",
                answer(listening, plate.frequencies, plate.roller_count, error / 100.0, settings),
            )
        others = ("6203", "6204", "6205") if listening.record.group == MFPT else ("6203", "6204", "6206")
        for name in others:
            yield name, answer(listening, *orders_of(name), 0.0, settings)
    elif not listening.part:
        place = "next to a faulty one" if listening.record.part else "in a healthy machine"
        yield place, answer(listening, plate.frequencies, plate.roller_count, 0.0, settings)
        if listening.record.part:
            other = load_plate(PLATES[FAN if listening.end == DRIVE else DRIVE]).frequencies
            named = replace(settings, neighbours=(other,))
            yield (
                f"{place}, named",
                answer(listening, plate.frequencies, plate.roller_count, 0.0, named),
            )


def answers(record: Record, key: str) -> list[list[str]]:
    """List the answers of a record: its key, the faulty part, the case, the verdict."""
    return [
        [key, listening.part, case, verdict]
        for listening in listenings(record)
        for case, verdict in cases(listening)
    ]


def outcome(part: str, verdict: str) -> str:
    """Name an answer beside the faulty part."""
    return "right" if verdict == part else "another part" if verdict in FAULTS else verdict


def rows(found: Iterable[Sequence[str]]) -> dict[str, Counter[str]]:
    """Count answers by case; each is (record, part, case, verdict)."""
    counted: dict[str, Counter[str]] = {}
    for _, part, case, verdict in found:
        counted.setdefault(case, Counter())[outcome(part, verdict) if part else verdict] += 1
    return counted


def text(found: Sequence[Sequence[str]], counts: str) -> str:
    """Write the page."""
    counted = rows(found)
    clear = [each for each in found if each[1]]
    never = sorted({name for name, _, case, verdict in clear if case == "+0 %" and verdict == "healthy"})
    others = [each for each in clear if each[0] not in never]
    values = {
        "counts": counts,
        "uncertain": 100.0 * UNCERTAINTY,
        "answers": " | ".join(ROW_ANSWERS.get(each, each) for each in ANSWERS),
        "bars": "--:|" * len(ANSWERS),
        "speeds": [_row(f"{each:+d} %", counted.get(f"{each:+d} %", Counter())) for each in ERRORS],
        "bearings": [_row(name, counted[name]) for name in BEARINGS if name in counted],
        "total": len(clear),
        "records": len({each[0] for each in clear}),
        "never": len(never),
        "names": ", ".join(never) or "none",
        "share_healthy": _percent(others, "healthy"),
        "all_healthy": _percent(clear, "healthy"),
        "share_wrong": _percent(clear, "another part"),
        "healthy": [_healthy_row(case, counted.get(case, Counter())) for case in HEALTHY_CASES],
    }
    return render(__file__, values)


def _healthy_row(case: str, here: Counter[str]) -> tuple[str | int, ...]:
    parts = sum(here[part] for part in FAULTS)
    return case, here["healthy"], here["not_diagnosable"], here["unexplained"], parts


def _row(name: str, counted: Counter[str]) -> tuple[str, ...]:
    return name, *(str(counted[each]) for each in ANSWERS)


def _percent(found: Sequence[Sequence[str]], answered: str) -> float:
    hits = sum(outcome(part, verdict) == answered for _, part, _, verdict in found)
    return 100.0 * hits / max(1, len(found))


def main(arguments: Sequence[str] | None = None) -> int:
    """Answer all records, go on where an earlier run was stopped, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cwru", "mfpt", "hit"):
        parser.add_argument(f"--{name}", type=Path, metavar="FOLDER", help="with its .mat files")
    parser.add_argument(
        "--results", type=Path, metavar="FILE", help="JSON to keep answers in, and go on from"
    )
    parser.add_argument(
        "-o", "--output", type=Path, default=PAGE, help="default docs/evidence/monitor_wrong_inputs.md"
    )
    args = parser.parse_args(arguments)
    chosen = records(args.cwru, args.mfpt, args.hit)
    if not chosen:
        parser.error("there is no known record below the folders")
    kept, found = KeptResults(args.results), []
    for record in chosen:
        key = f"{record.group} {record.name}"
        print(key, file=sys.stderr)
        found += kept.get(key, partial(answers, record, key))
    groups = Counter(record.group for record in chosen)
    counts = ", ".join(f"{count} of {group}" for group, count in groups.items())
    args.output.write_text(text(found, counts), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
