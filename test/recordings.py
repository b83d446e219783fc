"""Recordings that tests read: of synthetic runs, and of signals as a measuring program leaves them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.record.sinks import McapSink
from test.record.synthetic_run import SyntheticRun, description

MEASURED_RATE = 25_600.0


def write_recording(
    path: Path, blocks: int, sensors: tuple[str, ...] = ("axlebox_top", "axlebox_end")
) -> Path:
    """Record a synthetic run of some blocks."""
    run = description(duration=blocks * 0.02, sensors=sensors)
    sink = McapSink(path)
    sink.open(run)
    for block in SyntheticRun(sensor_count=len(sensors)).blocks(blocks):
        sink.write(block)
    sink.close()
    return path


def import_signal(
    path: Path,
    acceleration: Float,
    *,
    bearing: str = "HS130x230",
    rate: float = MEASURED_RATE,
    speed_rpm: float = 1200.0,
    **options: Any,
) -> Path:
    """Import a measured signal, shape [sample, axis], [m/s^2], as a recording of a bearing."""
    measured = path.parent / "measured.npz"
    np.savez(measured, acceleration=acceleration, fs=rate)
    return bd.import_measured(measured, path, bearing=bearing, unit="m/s2", speed_rpm=speed_rpm, **options)


def import_noise(
    path: Path, seed: int = 1, seconds: float = 3.2, rate: float = MEASURED_RATE, **options: Any
) -> Path:
    """Import noise on three axes as a recording of a bearing."""
    noise = np.random.default_rng(seed).normal(0.0, 1.0, (round(seconds * rate), 3))
    return import_signal(path, noise, rate=rate, **options)
