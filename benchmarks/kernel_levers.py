"""What makes the time step fast: the step without one of its levers at a time, in turns with it."""

from __future__ import annotations

import importlib
import pkgutil
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numba

from beardyn_core import physics
from beardyn_core.base.jit import LANE_WIDTH, OPTIONS, inline
from beardyn_core.choice import load_scene
from beardyn_core.physics.tiers import imex
from beardyn_core.scene.scene import Scene
from benchmarks.runs import Table
from test.kernels.rig import Rig

SETS = ("standard", "full")
STEPS = 512
Kernel = Callable[..., None]


def _always(_value: Any) -> Any:
    return True


@contextmanager
def _anew(name: str, replacement: Callable[..., Any]) -> Iterator[Kernel]:
    """Make `advance` with all kernels anew around another function of a name; the first call compiles."""
    modules = [
        importlib.import_module(found.name)
        for found in pkgutil.walk_packages(physics.__path__, f"{physics.__name__}.")
    ]
    kept: list[tuple[Any, str, Any]] = []
    built: dict[int, Any] = {}
    try:
        for module in modules:
            for each, value in list(vars(module).items()):
                if each == name:
                    new = inline(replacement)
                elif isinstance(value, numba.core.registry.CPUDispatcher) and value is not imex.advance:
                    new = built.setdefault(id(value), inline(value.py_func))
                else:
                    continue
                kept.append((module, each, value))
                setattr(module, each, new)
        if not any(each == name for _, each, _ in kept):
            raise LookupError(f"no module of physics has a function {name}")
        yield numba.njit(**OPTIONS)(imex.advance.py_func)
    finally:
        for module, each, value in kept:
            setattr(module, each, value)


def _rig(scene: Scene, width: int, explicit: bool = False) -> Rig:
    numerics = replace(scene.numerics, integrator="explicit") if explicit else scene.numerics
    rig = Rig.at_equilibrium(replace(scene, numerics=numerics), width=width)
    # the stage timers wait for values in one register, which 16 lanes do not fit into
    rig.parameters = rig.parameters._replace(effects=rig.parameters.effects._replace(timers=None))
    return rig


def kernel_levers(turns: int) -> Table:
    """Measure the time of a step without each lever over that of the step as it is, 80 kN, 6 laminae.

    Parameters
    ----------
    turns : int
        Stretches of 512 steps of each, in turns.
    """
    scenes = {name: load_scene("static_80kN", effects=name) for name in SETS}
    ratios = {name: _ratios(scene, turns) for name, scene in scenes.items()}
    rows: list[tuple[str | float, ...]] = [
        (lever, *(ratios[name][lever] for name in SETS)) for lever in ratios[SETS[0]]
    ]
    return Table(
        "levers",
        "Time of a step without a lever over that of the step as it is",
        ("the step with", *SETS),
        rows,
        f"Medians over {turns} stretches of {STEPS} steps in turns. Explicit: without the 6 x 6 system of "
        "each roller, with the same step, which no run bears for long.",
    )


def _ratios(scene: Scene, turns: int) -> dict[str, float]:
    runs: dict[str, tuple[Rig, Kernel]] = {"as it is": (_rig(scene, LANE_WIDTH), imex.advance)}
    for width in (1, LANE_WIDTH // 2, 2 * LANE_WIDTH):
        name = "scalars" if width == 1 else f"{width} lanes"
        runs[f"{name} instead of {LANE_WIDTH} lanes"] = (_rig(scene, width), imex.advance)
    runs["contacts computed that no roller of a block reaches"] = (_rig(scene, LANE_WIDTH), _unskipped(scene))
    runs["explicit contacts"] = (_rig(scene, LANE_WIDTH, explicit=True), imex.advance)
    times: dict[str, list[float]] = {name: [] for name in runs}
    for turn in range(turns + 1):
        for name in runs if turn % 2 else reversed(runs):
            rig, kernel = runs[name]
            began = time.perf_counter()
            rig.run(STEPS, kernel=kernel)
            if turn > 0:  # the first compiles
                times[name].append(time.perf_counter() - began)
    base = times["as it is"]
    return {
        name: statistics.median(a / b for a, b in zip(found, base, strict=True))
        for name, found in times.items()
    }


def _unskipped(scene: Scene) -> Kernel:
    """Make an `advance` that looks at every contact, compiled for a scene."""
    with _anew("any_positive", _always) as kernel:
        _rig(scene, LANE_WIDTH).run(1, kernel=kernel)
    return kernel
