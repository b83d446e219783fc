"""Where everything lies that is kept from run to run: kernels, choices, meshes."""

from __future__ import annotations

import os
from pathlib import Path


def cache_root() -> Path:
    """Name the folder: ``$BEARDYN_CACHE_DIR``, or in the user's cache."""
    root = os.environ.get("BEARDYN_CACHE_DIR")
    if root is None:
        root = os.path.join(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache")), "beardyn")
    return Path(root)
