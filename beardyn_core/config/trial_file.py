"""The trial file: a matrix of faults, sizes, speeds, tracks and wheels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from beardyn_core.config.folders import find
from beardyn_core.config.load import read_noun
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.trial import Trial


def read_trial(name: str | Path, *, tier: str | None = None, seed: int | None = None) -> tuple[Trial, Path]:
    """Read the trial of a shipped name or of a file, its sizes in order, and find its path.

    Parameters
    ----------
    tier, seed : optional
        Instead of the file's; with another tier the check falls away where it is the same one.

    Raises
    ------
    InputError
        With every mistake in the file.
    """
    path = find("trials", str(name))
    data = read_file(path)
    if tier is not None:
        data["tier"] = tier
        if isinstance(data.get("check"), dict) and data["check"].get("tier") == tier:
            del data["check"]
    if seed is not None:
        data["seed"] = seed
    trial: Trial = read_noun(Trial, data, str(path))
    return replace(trial, folder=path.parent, sizes=tuple(sorted(trial.sizes))), path
