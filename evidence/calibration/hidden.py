"""Axleboxes whose numbers a calibration is not told, and what it makes of their recordings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import beardyn_core as bd
from beardyn_core.api.calibrating import calibrate
from beardyn_core.base.edge import write_noun
from beardyn_core.base.plain_json import plain
from beardyn_core.calibration.unknowns import UNKNOWNS
from beardyn_core.cli.calibrate import json_object
from evidence.runner import kept_json

BASE = "service_high_speed"
SECONDS = 5.0
BUDGET = 60


@dataclass(frozen=True)
class Hidden:
    """An axlebox unlike the scene that its calibration begins with, on another track."""

    name: str
    frequency: A[float, "of the modes of its box, factor"]
    damping: A[float, "of them, factor"]
    background: A[float, "amplitude, factor"]
    noise: A[float, "density, [m/s2 per root Hz]"]
    end_play: A[float, "[mm]"]
    seed: A[int, "of track, background and noise"]
    lot: A[int, "seed of the bearing as made"]


BOXES = (
    Hidden("A", 1.08, 0.6, 1.6, 0.03, 0.15, 900, 700),
    Hidden("B", 0.93, 1.8, 0.7, 0.05, 0.05, 901, 701),
    Hidden("C", 1.04, 1.4, 1.3, 0.001, 0.18, 902, 702),
)


def play(box: Hidden, path: Path) -> None:
    """Simulate an axlebox in the tier `full`, and record it."""
    base: dict[str, Any] = write_noun(bd.scene(BASE))
    structure: dict[str, Any] = {"kind": "modes", "table": "high_speed"}
    structure |= {"stiffness_factor": box.frequency**2, "damping_factor": box.damping}
    sensor = {**base["sensors"][0], "noise_density_m_per_s2_per_sqrt_Hz": box.noise}
    bd.simulate(
        BASE,
        tier="full",
        effects={"preset": "auto", "structure": structure},
        background={**base["background"], "amplitude_factor": box.background},
        sensors=[sensor],
        end_play_mm=box.end_play,
        seed=box.seed,
        scatter={**base["scatter"], "seed": box.lot},
        duration=SECONDS,
        record=path,
        progress=True,
    )


def found_of(box: Hidden, folder: Path) -> dict[str, Any]:
    """Play an axlebox and calibrate a twin in `quasistatic`; what a folder has of it is not done again."""
    recording, result = folder / f"{box.name}.mcap", folder / f"{box.name}.json"
    if not recording.exists():
        play(box, recording)

    def calibrated() -> Any:
        found = calibrate(
            recording, BASE, folder / f"{box.name}.yaml", budget=BUDGET, progress=True, force=True
        )
        return plain(json_object(found))

    told: dict[str, Any] = kept_json(result, calibrated)
    return told


def rows(box: Hidden, found: dict[str, Any]) -> list[str]:
    """Write truth beside fit, a row for each unknown."""
    lines = []
    for unknown, told in zip(UNKNOWNS, found["unknowns"], strict=True):
        truth = getattr(box, unknown.name)
        low, high = told["interval_90"]
        missed = "" if low <= truth <= high else ", missed"
        fit = f"left at {told['base']:.3g}" if told["reason"] else f"**{told['value']:.3g}**"
        lines.append(
            f"| {box.name} | {unknown.words} | {truth:g} | {fit} | {low:.3g} to {high:.3g}{missed} | "
            f"{100 * told['share_of_range']:.0f} % |"
        )
    return lines
