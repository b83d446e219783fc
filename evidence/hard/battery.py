"""All hard cases side by side, each in a process of its own kind; what is done is not done again.

A case is done when the folder has a result of the same case and the same sources. Long cases keep a
checkpoint there and are continued from it.
"""

from __future__ import annotations

import ast
import hashlib
import logging
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path

import numba
import numpy as np

import beardyn_core
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.experiments.loop import Progress, run_plan
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Entry, Layout, Store
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.study.compiling import warm_once
from evidence.hard.case import HardCase
from evidence.hard.case_scene import scene_of
from evidence.hard.report import outcome_from
from evidence.hard.run import STARTS, run_case
from evidence.hard.verdict import FAILED, Outcome

OUTCOMES = "outcomes.jsonl"
LINES = Layout[Outcome](
    lambda each: {"key": each.key, "digest": each.digest, "outcome": asdict(each.result)},
    lambda row: Entry(row["key"], row["digest"], outcome_from(row["outcome"])),
    default=lambda value: value.tolist(),  # numbers of NumPy
)
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
    store = Store(folder / OUTCOMES, LINES)
    plan = store.resume(plan_of(list(cases), folder, starts))
    total, there = len(plan.items), [plan.kept[key] for key in plan.items if key in plan.kept]
    for number, outcome in enumerate(there, start=1):
        report(outcome, number, total)
    if not plan.missing:
        return there
    plan = replace(plan, order=tuple(_long_ones_first({key: plan.items[key] for key in plan.missing})))

    def tell(now: Progress[Outcome]) -> None:
        for key, outcome in now.latest.items():  # they are in the store
            _checkpoint_of(plan.items[key], folder, starts).unlink(missing_ok=True)
            report(outcome, now.done, total)

    with store.opened(plan), Engine(Cluster(workers=jobs)) as engine:
        outcomes = run_plan(plan, engine, store, tell)
        store.tidy(plan)
    return list(outcomes.values())


def plan_of(cases: Sequence[HardCase], folder: Path, starts: int = STARTS) -> Plan[HardCase, Outcome]:
    """Plan the runs of cases."""
    items = {key_of(case, starts): case for case in cases}
    return Plan(
        items,
        run_cases,
        (folder, starts),
        {key: _mark(case) for key, case in items.items()},
        lost=lambda case, killed: Outcome(case.name, FAILED, (f"crashed: {killed} processes died of it",)),
        keeps_lost=False,  # it may have been the memory
        has_failed=lambda outcome: outcome.verdict == FAILED,
    )


def _long_ones_first(cases: Mapping[str, HardCase]) -> list[str]:
    """Order cases so that no process works alone at the end, and kernels of many cases come before others."""
    kernels = {key: kernel_of(case) for key, case in cases.items()}
    size = Counter(kernels.values())
    return sorted(cases, key=lambda key: (not cases[key].long, -size[kernels[key]]))


def run_cases(cases: Sequence[HardCase], request: tuple[Path, int]) -> list[Outcome]:
    """Run some cases in this process."""
    return [_one(case, *request) for case in cases]


def _one(case: HardCase, folder: Path, starts: int) -> Outcome:
    """Run a case in this process; a crash of the model is a verdict too."""
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    checkpoint = _checkpoint_of(case, folder, starts)
    try:
        kernel = kernel_of(case)
        if kernel not in (*_NO_KERNEL, "none"):
            warm_once(scene_of(case), kernel)
        outcome = run_case(case, checkpoint, starts)
    except Exception:
        outcome = Outcome(case.name, FAILED, (f"crashed: {traceback.format_exc(limit=-3)}",))
    return outcome


def _checkpoint_of(case: HardCase, folder: Path, starts: int) -> Path:
    return folder / f"{key_of(case, starts)}-{_mark(case)}.checkpoint"


def key_of(case: HardCase, starts: int) -> str:
    """Name a case and how often it is begun, as a file may be called."""
    return case.name.replace(".", "_") + ("" if starts == STARTS else f"-{starts}")


def forget(cases: Iterable[HardCase], folder: Path) -> None:
    """Forget what has been done of cases, from however many starts, their checkpoints included."""
    store = Store(folder / OUTCOMES, LINES)
    names = [key_of(case, STARTS) for case in cases]
    store.forget([each.key for each in store.entries() if each.key.partition("-")[0] in names])
    for name in names:
        for path in folder.glob(f"{name}-*.checkpoint"):
            path.unlink()


def earlier_results(folder: Path) -> list[Path]:
    """List the results that an earlier version has left, which this one cannot read."""
    return sorted(folder.glob("*.outcome"))


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
