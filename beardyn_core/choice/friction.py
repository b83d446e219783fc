"""Rules of friction: traction with film, rolling resistance, drag, seals, warming."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from beardyn_core.choice.discretisation_error import QUIET_BAND
from beardyn_core.choice.losses import LOST_GRIP, Drive
from beardyn_core.choice.reference_solution import Evidence
from beardyn_core.choice.rule import FAST, FRICTION_DB, FULL, Alternative, Rule, absent, on_or_off, percent
from beardyn_core.effects import (
    CoulombTraction,
    LineFilm,
    LoadSharingTraction,
    MixedTraction,
    Thermal,
    Traction,
)
from beardyn_core.physics.cage.drag import CAGE_DRAGS
from beardyn_core.physics.thermal import thermal_network

# Runs shorter than this stay at the temperature the scene gives.
_SMALLEST_DRIFT = 0.01  # that a reason mentions, [K]
_SHORT = 60.0
# Torque goes about with this power of the viscosity, which falls with `temperature_coefficient`.
_VISCOSITY_POWER = 0.66
# What raceways lose by the creep of skewed rollers over what the ribs lose: twice what the audit of `full`
# finds with films and without, see evidence/automatic/torque.py.
_CREEP, _DRY_CREEP = 0.05, 0.07
# What the fast tiers add to the third octaves around the resonance along the axle, all axes together, where
# no creep along the cup damps it, [dB]: docs/effects_auto.md, rows without creep.
UNDAMPED_DB, UNDAMPED_QUIET_DB = 8.5, 2.0
# Torque that the fast tiers miss besides where the box bends in modes: 4 to 6 % with every effect
# (docs/evidence/ladder.md, service_high_speed and its cup), 1 % where it bends in rings (wheel_flat).
_BY_MODES = 0.05
# Barrels slide along the ellipses of their contacts, which the estimate of the torque leaves out: of 6.1 N m
# of SRB120x260 under 80 kN at 600 rpm fast tiers miss 47 %, another law of friction changes it by 4 %.
_SLIDING_OF_ELLIPSE, _OF_ANOTHER_LAW = 0.6, 0.1


def traction(evidence: Evidence) -> Rule:
    """Decide on the law of friction that drives the rollers: all agree while little traction is used."""
    effects, losses = evidence.scene.effects, evidence.losses
    reference = losses.drive(effects.traction, effects.film)
    parameter = losses.film_parameter(effects.film)
    use = "would need" if reference.used > 1.0 else "use"
    reason = (
        f"the rollers {use} {percent(reference.used)} of the traction there is, at a film of "
        f"{parameter:.2f} times the roughness"
        if reference.needed > 0.0
        else "nothing has to be driven"
    )
    if effects.traction is None:
        reason = "no law of friction is given"
    elif reference.slip > LOST_GRIP:
        reason += ": they skid, and the law of friction decides the torque"
    costs = evidence.costs

    def alternative(word: str, law: Traction, film: LineFilm | None, cost: float) -> Alternative:
        drive, same = losses.drive(law, film), law is effects.traction
        told = reason if same else f"{reason}; by this law {percent(drive.used)}"
        errors = {} if same and film is effects.film else _other_law(evidence, drive, reference, law, film)
        return Alternative({"traction": law, "film": film}, told, errors, cost, FULL, word)

    found = []
    mixed_cost = costs.saved("traction")
    if effects.traction is not None:
        thermal = 0.0
        if effects.film is not None and (effects.film.thermal != "none" or effects.film.isoviscous):
            thermal = costs.extra("film thermal, isoviscous")
        law_cost = mixed_cost
        if isinstance(effects.traction, LoadSharingTraction):
            law_cost += costs.extra("traction load_sharing")
        word = f"{effects.traction.kind}, {'film' if effects.film is not None else 'no film'}"
        found.append(alternative(word, effects.traction, effects.film, law_cost + thermal))
        if effects.film is not None and isinstance(effects.traction, LoadSharingTraction):
            found.append(alternative("mixed, film", MixedTraction(), LineFilm(), mixed_cost))
        dry = costs.instead("traction", "traction coulomb, no film")
        found.append(alternative("coulomb, no film", CoulombTraction(), None, dry))
    # nothing else drives the rollers of the full tier
    tiers = FAST if effects.traction is not None else FAST | FULL
    rolling = f"the tier's rollers roll without slip; {reason}"
    without = _without_slip(evidence, reference)
    creeps = effects.traction is not None and effects.film is not None
    undamped = UNDAMPED_DB if evidence.band > QUIET_BAND else UNDAMPED_QUIET_DB
    # a film stays: it is what starves the rolling resistance
    found.append(
        Alternative(
            {"traction": None, "film": effects.film},
            rolling,
            {**without, "vibration": undamped if creeps else 0.0},
            0.0,
            tiers,
            "off",
        )
    )
    if creeps:
        creeping = f"the tier's rollers creep along the cup and roll without slip; {reason}"
        members = {"traction": effects.traction, "film": effects.film}
        found.append(Alternative(members, creeping, without, mixed_cost, FAST, word))
    return Rule("traction", tuple(found))


def _other_law(
    evidence: Evidence, drive: Drive, reference: Drive, law: Traction, film: LineFilm | None
) -> dict[str, float]:
    """Bound the errors of another law of friction where nothing skids.

    Rib friction skews the rollers, and the raceways lose a little by their creep, which each law gives
    differently; the creep also moves the resonance of the axlebox. Another film feeds the rolling resistance.
    """
    losses = evidence.losses
    found = _apart(evidence, drive, reference)
    found["torque"] += _creep(evidence, law) + _creep(evidence, evidence.scene.effects.traction)
    found["torque"] += evidence.torque_share(losses.rolling_with(film) - losses.rolling)
    if evidence.scene.bearing.self_aligning:
        found["torque"] += _OF_ANOTHER_LAW
    found["vibration"] = FRICTION_DB
    return found


def _without_slip(evidence: Evidence, reference: Drive) -> dict[str, float]:
    """Bound the errors of pure rolling, which leaves out slip and the creep of skewed rollers."""
    found = _apart(evidence, Drive(0.0, 1.0, 0.0, 0.0), reference)
    found["torque"] += _creep(evidence, evidence.scene.effects.traction)
    structure = evidence.scene.effects.structure
    if structure is not None and structure.kind == "modes":
        found["torque"] += _BY_MODES
    if evidence.scene.bearing.self_aligning:
        found["torque"] += _SLIDING_OF_ELLIPSE
    return found


def _creep(evidence: Evidence, law: Traction | None) -> float:
    if law is None:
        return 0.0
    share = _DRY_CREEP if isinstance(law, CoulombTraction) else _CREEP
    return evidence.torque_share(share * evidence.losses.rib(evidence.scene.effects.rib))


def _apart(evidence: Evidence, one: Drive, other: Drive) -> dict[str, float]:
    """Compute the errors when one law of friction replaces another; slip changes the orbit speed."""
    return {
        "torque": evidence.torque_share(one.torque - other.torque),
        **evidence.slipping(0.5 * abs(one.slip - other.slip)),
    }


def rolling_resistance(evidence: Evidence) -> Rule:
    """Decide on rolling resistance: on when it makes up a notable part of the torque."""
    effects, losses = evidence.scene.effects, evidence.losses
    effect = effects.rolling_resistance
    if effect is None:
        return absent("rolling_resistance")
    drive = losses.drive(effects.traction, effects.film)
    less = losses.drive(effects.traction, effects.film, rolling=False)
    reason = f"{losses.rolling:.3g} N m of a torque of about {evidence.torque:.3g} N m"
    influence = {
        "torque": evidence.torque_share(losses.rolling) + evidence.torque_share(drive.torque - less.torque),
        **evidence.slipping(0.5 * abs(drive.slip - less.slip)),
    }
    return on_or_off(
        "rolling_resistance", effect, reason, influence, evidence.costs.extra("rolling_resistance")
    )


def drag(evidence: Evidence) -> Rule:
    """Decide on drag: on when it makes up a notable part of the torque, or brakes rollers that slip."""
    effects, losses = evidence.scene.effects, evidence.losses
    if effects.drag is None:
        return absent("drag")
    drive = losses.drive(effects.traction, effects.film)
    less = losses.drive(effects.traction, effects.film, drag=False)
    reason = f"{losses.drag:.3g} N m of a torque of about {evidence.torque:.3g} N m"
    part = drive.share(drive.needed - less.needed) if drive.skids else 0.0
    if part > 0.0:
        reason += f", {percent(part)} of what brakes rollers that hardly stick"
    influence = {
        "torque": evidence.torque_share(losses.drag) + evidence.torque_share(part * drive.torque),
        **evidence.slipping(0.5 * max(abs(drive.slip - less.slip), part)),
    }
    return on_or_off("drag", effects.drag, reason, influence, evidence.costs.extra("drag"))


def seal(evidence: Evidence) -> Rule:
    """Decide on the seals: on when they make up a notable part of the torque."""
    effect, torque = evidence.scene.effects.seal, evidence.losses.seal
    if effect is None:
        return absent("seal")
    reason = f"{torque:.3g} N m of a torque of about {evidence.torque:.3g} N m"
    influence = {"torque": evidence.torque_share(torque)}
    return on_or_off("seal", effect, reason, influence, evidence.costs.extra("seal"))


def cage_drag_rules() -> tuple[Callable[[Evidence], Rule], ...]:
    """Make a rule for each effect that brakes the cages: on when it makes up a notable part of the torque."""
    return tuple(map(_cage_drag_rule, CAGE_DRAGS))


def _cage_drag_rule(name: str) -> Callable[[Evidence], Rule]:
    def rule(evidence: Evidence) -> Rule:
        effect = getattr(evidence.scene.effects, name)
        if effect is None:
            return absent(name)
        torque = evidence.losses.cage_drag.get(effect.about.loss, 0.0)
        reason = f"{torque:.3g} N m of a torque of about {evidence.torque:.3g} N m"
        influence = {"torque": evidence.torque_share(torque)}
        return on_or_off(name, effect, reason, influence, evidence.costs.extra(name))

    rule.__name__ = name
    return rule


def thermal(evidence: Evidence) -> Rule:
    """Decide on warming: on when a run is so long that its losses warm the oil."""
    scene = evidence.scene
    effect = scene.effects.thermal or Thermal()
    drift = _warming(evidence, effect)
    influence = {"torque": min(_VISCOSITY_POWER * scene.lubricant.temperature_coefficient * abs(drift), 1.0)}
    reason = f"in {scene.duration:g} s {_drift_text(drift)}"
    if scene.duration < _SHORT and scene.effects.thermal is None:
        return Rule("thermal", (Alternative({"thermal": None}, reason, word="off"),))
    cost = evidence.costs.extra("thermal")
    fed = cost + evidence.costs.saved("audit")
    on = Alternative({"thermal": effect}, f"{reason}; the audit feeds it", {}, fed, FULL)
    fast = Alternative({"thermal": effect}, reason, {}, cost, FAST)
    return Rule("thermal", (on, fast, Alternative({"thermal": None}, reason, influence, word="off")))


def _drift_text(drift: float) -> str:
    if abs(drift) < _SMALLEST_DRIFT:
        return f"the temperature of the oil changes by less than {_SMALLEST_DRIFT:g} K"
    return f"the oil {'warms' if drift > 0.0 else 'cools'} by about {abs(drift):.2g} K"


def _warming(evidence: Evidence, effect: Thermal) -> float:
    """Compute the drift of the temperature of bearing and box as one body by the end of the run, [K]."""
    scene, speed = evidence.scene, abs(evidence.loads.typical.speed)
    network = thermal_network(
        scene.bearing, effect, scene.mounting.box_mass, speed, scene.roller_total, scene.rows
    )
    capacity, leaving = float(np.sum(network.capacity)), float(np.sum(network.to_ambient))
    gain = evidence.torque * speed - leaving * (scene.temperature - effect.ambient)
    if leaving <= 0.0:
        return gain * scene.duration / capacity
    return float(gain / leaving * -np.expm1(-scene.duration * leaving / capacity))
