"""Where what is kept from run to run lies: kernels, choices, meshes; and what came with the package."""

from __future__ import annotations

import os
from pathlib import Path


def cache_root() -> Path:
    """Name the folder: ``$BEARDYN_CACHE_DIR``, or in the user's cache."""
    root = os.environ.get("BEARDYN_CACHE_DIR")
    if root is None:
        root = os.path.join(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache")), "beardyn")
    return Path(root)


def shipped_root() -> Path:
    """Name the folder that the build of a wheel fills like `cache_root`; nothing is written there later."""
    return Path(__file__).parents[1] / "shipped"
