"""The best tier that keeps the asked pace on this machine, and what is given up for it."""

from __future__ import annotations

import os
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

MARGIN = 1.3  # of the speed over the pace with messages, recorder and monitor next to it
# What is left of the speed alone with them, where two cores or one carry all: `python -m evidence.ros.costs`
# found 1.0 to 1.4 where 1.7 to 2.4 were measured alone, and a run of five minutes fell behind.
_FEW_CORES, _LEFT_ON_FEW = 2, 0.6
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
    from beardyn_core.choice.load import complete_scene

    def whole(found: OpenScene) -> Scene:
        scene = complete_scene(found, outside_load=True)
        return scene if of_box is None else of_box(scene)

    scene = whole(usual)
    best, *faster = _candidates(scene.tier, usual, read)
    if not faster:
        return Kept(scene, scene.tier, "")
    speeds: dict[str, float] = {}
    needed = margin_alone() * pace

    def holds(candidate: _Candidate) -> bool:
        if candidate.name not in speeds:
            speeds[candidate.name] = (measure or measured_speed)(whole(candidate.scene))
        return speeds[candidate.name] >= needed

    try:
        if _SURELY * needed * best.choice.seconds <= 1.0:
            stays = holds(best)
        else:
            # next to the machine that costs were measured on
            machine = speeds[faster[0].name] * faster[0].choice.seconds if holds(faster[0]) else 0.0
            stays = machine >= needed * best.choice.seconds and holds(best)
        taken = best if stays else next((each for each in faster if holds(each)), faster[-1])
    except (InputError, ValidityError) as error:
        note = f"tier {scene.tier} stays, for the speed of this machine is not known: {error}"
        return Kept(scene, scene.tier, note)
    if taken is best:
        return Kept(scene, scene.tier, "")
    return Kept(whole(taken.scene), taken.choice.tier, _note(taken, best, speeds, pace))


def margin_alone() -> float:
    """Compute the margin of a speed that is measured alone on this machine."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return MARGIN / _LEFT_ON_FEW if cores <= _FEW_CORES else MARGIN


@dataclass(frozen=True)
class _Candidate:
    """What a scene may be computed with to keep its pace."""

    name: str
    scene: OpenScene
    choice: Choice


def _candidates(tier: str, usual: OpenScene, read: Callable[[str], OpenScene]) -> list[_Candidate]:
    """List the scene as it is and in each faster tier, the best first.

    Before `quasistatic` as it is chosen comes `quasistatic` with coupled laminae, where third octaves are
    asked for and rings bend, which its bounds were found with.
    """
    from beardyn_core.choice.discretisation_error import is_coupled
    from beardyn_core.choice.load import choice_for, with_coupled_laminae

    found = [_Candidate(f"tier {tier}", usual, choice_for(usual))]
    best_first = tuple(reversed(TIERS))
    for faster in best_first[best_first.index(tier) + 1 :]:
        with suppress(InputError):
            there = read(faster)
            plain = _Candidate(f"tier {faster}", there, choice_for(there))
            coupled = with_coupled_laminae(there)
            if coupled is not None and plain.choice.effects.lamina_coupling is None:
                choice = choice_for(coupled)
                if is_coupled(choice):
                    found.append(_Candidate(f"tier {faster} with coupled laminae", coupled, choice))
            found.append(plain)
    return found


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


def _note(taken: _Candidate, best: _Candidate, speeds: dict[str, float], pace: float) -> str:
    from beardyn_core.choice.discretisation_error import third_octaves_found

    reached = f"{taken.name} runs {speeds[taken.name]:.1f} times as fast as real time here"
    if speeds[taken.name] < margin_alone() * pace:
        reached += (
            f", too slow for the pace of {pace:g} that is asked for with a margin of {margin_alone():.2g}"
        )
    about = "" if best.name in speeds else "about "
    expected = speeds.get(best.name, speeds[taken.name] * taken.choice.seconds / best.choice.seconds)
    given_up = [
        f"{name} {_error(name, loose)} in place of {_error(name, best.choice.expected[name])}"
        for name, loose in taken.choice.expected.items()
        if loose > best.choice.expected[name] and name != _DECIBELS
    ]
    if bands := third_octaves_found(taken.choice):
        kept = _error(_DECIBELS, best.choice.expected[_DECIBELS])
        given_up.append(f"third octaves {bands} in place of {kept}")
    return (
        f"{reached}, {best.name} {about}{expected:.1f} times; bounds of the errors: "
        f"{', '.join(given_up) or 'no larger'}"
    )


def _error(name: str, value: float) -> str:
    return f"{value:.2g} dB" if name == _DECIBELS else f"{100.0 * value:.2g} %"
