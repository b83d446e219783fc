"""Close a set: the table with its splits, the data card, the checksums; and check them later."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import write_whole
from beardyn_core.experiments import Cluster
from beardyn_core.population.data_card import card_text
from beardyn_core.population.difficulty import difficulty_of
from beardyn_core.population.features import UNITS as FEATURE_UNITS
from beardyn_core.population.folder import CARD, SUMS, read_about, write_about
from beardyn_core.population.signal_store import SIGNALS
from beardyn_core.population.sweep_scenes import SweepScenes
from beardyn_core.population.table import FEATURES, RUNS, splits_of, write_table

_FIRST = ("run", "bearing_id", "split", "status", "reason", "condition")
_READ = 1 << 20


def close_set(
    folder: Path,
    scenes: SweepScenes,
    about: dict[str, Any],
    done: Mapping[int, Mapping[str, Any]],
    cluster: Cluster,
) -> None:
    """Write the tables, the card and the checksums of the runs that are done."""
    made = [done[run] for run in sorted(done)]
    if not made:
        return
    labels = [dict(each["labels"]) for each in made]
    parts = splits_of([row["bearing_id"] for row in labels], scenes.sweep.split, scenes.sweep.seed)
    rows = []
    for row, part in zip(labels, parts, strict=True):
        row["split"] = part if row["bearing_id"] else None
        rows.append({name: row.get(name) for name in _FIRST} | row)
    facts = {key: about[key] for key in ("sweep", "licence", "code", "versions")}
    write_table(folder / RUNS, rows, {}, facts)
    features = [{"run": row["run"], **each["features"]} for row, each in zip(rows, made, strict=True)]
    write_table(folder / FEATURES, features, FEATURE_UNITS, facts)
    seconds, processor = (sorted(float(each[name]) for each in made) for name in ("seconds", "processor"))
    about["done"] = len(made)
    about["failed"] = sum(row["status"] != "complete" for row in rows)
    about["seconds_a_run"] = {"median": seconds[len(seconds) // 2], "total": sum(seconds)}
    about["processor_seconds_a_run"] = {
        "median": processor[len(processor) // 2],
        "total": round(sum(processor), 3),
    }
    about["most_memory"] = max(int(each["memory"]) for each in made)
    about["processes"] = len({each["worker"] for each in made})
    about["parts"] = dict(Counter(row["split"] for row in rows if row["split"]))
    about["split"] = scenes.sweep.split.shares
    about["difficulty"] = difficulty_of(rows, features, scenes.sweep.seed)
    write_about(folder, about)
    write_whole(folder / CARD, card_text(scenes, about, rows))
    write_sums(folder)


def write_sums(folder: Path) -> None:
    """Write the checksums of all files of a set, as `sha256sum -c` reads them."""
    lines = [f"{_sum(path)}  {path.relative_to(folder).as_posix()}" for path in _files(folder)]
    write_whole(folder / SUMS, "\n".join(lines) + "\n")


def verify(folder: Path) -> list[str]:
    """List what is not as it was when the set was closed: files that differ, are missing or are new.

    Raises
    ------
    InputError
        The folder is no set, or has no checksums.
    """
    read_about(folder)
    if not (folder / SUMS).is_file():
        raise InputError(f"{folder}: has no {SUMS}: its sweep is not finished; the same command goes on")
    told = {}
    for line in (folder / SUMS).read_text(encoding="utf-8").splitlines():
        digest, _, name = line.partition("  ")
        told[name] = digest
    found = {path.relative_to(folder).as_posix(): path for path in _files(folder)}
    problems = [f"{folder / name}: is missing" for name in told if name not in found]
    for name, path in found.items():
        if name not in told:
            problems.append(f"{path}: was not there when the set was closed")
        elif _sum(path) != told[name]:
            problems.append(f"{path}: is not what it was when the set was closed")
    return problems


def _files(folder: Path) -> list[Path]:
    """List the files of a set that are kept: not the checksums, and not the journal of what is done."""
    from beardyn_core.population.folder import ABOUT, JOURNAL

    own = [folder / name for name in (ABOUT, CARD, RUNS, FEATURES, JOURNAL) if (folder / name).is_file()]
    return sorted([*own, *(path for path in (folder / SIGNALS).rglob("*") if path.is_file())])


def _sum(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while part := file.read(_READ):
            digest.update(part)
    return digest.hexdigest()
