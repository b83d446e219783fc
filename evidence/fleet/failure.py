"""Runs to failure of PRONOSTIA through the fleet: when the list says what.

``python -m evidence.fleet.failure --pronostia DIR --folder DIR`` prints a line for each run. Its records of
0.1 s, one every 10 s, are too short for a verdict: what can be said is that levels have risen.
"""

from __future__ import annotations

import argparse
import csv
import os
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path

import beardyn_core as bd
from beardyn_core.fleet.health import WATCH, axlebox_histories, replay
from beardyn_core.fleet.store import open_store

SETS = ("Learning_set", "Full_Test_Set")
BEGIN, EVERY_S = datetime(2011, 1, 1, tzinfo=UTC), 10.0
RPM = {"1": 1800, "2": 1650, "3": 1500}  # of the three conditions
BEARING = """name: bearing of PRONOSTIA
roller_count: 13
roller_diameter_mm: 3.5
pitch_diameter_mm: 25.6
contact_angle_deg: 0
"""


def write_manifest(folders: Sequence[Path], manifest: Path, every: int) -> int:
    """Write a manifest of every so-manieth record of runs; gives how many lines."""
    manifest.parent.mkdir(parents=True, exist_ok=True)
    bearing = manifest.with_name("bearing.yaml")
    bearing.write_text(BEARING, encoding="utf-8")
    lines = []
    for folder in folders:
        for number, path in enumerate(sorted(folder.glob("acc_*.csv"))[::every]):
            lines.append(
                {
                    "file": os.path.relpath(path, manifest.parent),
                    "vehicle": folder.name,
                    "axle": "1",
                    "side": "left",
                    "time": (BEGIN + timedelta(seconds=EVERY_S * every * number)).isoformat(),
                    "bearing": str(bearing),
                    "channels": "y=5,z=6",
                    "unit": "g",
                    "rate_Hz": 25_600,
                    "time_channel": "none",
                    "speed_rpm": RPM[folder.name[len("Bearing")]],
                }
            )
    with manifest.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(lines[0]))
        writer.writeheader()
        writer.writerows(lines)
    return len(lines)


def lines_of(store_path: Path) -> list[str]:
    """Say of each run when the list first watched it, and how it ended."""
    with open_store(store_path) as store:
        recordings = store.recordings()
    lines = []
    for box, history in axlebox_histories(recordings).items():
        health, points = replay(history, {})
        watched = [each.state == WATCH for each in points]
        off = [place for place, each in enumerate(watched) if not each]
        first = watched.index(True) if any(watched) else None
        stays = off[-1] + 1 if off and watched[-1] else None
        share = "never" if first is None else f"first at {100 * first / len(points):.0f} % of the run"
        share += "" if stays is None else f", to the end from {100 * stays / len(points):.0f} %"
        lines.append(
            f"{box.vehicle}: {len(points)} records, watch {share}; at the end {health.state}: {health.why[0]}"
        )
    return lines


def main() -> None:
    """Add the runs and print what became of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pronostia", type=Path, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--runs", nargs="*", default=[], help="names such as Bearing1_2; default all")
    parser.add_argument("--every", type=int, default=1, help="take every so-manieth record")
    args = parser.parse_args()
    folders = sorted(each for name in SETS for each in (args.pronostia / name).iterdir() if each.is_dir())
    chosen = [each for each in folders if not args.runs or each.name in args.runs]
    manifest = args.folder / "manifest.csv"
    count = write_manifest(chosen, manifest, args.every)
    store = args.folder / "failure.sqlite"
    told = bd.fleet(store).add(
        [args.folder, *chosen],
        manifest=manifest,
        estimator="none",
        workers=os.cpu_count() or 1,
        progress=lambda done, total: print(f"{done} of {total}", flush=True) if done % 100 == 0 else None,
    )
    print(f"{count} records, {len(told.refused)} refused", *told.refused[:3], sep="\n")
    print("\n".join(lines_of(store)))


if __name__ == "__main__":
    main()
