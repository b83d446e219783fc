"""How many rollers a kernel takes at once depends on the processor, and no result on that."""

from __future__ import annotations

import numpy as np
import pytest

import beardyn_core.twin
from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.twin import Twin


def forces(width: int, tier: str, monkeypatch: pytest.MonkeyPatch) -> np.ndarray:
    monkeypatch.setattr(beardyn_core.twin, "LANE_WIDTH", width)
    scene = load_scene("static_80kN", duration=0.06, effects="dry", tier=tier)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, 0.06, scene.seed))
    return np.concatenate([twin.advance().force for _ in range(3)])


@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_four_lanes_give_the_forces_of_eight(tier: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Processors with AVX2 and with AVX-512; rollers in their pockets multiply what rounding differs by."""
    four, eight = (forces(width, tier, monkeypatch) for width in (4, 8))
    assert len(four) >= 10
    np.testing.assert_allclose(four, eight, rtol=0.0, atol=1e-6 if tier == "lumped" else 0.01)
