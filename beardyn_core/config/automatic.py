"""`auto` in a scene: what may be chosen, and the scene with what has been chosen written down."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

from beardyn_core.choice.free import EFFECTS, NOTHING, Free
from beardyn_core.config.effects_file import EffectsKeys
from beardyn_core.config.scene_file import SceneKeys
from beardyn_core.config.yaml_text import write_mapping
from beardyn_core.effects import Cage, CoulombTraction, EffectSet, KinematicCage, MixedTraction, RotatingCage
from beardyn_core.scene.scene import Scene

if TYPE_CHECKING:
    from beardyn_core.choice.outcome import Choice

AUTO = "auto"
REFERENCE = "full"
_KINDS: dict[type, str] = {
    CoulombTraction: "coulomb",
    MixedTraction: "mixed",
    Cage: "six_dof",
    RotatingCage: "rotating",
    KinematicCage: "kinematic",
}


def take_auto(data: dict[str, Any]) -> Free:
    """Replace every `auto` of a scene's mapping by what can be read, and say what may be chosen.

    With `effects: auto` everything that is not written down may be.
    """
    effects = data.get("effects")
    all_free = effects == AUTO or (isinstance(effects, dict) and effects.get("preset") == AUTO)
    free_effects: frozenset[str] = frozenset()
    if all_free:
        written = set(effects) if isinstance(effects, dict) else set()
        data["effects"] = (
            {**effects, "preset": REFERENCE} if isinstance(effects, dict) else {"preset": REFERENCE}
        )
        free_effects = frozenset(name for name in EFFECTS if name not in written)
    free_tier = data.get("tier", AUTO if all_free else "full") == AUTO
    if free_tier:
        data["tier"] = "full"
    numerics = data.get("numerics", {})
    if numerics == AUTO:
        numerics = dict.fromkeys(("laminae", "steps_per_sample"), AUTO)
    if not isinstance(numerics, dict):
        return replace(NOTHING, tier=free_tier, effects=free_effects)  # a mistake that is told later
    # a step that nobody gave goes with the tier
    usual = {"steps_per_sample": AUTO} if free_tier else {}
    if all_free:
        usual = {"laminae": AUTO, "steps_per_sample": AUTO}
    open_keys = {key for key, value in {**usual, **numerics}.items() if value == AUTO}
    data["numerics"] = {key: value for key, value in numerics.items() if key not in open_keys}
    return Free(free_tier, "laminae" in open_keys, "steps_per_sample" in open_keys, free_effects)


@dataclass(frozen=True)
class Explanation:
    """A scene, why it is computed as it is, and what would be chosen for it.

    Parameters
    ----------
    scene : Scene
        Resolved.
    current : Choice
        What it has, with what has been chosen.
    automatic : Choice or None
        What `effects: auto` would choose; ``None`` where `current` is that already.
    """

    scene: Scene
    current: Choice
    automatic: Choice | None


def choice_for(keys: SceneKeys, free: Free, reference: EffectSet) -> Choice:
    """Choice for a scene as it is read."""
    from beardyn_core.choice.choose import choose  # brings the compiler along

    scene = keys.noun("")
    if free.anything:
        # what is written down is wanted so, and not an error
        return choose(scene, free)
    return choose(replace(scene, effects=_judged_by(scene.effects, reference)), free, scene.effects)


def _judged_by(given: EffectSet, reference: EffectSet) -> EffectSet:
    """The reference with the options that the scene gives; cheaper kinds are judged against its own."""
    graded = ("traction", "film", "rib", "cage")
    own = {
        name: getattr(given, name)
        for name in EFFECTS
        if name not in graded and getattr(given, name) is not None
    }
    own |= {
        name: getattr(given, name)
        for name in graded
        if getattr(given, name) is None and getattr(reference, name) is None
    }
    return replace(reference, **own)


def resolved(keys: SceneKeys, choice: Choice) -> Scene:
    """The scene with a choice written down, so that its recording states every number."""
    scene = keys.noun("")
    assert isinstance(keys.effects, EffectsKeys)
    written = keys.model_dump(mode="json", exclude_none=True)
    written["effects"] = written_effects(choice.effects, scene.effects, keys.effects)
    written["tier"] = choice.tier
    written["numerics"] = {"laminae": choice.laminae, "steps_per_sample": choice.steps_per_sample}
    final = SceneKeys.model_validate(written)
    made = final.noun(write_mapping(final.model_dump(mode="json", exclude_none=True)))
    assert made.effects == choice.effects
    return replace(made, chosen=choice.reasons)


def written_effects(chosen: EffectSet, given: EffectSet, keys: EffectsKeys) -> dict[str, Any]:
    """Keys of chosen effects: those of the scene where the options are its own."""
    found: dict[str, Any] = {"name": AUTO, "purpose": "Chosen for the accuracy asked for."}
    own = keys.model_dump(mode="json", exclude_none=True)
    for name in EFFECTS:
        options, before = getattr(chosen, name), getattr(given, name)
        if options is None:
            continue
        if options == before:
            found[name] = own[name]
        elif type(options) is type(before):
            found[name] = {**own[name], **_changes(options, before)}
        else:
            kind = _KINDS.get(type(options))
            found[name] = {} if kind is None else {"kind": kind}
    return found


def _changes(options: Any, before: Any) -> dict[str, Any]:
    """Options that differ; all that a choice changes are switches and names, without a unit."""
    changed = {
        field.name: getattr(options, field.name)
        for field in fields(options)
        if getattr(options, field.name) != getattr(before, field.name)
    }
    assert all(value is None or isinstance(value, bool | str) for value in changed.values())
    return {key: False if value is None and key != "lubrication" else value for key, value in changed.items()}
