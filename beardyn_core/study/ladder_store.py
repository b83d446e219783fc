"""Runs of an accuracy study in a file, from which an interrupted one goes on; a finished one leaves none.

A level is timed whole in one go: where an interrupt left some of its runs, all of them are run again. Times
of another machine do not count, nor do runs of other code, of another scene or of other windows.
"""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.config import scene_text
from beardyn_core.config.content import files_of
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Entry, Layout, Store
from beardyn_core.study.level_run import Attempt, Comparison, Run
from beardyn_core.study.measures import Outcome

if TYPE_CHECKING:
    from beardyn_core.base.arrays import Float

RUNS_FILE = "runs.jsonl"


def _values(arrays: tuple[Float, ...]) -> list[Any]:
    return [each.tolist() for each in arrays]


def _arrays(values: list[Any]) -> tuple[Float, ...]:
    return tuple(np.array(each, dtype=np.float64) for each in values)


def _to_json(entry: Entry[Run]) -> dict[str, Any]:
    found = entry.result.outcome
    return {
        "key": entry.key,
        "digest": entry.digest,
        "status": entry.result.status,
        "walls": entry.result.walls.tolist(),
        "whole": None if found is None else _values(found.whole),
        "windows": None if found is None else [_values(each) for each in found.windows],
    }


def _of_json(row: dict[str, Any]) -> Entry[Run]:
    found = None
    if row["whole"] is not None:
        found = Outcome(_arrays(row["whole"]), tuple(_arrays(each) for each in row["windows"]))
    return Entry(
        row["key"], row["digest"], Run(found, np.array(row["walls"], dtype=np.float64), row["status"])
    )


def store_of(comparison: Comparison, folder: Path | None) -> Store[Run]:
    """Give the store of a study; its first line identifies scene and windows."""
    about = {
        "accuracy_study": comparison.scene.name,
        "settling_s": comparison.settling,
        "compared_s": comparison.edges[-1] - comparison.edges[0],
    }
    return Store(None if folder is None else folder / RUNS_FILE, Layout(_to_json, _of_json), about)


def digests_of(items: Mapping[str, Attempt], comparison: Comparison) -> dict[str, str]:
    """Hash all that each run depends on: scene of its level and files in it, windows, code, machine."""
    common = repr((comparison.settling, comparison.edges, comparison.block_count, platform.node()))
    files = b"".join(path.read_bytes() for path in files_of(comparison.scene))
    found = {}
    for key, each in items.items():
        scene = scene_text(each.level.applied(comparison.scene))
        digest = hashlib.sha256(f"{scene}\n{each.number}\n{common}\n{simulator_digest()}\n".encode())
        digest.update(files)
        found[key] = digest.hexdigest()[:16]
    return found


def resume(plan: Plan[Attempt, Run], store: Store[Run]) -> Plan[Attempt, Run]:
    """Take up a study where its file has left it: levels of which all runs are there count as done.

    Raises
    ------
    InputError
        The file is of another study.
    """
    about = store.described
    if about is not None and about != store.about:
        raise InputError(
            f"{store.path}: is of an interrupted study of {about.get('accuracy_study', 'something else')} "
            "with other options; give another folder, or --force to start over and lose it"
        )
    found = store.resume(plan)
    cut_off = {each.place for key, each in plan.items.items() if key not in found.kept}
    whole = {key: run for key, run in found.kept.items() if plan.items[key].place not in cut_off}
    return replace(found, kept=whole)
