"""Where the shipped configuration lies."""

from __future__ import annotations

import os
import site
import sys
from collections.abc import Iterator
from pathlib import Path

from beardyn_core.base.errors import InputError


def _candidates() -> Iterator[Path]:
    if chosen := os.environ.get("BEARDYN_CONFIG"):
        yield Path(chosen)
        return
    yield Path(__file__).resolve().parents[2] / "config"  # a source checkout
    prefixes = [sys.prefix, site.getuserbase(), *os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)]
    for prefix in prefixes:
        if prefix:
            yield Path(prefix) / "share" / "beardyn" / "config"


def config_folder() -> Path:
    """Find the folder of the shipped configuration.

    It is ``$BEARDYN_CONFIG`` when that is set; else the checkout's own, else ``share/beardyn/config`` of the
    environment, of the user's packages or of a sourced ROS 2 workspace, whichever is there first.

    Raises
    ------
    InputError
        With every place searched, when there is none.
    """
    candidates = list(dict.fromkeys(_candidates()))
    for folder in candidates:
        if (folder / "scenes").is_dir() or (folder / "bearings").is_dir():
            return folder
    searched = ", ".join(str(folder) for folder in candidates)
    raise InputError(
        f"the configuration folder was not found; searched {searched}; "
        "install with `pip install .` or set BEARDYN_CONFIG to the folder that holds bearings and scenes"
    )
