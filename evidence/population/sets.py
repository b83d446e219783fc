"""The sets that the learner is tested on besides its own: other speeds, another box, another tier."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import beardyn_core as bd
from beardyn_core.config.automatic import AUTO
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.population.folder import SUMS
from beardyn_core.population.labelled_set import LabelledSet

TRAINED = "spalls"
SPEED = "operation.speed_profile[0].speed_kmh"
# what differs from the sweep that the learner is trained on: keys that are set, and keys that are drawn
OTHERS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "other speeds": ({}, {SPEED: {"kind": "uniform", "low": 180.0, "high": 260.0}}),
    "another tier": ({"tier": "quasistatic"}, {}),
    "a box that rings": (
        {"effects": {"preset": AUTO, "structure": {"kind": "modes", "table": "high_speed"}}},
        {},
    ),
}
_SEED = 2  # other bearings, tracks and spalls than those of the training


def other_sweep(name: str, runs: int) -> dict[str, Any]:
    """Give the keys of a sweep of `OTHERS`."""
    data = read_file(find("sweeps", TRAINED))
    changes, drawn = OTHERS[name]
    vary = [{**each, **drawn.get(each["key"], {})} for each in data["vary"]]
    return {
        **data,
        "sweep": name,
        "set": {**data["set"], **changes},
        "vary": vary,
        "runs": runs,
        "runs_per_bearing": 1,
        "seed": _SEED,
    }


def trained_set(folder: Path, runs: int | None, workers: int | None) -> LabelledSet:
    """Open the set that the learner is trained on, or make it, or take it up where it was."""
    folder.mkdir(exist_ok=True)
    if (folder / TRAINED / SUMS).is_file():
        return LabelledSet(folder / TRAINED)
    changes: dict[str, Any] = {} if runs is None else {"runs": runs}
    return bd.sweep(TRAINED, folder / TRAINED, workers=workers, progress=True, **changes)


def other_set(name: str, folder: Path, runs: int, workers: int | None) -> LabelledSet:
    """Make a set of `OTHERS` in a folder, or take it up where it was; one that is complete is opened."""
    folder.mkdir(exist_ok=True)
    own = folder / name.replace(" ", "_")
    if (own / SUMS).is_file():
        return LabelledSet(own)
    return bd.sweep(other_sweep(name, runs), own, workers=workers, progress=True)
