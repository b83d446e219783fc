"""Which rungs a ladder has, and what they are expected to cost."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

from beardyn_core.choice.choose import choose
from beardyn_core.choice.outcome import Choice
from beardyn_core.config import load_effects
from beardyn_core.effects import EffectSet
from beardyn_core.integrate.friction_steps import usual_steps
from beardyn_core.scene.scene import QUANTITIES, Scene
from beardyn_core.scene.tier import TIERS
from beardyn_core.study.rung import Rung

REFERENCE_LAMINAE, REFERENCE_STEPS = 40, 8
# effects named by these are known by what they hold only
AUTO, OF_THE_SCENE = "auto", "of the scene"
# measured as a level in the spectrum of the vibration: what one asks of it, the choice has to hold there
_CHOSEN_AS = {"fault_line": "vibration"}
# wall time per simulated second on one core of a 2.5 GHz machine, for the progress bar and the order of runs
_FAST_COST = {"lumped": (0.06, 0.002), "quasistatic": (0.06, 0.012)}
_FULL_COST = (0.10, 0.025)
_FAST_EFFECTS = "standard"
_MANY_EFFECTS, _MANY_EFFECTS_FACTOR = 10, 1.8


@dataclass(frozen=True)
class RungList:
    """The reference, its coarser neighbour, and the rungs to be judged.

    Parameters
    ----------
    reference : Rung
        Every effect, many laminae, a small step.
    neighbour : Rung
        Half of the reference's laminae and twice its step.
    rungs : tuple of Rung
        The cheapest first.
    """

    reference: Rung
    neighbour: Rung
    rungs: tuple[Rung, ...]

    def including(self, *more: Rung) -> RungList:
        """The same with other rungs among those to be judged."""
        return replace(self, rungs=tuple(sorted([*self.rungs, *more], key=expected_cost)))


def _rung(tier: str, effects_name: str, effects: EffectSet, laminae: int, steps: float) -> Rung:
    words = [] if tier == "full" else [tier]
    if tier == "full" or effects_name != _FAST_EFFECTS:
        words.append(f"effects {effects_name}")
    name = ", ".join([*words, f"{laminae} laminae x {steps}"])
    return Rung(name, tier, effects_name, effects, laminae, steps)


def rungs_of(scene: Scene, quick: bool = False, each_effect: bool = False) -> RungList:
    """The rungs of a scene's ladder.

    Parameters
    ----------
    scene : Scene
    quick : bool
        Few rungs, and none with effects that the shipped presets do not have.
    each_effect : bool
        Also `full` less each of its effects in turn.

    Returns
    -------
    RungList
    """
    full, standard, dry = (load_effects(name) for name in ("full", "standard", "dry"))
    reference = replace(_rung("full", "full", full, REFERENCE_LAMINAE, REFERENCE_STEPS), name="reference")
    neighbour = _rung("full", "full", full, REFERENCE_LAMINAE // 2, REFERENCE_STEPS // 2)
    lumped, balanced, usual = (TIERS[name].steps_per_sample for name in ("lumped", "quasistatic", "full"))
    fast: dict[str, tuple[tuple[int, int], ...]] = {"lumped": ((6, lumped),), "quasistatic": ((6, balanced),)}
    steps: dict[str, tuple[EffectSet, tuple[tuple[int, int], ...]]] = {
        "dry": (dry, ((6, usual_steps(dry, 6)),)),
        "standard": (standard, ((6, usual),)),
        "full": (full, ((6, usual),)),
    }
    if not quick:
        fast = {
            "lumped": ((1, lumped), (6, lumped), (6, 4 * lumped)),
            "quasistatic": (
                (3, balanced),
                (6, balanced),
                (6, 2 * balanced),
                (6, 4 * balanced),
                (20, balanced),
            ),
        }
        losses = {name: getattr(full, name) for name in ("rolling_resistance", "drag", "seal")}
        lossy = replace(standard, **losses)
        steps |= {
            "standard": (
                standard,
                ((3, usual), (6, 2), (6, 3), (6, usual), (6, 2 * usual), (20, usual)),
            ),
            "standard + losses": (lossy, ((6, usual),)),
            "standard + losses + ring_flexibility": (
                replace(lossy, ring_flexibility=full.ring_flexibility),
                ((6, usual),),
            ),
            "full - lamina_coupling": (replace(full, lamina_coupling=None), ((6, usual),)),
            "full": (
                full,
                (
                    (3, usual),
                    (6, 2),
                    (6, 3),
                    (6, usual),
                    (6, 2 * usual),
                    (6, 4 * usual),
                    (10, usual),
                ),
            ),
        }
    if each_effect:
        steps |= {f"full - {name}": (less, ((6, usual),)) for name, less in _one_less(full)}
    found = [
        _rung(tier, _FAST_EFFECTS, standard, laminae, count)
        for tier, choices in fast.items()
        for laminae, count in choices
    ]
    found += [
        _rung("full", name, effects, laminae, count)
        for name, (effects, choices) in steps.items()
        for laminae, count in choices
    ]
    found.append(neighbour)
    known = {effects: name for name, (effects, _) in steps.items()}
    own = rung_of(scene, known.get(scene.effects, OF_THE_SCENE))
    if _choices(own) not in [_choices(rung) for rung in found]:
        found.append(own)
    return RungList(reference, neighbour, tuple(sorted(found, key=expected_cost)))


def rung_of(scene: Scene, effects_name: str, name: str = "") -> Rung:
    """What a scene itself is computed with, as a rung.

    Parameters
    ----------
    scene : Scene
    effects_name : str
        What its effects are called.
    name : str, optional
        Of the rung; from its choices when not given.
    """
    numerics = scene.numerics
    rung = _rung(scene.tier, effects_name, scene.effects, numerics.laminae, numerics.steps_per_sample)
    return replace(rung, name=name) if name else rung


def chosen_for(scene: Scene, accuracy: float, asked: tuple[str, ...]) -> Choice:
    """What `effects: auto` chooses for a scene, whatever the scene is computed with itself.

    Parameters
    ----------
    scene : Scene
    accuracy : float
        Asked for, [-].
    asked : tuple of str
        Quantities that it is asked of; a fault line is asked of the vibration.
    """
    wanted = {_CHOSEN_AS.get(name, name) for name in asked}
    quantities = tuple(name for name in QUANTITIES if name in wanted)
    return choose(replace(scene, effects=load_effects("full"), accuracy=accuracy, quantities=quantities))


def automatic(scene: Scene, accuracy: float, asked: tuple[str, ...]) -> Rung:
    """The rung of `chosen_for`, to be judged against every effect."""
    return rung_of(
        chosen_for(scene, accuracy, asked).applied(scene), AUTO, name=f"auto {100.0 * accuracy:g} %"
    )


def _choices(rung: Rung) -> tuple[str, EffectSet, int, float]:
    return rung.tier, rung.effects, rung.laminae, rung.steps_per_sample


def _one_less(effects: EffectSet) -> list[tuple[str, EffectSet]]:
    """Sets with one effect less that can be computed, by the name of that effect."""
    needed = {"film", "traction"}  # each asks for the other
    names = [field.name for field in fields(effects) if field.name not in needed]
    return [(name, replace(effects, **{name: None})) for name in names if getattr(effects, name) is not None]


def expected_cost(rung: Rung) -> float:
    """Wall time per simulated second to expect: for the order of runs and the time left, nothing else."""
    base, per_lamina = _FAST_COST.get(rung.tier, _FULL_COST)
    many = len(rung.effects.names()) > _MANY_EFFECTS and rung.tier == "full"
    return (
        rung.steps_per_sample * (base + per_lamina * rung.laminae) * (_MANY_EFFECTS_FACTOR if many else 1.0)
    )
