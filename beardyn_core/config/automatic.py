"""`auto` in a scene: what it leaves open."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.scene.scene import EFFECTS, NOTHING, Free

AUTO = "auto"
REFERENCE = "all"
RINGS = ("elastic", "rigid")
UNNAMED = AUTO  # what a scene has that names no effects


def names_a_box(effects: Any) -> bool:
    """Tell whether effects as they are written have a table of modes, which says what box there is."""
    structure = effects.get("structure") if isinstance(effects, dict) else None
    return isinstance(structure, dict) and structure.get("kind") == "modes"


def auto_in_its_box(effects: Any) -> Any:
    """Make `auto` out of effects as they are written, with the box that they have."""
    return {"preset": AUTO, "structure": effects["structure"]} if names_a_box(effects) else AUTO


def set_rings(effects: Any, rings: str) -> dict[str, Any]:
    """Let the rings of a scene bend or not, whatever else its effects are.

    Parameters
    ----------
    effects : str, mapping or None
        As a scene has them.
    rings : str
        ``elastic``: as the effects have it, or else with the usual housing; ``rigid``: no bending, no modes.

    Raises
    ------
    InputError
        Of another word.
    """
    if rings not in RINGS:
        raise InputError(f"rings is {rings!r}; allowed are {', '.join(RINGS)}")
    written = dict(effects) if isinstance(effects, dict) else {"preset": effects or UNNAMED}
    if rings == "rigid":
        return {**written, "structure": False}
    return written if isinstance(written.get("structure"), dict) else {**written, "structure": True}


def take_auto(data: dict[str, Any]) -> Free:
    """Replace every `auto` of a scene's mapping by what can be read, and say what may be chosen.

    With `effects: auto` everything that is not written down may be; where no effects are named, all but the
    tier, which is then the full one. A table of modes says which box there is,
    and not how much of its bending counts, unless it comes with ``highest_Hz``. The rate of the sensors may
    be chosen with anything else, where none of them names one.
    """
    named = "effects" in data
    effects = data.setdefault("effects", UNNAMED)
    all_free = effects == AUTO or (isinstance(effects, dict) and effects.get("preset") == AUTO)
    free_effects: frozenset[str] = frozenset()
    if all_free:
        written = set(effects) if isinstance(effects, dict) else set()
        if isinstance(effects, dict) and names_a_box(effects) and "highest_Hz" not in effects["structure"]:
            written.discard("structure")
        data["effects"] = (
            {**effects, "preset": REFERENCE} if isinstance(effects, dict) else {"preset": REFERENCE}
        )
        free_effects = frozenset(name for name in EFFECTS if name not in written)
    free_tier = data.get("tier", AUTO if all_free and named else "full") == AUTO
    if free_tier:
        data["tier"] = "full"
    numerics = data.get("numerics", {})
    if numerics == AUTO:
        numerics = dict.fromkeys(("laminae", "steps_per_sample"), AUTO)
    if not isinstance(numerics, dict):
        return replace(NOTHING, tier=free_tier, effects=free_effects)  # a mistake, reported later
    # a step that nobody gave goes with the tier
    usual = {"steps_per_sample": AUTO} if free_tier else {}
    if all_free:
        usual = {"laminae": AUTO, "steps_per_sample": AUTO}
    open_keys = {key for key, value in {**usual, **numerics}.items() if value == AUTO}
    data["numerics"] = {key: value for key, value in numerics.items() if key not in open_keys}
    anything = free_tier or bool(open_keys) or bool(free_effects)
    return Free(
        free_tier,
        "laminae" in open_keys,
        "steps_per_sample" in open_keys,
        free_effects,
        anything and not _names_a_rate(data.get("sensors")),
    )


def _names_a_rate(sensors: Any) -> bool:
    """Tell whether a sensor as it is written has a rate of its own."""
    return isinstance(sensors, list | tuple) and any(
        isinstance(each, dict) and "rate_kHz" in each for each in sensors
    )
