"""The folder of a set while it is made: what is done, for which sweep and by which code."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import write_whole
from beardyn_core.base.plain_json import plain
from beardyn_core.base.versions import versions
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Entry, Layout, Store, differing
from beardyn_core.population.batch import Made
from beardyn_core.population.signal_store import SIGNALS, SignalStore, forget
from beardyn_core.population.sweep_scenes import SweepScenes
from beardyn_core.population.table import FEATURES, RUNS

ABOUT, JOURNAL, CARD, SUMS = "set.json", "journal.jsonl", "README.md", "SHA256SUMS"
FILES = (ABOUT, JOURNAL, CARD, SUMS, RUNS, FEATURES)
_FORMAT = 1
# a line for every task that is done, after its signals are written
LINES = Layout[dict[str, Any]](
    lambda each: each.result,
    lambda made: Entry(str(int(made["labels"]["run"])), "", made),
    group="made",
)


def read_about(folder: Path) -> dict[str, Any]:
    """Read what a set says about itself.

    Raises
    ------
    InputError
        The folder is no set.
    """
    try:
        # earlier versions wrote NaN, which is no JSON
        found = plain(json.loads((folder / ABOUT).read_text(encoding="utf-8")))
    except FileNotFoundError:
        raise InputError(
            f"{folder}: is no set of runs: it has no {ABOUT}; `beardyn sweep` makes one"
        ) from None
    except (OSError, ValueError) as error:
        raise InputError(f"{folder / ABOUT}: cannot be read: {error}") from None
    if not isinstance(found, dict) or found.get("format") != _FORMAT:
        raise InputError(f"{folder / ABOUT}: is not what this version writes (format {_FORMAT})")
    return found


def folder_of_set_problems(folder: Path, scenes: SweepScenes, *, force: bool) -> list[str]:
    """List why the runs of a sweep cannot go into a folder; nothing is created."""
    if Store(folder / JOURNAL, LINES).is_busy:
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
    asked, before = scenes.sweep.run_count, about["runs"]
    different = differing(scenes.identity, about["identity"])
    if different == ["runs"]:
        return [
            f"{folder}: is a set of {before} runs, and {asked} are asked for; sampling "
            f"{scenes.sweep.sampling} draws other runs for another number, only random and sobol continue "
            f"them: ask for {before}; or {lose}"
        ]
    if different:
        what = ", ".join("the scene" if name == "base" else name for name in different)
        return [f"{folder}: its {count} runs are of another sweep (different: {what}); {lose}"]
    if about["code"] != simulator_digest():
        return [
            f"{folder}: its {count} runs are of other code (digest {about['code']}, this is "
            f"{simulator_digest()}), and runs of both would not go together; {lose}"
        ]
    if before > asked and count > asked:
        return [
            f"{folder}: has {count} runs, more than the {asked} that are asked for; ask for as many or more, "
            "or give another folder"
        ]
    return []


def begin(folder: Path, scenes: SweepScenes, *, fresh: bool) -> dict[str, Any]:
    """Make the folder, or take one up again; gives what it says about itself."""
    folder.mkdir(exist_ok=True)
    if fresh:
        for name in FILES:
            with suppress(FileNotFoundError):
                (folder / name).unlink()
        forget(folder)
    if (folder / ABOUT).is_file():
        about = read_about(folder) | {"runs": scenes.sweep.run_count}
    else:
        about = {
            "format": _FORMAT,
            "sweep": scenes.sweep.name,
            "purpose": scenes.sweep.purpose,
            "licence": scenes.sweep.licence,
            "runs": scenes.sweep.run_count,
            "begun": datetime.now(UTC).isoformat(timespec="seconds"),
            "code": simulator_digest(),
            "versions": versions(),
            "chosen": list(scenes.chosen),
            "identity": scenes.identity,
        }
    write_about(folder, about)
    return about


def write_about(folder: Path, about: dict[str, Any]) -> None:
    """Write what a set says about itself."""
    write_whole(folder / ABOUT, json.dumps(plain(about), indent=1, allow_nan=False) + "\n")


def done_rows(folder: Path) -> dict[int, dict[str, Any]]:
    """Read the runs that are done, by number: labels, features, times, worker and its memory."""
    return {int(each.key): each.result for each in Store(folder / JOURNAL, LINES).entries()}


class SetStore(Store[dict[str, Any]]):
    """The journal of a set, and the signals that are written before each of its lines.

    Parameters
    ----------
    folder : Path
    says : dict
        What the set says about itself; gets what is learnt of the machine.
    """

    def __init__(self, folder: Path, says: dict[str, Any]) -> None:
        super().__init__(folder / JOURNAL, LINES)
        self._folder, self._says = folder, says
        self._signals: SignalStore | None = None

    @contextmanager
    def opened(self, plan: Plan[Any, Any]) -> Iterator[None]:
        """Lock the journal, and make room for the signals of runs that are missing."""
        with super().opened(plan):
            if plan.missing:
                self._signals = SignalStore(self._folder, len(plan.items), plan.together)
            yield

    def add(self, entries: Sequence[Entry[Any]]) -> list[Entry[Any]]:
        """Add the results of a task, `Made` as they are; gives the rows of the journal.

        Raises
        ------
        InputError
            A worker has other code, or signals do not fit.
        """
        runs: list[Made] = [each.result for each in entries]
        self._check_code(runs[0])
        assert self._signals is not None
        if problems := self._signals.write(runs):
            raise InputError([f"{self._folder}: {problem}, unlike the others" for problem in problems])
        return super().add([each._replace(result=_row(each.result)) for each in entries])

    def _check_code(self, made: Made) -> None:
        """Refuse a worker whose bits would be others."""
        if not made.code:
            return
        code, _, lanes = made.code.partition("-")
        if code != simulator_digest():
            raise InputError(
                f"worker {made.worker}: its beardyn is another one (digest {code}, here "
                f"{simulator_digest()}); install the same version on every machine"
            )
        if "lanes" not in self._says:
            self._says["lanes"] = lanes
            write_about(self._folder, self._says)
        known = self._says["lanes"]
        if lanes != known:
            raise InputError(
                f"worker {made.worker}: its processor takes {lanes} rollers at once, the runs so far were "
                f"made {known} at once; their last bits would differ: use machines of one kind"
            )


def _row(made: Made) -> dict[str, Any]:
    """Write a run as the journal has it."""
    return {
        "labels": plain(made.labels),
        "features": plain(made.features),
        "seconds": round(made.seconds, 4),
        "processor": round(made.processor, 4),
        "worker": made.worker,
        "memory": made.memory,
    }


def size_of(folder: Path) -> int:
    """Measure the signals of a set, [byte]."""
    return sum(path.stat().st_size for path in (folder / SIGNALS).rglob("*") if path.is_file())
