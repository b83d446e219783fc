"""Recordings of a fleet with results that are stated, not analysed; and small files to analyse."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.fleet.analysis import Analysis
from beardyn_core.fleet.identity import Axlebox, FleetRecording
from beardyn_core.fleet.store import Stored
from test.fault_signals import RATE, fault_signal

DAY = 86_400.0
BEGIN = 1.7e9
BOX = Axlebox("V1", "1", "left")
LEVELS = np.array([[0.0, 5.0, 8.0, 6.0, 3.0]])
BEARING = """name: test bearing
roller_count: 17
roller_diameter_mm: 26.7
pitch_diameter_mm: 185.0
contact_angle_deg: 10.5
"""


def analysis(verdict: str = "healthy", confidence: float = 0.9, rise: float = 0.0, **more: Any) -> Analysis:
    """What an analysis says, levels a number of decibels over the usual ones."""
    given: dict[str, Any] = {
        "bearing_name": "HS130x230",
        "axes": ("z",),
        "levels": LEVELS + rise,
        "shaft_frequency": 20.0,
        "agreeing": 4,
        "analyses": 4,
    }
    return Analysis(verdict, f"says {verdict}", confidence=confidence, **{**given, **more})


def wide(part: str, width: float, doubt: float = 1e-3) -> Analysis:
    """A part with a spall of a width, [m]."""
    return analysis(
        part,
        stage="developed",
        stage_reason=f"developed: {1e3 * width:.1f} mm wide",
        width=width,
        width_low=width - doubt,
        width_high=width + doubt,
        width_from="monitor",
    )


def history(
    analyses: Sequence[Analysis | str], box: Axlebox = BOX, every: float = DAY, first: int = 0
) -> list[Stored]:
    """Recordings of one axlebox, one a day, 500 km between them."""
    return [
        Stored(
            first + day, box, box.vehicle, BEGIN + every * day, 1e8 + 5e5 * day, "HS130x230", f"{day}.npz",
            False, each if isinstance(each, Analysis) else analysis(each),
        )
        for day, each in enumerate(analyses)
    ]  # fmt: skip


def recording(day: int = 0, box: Axlebox = BOX, **more: Any) -> FleetRecording:
    """A recording that is to be added."""
    made = FleetRecording(
        Path(f"{box.axle}_{box.side}_{day}.npz"), box, box.vehicle, BEGIN + DAY * day, 1e8 + 5e5 * day,
        "HS130x230", sha256=f"{box.name} {day}",
    )  # fmt: skip
    return replace(made, **more)


def write_files(folder: Path, days: int, faulty: Axlebox | None = None) -> list[dict[str, Any]]:
    """Write files of two axles with a tachometer, and their manifest; the lines of it."""
    folder.mkdir(exist_ok=True)
    (folder / "bearing.yaml").write_text(BEARING, encoding="utf-8")
    lines = []
    for day in range(days):
        for place, box in enumerate(Axlebox("V1", axle, side) for axle in "12" for side in ("left", "right")):
            fault = "cup" if box == faulty else None
            _, angle, signal = fault_signal(fault, seed=10 * day + place, duration=1.6)
            name = f"{day}_{box.axle}_{box.side}.npz"
            pulses = (np.mod(angle, 2.0 * np.pi) < 0.6).astype(np.int8)
            np.savez(folder / name, z=signal[:, 2].astype(np.float32), tacho=pulses)
            lines.append(
                {
                    "file": name,
                    **box._asdict(),
                    "time": f"2026-03-{day + 1:02d}T10:00:00",
                    "mileage_km": 1000 + 300 * day,
                    "bearing": str(folder / "bearing.yaml"),
                    "rate_Hz": RATE,
                    "unit": "m/s2",
                    "channels": "z=z",
                    "tacho_channel": "tacho",
                }
            )
    write_manifest(folder, lines)
    return lines


def write_manifest(folder: Path, lines: Sequence[dict[str, Any]]) -> None:
    """Write a manifest."""
    heads = list(dict.fromkeys(key for line in lines for key in line))
    with (folder / "manifest.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, heads)
        writer.writeheader()
        writer.writerows(lines)
