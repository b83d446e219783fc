"""Rules of the parts that guide the rollers: rib, small rib, cage."""

from __future__ import annotations

import math
from dataclasses import replace

from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.bearing.kinematics import centrifugal_force
from beardyn_core.choice.discretisation_error import edge_time
from beardyn_core.choice.reference_solution import MOST_DB, Evidence, decibels
from beardyn_core.choice.rule import (
    FAST,
    FRICTION_DB,
    FULL,
    Alternative,
    Influence,
    Rule,
    absent,
    on_or_off,
    percent,
)
from beardyn_core.effects import Cage, CageModel, KinematicCage, Rib, RotatingCage

# Torque that a cage which cannot sink leaves out, over that of the pockets of idle rollers: 1.2 to 1.3 in
# runs of three spalled scenes, tried by `make automatic`.
_HELD_UP = 1.35
MOST_SLIP = 1.0


def rib(evidence: Evidence) -> Rule:
    """Decide on the rib: always on, as every loaded roller presses on it; with film for the torque."""
    effect, losses = evidence.scene.effects.rib, evidence.losses
    if effect is None:
        return absent("rib", FULL)
    if not effect.about.suits(evidence.scene.bearing.kind):
        return absent("rib")
    share = float(evidence.typical.rib_load.max()) / max(evidence.typical.largest_roller_load, 1.0e-3)
    full, dry = losses.rib(effect), losses.rib(_plain(effect))
    reason = f"the raceways press the rollers against it with {percent(share)} of their load"
    fuller = effect.lubrication is not None or effect.roller_end or effect.drilling
    if fuller:
        reason += f"; lubricated it takes {full:.3g} N m, dry {dry:.3g} N m "
        reason += f"of a torque of {evidence.torque:.3g} N m"
    costs = evidence.costs
    basic = costs.saved("rib")
    more = 0.0
    if effect.lubrication is not None:
        more += costs.extra("rib lubrication mixed")
    if effect.roller_end or effect.drilling:
        more += costs.extra("rib roller_end, drilling")
    tiers = FULL if effect.roller_end else FAST | FULL
    word = "lubricated" if fuller else "on"
    found = [Alternative({"rib": effect}, reason, {}, basic + more, tiers, word)]
    if effect.roller_end:
        # where rollers do not lean beyond their rims, what is left of it is the same
        inside = replace(effect, roller_end=False)
        found.append(Alternative({"rib": inside}, reason, {}, basic + more, FAST, word))
    if fuller:
        influence = {"torque": evidence.torque_share(full - dry), "vibration": FRICTION_DB}
        drive = losses.drive(evidence.scene.effects.traction, evidence.scene.effects.film)
        if drive.skids:
            # what the ribs brake more, seen at the raceways compared with what these have to drive
            brake = abs(full - dry) / (0.5 * evidence.scene.bearing.pitch_diameter)
            part = drive.share(brake)
            influence["torque"] += evidence.torque_share(part * drive.torque)
            influence |= evidence.slipping(0.5 * part)
        found.append(Alternative({"rib": _plain(effect)}, reason, influence, basic, word="dry"))
    return Rule("rib", tuple(found))


def _plain(effect: Rib) -> Rib:
    return replace(effect, lubrication=None, roller_end=False, drilling=False)


def small_rib(evidence: Evidence) -> Rule:
    """Decide on the small rib: on when rollers can leave the large rib."""
    scene, loads = evidence.scene, evidence.loads
    effect = scene.effects.small_rib
    if effect is None or not effect.about.suits(scene.bearing.kind):
        return absent("small_rib")
    outward = centrifugal_force(scene.bearing, loads.typical.speed) * math.sin(scene.bearing.cup_angle)
    outward /= scene.bearing.roller_mass * STANDARD_GRAVITY
    influence: dict[str, float] = {}
    if loads.reverses:
        reason = (
            f"the axial force goes from {loads.axial_low / 1e3:.3g} to {loads.axial_high / 1e3:.3g} kN "
            "and takes the rollers of one row after the other off the large rib"
        )
        influence = {"vibration": MOST_DB, "roller_load": 0.01}
    else:
        if outward < 1.0:
            influence = {"vibration": decibels(1.0 + 1.0 / max(outward, 0.1))}
        reason = (
            f"the centrifugal force holds idle rollers at the large rib with {outward:.2g} times their weight"
        )
    return on_or_off("small_rib", effect, reason, influence, evidence.costs.extra("small_rib"), FULL)


def cage(evidence: Evidence) -> Rule:
    """Decide on the cage: dynamic for slip, a worn pocket or vibration; otherwise kinematic."""
    scene, losses = evidence.scene, evidence.losses
    effects = scene.effects
    effect = effects.cage
    if effect is None:
        return absent("cage")
    drive = losses.drive(effects.traction, effects.film)
    slip = 0.5 * drive.slip
    reason = f"the rollers slip by {percent(drive.slip)} of their rolling speed"
    reason += f", using {percent(drive.used)} of the traction"
    worn = evidence.worn_pockets
    if worn:
        reason += f"; a pocket is worn by {1e3 * max(defect.clearance for defect in worn):.2g} mm"
    if drive.needed == 0.0:
        reason = "nothing turns the cage"
    pocket = evidence.torque_share(evidence.pressed * losses.pocket)
    knock = MOST_DB if worn else decibels(1.0 + losses.pocket_force / max(_excitation(evidence), 1.0))
    costs = evidence.costs
    basic = costs.saved("cage")
    # what idle rollers lay on the cage makes loaded ones slip: other pockets, another slip
    weighed = abs(losses.total - evidence.losses_without_weight.total)
    left = {"torque": max(pocket, evidence.torque_share(evidence.pressed * weighed))}
    # where the raceways hardly drive the rollers, pockets decide at which speed they go
    if drive.skids:
        left = {"torque": pocket + evidence.torque_share(drive.torque), **evidence.slipping(0.5)}

    def alternative(
        word: str, model: CageModel | None, cost: float, without: Influence, tiers: frozenset[str]
    ) -> Alternative:
        return Alternative({"cage": model}, reason, without, max(cost, 0.001), tiers, word)

    lubricated = isinstance(effect, Cage) and effect.lubrication is not None
    whole = basic + costs.extra("cage lubrication") if lubricated else basic
    found = [alternative(f"{effect.kind}{', lubricated' if lubricated else ''}", effect, whole, {}, FULL)]
    speed = {"cage_speed": MOST_SLIP if worn else max(slip, left.get("cage_speed", 0.0))}
    if isinstance(effect, Cage):
        if lubricated:
            dry = {**left, "vibration": knock}
            found.append(alternative("six_dof, dry", replace(effect, lubrication=None), basic, dry, FULL))
        spin = costs.instead("cage", "cage rotating")
        loss = {**left, "torque": _HELD_UP * left["torque"], "vibration": knock}
        found.append(alternative("rotating", RotatingCage(), spin, loss, FULL))
        prescribed = costs.instead("cage", "cage kinematic")
        # at a prescribed speed the cage takes over part of the force that rolling needs from the raceways
        taken = evidence.torque_share(0.25 * drive.needed * scene.bearing.pitch_diameter)
        loss = {**left, "torque": _HELD_UP * left["torque"] + taken, "vibration": knock, **speed}
        found.append(alternative("kinematic", KinematicCage(), prescribed, loss, FULL))
    if not isinstance(effect, KinematicCage):
        # slip and rattle are states in `quasistatic`
        moves = frozenset({"quasistatic"})
        found.append(alternative("in its plane", effect, costs.of_loose_rollers, {}, moves))
    found.append(alternative("off", None, 0.001, {**left, "vibration": knock, **speed}, FAST))
    if not isinstance(effect, KinematicCage):
        # in `lumped` pockets only rub, which costs nothing
        rubs = frozenset({"lumped"})
        found.append(alternative("as friction", effect, 0.001, {"vibration": knock, **speed}, rubs))
    return Rule("cage", tuple(found))


def _excitation(evidence: Evidence) -> float:
    """Compute the force that shakes the axlebox at the end of the band where a fault takes it off, [N].

    A fault takes it from a roller over the time of its edge, a pocket knocks at once. A fault on a roller
    strikes once in a while, and does not drown what the cage does in between.
    """
    received = [
        share * min(1.0 / (math.pi * evidence.band * edge_time(evidence, patch)), 1.0)
        for patch, share in zip(evidence.patches, evidence.patch_shares, strict=True)
        if patch.on != "roller"
    ]
    return max(received, default=0.0) * evidence.typical.largest_roller_load
