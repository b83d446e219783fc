"""Many random scenes on the engine; results lie in a folder, and what is there is not done again."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterator
from dataclasses import asdict, fields
from importlib.metadata import version
from pathlib import Path

from beardyn_core.experiments import Cluster, Engine
from evidence.random.trial import FAILED, Tried, tried

AT_ONCE = 20  # scenes of a task: a result is on disk at the latest after some seconds
_HERE = Path(__file__).resolve().parent
_ROOT = _HERE.parents[1]
# of the simulator that a run goes through; the others make, read and judge recordings and sets
_ROOMS = (
    "base", "bearing", "choice", "config", "effects", "physics", "rail", "scene", "sensors", "structure",
)  # fmt: skip
_NOUNS = ("backgrounds", "bearings", "effects", "lubricants", "structures", "vehicles")


def code() -> str:
    """Hash all that a result depends on: what a run goes through, and how scenes are drawn and judged."""
    digest = hashlib.sha256()
    digest.update(sys.version.encode())
    for package in ("numba", "numpy", "scipy", "llvmlite"):
        digest.update(version(package).encode())
    for path in sources():
        digest.update(f"\n{path.relative_to(_ROOT)}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:12]


def sources() -> list[Path]:
    """List the modules and tables that decide what becomes of a scene."""
    package, tables = _ROOT / "beardyn_core", _ROOT / "config"
    found = [*package.glob("*.py"), *(_HERE / f"{name}.py" for name in ("drawing", "scenes", "trial"))]
    for folder in [*(package / room for room in _ROOMS), *(tables / noun for noun in _NOUNS)]:
        found += [path for path in folder.rglob("*") if path.suffix in (".py", ".json", ".yaml", ".csv")]
    return sorted(found)


def results(folder: Path, speed: str, seed: int, made_by: str) -> list[Tried]:
    """Read the results of a folder that some code has made, in the order of their numbers."""
    path = folder / f"{speed}.jsonl"
    known = {field.name for field in fields(Tried)}
    found: dict[int, Tried] = {}
    for line in path.read_text().splitlines() if path.exists() else ():
        try:
            stored = json.loads(line)
        except json.JSONDecodeError:  # cut off when the run was killed
            continue
        if stored["code"] == made_by and stored["seed"] == seed:
            found[stored["number"]] = Tried(**{key: stored[key] for key in known})
    return [found[number] for number in sorted(found)]


def last_code(folder: Path, speed: str) -> str:
    """Tell which code has made the last result of a folder; empty where there is none."""
    path = folder / f"{speed}.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    return next((json.loads(line)["code"] for line in reversed(lines) if line.endswith("}")), "")


def try_many(folder: Path, speed: str, count: int, seed: int, jobs: int) -> Iterator[Tried]:
    """Try the scenes 0 to ``count`` that a folder does not have, and give each as it is done.

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
    there = {each.number for each in results(folder, speed, seed, made_by)}
    todo = [number for number in range(count) if number not in there]
    tasks = [tuple(todo[first : first + AT_ONCE]) for first in range(0, len(todo), AT_ONCE)]
    if not tasks:
        return
    path = folder / f"{speed}.jsonl"
    with Engine(Cluster(workers=jobs)) as engine, path.open("a") as file:
        for ended in engine.run(try_some, tasks, seed, speed):
            done = ended.value
            if ended.killed:
                died = f"one of these scenes ended {ended.killed} processes, one after the other"
                done = [Tried(number, speed, "", "", "", FAILED, died) for number in ended.task]
            for each in done:
                file.write(json.dumps({**asdict(each), "seed": seed, "code": made_by}) + "\n")
                yield each
            file.flush()


def try_some(numbers: tuple[int, ...], seed: int, speed: str) -> list[Tried]:
    """Try some scenes in this process."""
    return [tried(number, seed, speed) for number in numbers]
