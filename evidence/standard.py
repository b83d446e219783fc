"""Shipped scenes with the standard effects, which many pages are about."""

from __future__ import annotations

from typing import Any

from beardyn_core.choice import load_scene
from beardyn_core.config.automatic import names_a_box
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.scene import Scene

STANDARD = "standard"


def standard_scene(name: str, **changes: Any) -> Scene:
    """Load a shipped scene with the standard effects, in its own box where that rings.

    Parameters
    ----------
    name : str
    **changes
        Further arguments of `beardyn_core.choice.load_scene`.
    """
    return load_scene(name, effects=standard_effects(name), **changes)


def standard_effects(name: str) -> dict[str, Any]:
    """Write the standard effects for a shipped scene, in its own box where that rings."""
    written = read_file(find("scenes", name)).get("effects", {})
    box = {"structure": written["structure"]} if names_a_box(written) else {}
    return {"preset": STANDARD, **box}
