"""Many random scenes on the engine; results lie in a folder, and what is there is not done again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from beardyn_core.experiments import Cluster, Engine
from beardyn_core.experiments.code_digest import files_digest
from beardyn_core.experiments.loop import Progress, run_plan
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Entry, Layout, Store
from evidence.random.trial import FAILED, Tried, tried

AT_ONCE = 20  # scenes of a task: a result is on disk at the latest after some seconds
_FIELDS = [field.name for field in fields(Tried)]
_HERE = Path(__file__).resolve().parent
_ROOT = _HERE.parents[1]
# of the simulator that a run goes through; the others make, read and judge recordings and sets
_ROOMS = (
    "base", "bearing", "choice", "config", "effects", "physics", "rail", "scene", "sensors", "structure",
)  # fmt: skip
_NOUNS = ("backgrounds", "bearings", "effects", "lubricants", "structures", "vehicles")


def code() -> str:
    """Hash all that a result depends on: what a run goes through, and how scenes are drawn and judged."""
    return files_digest(sources(), _ROOT)


def sources() -> list[Path]:
    """List the modules and tables that decide what becomes of a scene."""
    package, tables = _ROOT / "beardyn_core", _ROOT / "config"
    found = [*package.glob("*.py"), *(_HERE / f"{name}.py" for name in ("drawing", "scenes", "trial"))]
    for folder in [*(package / room for room in _ROOMS), *(tables / noun for noun in _NOUNS)]:
        found += [path for path in folder.rglob("*") if path.suffix in (".py", ".json", ".yaml", ".csv")]
    return sorted(found)


def store_of(folder: Path, speed: str) -> Store[Tried]:
    """Give the store of the results of a speed."""
    return Store(folder / f"{speed}.jsonl", LINES)


def _digest(made_by: str, seed: int) -> str:
    return f"{made_by} {seed}"


def _to_json(entry: Entry[Tried]) -> dict[str, Any]:
    made_by, seed = entry.digest.split(" ")
    return {**asdict(entry.result), "seed": int(seed), "code": made_by}


def _of_json(row: dict[str, Any]) -> Entry[Tried]:
    result = Tried(**{key: row[key] for key in _FIELDS})
    return Entry(str(result.number), _digest(row["code"], row["seed"]), result)


LINES = Layout(_to_json, _of_json)


def results(folder: Path, speed: str, seed: int, made_by: str) -> list[Tried]:
    """Read the results of a folder that some code has made, in the order of their numbers."""
    entries = store_of(folder, speed).entries()
    found = {each.result.number: each.result for each in entries if each.digest == _digest(made_by, seed)}
    return [found[number] for number in sorted(found)]


def last_code(folder: Path, speed: str) -> str:
    """Tell which code has made the last result of a folder; empty where there is none."""
    entries = store_of(folder, speed).entries()
    return entries[-1].digest.partition(" ")[0] if entries else ""


def try_many(
    folder: Path, speed: str, count: int, seed: int, jobs: int, report: Callable[[Tried], None]
) -> None:
    """Try the scenes 0 to ``count`` that a folder does not have, and report each as it is done.

    Parameters
    ----------
    folder : Path
        Results are appended to ``<speed>.jsonl`` in it.
    speed : str
        ``fast`` or ``full``.
    jobs : int
        Processes side by side.
    """
    folder.mkdir(parents=True, exist_ok=True)
    made_by = code()
    items = {str(number): number for number in range(count)}

    def lost(number: int, killed: int) -> Tried:
        died = f"this scene ended {killed} processes, one after the other"
        return Tried(number, speed, "", "", "", FAILED, died)

    store = store_of(folder, speed)
    plan = store.resume(
        Plan(
            items,
            try_some,
            (seed, speed),
            dict.fromkeys(items, _digest(made_by, seed)),
            together=AT_ONCE,
            lost=lost,
            has_failed=lambda each: each.verdict == FAILED,
        )
    )
    if not plan.missing:
        return

    def tell(now: Progress[Tried]) -> None:
        for each in now.latest.values():
            report(each)

    with store.opened(plan), Engine(Cluster(workers=jobs)) as engine:
        run_plan(plan, engine, store, tell)


def try_some(numbers: Sequence[int], request: tuple[int, str]) -> list[Tried]:
    """Try some scenes in this process."""
    return [tried(number, *request) for number in numbers]
