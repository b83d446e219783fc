"""Bearings under a steady load, with nothing but their own dynamics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from beardyn_core.choice import scene_from_mapping
from beardyn_core.scene.scene import Scene

Force = tuple[float, float, float]


def steady_scene(
    bearing: str, tier: str, force: Force, rpm: float, tilt: str = "locked", **more: Any
) -> Scene:
    """A bearing under a steady load [kN], the cup held, with the standard effects."""
    return scene_from_mapping(
        {
            "scene": "steady",
            "bearing": bearing,
            "lubricant": "L055",
            "effects": "standard",
            "tier": tier,
            "operation": {"kind": "constant", "force_kN": list(force), "speed_rpm": rpm},
            "mounting": {"cup": "held", "journal_tilt": tilt},
            **more,
        },
        "steady",
        Path(),
    )
