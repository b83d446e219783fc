"""All hard cases side by side, each in a process of its own kind; what is done is not done again.

A case is done when a result of the same case and the same sources lies in the folder. Long cases keep a
checkpoint there and are continued from it.
"""

from __future__ import annotations

import ast
import hashlib
import logging
import pickle
import traceback
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path

import numba
import numpy as np

import beardyn_core
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.study.compiling import warm_once
from evidence.hard.case import HardCase
from evidence.hard.case_scene import scene_of
from evidence.hard.run import STARTS, keep, run_case
from evidence.hard.verdict import FAILED, Outcome

_CORE = Path(beardyn_core.__path__[0])
_HERE = Path(__file__).resolve().parent
_NOT_IN_A_RESULT = ("catalogue", "cases_", "report", "battery", "page", "test_", "__main__")
_NO_KERNEL = ("refused scene", "explicit")


def run_battery(
    cases: Iterable[HardCase],
    folder: Path,
    jobs: int,
    report: Callable[[Outcome, int, int], None],
    starts: int = STARTS,
) -> list[Outcome]:
    """Run cases and keep their outcomes in a folder; returns them in the order of the cases.

    Parameters
    ----------
    cases : iterable of HardCase
    folder : Path
        Of results and checkpoints.
    jobs : int
        Processes side by side.
    report : callable
        Gets every outcome, how many are there and of how many.
    starts : int
        Of each case, where it has more than one.
    """
    folder.mkdir(parents=True, exist_ok=True)
    cases = list(cases)
    done = {case.name: found for case in cases if (found := _kept(_place(case, folder, starts))) is not None}
    for number, outcome in enumerate(list(done.values()), start=1):
        report(outcome, number, len(cases))
    todo = [case for case in cases if case.name not in done]
    if not todo:
        return [done[case.name] for case in cases]
    size = Counter(kernel_of(case) for case in todo)
    # long cases first, so that no process works alone at the end; kernels of many cases before others
    todo.sort(key=lambda case: (not case.long, -size[kernel_of(case)]))
    with Engine(Cluster(workers=jobs)) as engine:
        for ended in engine.run(_one, todo, folder, starts):
            outcome = ended.value
            if ended.killed:
                outcome = Outcome(ended.task.name, FAILED, (f"crashed: {ended.killed} processes died of it",))
            done[outcome.name] = outcome
            report(outcome, len(done), len(cases))
    return [done[case.name] for case in cases]


def _one(case: HardCase, folder: Path, starts: int) -> Outcome:
    """Run a case in this process; a crash of the model is a verdict too."""
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    place = _place(case, folder, starts)
    try:
        kernel = kernel_of(case)
        if kernel not in (*_NO_KERNEL, "none"):
            warm_once(scene_of(case), kernel)
        outcome = run_case(case, place.with_suffix(".checkpoint"), starts)
    except Exception:
        outcome = Outcome(case.name, FAILED, (f"crashed: {traceback.format_exc(limit=-3)}",))
    keep(place.with_suffix(".outcome"), outcome)
    place.with_suffix(".checkpoint").unlink(missing_ok=True)
    return outcome


def _kept(place: Path) -> Outcome | None:
    path = place.with_suffix(".outcome")
    if not path.exists():
        return None
    outcome = pickle.loads(path.read_bytes())
    assert isinstance(outcome, Outcome)
    return outcome


def _place(case: HardCase, folder: Path, starts: int) -> Path:
    """Name the file of a case; the name has no dot, so that a suffix can follow."""
    fewer = "" if starts == STARTS else f"-{starts}"
    return folder / f"{case.name.replace('.', '_')}-{_mark(case)}{fewer}"


def _mark(case: HardCase) -> str:
    """Hash of the case and of all sources and shipped configuration a result depends on."""
    return hashlib.sha256((repr(case) + _sources()).encode()).hexdigest()[:12]


_SOURCES: list[str] = []


def _sources() -> str:
    if not _SOURCES:
        digest = hashlib.sha256()
        core = [path for path in _CORE.rglob("*.py") if path.parent.name not in ("cli", "record")]
        own = [path for path in _HERE.glob("*.py") if not path.name.startswith(_NOT_IN_A_RESULT)]
        for path in (*sorted(core), *sorted(own)):
            digest.update(ast.dump(ast.parse(path.read_bytes())).encode())
        _SOURCES.append(digest.hexdigest())
    return _SOURCES[0]


def kernel_of(case: HardCase) -> str:
    """Name the compiled kernel that a case needs by the types of its parameters."""
    if case.run_as in _NO_KERNEL:
        return case.run_as
    try:
        scene = scene_of(case)
        parameters = build_parameters(scene, Arrangement(scene.bearing.roller_count, LANE_WIDTH), np.zeros(6))
        return f"{scene.tier}: {numba.typeof(TIERS[scene.tier].parameters(scene, parameters))}"
    except (InputError, ValidityError):
        return "none"


def kernels_of(cases: Iterable[HardCase]) -> int:
    """Count the kernels that cases need."""
    return len({kernel_of(case) for case in cases if case.run_as not in _NO_KERNEL} - {"none"})
