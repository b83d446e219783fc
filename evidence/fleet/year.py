"""A year of 64 axleboxes: three growing spalls, a wheel flat, wheels that are turned, a sensor that dies.

``python -m evidence.fleet.year --folder DIR`` makes the recordings, adds them to a store, and keeps what
became of it beside this module; ``python -m evidence.fleet.page`` writes docs/evidence/fleet_year.md of that.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import time
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime, timedelta
from math import isfinite, nan
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import beardyn_core as bd
from beardyn_core.base.outputs import write_whole
from beardyn_core.fleet.health import ACT, CANNOT_TELL, PLAN, WATCH, axlebox_histories, replay
from beardyn_core.fleet.identity import Axlebox
from beardyn_core.fleet.mileage_left import judge_mileage
from beardyn_core.fleet.ranking import rank_fleet
from beardyn_core.fleet.sisters import compare_sisters
from beardyn_core.fleet.store import open_store
from evidence.fleet.signals import HEALTHY, RATE, STEP, WIDTHS_MM, TwinRun, twin_run, write_recording

KEPT = Path(__file__).with_name("year.json")
BEGIN = datetime(2025, 1, 6, 10, 0, tzinfo=UTC)
TRAINS, AXLES, DAYS = 8, 4, 365
KM_A_DAY = 600.0
SEED = 5


class Growing(NamedTuple):
    """A spall that grows from 2 mm to 20 mm."""

    box: Axlebox
    part: str
    begins: int  # day
    takes: int  # days from 2 mm to 20 mm


SPALLS = (
    Growing(Axlebox("T2", "3", "left"), "cup", 60, 200),
    Growing(Axlebox("T5", "1", "right"), "cone", 100, 220),
    Growing(Axlebox("T7", "4", "left"), "cup", 200, 140),
)
FLAT_AXLE, FLAT_FROM, FLAT_TO = ("T4", "2"), 150, 230
DEAD, DEAD_FROM = Axlebox("T6", "2", "right"), 220
TURNED, TURNED_ON = "T3", 180


def width_mm(spall: Growing, day: float) -> float:
    """Width of a spall on a day, 0 before it is there, without bounds after 20 mm, [mm]."""
    share = (day - spall.begins) / spall.takes
    return float(2.0 * 10.0**share) if share >= 0.0 else 0.0


def boxes() -> Iterator[Axlebox]:
    """List the axleboxes."""
    for train in range(1, TRAINS + 1):
        for axle in range(1, AXLES + 1):
            for side in ("left", "right"):
                yield Axlebox(f"T{train}", str(axle), side)


def run_of(box: Axlebox, day: int, random: np.random.Generator) -> str:
    """Choose the run of a recording."""
    for spall in SPALLS:
        width = width_mm(spall, day)
        if spall.box == box and width:
            # the next smaller one that was simulated: a spall is not wider than it is
            stage = max(each for each in WIDTHS_MM if each <= min(max(width, 2.0), 20.0))
            return f"{spall.part}_{stage:g}"
    if box[:2] == FLAT_AXLE and FLAT_FROM <= day < FLAT_TO:
        return "flat_0"
    return f"healthy_{random.integers(HEALTHY)}"


def gain_dB(box: Axlebox, day: int, own: float, ride: float) -> float:
    """Gain of a recording: of the box, the ride, the season and the wheel, [dB]."""
    season = 1.5 * np.cos(2.0 * np.pi * (day - 15) / 365.0)  # stiff grease and ballast in winter
    turned = box.vehicle == TURNED and day >= TURNED_ON
    worn = 3.0 * ((day - TURNED_ON if turned else day + 60) / 365.0)  # a tread that becomes rough
    return float(own + ride + season + worn)


def write_year(folder: Path, every: int, runs: Mapping[str, TwinRun]) -> int:
    """Write all recordings of the year with their manifest; gives how many."""
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(SEED)
    own = {box: random.normal(0.0, 1.0) for box in boxes()}
    lines: list[dict[str, Any]] = []
    for day in range(0, DAYS, every):
        for box in boxes():
            if box == next(b for b in boxes() if b.vehicle == box.vehicle):
                ride = random.normal(0.0, 2.0)  # of the train on this day
                air = 10.0 - 12.0 * np.cos(2.0 * np.pi * (day - 15) / 365.0) + random.normal(0.0, 3.0)
            name = f"{day:03d}_{'_'.join(box)}.npz"
            run = runs[run_of(box, day, random)]
            gain = 10.0 ** (gain_dB(box, day, own[box], ride) / 20.0)
            if box == DEAD and day >= DEAD_FROM:
                run = TwinRun(np.zeros(len(run.angle)), run.angle)
                _write_dead(folder / name, run)
            else:
                write_recording(folder / name, run, gain, random)
            width = max((width_mm(each, day) for each in SPALLS if each.box == box), default=0.0)
            warm = air + 30.0 + random.normal(0.0, 2.0) + 0.6 * min(width, 25.0)
            lines.append(
                {
                    "file": name,
                    **box._asdict(),
                    "time": (BEGIN + timedelta(days=day, seconds=20 * int(box.axle))).isoformat(),
                    "mileage_km": round(120_000 + KM_A_DAY * day),
                    "temperature_C": round(warm, 1),
                }
            )
    with (folder / "manifest.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(lines[0]))
        writer.writeheader()
        writer.writerows(lines)
    return len(lines)


def _write_dead(path: Path, run: TwinRun) -> None:
    """Write what a dead sensor gives: a steady number."""
    pulses = (np.mod(run.angle, 2.0 * np.pi) < 0.6).astype(np.int8)
    dead = np.full(len(pulses), 3, np.int16)
    # the day in two samples: a file like another would be the same recording
    np.savez(path, z=dead, tacho=pulses, day=np.array([int(path.name[:3])]))


def judge(store_path: Path) -> dict[str, Any]:
    """Find when what was alarmed, and what the list at the end of the year says."""
    with open_store(store_path) as store:
        recordings = store.recordings()
        status = rank_fleet(store)
    comparisons = compare_sisters(recordings)
    by_box = {each.box: each for each in SPALLS}
    found: list[dict[str, Any]] = []
    false_alarms, watches, boxes_watched = 0, 0, set()
    points_healthy = 0
    for box, history in axlebox_histories(recordings).items():
        _, points = replay(history, comparisons)
        days = [(each.time - BEGIN.timestamp()) / 86_400.0 for each in points]
        alarm = [each.state in (PLAN, ACT) for each in points]
        spall = by_box.get(box)
        if spall is None:
            false_alarms += sum(a and not b for a, b in zip(alarm, [False, *alarm[:-1]], strict=True))
            watched = [each.state == WATCH for each in points]
            watches += sum(watched)
            points_healthy += len(points)
            if any(watched):
                boxes_watched.add(box.name)
            continue
        ends = spall.begins + spall.takes
        firsts = {
            state: next((day for day, e in zip(days, points, strict=True) if e.state in states), nan)
            for state, states in (("watch", (WATCH, PLAN, ACT)), ("plan", (PLAN, ACT)), ("act", (ACT,)))
        }
        before = [a for a, day in zip(alarm, days, strict=True) if day < spall.begins]
        false_alarms += any(before)
        known = (judge_mileage(history[:count], spall.part) for count in range(1, len(history) + 1))
        first = next(
            ((each, one) for each, one in zip(known, history, strict=True) if each.is_known),
            (judge_mileage(history, spall.part), history[-1]),
        )
        left, now = first[0], (first[1].time - BEGIN.timestamp()) / 86_400.0
        found.append(
            {
                "box": box.name,
                "part": spall.part,
                "begins": spall.begins,
                "ends": ends,
                "first": {key: None if not isfinite(day) else day for key, day in firsts.items()},
                "width_mm": {k: None if not isfinite(d) else width_mm(spall, d) for k, d in firsts.items()},
                "lead_days": None if not isfinite(firsts["plan"]) else ends - firsts["plan"],
                "left": left.sentence,
                "laws": left.laws_sentence,
                "laws_hold": bool(left.span[0] <= 1e3 * KM_A_DAY * (ends - now) <= left.span[1]),
                "left_on_day": now if left.is_known else None,
                "left_km": [each / 1e3 for each in left.distance] if left.is_known else None,
                "true_left_km": KM_A_DAY * (ends - now),
                "rank": next(each.rank for each in status.standings if each.axlebox == box),
            }
        )
    listed = [
        {
            "rank": each.rank,
            "box": each.axlebox.name,
            "health": each.health.state,
            "part": each.health.part,
            "why": each.health.why[0],
            "notes": list(each.health.notes),
        }
        for each in status.standings
        if each.health.state != "ok"
    ]
    dead = next(each for each in status.standings if each.axlebox == DEAD)
    return {
        "spalls": found,
        "false_alarms": false_alarms,
        "watch_share": watches / max(points_healthy, 1),
        "boxes_watched": sorted(boxes_watched),
        "listed": listed,
        "dead": dead.health.state,
        "dead_is_told": dead.health.state == CANNOT_TELL,
        "recordings": len(recordings),
    }


def main() -> None:
    """Make the year and judge it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, required=True, help="for recordings and store")
    parser.add_argument("--every", type=int, default=7, help="days between two recordings")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--judge", action="store_true", help="judge a store that is there")
    args = parser.parse_args()
    if args.judge:
        write_whole(
            KEPT,
            json.dumps({**judge(args.folder / "year.sqlite"), "every_days": args.every}, indent=1) + "\n",
        )
        return
    from evidence.fleet.signals import names

    runs = {name: twin_run(name, args.folder / "runs") for name in names()}
    count = write_year(args.folder / "recordings", args.every, runs)
    print(f"{count} recordings", flush=True)
    begin = time.time()
    store = args.folder / "year.sqlite"
    told = bd.fleet(store).add(
        args.folder / "recordings",
        bearing="HS130x230", channels="z=z", unit="m/s2", scale=STEP, rate_Hz=RATE, tacho_channel="tacho",
        workers=args.workers, estimator="none",
        progress=lambda done, total: print(f"{done} of {total}", flush=True) if done % 64 == 0 else None,
    )  # fmt: skip
    print(told.refused[:5])
    print(f"{time.time() - begin:.0f} s")
    write_whole(KEPT, json.dumps({**judge(store), "every_days": args.every}, indent=1) + "\n")


if __name__ == "__main__":
    main()
