"""The scene of one axlebox as a file: that of the base with fitted values, and what is known of each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from beardyn_core.base.edge import write_noun
from beardyn_core.calibration.fitting import Fit
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.scene import Scene


def scene_keys(
    base: Scene | Path, twin: Scene, fits: tuple[Fit, ...], sensor: int, folder: Path
) -> dict[str, Any]:
    """Give the mapping of the fitted scene, for a file in a folder.

    Parameters
    ----------
    base : Scene or Path
        Of a file its keys are kept, references and what is left open with ``auto`` included.
    twin : Scene
        That of the base in the tier of the twin.
    fits : tuple of Fit
        Those with a reason are left out.
    sensor : int
        Number of the accelerometer that was used.
    folder : Path
        Of the file to write: files next to that of the base are named by their whole path in another one.
    """
    data = write_noun(base) if isinstance(base, Scene) else read_file(base)
    home = Path() if isinstance(base, Scene) else base.parent
    if home.resolve() != folder.resolve() and not isinstance(base, Scene):
        data = _locate_files(data, home)
    if "sensors" not in data:
        data["sensors"] = [write_noun(each) for each in twin.sensors]
    for fit in fits:
        if not fit.reason:
            data = fit.unknown.write_into(data, sensor, fit.value, home)
    return data


def _locate_files(value: Any, home: Path) -> Any:
    """Write names of files next to the scene as whole paths; shipped names stay."""
    if isinstance(value, dict):
        return {key: _locate_files(each, home) for key, each in value.items()}
    if isinstance(value, list):
        return [_locate_files(each, home) for each in value]
    if isinstance(value, str) and "." in value and (home / value).is_file():
        return str((home / value).resolve())
    return value


def scene_text(data: dict[str, Any], sentences: list[str]) -> str:
    """Write the scene with sentences as comments above it."""
    head = "".join(f"# {line}\n" for line in sentences)
    return f"{head}\n{yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=100)}"
