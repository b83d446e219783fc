"""Spalls of a spherical bearing of a loaded wagon: the monitor names each part, none if healthy."""

from __future__ import annotations

from typing import Any

import pytest

from test.detection.wagons import assert_named, last_verdicts, scene_of

WAGON, ABOVE = "freight_spherical_cup", 190.0


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
@pytest.mark.parametrize(
    "defect",
    [
        {"on": "cup", "length_mm": 20, "width_mm": 8},
        {"on": "cone", "length_mm": 20},
        {"on": "roller", "roller": 3, "length_mm": 20},
    ],
    ids=["cup", "cone", "roller"],
)
def test_a_spall_of_each_part_is_named(tier: str, defect: dict[str, Any]) -> None:
    assert_named(defect["on"], last_verdicts(scene_of(tier, WAGON, ABOVE, **defect)))


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_a_healthy_bearing_is_named_healthy(tier: str) -> None:
    assert set(last_verdicts(scene_of(tier, WAGON, ABOVE))) == {"healthy"}
