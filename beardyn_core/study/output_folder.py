"""The option ``--output DIR`` of commands that write a folder."""

from __future__ import annotations

import os
from pathlib import Path


def folder_problems(folder: Path | None) -> list[str]:
    """Why a folder cannot be written to or made, in a sentence; nothing is created.

    Parameters
    ----------
    folder : Path or None
        As given; ``None``: not given.
    """
    if folder is None:
        return []
    if folder.exists() and not folder.is_dir():
        return [f"--output {folder}: is a file; give the name of a folder"]
    if not folder.is_dir() and not folder.parent.is_dir():
        return [f"--output {folder}: the folder {folder.parent} does not exist; create it first"]
    if not os.access(folder if folder.is_dir() else folder.parent, os.W_OK):
        return [f"--output {folder}: cannot be written; choose a folder you may write to"]
    return []
