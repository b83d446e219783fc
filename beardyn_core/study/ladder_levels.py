"""The levels of a ladder, each a choice of tier, effects, laminae and step, and their expected cost."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Annotated as A

from beardyn_core.choice.choose import choose
from beardyn_core.choice.load import in_box_of
from beardyn_core.choice.rule import Choice
from beardyn_core.config import load_effects
from beardyn_core.effects import EffectSet
from beardyn_core.physics.tiers.friction_steps import usual_steps
from beardyn_core.scene.scene import QUANTITIES, Numerics, Scene
from beardyn_core.scene.sensor import RATES
from beardyn_core.scene.tier import TIERS

REFERENCE_LAMINAE, REFERENCE_STEPS = 40, 8
# effects named by these are known by what they hold only
AUTO, OF_THE_SCENE = "auto", "of the scene"
# measured as a level in the spectrum of the vibration: what one asks of it, the choice has to hold there
_CHOSEN_AS = {"fault_line": "vibration"}
# wall time per simulated second on one core of a 2.5 GHz machine, for the progress bar and the order of runs
_FAST_COST = {"lumped": (0.06, 0.002), "quasistatic": (0.06, 0.012)}
_FULL_COST = (0.10, 0.025)
_MANY_EFFECTS, _MANY_EFFECTS_FACTOR = 10, 1.8


@dataclass(frozen=True)
class Level:
    """Tier, effects, laminae and step with which a scene is computed."""

    name: A[str, "names the level in tables and pictures"]
    tier: A[str, "name of a tier, see `scene.tier`"]
    effects_name: A[str, "what the set of effects is called"]
    effects: EffectSet
    laminae: A[int, "of each roller"]
    steps_per_sample: A[float, "time steps per waveform sample (25.6 kHz), [-]"]

    def applied(self, scene: Scene) -> Scene:
        """Apply this choice to a scene; bearing, load, faults and seed stay, all sensors run at 25.6 kHz."""
        numerics = Numerics(self.laminae, self.steps_per_sample)
        sensors = tuple(replace(sensor, rate=RATES[0]) for sensor in scene.sensors)
        return replace(scene, tier=self.tier, effects=self.effects, numerics=numerics, sensors=sensors)


@dataclass(frozen=True)
class LevelList:
    """The reference, its coarser neighbour, and the levels to be judged."""

    reference: A[Level, "every effect, many laminae, a small step"]
    neighbour: A[Level, "half of the reference's laminae and twice its step"]
    levels: A[tuple[Level, ...], "the cheapest first"]

    def including(self, *more: Level) -> LevelList:
        """Add further levels to those to be judged."""
        return replace(self, levels=tuple(sorted([*self.levels, *more], key=expected_cost)))


def _level(tier: str, effects_name: str, effects: EffectSet, laminae: int, steps: float) -> Level:
    words = [*([] if tier == "full" else [tier]), f"effects {effects_name}"]
    name = ", ".join([*words, f"{laminae} laminae x {steps}"])
    return Level(name, tier, effects_name, effects, laminae, steps)


def levels_of(scene: Scene, quick: bool = False, each_effect: bool = False) -> LevelList:
    """Make the levels of a scene's ladder.

    Parameters
    ----------
    scene : Scene
    quick : bool
        Few levels, and none with effects that the shipped presets do not have.
    each_effect : bool
        Also `all` less each of its effects in turn.
    """
    every, standard, dry = (load_effects(name) for name in ("all", "standard", "dry"))
    every = in_box_of(every, scene.effects)
    reference = replace(_level("full", "all", every, REFERENCE_LAMINAE, REFERENCE_STEPS), name="reference")
    neighbour = _level("full", "all", every, REFERENCE_LAMINAE // 2, REFERENCE_STEPS // 2)
    lumped, balanced, usual = (TIERS[name].steps_per_sample for name in ("lumped", "quasistatic", "full"))
    fast: dict[str, list[tuple[int, int]]] = {"lumped": [(6, lumped)], "quasistatic": [(6, balanced)]}
    steps: dict[str, tuple[EffectSet, list[tuple[int, int]]]] = {
        "dry": (dry, [(6, usual_steps(dry, 6))]),
        "standard": (standard, [(6, usual)]),
        "all": (every, [(6, usual)]),
    }
    if not quick:
        fast = {
            "lumped": [(1, lumped), (6, lumped), (6, 4 * lumped)],
            "quasistatic": [(3, balanced), *((6, count * balanced) for count in (1, 2, 4)), (20, balanced)],
        }
        lossy = replace(
            standard, **{name: getattr(every, name) for name in ("rolling_resistance", "drag", "seal")}
        )
        flexible = replace(lossy, structure=every.structure)
        six = [(3, usual), (6, 2), (6, 3), (6, usual), (6, 2 * usual)]
        steps |= {
            "standard": (standard, [*six, (20, usual)]),
            "standard + losses": (lossy, [(6, usual)]),
            "standard + losses + structure": (flexible, [(6, usual)]),
            "all - lamina_coupling": (replace(every, lamina_coupling=None), [(6, usual)]),
            "all": (every, [*six, (6, 4 * usual), (10, usual)]),
        }
    if each_effect:
        steps |= {f"all - {name}": (less, [(6, usual)]) for name, less in _one_less(every)}
    rows: list[tuple[str, str, EffectSet, list[tuple[int, int]]]] = []
    rows += [(tier, "standard", standard, choices) for tier, choices in fast.items()]
    rows += [(tier, "all", every, [(6, TIERS[tier].steps_per_sample)]) for tier in fast]
    rows += [("full", name, effects, choices) for name, (effects, choices) in steps.items()]
    found = [
        _level(tier, name, effects, *choice) for tier, name, effects, choices in rows for choice in choices
    ]
    found.append(neighbour)
    known = {effects: name for name, (effects, _) in steps.items()}
    own = level_of(scene, known.get(scene.effects, OF_THE_SCENE))
    if _choices(own) not in [_choices(level) for level in found]:
        found.append(own)
    return LevelList(reference, neighbour, tuple(sorted(found, key=expected_cost)))


def level_of(scene: Scene, effects_name: str, name: str = "") -> Level:
    """Make a level of a scene's own tier, effects, laminae and step; its name says these when left out."""
    numerics = scene.numerics
    level = _level(scene.tier, effects_name, scene.effects, numerics.laminae, numerics.steps_per_sample)
    return replace(level, name=name) if name else level


def chosen_for(scene: Scene, accuracy: float, asked: tuple[str, ...], to: float | None = None) -> Choice:
    """Choose for a scene as `effects: auto` does, whatever the scene is computed with itself.

    The accuracy is a share; a fault line is asked of the vibration, of which every band counts, or those
    up to a frequency, [Hz].
    """
    wanted = {_CHOSEN_AS.get(name, name) for name in asked}
    quantities = tuple(name for name in QUANTITIES if name in wanted)
    every = in_box_of(load_effects("all"), scene.effects)
    return choose(replace(scene, effects=every, accuracy=accuracy, quantities=quantities, vibration_to=to))


def automatic(scene: Scene, accuracy: float, asked: tuple[str, ...]) -> Level:
    """Make the level of `chosen_for`, to be judged against every effect."""
    return level_of(
        chosen_for(scene, accuracy, asked).applied(scene), AUTO, name=f"auto {100.0 * accuracy:g} %"
    )


def _choices(level: Level) -> tuple[str, EffectSet, int, float]:
    return level.tier, level.effects, level.laminae, level.steps_per_sample


def _one_less(effects: EffectSet) -> list[tuple[str, EffectSet]]:
    """List the sets with one effect less that can be computed, by the name of that effect."""
    needed = {"film", "traction"}  # each asks for the other
    names = [field.name for field in fields(effects) if field.name not in needed]
    return [(name, replace(effects, **{name: None})) for name in names if getattr(effects, name) is not None]


def expected_cost(level: Level) -> float:
    """Estimate the wall time per simulated second: for the order of runs and the time left only."""
    base, per_lamina = _FAST_COST.get(level.tier, _FULL_COST)
    many = len(level.effects.names()) > _MANY_EFFECTS and level.tier == "full"
    return (
        level.steps_per_sample * (base + per_lamina * level.laminae) * (_MANY_EFFECTS_FACTOR if many else 1.0)
    )
