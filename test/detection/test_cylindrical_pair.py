"""Spalls of a cylindrical pair in a loaded wagon in service: the monitor names each part, none if healthy."""

from __future__ import annotations

from typing import Any

import pytest

from beardyn_core.choice import load_scene
from test.detection.wagons import assert_named, last_verdicts, scene_of

WAGON, ABOVE = "freight_cylindrical_cup", 170.0
LOCOMOTIVE = "locomotive_cylindrical_cup"


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
@pytest.mark.parametrize(
    "defect",
    [
        {"on": "cup", "length_mm": 40, "width_mm": 8},
        {"on": "cone", "length_mm": 25},
        {"on": "roller", "roller": 3, "length_mm": 25},
    ],
    ids=["cup", "cone", "roller"],
)
def test_a_spall_of_each_part_is_named(tier: str, defect: dict[str, Any]) -> None:
    assert_named(defect["on"], last_verdicts(scene_of(tier, WAGON, ABOVE, **defect)))


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_a_healthy_pair_is_named_healthy(tier: str) -> None:
    assert set(last_verdicts(scene_of(tier, WAGON, ABOVE))) == {"healthy"}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [71, 72, 73, 74])
def test_a_healthy_pair_as_shipped_is_named_healthy_in_full(seed: int) -> None:
    scene = load_scene("freight_cylindrical", tier="full", seed=seed, effects="auto")
    assert set(last_verdicts(scene, count=6)) == {"healthy"}


@pytest.mark.slow
@pytest.mark.parametrize("defect", [{}, {"on": "cup"}], ids=["healthy", "cup"])
def test_a_spalled_outer_ring_of_a_locomotive_is_named_and_a_healthy_one_is_not(
    defect: dict[str, Any],
) -> None:
    verdicts = last_verdicts(scene_of("quasistatic", LOCOMOTIVE, ABOVE, **defect))
    assert set(verdicts) == {defect.get("on", "healthy")}
