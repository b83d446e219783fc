"""The best tier that keeps the asked pace on this machine, and what is given up for it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from beardyn_core.scene.tier import TIERS

if TYPE_CHECKING:
    from beardyn_core.choice.rule import Choice
    from beardyn_core.config.load import OpenScene
    from beardyn_core.scene.scene import Scene

MARGIN = 1.3  # of the speed alone over the pace with messages, recorder and monitor beside it
_SETTLING_S, _MEASURED_S, _LOOK_S = 0.1, 1.0, 0.5  # simulated; simulated at most; wall time at most
_SURELY = 4.0  # times faster than asked where costs were measured: then the best tier is tried first
_DECIBELS = "vibration"  # of the quantities the one that is not a fraction


@dataclass(frozen=True)
class Kept:
    """A scene that keeps the pace, or comes nearest to it."""

    scene: Scene
    tier: str
    note: str  # what was measured and given up; empty where nothing was


def keep_pace(
    read: Callable[[str], OpenScene], pace: float, measure: Callable[[Scene], float] | None = None
) -> Kept:
    """Take the best tier that runs at a pace with a margin.

    Where the full tier is not sure to keep it, the quasistatic one is measured first: how fast it is next to
    what it costs elsewhere says whether the full one is worth compiling.

    Parameters
    ----------
    read : callable
        Reads the scene in a tier that it is given, everything else as written.
    pace : float
        Simulated seconds per wall second that are asked for.
    measure : callable, optional
        Gives the simulated seconds per wall second of a scene; `measured_speed` by default.

    Raises
    ------
    InputError
        With every mistake in the scene.
    """
    from beardyn_core.choice.load import choice_for, complete_scene

    found = {tier: read(tier) for tier in TIERS}
    choices = {tier: choice_for(each) for tier, each in found.items()}
    speeds: dict[str, float] = {}
    needed = MARGIN * pace

    def holds(tier: str) -> bool:
        if tier not in speeds:
            speeds[tier] = (measure or measured_speed)(complete_scene(found[tier], outside_load=True))
        return speeds[tier] >= needed

    lumped, middle, best = TIERS  # from the fastest to the best
    taken = middle
    if _SURELY * needed * choices[best].seconds <= 1.0 and holds(best):
        taken = best
    elif holds(middle):
        machine = speeds[middle] * choices[middle].seconds  # next to the one that costs were measured on
        if machine >= needed * choices[best].seconds and holds(best):
            taken = best
    else:
        holds(lumped)
        taken = lumped
    note = "" if taken == best else _note(taken, best, choices, speeds, pace)
    return Kept(complete_scene(found[taken], outside_load=True), taken, note)


def measured_speed(scene: Scene) -> float:
    """Run the beginning of a scene and give the simulated seconds per wall second."""
    from beardyn_core.run import start

    simulation = start(scene, _SETTLING_S + _MEASURED_S)
    began, simulated = 0.0, 0.0
    for block in simulation.blocks():
        if block.end_ns <= _SETTLING_S * 1e9:
            began = time.perf_counter()
            continue
        simulated = block.end_ns * 1e-9 - _SETTLING_S
        if time.perf_counter() - began > _LOOK_S:
            break
    return simulated / max(time.perf_counter() - began, 1e-9)


def _note(taken: str, best: str, choices: dict[str, Choice], speeds: dict[str, float], pace: float) -> str:
    reached = f"tier {taken} runs {speeds[taken]:.1f} times as fast as real time here"
    if speeds[taken] < MARGIN * pace:
        reached += f", too slow for the pace of {pace:g} that is asked for with a margin of {MARGIN:g}"
    expected = speeds.get(best, speeds[taken] * choices[taken].seconds / choices[best].seconds)
    given_up = [
        f"{name} {_error(name, loose)} in place of {_error(name, choices[best].expected[name])}"
        for name, loose in choices[taken].expected.items()
        if loose > choices[best].expected[name]
    ]
    about = "" if best in speeds else "about "
    return (
        f"{reached}, {best} {about}{expected:.1f} times; bounds of the errors: "
        f"{', '.join(given_up) or 'no larger'}"
    )


def _error(name: str, value: float) -> str:
    return f"{value:.2g} dB" if name == _DECIBELS else f"{100.0 * value:.2g} %"
