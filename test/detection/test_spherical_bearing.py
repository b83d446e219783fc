"""Spalls of a spherical bearing of a loaded wagon: the monitor names each part, none if healthy."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import scene_from_mapping
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.monitor.streaming import Monitor, MonitorInput
from beardyn_core.run import blocks

DURATION = 4.6  # 40 turns of the shaft


def scene_of(tier: str, **defect: Any) -> Any:
    """The shipped wagon with background and scatter, in a rigid box, with another spall or none."""
    path = find("scenes", "freight_spherical_cup")
    keys = {**read_file(path), "tier": tier, "effects": "standard"}
    keys["sensors"] = [{**keys["sensors"][0], "position_mm": [0, 0, 190]}]
    keys["defects"] = [{**keys["defects"][0], **defect}] if defect else []
    return scene_from_mapping(keys, "wagon", path.parent)


def last_verdicts(scene: Any, count: int = 3) -> list[str]:
    monitor = Monitor(fault_frequencies(scene.bearing), scene.bearing.roller_count)
    found = []
    for block in blocks(replace(scene, duration=DURATION), DURATION):
        result = monitor.take(MonitorInput.of_block(block))
        if result is not None and result.verdict != "waiting":
            found.append(result.verdict)
    return found[-count:]


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
    verdicts = last_verdicts(scene_of(tier, **defect))
    assert set(verdicts) <= {defect["on"], "healthy"}
    assert defect["on"] in verdicts


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_a_healthy_bearing_is_named_healthy(tier: str) -> None:
    assert set(last_verdicts(scene_of(tier))) == {"healthy"}
