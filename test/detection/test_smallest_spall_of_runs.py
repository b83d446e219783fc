"""The smallest spall of a healthy record is that of runs of the same scene with such a spall."""

from __future__ import annotations

from typing import Any

import pytest

import beardyn_core as bd

SCENE: dict[str, Any] = {"source": "service_high_speed", "tier": "quasistatic", "duration": 4.0, "seed": 3}


def verdict(width_mm: float) -> str:
    spall = {"kind": "field_spall", "on": "cup", "width_mm": width_mm}
    return bd.monitor(bd.simulate(bd.scene(**SCENE, faults=[spall]))).verdict


@pytest.mark.slow
def test_runs_with_the_smallest_spall_are_named_and_narrower_ones_missed() -> None:
    healthy = bd.simulate(bd.scene(**SCENE))
    assert bd.monitor(healthy).verdict == "healthy"
    cup = next(each for each in bd.smallest_spalls(healthy).spalls if each.part == "cup")
    assert 0.0 < cup.missed < cup.named < 15e-3
    # a step of the widths to either side: the roughness that they run over is another one
    assert verdict(1.5e3 * cup.named) == "cup"
    assert verdict(0.5e3 * cup.missed) == "healthy"
