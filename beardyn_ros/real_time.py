"""The best tier that keeps the asked pace on this machine, and what is given up for it."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError, ValidityError
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
    note: str  # what was measured and given up; empty where the tier is that of the scene


def keep_pace(
    usual: OpenScene,
    read: Callable[[str], OpenScene],
    pace: float,
    measure: Callable[[Scene], float] | None = None,
    of_box: Callable[[Scene], Scene] | None = None,
) -> Kept:
    """Take the best tier that runs at a pace with a margin: that of the scene, or a faster one.

    Where that of the scene is not sure to keep it, the next one is measured first: how fast it is next to
    what it costs elsewhere says whether the other is worth compiling. A tier that the scene cannot be
    computed in is left out. Where nothing can be measured the tier stays that of the scene.

    Parameters
    ----------
    usual : OpenScene
        As it would be without a pace.
    read : callable
        Reads the scene in a tier that it is given, everything else as written.
    pace : float
        Simulated seconds per wall second that are asked for.
    measure : callable, optional
        Gives the simulated seconds per wall second of a scene; `measured_speed` by default.
    of_box : callable, optional
        Makes the scene of one axlebox of several.

    Raises
    ------
    InputError
        With every mistake in the scene.
    """
    from beardyn_core.choice.load import choice_for, complete_scene

    def whole(found: OpenScene) -> Scene:
        scene = complete_scene(found, outside_load=True)
        return scene if of_box is None else of_box(scene)

    scene = whole(usual)
    found = {scene.tier: usual}
    best_first = tuple(reversed(TIERS))
    for tier in best_first[best_first.index(scene.tier) + 1 :]:
        with suppress(InputError):
            found[tier] = read(tier)
    best, *faster = found
    if not faster:
        return Kept(scene, best, "")
    choices = {tier: choice_for(each) for tier, each in found.items()}
    speeds: dict[str, float] = {}
    needed = MARGIN * pace

    def holds(tier: str) -> bool:
        if tier not in speeds:
            speeds[tier] = (measure or measured_speed)(whole(found[tier]))
        return speeds[tier] >= needed

    try:
        if _SURELY * needed * choices[best].seconds <= 1.0:
            stays = holds(best)
        else:
            # next to the machine that costs were measured on
            machine = speeds[faster[0]] * choices[faster[0]].seconds if holds(faster[0]) else 0.0
            stays = machine >= needed * choices[best].seconds and holds(best)
        taken = best if stays else next((tier for tier in faster if holds(tier)), faster[-1])
    except (InputError, ValidityError) as error:
        return Kept(scene, best, f"tier {best} stays, for the speed of this machine is not known: {error}")
    if taken == best:
        return Kept(scene, best, "")
    return Kept(whole(found[taken]), taken, _note(taken, best, choices, speeds, pace))


def measured_speed(scene: Scene) -> float:
    """Run the beginning of a scene, less than a second, and give the simulated seconds per wall second."""
    from beardyn_core.run import start

    simulation = start(scene, min(_SETTLING_S + _MEASURED_S, scene.duration))
    began, begin, simulated = time.perf_counter(), 0.0, 0.0
    for block in simulation.blocks():
        simulated = block.end_ns * 1e-9
        if simulated <= _SETTLING_S:
            began, begin = time.perf_counter(), simulated
        elif time.perf_counter() - began > _LOOK_S:
            break
    return (simulated - begin) / max(time.perf_counter() - began, 1e-9)


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
