"""Rules of weight, damping, coupled laminae and bookkeeping."""

from __future__ import annotations

import math
from dataclasses import replace

from beardyn_core.choice.reference_solution import MOST_DB, REFERENCE_LAMINAE, Evidence, decibels
from beardyn_core.choice.rule import FAST, FULL, Alternative, Rule, absent, on_or_off, percent
from beardyn_core.physics.cage.rubbing import bar_weight

_NOTABLE = 0.01  # of the torque
# What idle rollers on the cage take may be so many times the estimate, which counts them with the rings at
# rest: 1.2 with one roller too large (`oversize_roller`), which lifts its neighbours off once a turn.
_MORE_IDLE = 1.5
_UNDAMPED = 0.2  # of deflection and load after strikes; 7 and 17 % with a flat, its 99 % quantile
# What independent laminae add to third octaves behind a fault in `full`: 1.5 dB at 8 kHz (`cup_spall`), 1.6
# at 10 kHz and 0.5 at 5 kHz (`roller_spall`, where the whole choice was 2.8 dB off).
_UNCOUPLED_FROM, _UNCOUPLED_BELOW_DB, _UNCOUPLED_DB = 5000.0, 0.5, 2.8
# The same where slices are the loudest: `waviness`, 40 of them.
_QUIET_UNCOUPLED_DB = 2.8


def gravity(evidence: Evidence) -> Rule:
    """Decide on weight: on when that of rollers and cages is notable against the load."""
    scene = evidence.scene
    effect = scene.effects.gravity
    if effect is None:
        return absent("gravity")
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
    losses, light = evidence.losses, evidence.losses_without_weight
    drive = losses.drive(scene.effects.traction, scene.effects.film)
    # idle rollers lie on the cage, which loaded ones have to push
    slip = abs(drive.slip - light.drive(scene.effects.traction, scene.effects.film).slip)
    torque = _MORE_IDLE * evidence.pressed * abs(losses.total - light.total)
    if drive.skids:
        # the way up and down brakes and drives rollers that hardly stick: mean amount along the orbit
        part = drive.share(scene.roller_total * bar_weight(bearing, effect.acceleration))
        reason += f", and {percent(part)} of what brakes rollers that hardly stick"
        slip, torque = max(slip, part), max(torque, part * drive.torque)
    moved = evidence.slipping(0.5 * slip)
    influence |= {"torque": evidence.torque_share(torque), "cage_speed": moved["cage_speed"]}
    influence["roller_load"] += moved["roller_load"]
    influence["deflection"] += moved["deflection"]
    if evidence.torque_share(torque) > _NOTABLE:
        most = percent(evidence.torque_share(torque))
        reason += f"; idle ones that lie on the cage make up to {most} of the torque"
    return on_or_off("gravity", effect, reason, influence, evidence.costs.saved("gravity"))


def contact_damping(evidence: Evidence) -> Rule:
    """Decide on contact damping: on for vibration, where it decides the height of resonances."""
    scene = evidence.scene
    effect = scene.effects.contact_damping
    if effect is None:
        return absent("contact_damping")
    cost = evidence.costs.saved("contact_damping")
    if not evidence.moves:
        reason = "the cup is held, so that the axlebox has no resonance to damp; without it rollers bounce"
        return on_or_off("contact_damping", effect, reason, {}, cost)
    bounce = evidence.bounce
    omega = 2.0 * math.pi * bounce.frequency
    contacts = 0.5 * omega * effect.time_constant * bounce.contacts
    box = scene.mounting.box_mass + scene.bearing.cup_mass
    others = 0.5 * scene.mounting.damping[2] / (box * omega) + bounce.axle
    rest = "suspension and axle" if bounce.axle > 0.0 else "the suspension"
    reason = (
        f"contacts damp the axlebox at its {bounce.frequency:.0f} Hz by {percent(contacts)} of "
        f"the critical damping, {rest} by {percent(others)}"
    )
    influence = {"vibration": decibels((contacts + others) / max(others, 1.0e-6))}
    if evidence.struck:
        reason += "; wheel or rail strikes, and loads swing for as long as little damps them"
        influence |= {"deflection": _UNDAMPED, "roller_load": _UNDAMPED}
    return on_or_off("contact_damping", effect, reason, influence, cost)


def audit(evidence: Evidence) -> Rule:
    """Decide on the energy audit: off, because it changes no quantity."""
    effect = evidence.scene.effects.audit
    reason = "keeps the energy balance and changes no quantity"
    if evidence.scene.effects.thermal is not None:
        feeds = Alternative({"audit": effect}, "feeds the thermal effect", tiers=FULL)
        without = Alternative({"audit": None}, "a fast tier keeps no energy balance", tiers=FAST, word="off")
        return Rule("audit", (feeds, without))
    if effect is None:
        return Rule("audit", (Alternative({"audit": None}, reason, word="off"),))
    return on_or_off("audit", effect, reason, {}, evidence.costs.saved("audit"), FULL)


def lamina_coupling(evidence: Evidence) -> Rule:
    """Decide on coupled laminae: on when they distribute the load otherwise than independent ones.

    Over patches both lose the load that a half-space loses (`physics.spall_cover`), but springs that do not
    know each other are louder above 5 kHz. Fast tiers have that in what their third octaves are off by.
    """
    effect = evidence.scene.effects.lamina_coupling
    if effect is None or not effect.about.suits(evidence.scene.bearing.kind):
        return absent("lamina_coupling")
    # a cup that bends leans against its rollers: along the axle it moves with their stiffness against tilt
    many = {"laminae": REFERENCE_LAMINAE, "bending": evidence.statics.flexible}
    change = evidence.difference({**many, "coupling": None}, {**many, "coupling": effect}, heavy=True)
    influence = change.influence()
    reason = (
        f"coupled laminae change the deflection by {percent(change.deflection)} and the largest roller load "
        f"by {percent(change.roller_load)}"
    )
    louder = 0.0
    if evidence.patches:
        louder = _UNCOUPLED_DB if evidence.band > _UNCOUPLED_FROM else _UNCOUPLED_BELOW_DB
    elif evidence.shaken_by_slices:
        louder = _QUIET_UNCOUPLED_DB
    cost = evidence.costs.extra("lamina_coupling")
    on, off = on_or_off("lamina_coupling", effect, reason, influence, cost).alternatives
    beyond = {**influence, "vibration": influence.get("vibration", 0.0) + louder}
    return Rule("lamina_coupling", (on, replace(off, tiers=FAST), replace(off, influence=beyond, tiers=FULL)))
