"""Lines of FTF are found where something comes once a turn of the cage, and not in noise."""

from __future__ import annotations

import math

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.config import load_bearing
from beardyn_core.monitor.chain import MonitorSettings, Stretch
from evidence.trial.worn_pockets import cage_lines, way_behind

BEARING = load_bearing("HS130x230")
RATE, SHAFT, REVOLUTIONS = 12_000.0, 15.0, 60.0


@pytest.mark.parametrize("louder", [0.0, 1.5])
def test_what_is_louder_once_a_turn_of_the_cage_passes_the_alarm_and_noise_does_not(louder: float) -> None:
    ftf = fault_frequencies(BEARING).ftf
    turned = np.arange(int(REVOLUTIONS / SHAFT * RATE)) * SHAFT / RATE
    loud = 1.0 + louder * ((0.997 * ftf * turned) % 1.0 < 0.08)
    signal = np.random.default_rng(3).normal(size=len(turned)) * loud
    stretch = Stretch(RATE, signal, np.asarray(2.0 * math.pi * turned, np.float64), math.nan, 0)
    (found,) = cage_lines(stretch, ftf, MonitorSettings()).candidates
    assert (found.score >= found.threshold) == (louder > 0.0)
    if louder:
        assert found.order == pytest.approx(0.997 * ftf, rel=2e-3)


def test_a_roller_that_lags_in_the_zone_alone_is_behind_by_its_way_there() -> None:
    cage = np.linspace(0.0, 40.0 * math.pi, 20_001)
    places = cage[:, None] + 2.0 * math.pi * np.arange(BEARING.roller_count) / BEARING.roller_count
    lag = 0.01 * (np.cos(places) > 0.5)
    late = way_behind(BEARING, places - lag, cage, 3)
    assert late == pytest.approx(0.01 * 0.5 * BEARING.pitch_diameter, rel=1e-9)
