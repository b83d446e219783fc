"""The folder of a set while it is made: what is done, for which sweep and by which code."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, BinaryIO

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import is_being_written, open_to_append, write_whole
from beardyn_core.base.versions import versions
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.population.batch import Batch
from beardyn_core.population.plan import Plan
from beardyn_core.population.store import SIGNALS, forget
from beardyn_core.population.table import FEATURES, RUNS

ABOUT, JOURNAL, CARD, SUMS = "set.json", "journal.jsonl", "README.md", "SHA256SUMS"
FILES = (ABOUT, JOURNAL, CARD, SUMS, RUNS, FEATURES)
_FORMAT = 1


def read_about(folder: Path) -> dict[str, Any]:
    """Read what a set says about itself.

    Raises
    ------
    InputError
        The folder is no set.
    """
    try:
        found = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(
            f"{folder}: is no set of runs: it has no {ABOUT}; `beardyn sweep` makes one"
        ) from None
    except (OSError, ValueError) as error:
        raise InputError(f"{folder / ABOUT}: cannot be read: {error}") from None
    if not isinstance(found, dict) or found.get("format") != _FORMAT:
        raise InputError(f"{folder / ABOUT}: is not what this version writes (format {_FORMAT})")
    return found


def folder_of_set_problems(folder: Path, plan: Plan, *, force: bool) -> list[str]:
    """List why the runs of a plan cannot go into a folder; nothing is created."""
    if is_being_written(folder / JOURNAL):
        return [f"{folder}: another sweep is writing this set; wait for its end or give another folder"]
    if not folder.is_dir() or not any(folder.iterdir()):
        return []
    if not (folder / ABOUT).is_file():
        return [f"{folder}: holds files and no set of runs; give a new folder, for nothing there is replaced"]
    if force:
        return []
    about = read_about(folder)
    count = len(done_rows(folder))
    lose = "give another folder, or --force to start over and lose them"
    mine, there = plan.identity, about["identity"]
    different = [name for name in dict.fromkeys([*mine, *there]) if mine.get(name) != there.get(name)]
    if different:
        what = ", ".join("the scene" if name == "base" else name for name in different)
        return [f"{folder}: its {count} runs are of another sweep ({what} differ); {lose}"]
    if about["code"] != simulator_digest():
        return [
            f"{folder}: its {count} runs are of other code (digest {about['code']}, this is "
            f"{simulator_digest()}), and runs of both would not go together; {lose}"
        ]
    if about["runs"] > plan.sweep.run_count and count > plan.sweep.run_count:
        return [
            f"{folder}: has {count} runs, more than the {plan.sweep.run_count} that are asked for; "
            "ask for as many or more, or give another folder"
        ]
    return []


def begin(folder: Path, plan: Plan, *, fresh: bool) -> dict[str, Any]:
    """Make the folder, or take one up again; gives what it says about itself."""
    folder.mkdir(exist_ok=True)
    if fresh:
        for name in FILES:
            with suppress(FileNotFoundError):
                (folder / name).unlink()
        forget(folder)
    if (folder / ABOUT).is_file():
        about = read_about(folder) | {"runs": plan.sweep.run_count}
    else:
        about = {
            "format": _FORMAT,
            "sweep": plan.sweep.name,
            "purpose": plan.sweep.purpose,
            "licence": plan.sweep.licence,
            "runs": plan.sweep.run_count,
            "begun": datetime.now(UTC).isoformat(timespec="seconds"),
            "code": simulator_digest(),
            "versions": versions(),
            "chosen": list(plan.chosen),
            "identity": plan.identity,
        }
    write_about(folder, about)
    return about


def write_about(folder: Path, about: dict[str, Any]) -> None:
    """Write what a set says about itself."""
    write_whole(folder / ABOUT, json.dumps(about, indent=1, default=str) + "\n")


def done_rows(folder: Path) -> dict[int, dict[str, Any]]:
    """Read the runs that are done, by number: labels, features, times, worker and its memory."""
    found: dict[int, dict[str, Any]] = {}
    path = folder / JOURNAL
    if not path.is_file():
        return found
    with path.open(encoding="utf-8", errors="replace") as lines:
        for line in lines:
            with suppress(ValueError, TypeError, KeyError):  # the last one may be cut off
                for made in json.loads(line)["made"]:
                    found[int(made["labels"]["run"])] = made
    return found


class Journal:
    """File that gets a line for every task that is done, after its signals are written."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / JOURNAL
        with disk(self._path):
            self._file: BinaryIO = open_to_append(self._path)

    def add(self, batch: Batch) -> list[dict[str, Any]]:
        """Add runs that are done."""
        made = [
            {
                "labels": plain(each.labels),
                "features": plain(each.features),
                "seconds": round(each.seconds, 4),
                "processor": round(each.processor, 4),
                "worker": batch.worker,
                "memory": batch.memory,
            }
            for each in batch.made
        ]
        line = (json.dumps({"made": made}) + "\n").encode()
        with disk(self._path):
            while line:  # a disk that is nearly full takes a part
                line = line[self._file.write(line) :]
        return made

    def close(self) -> None:
        """Close the file, which unlocks it."""
        self._file.close()


@contextmanager
def disk(path: Path) -> Iterator[None]:
    """Turn a full disk into a sentence."""
    try:
        yield
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written: {error.strerror or error}; the runs before are kept, and the same "
            "command goes on from there"
        ) from error


def plain(value: Any) -> Any:
    """Turn what a run says into strict JSON: NaN to null, numbers of NumPy to those of Python."""
    if isinstance(value, dict):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def size_of(folder: Path) -> int:
    """Measure the signals of a set, [byte]."""
    return sum(path.stat().st_size for path in (folder / SIGNALS).rglob("*") if path.is_file())


def numbers_missing(count: int, done: Sequence[int] | dict[int, Any]) -> list[int]:
    """List the numbers of runs that are still to be done."""
    there = set(done)
    return [run for run in range(count) if run not in there]
