"""Waviness as periodic gap tables."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.fault_parameters import WaveParams
from beardyn_core.scene.scene import Scene

POINTS_PER_WAVE = 64  # linear interpolation is then good to 0.12 % of the amplitude of the shortest wave


def wave_params(scene: Scene, on: str, arrangement: Arrangement) -> WaveParams | None:
    """Waviness of one surface as a table of one period per row or roller; ``None`` without any."""
    waves = [wave for wave in scene.waviness if wave.on == on]
    if not waves:
        return None
    points = max(1024, POINTS_PER_WAVE * max(max(wave.orders) for wave in waves))
    azimuth = np.arange(points + 2, dtype=np.float64) * (2.0 * math.pi / points)
    count = arrangement.roller_count if on == "roller" else 1
    tables = np.zeros((2, count, points + 2))
    for wave in waves:
        for roller in range(count):
            if wave.roller is None or on != "roller" or wave.roller == roller:
                tables[wave.row, roller] += wave.gap(azimuth, roller)
    first = np.arange(2 * count, dtype=float).reshape(2, count) * (points + 2)
    start = arrangement.to_lanes(np.broadcast_to(first, (2, arrangement.roller_count)))
    return WaveParams(tables.reshape(-1), np.ascontiguousarray(start[:, None, :]), float(points))
