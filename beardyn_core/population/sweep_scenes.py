"""What all runs of a sweep are made of: the scene of each, made and checked before anything runs."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import plain
from beardyn_core.choice.load import choice_for, complete_scene
from beardyn_core.choice.trial import together
from beardyn_core.config.folders import find
from beardyn_core.config.load import OpenScene, read_scene_mapping
from beardyn_core.config.problems import Origin
from beardyn_core.config.yaml_text import read_file
from beardyn_core.population.draw import Row, rows_of, scaled_value
from beardyn_core.population.key_paths import AbsentError, Place, is_place, place_of, with_value
from beardyn_core.record.tables import SIGNALS, VIBRATION
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sweep import Choice, Scaled, Sweep, Variable
from beardyn_core.scene.tier import TIER_NAMES

CHECKED_HERE = 256  # runs whose scenes are made before the workers are started, which make the others
FORESEEN = 1024  # draws whose extremes settle what is chosen, however many are run
_SHOWN = 20  # sentences about rows
_LOOKED_AT = 32  # runs of a sweep that is wrong already
_NAME = "scene"
_TOLD_EVERY_S = 10.0


@dataclass(frozen=True)
class Frame:
    """What all runs of a set have in common, so that their signals fit into the same arrays."""

    duration: A[float, "[s]"]
    sensors: A[tuple[tuple[str, float], ...], "name and rate of each, [Hz]"]
    rollers: A[tuple[int, int], "rows, and rollers of each"]

    @classmethod
    def of(cls, scene: Scene) -> Frame:
        """Take that of a scene."""
        sensors = tuple((sensor.name, sensor.rate) for sensor in scene.sensors)
        return cls(scene.duration, sensors, (scene.rows, scene.bearing.roller_count))


@dataclass(frozen=True)
class SweepScenes:
    """All that the runs of a sweep are made of."""

    sweep: Sweep
    label: A[str, "what its file is called in messages"]
    base: A[dict[str, Any], "keys of the scene that every run starts from, references and choices resolved"]
    folder: A[Path, "of the scene's file"]
    scene_label: A[str, "what the scene's file is called in messages"]
    frame: A[Frame | None, "of all runs"] = None
    chosen: A[tuple[str, ...], "what was chosen for all runs together, with reasons"] = ()

    def keys(self, row: Row) -> tuple[dict[str, Any], dict[str, Any]]:
        """Make the mapping of a run's scene, and the value of each varied key; ``None`` where it has none."""
        data, values = self.base, dict[str, Any]()
        for variable in self.sweep.vary:
            key = variable.key
            value = scaled_value(variable, values) if isinstance(variable, Scaled) else row.drawn[key]
            values[key] = None
            if value is None and isinstance(variable, Scaled):
                continue
            try:
                data = with_value(data, place_of(key), value, self.folder)
            except AbsentError:  # a healthy bearing has no defects[0]
                continue
            values[key] = value
        data = {**data, _NAME: f"{self.sweep.name}, run {row.run}"[:80]}
        given = {*self.sweep.changes, *values}
        if "seed" not in given:
            data["seed"] = row.seed
        if isinstance(data.get("scatter"), dict) and "scatter.seed" not in given:
            data["scatter"] = {**data["scatter"], "seed": row.lot}
        return data, values

    def opened(self, row: Row) -> OpenScene:
        """Read the scene of a run.

        Raises
        ------
        InputError
            With every mistake, those of varied keys in the words of the sweep's file.
        """
        data, values = self.keys(row)
        label = f"{self.label}: run {row.run}"
        origins = [Origin(place_of(key), label, place_of(key)) for key in values]
        return read_scene_mapping(data, self.scene_label, self.folder, origins)

    def scene(self, row: Row) -> Scene:
        """Make the scene of a run, ready to run."""
        return replace(complete_scene(self.opened(row)), chosen=self.chosen)

    @property
    def identity(self) -> dict[str, Any]:
        """Describe all that the runs depend on besides the code, as the folder of the set keeps it."""
        sweep = write_noun(replace(self.sweep, folder=Path()))
        for key in ("purpose", "hours", "licence", "split"):
            sweep.pop(key, None)
        if self.sweep.extends:
            sweep.pop("runs", None)
        found: dict[str, Any] = plain({**sweep, "base": self.base})  # as the file has it, to be compared
        return found


def bearing_name(scene: Scene) -> str:
    """Name a bearing by all that it was made with: drawing and scatter, and neither load nor damage."""
    scatter = None if scene.scattered is None else write_noun(scene.scattered)
    text = json.dumps([write_noun(scene.bearing), scatter], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:10]


def scenes_of(sweep: Sweep, label: str, say: Callable[[str], None] = lambda _: None) -> SweepScenes:
    """Make the scenes of a sweep.

    Parameters
    ----------
    sweep : Sweep
    label : str
        What its file is called in messages.
    say : callable, optional
        Called with what takes time.

    Raises
    ------
    InputError
        With every mistake in the sweep, in its scene, and in the scenes of its runs.
    """
    try:
        scenes, opened = open_base(sweep, label)
    except InputError:
        raise InputError(mistakes_of(sweep, label)) from None
    rows = rows_of(sweep)
    extremes = _extremes(rows)
    few = rows if len(rows) <= CHECKED_HERE else _once([*extremes, *rows[:: len(rows) // CHECKED_HERE]])
    if problems := [*_unknown_signals(scenes, opened.scene), *check_rows(scenes, few)]:
        raise InputError(problems)
    scenes = _settle_choices(scenes, opened, _foreseen(scenes, rows), say)
    frame = Frame.of(scenes.scene(rows[0]))
    return replace(scenes, frame=frame)


def mistakes_of(sweep: Sweep, label: str) -> list[str]:
    """List the mistakes of a sweep, also those in runs of a scene that itself has some.

    Keys that are wrong by themselves are reported, left out of the scenes that the others are looked at in.
    """
    try:
        scenes, opened = open_base(sweep, label)
    except InputError as error:
        changes = {key: each for key, each in sweep.changes.items() if _alone(sweep, label, {key: each})}
        vary: list[Variable] = []
        for variable in sweep.vary:
            follows = isinstance(variable, Scaled) and variable.by not in [each.key for each in vary]
            if is_place(variable.key) and not follows:
                vary.append(variable)
        rest = replace(sweep, changes=changes, vary=tuple(vary))
        less = len(changes) < len(sweep.changes) or len(vary) < len(sweep.vary)
        return [*error.problems, *(mistakes_of(rest, label) if less else ())]
    rows = rows_of(sweep)
    few = _once([*_extremes(rows), *rows[:_LOOKED_AT]]) if sweep.vary else []
    return [*_unknown_signals(scenes, opened.scene), *_wrong(scenes, few)]


def _once(rows: Iterable[Row]) -> list[Row]:
    """Leave out what has been there before."""
    return list({row.run: row for row in rows}.values())


def _alone(sweep: Sweep, label: str, changes: dict[str, Any]) -> bool:
    """Tell whether a scene takes one change by itself."""
    try:
        open_base(replace(sweep, changes=changes, vary=()), label)
    except InputError:
        return False
    return True


def open_base(sweep: Sweep, label: str) -> tuple[SweepScenes, OpenScene]:
    """Read the scene of a sweep with what the sweep sets in it."""
    problems: list[str] = []
    places: dict[str, Place] = {}
    for key in (*sweep.changes, *(variable.key for variable in sweep.vary)):
        try:
            places[key] = place_of(key)
        except InputError as error:
            problems += [f"{label}: {problem}" for problem in error.problems]
    try:
        path = find("scenes", sweep.scene, sweep.folder)
    except InputError as error:
        raise InputError([*problems, *(f"{label}: scene: {each}" for each in error.problems)]) from None
    data, folder = read_file(path), path.parent
    origins = []
    for key, value in sweep.changes.items():
        if key not in places:
            continue
        try:
            data = with_value(data, places[key], value, folder)
        except AbsentError:
            problems.append(f"{label}: set.{key}: the scene has no such entry; its list is shorter")
        except InputError as error:
            problems += [f"{label}: set.{key}: {problem}" for problem in error.problems]
        origins.append(Origin(places[key], label, ("set", *places[key])))
    try:
        opened = read_scene_mapping(data, str(path), folder, origins)
    except InputError as error:
        raise InputError([*problems, *error.problems]) from None
    if problems:
        raise InputError(problems)
    return SweepScenes(sweep, label, opened.keys, folder, str(path)), opened


def _unknown_signals(scenes: SweepScenes, scene: Scene) -> list[str]:
    known = (*SIGNALS, *(f"{VIBRATION}_{sensor.name}" for sensor in scene.sensors[1:]))
    return [
        f"{scenes.label}: signals[{index}] is {name!r}; allowed are {', '.join(known)}"
        for index, name in enumerate(scenes.sweep.signals)
        if name not in known
    ]


def _extremes(rows: Sequence[Row]) -> list[Row]:
    """Find the runs with the smallest and the largest number of every key, and one with each other value."""
    found: dict[int, Row] = {}
    for key in rows[0].drawn if rows else ():
        numbers = sorted((row.drawn[key], row.run) for row in rows if isinstance(row.drawn[key], int | float))
        others: dict[str, Row] = {}
        for row in rows:
            if not isinstance(row.drawn[key], int | float):
                others.setdefault(json.dumps(row.drawn[key], sort_keys=True, default=str), row)
        ends = [rows[run] for _, run in (numbers[0], numbers[-1])] if numbers else []
        found |= {row.run: row for row in (*ends, *others.values())}
    return [found[run] for run in sorted(found)] or list(rows[:1])


def _foreseen(scenes: SweepScenes, rows: Sequence[Row]) -> list[OpenScene]:
    """Make the scenes of extreme runs, which are the same for any number of runs where more continue them."""
    sweep = scenes.sweep
    drawn = rows_of(replace(sweep, runs=FORESEEN)) if sweep.extends else rows
    found = []
    for row in _extremes(drawn):
        try:
            found.append(scenes.opened(row))
        except InputError:  # of a run that is not asked for: those that are have been checked
            continue
    return found or [scenes.opened(row) for row in _extremes(rows)]


def check_rows(scenes: SweepScenes, rows: Iterable[Row]) -> list[str]:
    """List what is wrong with the scenes of runs: each kind of mistake once, with how many runs have it."""
    rows = list(rows)
    frames: dict[Frame, int] = {}
    names: set[str] = set()

    def look(row: Row, scene: Scene) -> None:
        frames.setdefault(Frame.of(scene), row.run)
        names.add(bearing_name(scene))

    wrong = _wrong(scenes, rows, look)
    problems = [*wrong, *([] if wrong else _unused_keys(scenes, rows)), *_unlike(scenes, frames)]
    if len(names) == 1 and len(rows) > 1 and not wrong:
        problems.append(
            f"{scenes.label}: all {len(rows)} runs are of one and the same bearing, so that no part of the "
            "set could be without it: give its lot a grade (set: {scatter: {grade: G1}}), or vary bearing "
            "keys"
        )
    return problems[:_SHOWN]


def _wrong(
    scenes: SweepScenes, rows: Iterable[Row], look: Callable[[Row, Scene], None] = lambda *_: None
) -> list[str]:
    """List what is wrong with the scenes of runs, each kind of mistake once; look at those that are right."""
    found: dict[str, list[str]] = {}
    for row in rows:
        try:
            look(row, scenes.opened(row).scene)
        except InputError as error:
            for problem in error.problems:
                found.setdefault(_kind_of(problem, row), []).append(problem)
    return [
        f"{sentences[0]}{f' (and {len(sentences) - 1} more runs like it)' if len(sentences) > 1 else ''}"
        for sentences in found.values()
    ]


def _kind_of(problem: str, row: Row) -> str:
    """Take out of a sentence what differs from run to run."""
    return problem.replace(f": run {row.run}:", ":").partition(" is ")[0]


def _unused_keys(scenes: SweepScenes, rows: Sequence[Row]) -> list[str]:
    used = {key for row in rows for key, value in scenes.keys(row)[1].items() if value is not None}
    return [
        f"{scenes.label}: vary[{index}].key is {variable.key!r}: no run has such an entry; its list in the "
        "scene is shorter"
        for index, variable in enumerate(scenes.sweep.vary)
        if variable.key not in used and not _reachable(scenes, variable.key)
    ]


def _reachable(scenes: SweepScenes, key: str) -> bool:
    """Tell whether some value of a choice brings the entry that a key is of; few runs may have drawn none."""
    for choice in (each for each in scenes.sweep.vary if isinstance(each, Choice)):
        for value in choice.one_of:
            try:
                data = with_value(scenes.base, place_of(choice.key), value, scenes.folder)
                with_value(data, place_of(key), None, scenes.folder)
            except (AbsentError, InputError):
                continue
            return True
    return False


def _unlike(scenes: SweepScenes, frames: dict[Frame, int]) -> list[str]:
    """Say what makes the signals of runs of different lengths."""
    if len(frames) < 2:
        return []
    (one, first), (other, second) = list(frames.items())[:2]
    what = {
        "duration_s": (one.duration, other.duration),
        "sensors": (one.sensors, other.sensors),
        "rows and rollers": (one.rollers, other.rollers),
    }
    needs_rollers = {"rollers", "bodies", "contacts", "cages"} & set(scenes.sweep.signals)
    if not needs_rollers:
        del what["rows and rollers"]
    return [
        f"{scenes.label}: {name} is {a} in run {first} and {b} in run {second}; the signals of a set are of "
        "one length: leave it the same, or make two sets"
        for name, (a, b) in what.items()
        if a != b
    ]


def _settle_choices(
    scenes: SweepScenes, opened: OpenScene, found: list[OpenScene], say: Callable[[str], None]
) -> SweepScenes:
    """Choose what the scene leaves open, once for all runs: no learner must tell a fault by the effects."""
    free = replace(opened.free, rates=False)  # signals of one length
    if not free.anything:
        if opened.step_given:
            return scenes
        steps = max(complete_scene(each).numerics.steps_per_sample for each in found)
        return _with_numerics(scenes, opened.scene, steps_per_sample=steps)
    say(
        f"choosing the effects of the runs: {len(found)} kinds, some seconds for each, kept for the next time"
    )
    choices, told = [], time.monotonic()
    for each in found:
        choices.append(choice_for(OpenScene(each.scene, free, opened.step_given, {})))
        if time.monotonic() - told > _TOLD_EVERY_S and len(choices) < len(found):
            told = time.monotonic()
            say(f"effects are chosen for {len(choices)} of {len(found)} kinds of runs")
    tier = opened.scene.tier
    if free.tier:
        tier = max((choice.tier for choice in choices), key=TIER_NAMES.index)
        if any(choice.tier != tier for choice in choices):  # the step of a tier is chosen for it
            free = replace(free, tier=False)
            tiered = [replace(each.scene, tier=tier) for each in found]
            choices = [choice_for(OpenScene(each, free, opened.step_given, {})) for each in tiered]
    effects = together([choice.effects for choice in choices], found[0].scene.effects)
    hardest = max(choices, key=lambda choice: choice.seconds)
    scenes = _with_numerics(
        replace(scenes, base={**scenes.base, "tier": tier, "effects": write_noun(effects)}),
        opened.scene,
        laminae=max(choice.laminae for choice in choices),
        steps_per_sample=max(choice.steps_per_sample for choice in choices),
    )
    why = f"the same in all runs, which is what any of {len(choices)} kinds of them needs"
    return replace(scenes, chosen=(f"{hardest.summary}; {why}", *hardest.reasons[1:]))


def _with_numerics(scenes: SweepScenes, scene: Scene, **changes: Any) -> SweepScenes:
    numerics = {**write_noun(scene.numerics), **changes}
    return replace(scenes, base={**scenes.base, "numerics": numerics})
