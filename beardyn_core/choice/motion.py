"""Rules of weight, damping and bookkeeping."""

from __future__ import annotations

import math

from beardyn_core.choice.evidence import MOST_DB, Evidence, decibels
from beardyn_core.choice.rule import Alternative, Rule, percent

_FAST, _FULL = frozenset({"lumped", "quasistatic"}), frozenset({"full"})


def gravity(evidence: Evidence) -> Rule:
    """Decide on weight: on when that of rollers and cages is notable against the load."""
    scene = evidence.scene
    effect = scene.effects.gravity
    if effect is None:
        return Rule("gravity", (Alternative({"gravity": None}, "not in the reference", word="off"),))
    bearing = scene.bearing
    rolling = scene.roller_total * bearing.roller_mass
    weight = effect.acceleration * (rolling + scene.rows * bearing.cage.mass)
    share = weight / max(evidence.loads.typical.size, 1.0)
    reason = f"rollers and cages weigh {weight:.3g} N, {percent(share)} of the load"
    influence = {"force": share, "deflection": share, "roller_load": share}
    if evidence.moves:
        # where they lie decides what they hit: no estimate of a level is known, so the bound is taken
        reason += "; where idle rollers and cages rattle is theirs to decide"
        influence["vibration"] = MOST_DB
    drive = evidence.losses.drive(scene.effects.traction, scene.effects.film)
    if drive.skids:
        # the way up and down brakes and drives rollers that hardly stick: mean amount along the orbit
        rollers = effect.acceleration * rolling * 2.0 / math.pi
        part = drive.share(rollers)
        reason += f", and {percent(part)} of what brakes rollers that hardly stick"
        moved = evidence.slipping(0.5 * part)
        influence |= {"torque": evidence.torque_share(part * drive.torque), "cage_speed": moved["cage_speed"]}
        influence["roller_load"] += moved["roller_load"]
        influence["deflection"] += moved["deflection"]
    return Rule(
        "gravity",
        (
            Alternative({"gravity": effect}, reason, {}, evidence.costs.saved("gravity")),
            Alternative({"gravity": None}, reason, influence, word="off"),
        ),
    )


def contact_damping(evidence: Evidence) -> Rule:
    """Decide on contact damping: on for vibration, where it decides the height of resonances."""
    scene = evidence.scene
    effect = scene.effects.contact_damping
    if effect is None:
        return Rule(
            "contact_damping", (Alternative({"contact_damping": None}, "not in the reference", word="off"),)
        )
    if not evidence.moves:
        reason = "the cup is held, so that the axlebox has no resonance to damp; without it rollers bounce"
        return Rule(
            "contact_damping",
            (
                Alternative({"contact_damping": effect}, reason, {}, evidence.costs.saved("contact_damping")),
                Alternative({"contact_damping": None}, reason, word="off"),
            ),
        )
    omega = 2.0 * math.pi * evidence.resonance
    contacts = 0.5 * omega * effect.time_constant
    box = scene.mounting.box_mass + scene.bearing.cup_mass
    others = 0.5 * scene.mounting.damping[2] / (box * omega)
    reason = (
        f"contacts damp the axlebox at its {evidence.resonance:.0f} Hz by {percent(contacts)} of "
        f"the critical damping, the suspension by {percent(others)}"
    )
    influence = {"vibration": decibels((contacts + others) / max(others, 1.0e-6))}
    return Rule(
        "contact_damping",
        (
            Alternative({"contact_damping": effect}, reason, {}, evidence.costs.saved("contact_damping")),
            Alternative({"contact_damping": None}, reason, influence, word="off"),
        ),
    )


def audit(evidence: Evidence) -> Rule:
    """Decide on the energy audit: off, because it changes no quantity."""
    effect = evidence.scene.effects.audit
    reason = "keeps the energy balance and changes no quantity"
    if evidence.scene.effects.thermal is not None:
        feeds = Alternative({"audit": effect}, "feeds the thermal effect", tiers=_FULL)
        without = Alternative({"audit": None}, "a fast tier keeps no energy balance", tiers=_FAST, word="off")
        return Rule("audit", (feeds, without))
    alternatives = [Alternative({"audit": None}, reason, word="off")]
    if effect is not None:
        alternatives.insert(
            0, Alternative({"audit": effect}, reason, {}, evidence.costs.saved("audit"), _FULL)
        )
    return Rule("audit", tuple(alternatives))
