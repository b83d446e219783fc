"""Where what a user has made with this program and wants to keep lies, such as estimators."""

from __future__ import annotations

import os
from pathlib import Path


def data_root() -> Path:
    """Name the folder: ``$BEARDYN_DATA_DIR``, or in the user's data."""
    root = os.environ.get("BEARDYN_DATA_DIR")
    if root is None:
        home = os.environ.get("XDG_DATA_HOME", os.path.expanduser("~/.local/share"))
        root = os.path.join(home, "beardyn")
    return Path(root)
