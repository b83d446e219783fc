"""Runs of shipped wagons with another spall or none, and what the monitor says of them at last."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import scene_from_mapping
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.monitor.streaming import Monitor, MonitorInput
from beardyn_core.run import blocks

DURATION = 4.6  # 40 turns of the shaft of a wagon, 26 of a locomotive


def scene_of(tier: str, shipped: str, above: float, **defect: Any) -> Any:
    """A shipped scene with background and scatter, in a rigid box, with another spall or none.

    ``above``: height of the sensor above the bearing centre [mm].
    """
    path = find("scenes", shipped)
    keys = {**read_file(path), "tier": tier, "effects": "standard"}
    keys["sensors"] = [{**keys["sensors"][0], "position_mm": [0, 0, above]}]
    keys["defects"] = [{**keys["defects"][0], **defect}] if defect else []
    return scene_from_mapping(keys, "wagon", path.parent)


def last_verdicts(scene: Any, count: int = 3) -> list[str]:
    """What the monitor names at its last analyses."""
    monitor = Monitor(fault_frequencies(scene.bearing), scene.bearing.roller_count)
    found = []
    for block in blocks(replace(scene, duration=DURATION), DURATION):
        result = monitor.take(MonitorInput.of_block(block))
        if result is not None and result.verdict != "waiting":
            found.append(result.verdict)
    return found[-count:]


def assert_named(part: str, verdicts: Sequence[str]) -> None:
    """Most verdicts name the part, none another one."""
    assert set(verdicts) <= {part, "healthy"}
    assert 2 * list(verdicts).count(part) > len(verdicts)
