"""Scenes ready to run: read by `config`, then completed by the automatic choice."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

from beardyn_core.choice.choice_cache import kept, typical
from beardyn_core.choice.usual_step import usual_step
from beardyn_core.config.automatic import AUTO, REFERENCE
from beardyn_core.config.load import OpenScene, read_scene, read_scene_mapping, read_scene_text
from beardyn_core.config.nouns import load_effects
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.scene import EFFECTS, Free, LeftOpen, Scene

if TYPE_CHECKING:
    from beardyn_core.choice.rule import Choice

CHOOSING = "choosing effects for the accuracy asked for: a few seconds, once for a scene"

log = logging.getLogger("beardyn")


def load_scene(
    name: str | Path,
    *,
    effects: str | dict[str, Any] | None = None,
    tier: str | None = None,
    duration: float | None = None,
    laminae: int | None = None,
    seed: int | None = None,
    accuracy_percent: float | None = None,
    quantities: list[str] | None = None,
    vibration_to: float | None = None,
    outside_load: bool = False,
) -> Scene:
    """Load the scene of a shipped name or of a file.

    Parameters
    ----------
    name : str or Path
        A shipped scene, or the path of a YAML file.
    effects : str or dict, optional
        Preset, file or keys of effects instead of the scene's, or ``auto``.
    duration : float, optional
        [s].
    accuracy_percent, quantities, vibration_to : float, list of str, float, optional
        What is asked for, when something is ``auto``; the last in [Hz].
    outside_load : bool
        Whether the load comes from elsewhere than the scene's operation: the lumped tier then takes no steps
        longer than a sample unless the scene gives them.

    Raises
    ------
    InputError
        With every mistake in the scene and in the files it refers to.
    """
    overrides = {
        ("effects",): effects,
        ("tier",): tier,
        ("duration_s",): duration,
        ("numerics", "laminae"): laminae,
        ("seed",): seed,
        ("accuracy_percent",): accuracy_percent,
        ("quantities",): quantities,
        ("vibration_to_Hz",): vibration_to,
    }
    return complete_scene(read_scene(name, _given_choices(overrides)), outside_load)


def scene_with_all(name: str | Path) -> Scene:
    """Load a scene as `load_scene` does, but with every effect, in its own box, where it leaves them open."""
    found = read_scene(name)
    return found.scene if found.free.effects else complete_scene(found)


def scene_from_text(text: str, label: str = "scene") -> Scene:
    """Load the scene of a YAML text, such as the one recorded with a run; see `load_scene`."""
    return complete_scene(read_scene_text(text, label))


def scene_from_mapping(data: dict[str, Any], label: str, folder: Path) -> Scene:
    """Load the scene of the mapping in a scene file that lies in a folder; see `load_scene`."""
    return complete_scene(read_scene_mapping(data, label, folder))


@dataclass(frozen=True)
class Explanation:
    """A scene, why it is computed as it is, and what would be chosen for it."""

    scene: A[Scene, "resolved"]
    current: A[Choice, "what it has, with what has been chosen"]
    automatic: A[Choice | None, "what `effects: auto` would choose; ``None`` where `current` is that already"]


def explain_scene(
    name: str | Path,
    *,
    effects: str | None = None,
    tier: str | None = None,
    accuracy_percent: float | None = None,
    quantities: list[str] | None = None,
    vibration_to: float | None = None,
) -> Explanation:
    """Explain why a scene is computed as it is, and what would be chosen; arguments as of `load_scene`.

    Raises
    ------
    InputError
        With every mistake.
    """
    given = _given_choices(
        {
            ("effects",): effects,
            ("tier",): tier,
            ("accuracy_percent",): accuracy_percent,
            ("quantities",): quantities,
            ("vibration_to_Hz",): vibration_to,
        }
    )
    found = with_usual_step(read_scene(name, given))
    current = choice_for(found)
    if found.free.anything:
        return Explanation(current.applied(found.scene), current, None)
    every = read_scene(name, {**given, ("effects",): AUTO, ("tier",): AUTO}, without=("tier", "numerics"))
    return Explanation(found.scene, current, choice_for(every))


def _given_choices(overrides: dict[Any, Any]) -> dict[Any, Any]:
    return {place: value for place, value in overrides.items() if value is not None}


def complete_scene(found: OpenScene, outside_load: bool = False) -> Scene:
    """Complete a scene: by the automatic choice with its reasons, or by the usual step of its tier."""
    if found.free.anything:
        choice = choice_for(found)
        scene = choice.applied(found.scene)
        chosen = (scene.tier, scene.effects, scene.numerics)
        return replace(scene, left_open=LeftOpen(found.free, found.scene.effects, chosen, choice.rate))
    return with_usual_step(found, outside_load).scene


def with_usual_step(found: OpenScene, outside_load: bool = False) -> OpenScene:
    """Give a scene that leaves nothing open, and no step, the step that its tier takes for it."""
    if found.free.anything or found.step_given:
        return found
    scene = found.scene
    steps = usual_step(scene, outside_load).steps_per_sample
    return replace(found, scene=replace(scene, numerics=replace(scene.numerics, steps_per_sample=steps)))


def with_coupled_laminae(found: OpenScene) -> OpenScene | None:
    """Fix coupled laminae in a scene that leaves open whether it has them; ``None`` where it does not."""
    if "lamina_coupling" not in found.free.effects:
        return None
    return replace(found, free=replace(found.free, effects=found.free.effects - {"lamina_coupling"}))


def choice_for(found: OpenScene) -> Choice:
    """Choose for a scene as it is read, or find what was chosen for it before."""
    scene = found.scene
    if found.free.anything:
        # what is written down is wanted so, and not an error
        return _choice(scene, found.free, None)
    reference = load_effects(REFERENCE)
    judged = replace(scene, effects=_judged_by(scene.effects, reference))
    return _choice(judged, found.free, scene.effects)


def _choice(scene: Scene, free: Free, given: EffectSet | None) -> Choice:
    def work_out() -> Choice:
        from beardyn_core.choice.choose import choose

        _announce()
        return choose(scene, free, given)

    scene = typical(scene)
    return kept(scene, free, given, work_out)


@cache
def _announce() -> None:
    """Say, once in a process, what the seconds are for."""
    log.info(CHOOSING)


def in_box_of(effects: EffectSet, given: EffectSet) -> EffectSet:
    """Put effects into the box that others have a table of modes of."""
    if not isinstance(given.structure, ModalStructure):
        return effects
    return replace(effects, structure=given.structure)


def _judged_by(given: EffectSet, reference: EffectSet) -> EffectSet:
    """Give the reference the options of the scene; cheaper kinds are judged against the reference's own."""
    graded = ("traction", "film", "rib", "cage")
    own = {name: getattr(given, name) for name in EFFECTS if name not in graded}
    return replace(reference, **{name: options for name, options in own.items() if options is not None})
