"""Scenes of the tests of the choice: shipped ones and variants of them."""

from __future__ import annotations

from typing import Any

import yaml

from beardyn_core.choice import scene_from_text
from beardyn_core.scene.scene import Scene

BASE: dict[str, Any] = {
    "scene": "variant",
    "bearing": "HS130x230",
    "lubricant": "L055",
    "temperature_C": 70,
    "end_play_mm": 0.0,
    "effects": "auto",
    "operation": {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1165},
    "mounting": {"cup": "suspended", "journal_tilt": "locked"},
    "duration_s": 1.0,
}
HELD = {"cup": "held", "journal_tilt": "locked"}
SPALL = {
    "kind": "spall",
    "on": "cup",
    "row": 0,
    "azimuth_deg": 0,
    "width_mm": 6,
    "depth_um": 100,
    "length_mm": 25,
}


def constant(force: list[float], speed: float = 1165) -> dict[str, Any]:
    """One load [kN] and one speed [1/min]."""
    return {"kind": "constant", "force_kN": force, "speed_rpm": speed}


def variant(**keys: Any) -> Scene:
    """Scene of the base with other keys; `None` leaves a key out."""
    written = {key: value for key, value in {**BASE, **keys}.items() if value is not None}
    return scene_from_text(yaml.safe_dump(written))


def reasons(scene: Scene) -> dict[str, str]:
    """What was chosen, by the first word of its sentence."""
    return {sentence.split(" ", 1)[0]: sentence for sentence in scene.chosen}
