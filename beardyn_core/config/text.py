"""The text of a scene, written from its nouns: what is recorded cannot differ from what is run."""

from __future__ import annotations

from beardyn_core.config.yaml_text import write_mapping
from beardyn_core.edge import written
from beardyn_core.scene.scene import Scene


def scene_text(scene: Scene) -> str:
    """Write a scene as YAML: edge units, every reference resolved, every number.

    Returns
    -------
    str
        `beardyn_core.choice.scene_from_text` makes the same scene of it. A number of which no decimal in edge
        units is the exact value in SI comes back as its neighbour.
    """
    return write_mapping(written(scene))
