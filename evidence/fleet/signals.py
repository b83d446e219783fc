"""Recordings of a year from a small set of short twin runs: stages of spalls, scaled and with fresh noise.

What is simulated: 25 runs of 3 s of the scene `cup_spall` at 200 km/h, tier quasistatic, each with a spall
of a width, on the outer or the inner ring, or none, and the scene with a wheel flat. What is not: every
recording is 1.6 s of one of these runs times a gain of its box, its ride, its season and its wheel, with
noise of its own. A spall grows in the steps of the widths, and the track is that of the runs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.patch import Patch
from evidence.runner import Arrays, kept_arrays

SECONDS, RATE = 3.0, 25_600.0
RECORDED = 1.6  # of a run in a recording, from anywhere in it, [s]
WIDTHS_MM = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0)
HEALTHY = 4  # runs, of other bearings as made
NOISE = 1.5  # deviation of the noise of a sensor, [m/s^2]
STEP = 0.02  # of a number in a file, [m/s^2]


class TwinRun(NamedTuple):
    """Vertical acceleration and angle of one run."""

    acceleration: A[Float, "shape [sample], [m/s^2]"]
    angle: A[Float, "of the shaft, shape [sample], [rad]"]


def names() -> Iterator[str]:
    """Name the runs of the set."""
    yield from (f"healthy_{seed}" for seed in range(HEALTHY))
    yield from (f"{part}_{width:g}" for part in ("cup", "cone") for width in WIDTHS_MM)
    yield "flat_0"


def twin_run(name: str, kept: Path | None = None) -> TwinRun:
    """Simulate one run of the set, or take it from where an earlier go has kept it."""

    def simulated() -> Arrays:
        kind, _, number = name.partition("_")
        content = read_file(find("scenes", "cup_spall"))
        if kind == "flat":  # on the same track at the same speed, and no spall
            flat = {"kind": "flat", "shape": "fresh", "length_mm": 35, "azimuth_deg": 0}
            content = {
                **content,
                "defects": [],
                "operation": {**content["operation"], "wheel_defects": [flat]},
            }
        scene = bd.scene(content, tier="quasistatic")
        defects = scene.defects
        if kind != "flat":
            spall = defects[0]
            assert isinstance(spall, Patch)
            defects = () if kind == "healthy" else (replace(spall, on=kind, width=1e-3 * float(number)),)
        seed = 100 + int(number) if kind == "healthy" else 21
        run = bd.simulate(replace(scene, defects=defects, seed=seed), duration=SECONDS)
        angle = np.interp(run.vibration.time_ns, run.shaft.time_ns, np.unwrap(run.shaft.angle))
        return {"acceleration": run.vibration.values[:, 2].astype(np.float32), "angle": angle}

    found = kept_arrays(None if kept is None else kept / f"{name}.npz", simulated)
    return TwinRun(found["acceleration"].astype(np.float64), found["angle"])


def write_recording(path: Path, run: TwinRun, gain: float, random: np.random.Generator) -> None:
    """Write a recording as NumPy arrays: acceleration in steps of a sensor, and one pulse a turn."""
    count = round(RECORDED * RATE)
    begin = int(random.integers(len(run.angle) - count))
    part = run.acceleration[begin : begin + count]
    signal = gain * (part - part.mean()) + random.normal(0.0, NOISE, count)
    write_arrays(path, signal, run.angle[begin : begin + count])


def write_arrays(path: Path, signal: Float, angle: Float) -> None:
    """Write acceleration [m/s^2] and a tachometer of one pulse a turn."""
    pulses = (np.mod(angle, 2.0 * np.pi) < 0.6).astype(np.int8)
    np.savez(path, z=np.clip(np.round(signal / STEP), -32_000, 32_000).astype(np.int16), tacho=pulses)
