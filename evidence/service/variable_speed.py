"""The monitor while the train runs up, brakes, stops or has worn wheels, with and without a tachometer.

``python -m evidence.service.variable_speed`` writes docs/evidence/variable_speed.md. Runs of the twin with
the background of service, healthy and with a field spall of each part, read as measured vibration.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import warnings
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.study.monitored_recording import Conclusion
from evidence.pages import REPORTS, render
from evidence.runner import KeptResults

PAGE = REPORTS / "variable_speed.md"
SCENE, TIER, BEARING = "service_high_speed", "quasistatic", "HS130x230"
# of field spalls that the monitor finds at a steady speed [mm]
WIDTHS = {"cup": 12.0, "cone": 21.0, "roller": 16.0}
NEW_WHEEL_MM, WORN_WHEEL_MM = 920.0, 850.0
# time [s] and speed [km/h]; the wheel that a user states is a new one
PROFILES: dict[str, tuple[tuple[float, float], ...]] = {
    "steady": ((0.0, 140.0), (14.0, 140.0)),
    "run-up": ((0.0, 100.0), (14.0, 180.0)),
    "braking": ((0.0, 180.0), (14.0, 100.0)),
    "stop": ((0.0, 70.0), (2.0, 70.0), (16.0, 0.0), (18.0, 0.0), (32.0, 70.0), (34.0, 70.0)),
}
STEADY, WORN, WIDE = "steady", "worn wheel", "wide"
WAYS = ("tachometer", "vibration", "stated")
WAY_WORDS = {
    "tachometer": "tachometer",
    "vibration": "from the vibration",
    "stated": "stated, constant",
    WIDE: "stated, constant, ±10 %",
}


def run_of(profile: str, part: str, wheel_mm: float) -> bd.Run:
    """Simulate a profile of speed with a spall of a part, '' for none."""
    points = PROFILES[profile]
    text = [{"time_s": time, "speed_kmh": speed} for time, speed in points]
    base = bd.scene(SCENE)
    operation = {
        "kind": "quarter_vehicle",
        "vehicle": "emu_300",
        "irregularity": {"kind": "german_low"},
        "speed_profile": text,
        "wheel_diameter_mm": wheel_mm,
        "wheelset": "coupled",
    }
    faults = [{"kind": "field_spall", "on": part, "width_mm": WIDTHS[part]}] if part else []
    scene = bd.scene(base, tier=TIER, operation=operation, faults=faults, duration=points[-1][0])
    return bd.simulate(scene)


def verdict_of(run: bd.Run, way: str, profile: str, uncertainty: float | None = None) -> list[Any]:
    """Let the monitor judge a run, whose speed it gets in one way: see `_told`."""
    if way == "tachometer":
        return _told(bd.monitor(run))
    speeds = [speed for _, speed in PROFILES[profile]]
    rpm = [1000.0 / 60.0 * speed / (math.pi * 1e-3 * NEW_WHEEL_MM) for speed in speeds]
    reading: dict[str, Any] = {"speed_rpm": sum(rpm) / len(rpm)}
    if way == "vibration":
        # the range of a user who knows the line: a little wider than the profile, at most a factor of two
        low = max(min(rpm), 0.5 * max(rpm)) / 1.03
        reading = {"speed_range_rpm": f"{low:.0f}:{min(1.03 * max(rpm), 2.0 * low):.0f}"}
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = Path(folder) / "vibration.wav"
        bd.export(run, path, signals=["vibration"])
        try:
            measured = bd.read_measured(path, bearing=BEARING, **reading)
        except InputError as error:
            return ["refused", 0, 0, None, _reason("; ".join(error.problems), path)]
    settings = None if uncertainty is None else MonitorSettings(speed_uncertainty=uncertainty)
    return _told(bd.monitor(measured, settings=settings))


def _reason(sentence: str, path: Path) -> str:
    """Keep why a speed is not known, without the file and what to give in its place."""
    begun = sentence.replace(f"{path}: ", "").partition(" from 0 s on ")[2] or sentence
    return begun.partition("; give one of")[0]


def _told(conclusion: Conclusion) -> list[Any]:
    """List verdict, analyses that agree, all of them, confidence, reason of a refusal."""
    finding = conclusion.finding
    sure = finding is not None and math.isfinite(finding.confidence)
    confidence = finding.confidence if finding is not None and sure else None
    return [conclusion.verdict, conclusion.agreeing, conclusion.analyses, confidence, ""]


def answers(profile: str, part: str) -> list[list[Any]]:
    """Judge a run in all ways; at a steady speed also one with worn wheels, its speed stated for new ones."""
    run = run_of(profile, part, NEW_WHEEL_MM)
    found = [[profile, part, way, *verdict_of(run, way, profile)] for way in WAYS]
    if profile == STEADY:
        worn = run_of(profile, part, WORN_WHEEL_MM)
        found.append([WORN, part, "stated", *verdict_of(worn, "stated", profile)])
        found.append([WORN, part, WIDE, *verdict_of(worn, "stated", profile, 0.1)])
        found.append([WORN, part, "tachometer", *verdict_of(worn, "tachometer", profile)])
    return found


def cell(row: Sequence[Any]) -> str:
    """Write an answer for the table."""
    verdict, agreeing, analyses, confidence = row[3:7]
    if verdict == "refused":
        return "refused"
    sure = "" if confidence is None else f", {confidence:.2f}"
    return f"{verdict} {agreeing}/{analyses}{sure}"


def text(found: Sequence[Sequence[Any]]) -> str:
    """Write the page."""
    parts = ("", *WIDTHS)
    table = {(row[0], row[2], row[1]): row for row in found}
    cases = list(dict.fromkeys((row[0], row[2]) for row in found))
    rows = [(case, WAY_WORDS[way], *(cell(table[case, way, part]) for part in parts)) for case, way in cases]
    refused = {(row[0], row[7]) for row in found if row[3] == "refused"}
    faulty = [row for row in found if row[1]]
    counted = {
        way: (
            sum(row[3] == row[1] for row in faulty if row[2] == way),
            sum(row[2] == way for row in faulty),
        )
        for way in WAY_WORDS
    }
    values = {
        "scene": SCENE,
        "widths": ", ".join(f"{part} {width:g} mm" for part, width in WIDTHS.items()),
        "profiles": [
            (name, ", ".join(f"{v:g} km/h at {t:g} s" for t, v in p)) for name, p in PROFILES.items()
        ],
        "worn": WORN_WHEEL_MM,
        "new": NEW_WHEEL_MM,
        "rows": rows,
        "counts": [
            (WAY_WORDS[way], f"{right} of {total}") for way, (right, total) in counted.items() if total
        ],
        "alarms": sum(row[3] in WIDTHS for row in found if not row[1]),
        "healthy": sum(not row[1] for row in found),
        "refused": sorted(refused),
    }
    return render(__file__, values)


def main(arguments: Sequence[str] | None = None) -> int:
    """Make all runs, go on where an earlier call was stopped, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--results", type=Path, metavar="FILE", help="JSON to keep answers in, and go on from"
    )
    args = parser.parse_args(arguments)
    kept, found = KeptResults(args.results), []
    for profile in PROFILES:
        for part in ("", *WIDTHS):
            key = f"{profile} {part or 'healthy'}"
            print(key, file=sys.stderr)
            found += kept.get(key, partial(answers, profile, part))
    PAGE.write_text(text(found), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
