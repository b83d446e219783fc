"""Errors of a tier with fewer states than the full one and of a lamina count; the time step."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache, partial

import numpy as np

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.lamina_coupling import coupled_law, joint_depth, part_exponent
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.choice.fast_step import SLOW_BAND, fast_steps
from beardyn_core.choice.reference_solution import MOST_DB, REFERENCE_LAMINAE, Evidence, decibels
from beardyn_core.choice.rule import Choice, Influence, Verdict, percent
from beardyn_core.choice.usual_step import refine_for_outputs, with_modes
from beardyn_core.effects import Cage, EffectSet, LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.cage.pocket_film import pocket_film_params
from beardyn_core.physics.journal import bending_give
from beardyn_core.physics.lamina_table import surface_radius
from beardyn_core.physics.spall_cover import counted_cover, lamina_cover
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.physics.tiers.step_choice import USUAL_NOISE, choose_steps
from beardyn_core.scene.patch import Patch

_FINE = 400
_DEPTH = 1.0e-5  # of a working load [m]
_NOTHING = 1.0e-9
LAMINAE = (2, 4, 6, 8, 10, 12, 16, 20, 28, 40)
# Of third octaves behind a fault that is shorter than the roller: `roller_spall` was 1.6 dB off with 4
# coupled laminae and 0.65 with 6, where the other errors add up to 1.4.
_FEW, _OF_FEW_DB = 6, 0.5
# What slices shake a box with, as power over that of 40 of them: as much again with so many, falling with a
# power of their number. Of `waviness`, coupled, 4 slices were 11.4 dB too loud, 8, 12, 16 and 20 by 6.0, 3.5,
# 2.0 and 1.2; with waves a fifth as high 8 and 20 by 8.3 and 2.0. Between thin or rigid rings, and with a
# surface, be it fine, 4 were within 0.8 dB.
_KNOCKING_SLICES, _KNOCKING_POWER = 18.0, 2.5
# Width of a third-octave band over its centre.
_BAND = 0.2316
# One Newton step of the rollers in a time step, and the neglected turn of the normals: see test/tiers.
_QUASISTATIC_SHARE = 0.005
_LONGEST_STEP = 1.0 / 25_600.0  # of rollers that move in their pockets [s]
# Torque that a tier may miss over that of the pockets as the losses estimate it, against runs of `full` with
# every effect: see evidence/automatic/torque.py.
POCKETS = {"quasistatic": 0.8, "lumped": 2.0}
# What third octaves of a tier are off by at most against `full`, [dB]: to 400 Hz and to 1 kHz of a healthy
# bearing, to 5 kHz and above. See evidence/automatic/bands.py, whose table is held against them.
QUIET_BAND, IN_QUIET_BAND = 400.0, 1.1
LOW_BAND, IN_LOW_BAND = 1000.0, 2.0
MIDDLE_BAND, IN_MIDDLE_BAND = 5000.0, {"quasistatic": 6.0, "lumped": 6.0}
BEYOND = {"quasistatic": 9.0, "lumped": 22.0}
COUPLED_IN_MIDDLE_BAND, COUPLED_BEYOND = 6.0, 9.0  # of `quasistatic` with coupled laminae
# Share of the deflection that one spring a roller may miss with third octaves as above: `oversize_roller`
# misses 5.3 %, and is up to 6.6 dB off to 1 kHz and 11 dB to 5 kHz.
FITTING_SPRING = 0.03


def laminae(evidence: Evidence, count: int, tier: str) -> Verdict:
    """Compute the errors of a lamina count: load distribution, tilt stiffness, load lost over patches."""
    change = evidence.difference(
        {"laminae": count, "bending": evidence.statics.flexible},
        {"laminae": REFERENCE_LAMINAE, "bending": evidence.statics.flexible},
        heavy=True,
    )
    length = evidence.scene.bearing.effective_length
    partial = [patch for patch in evidence.patches if patch.length < length]
    tilt = max(abs(tilt_error(patch, length, count)) for patch in (None, *partial))
    if evidence.scene.bearing.self_aligning:  # rollers that hold no tilt
        tilt = 0.0
    # a mode that moves by half of that takes its level out of its band by as much
    shift = decibels(1.0 + 0.5 * tilt / _BAND)
    influence = {**change.influence(), "vibration": shift + decibels(change.stiffness)}
    reason = (
        f"{percent(change.deflection)} of the deflection is left out, {percent(tilt)} of the tilt stiffness"
    )
    if partial:
        lever = max(lever_error(patch, length, count) for patch in partial)
        influence["vibration"] += decibels(1.0 + lever)
        # over the patch the neighbours take what the line of springs gives wrongly
        influence["roller_load"] += 0.5 * (tilt + lever)
        shortest = 1e3 * min(patch.length for patch in partial)
        reason += f"; a patch of {shortest:.3g} mm tilts its roller {percent(lever)} wrong"
        coupling = evidence.scene.effects.lamina_coupling
        if coupling is not None and coupling.about.suits(evidence.scene.bearing.kind):
            taken = max(taking_error(patch, evidence.scene.bearing, coupling, count) for patch in partial)
            influence["vibration"] += decibels(1.0 + taken)
            reason += f" and takes {percent(taken)} too much or too little from it"
        if tier == "full" and count < _FEW:
            influence["vibration"] += _OF_FEW_DB
    if tier == "full" and evidence.shaken_by_slices:
        knocking = _knocking(count)
        influence["vibration"] += knocking
        reason += (
            f"; slices that meet the raceway one after the other shake the box, and little else does: "
            f"{knocking:.2g} dB"
        )
    influence["vibration"] = min(influence["vibration"], MOST_DB)
    return Verdict(reason, influence)


def _knocking(count: int) -> float:
    """Compute what so many slices add to third octaves of a box that little else shakes, [dB]."""
    few, many = (1.0 + (_KNOCKING_SLICES / each) ** _KNOCKING_POWER for each in (count, REFERENCE_LAMINAE))
    return decibels(math.sqrt(few / many))


def _uncovered_laminae(patch: Patch | None, length: float, count: int) -> tuple[list[float], list[float]]:
    """Find the middle of each lamina, and its length next to a patch, [m]."""
    step = length / count
    middles = [-0.5 * length + (index + 0.5) * step for index in range(count)]
    if patch is None:
        return middles, [step] * count
    low, high = patch.offset - 0.5 * patch.length, patch.offset + 0.5 * patch.length
    covered = [max(min(high, place + 0.5 * step) - max(low, place - 0.5 * step), 0.0) for place in middles]
    return middles, [step - part for part in covered]


def tilt_error(patch: Patch | None, length: float, count: int) -> float:
    """Compute the error of the tilt stiffness of the line next to a patch, against the reference, [-].

    What is left of a lamina acts at the lamina's middle.
    """

    def second_moment(laminae: int) -> float:
        middles, left = _uncovered_laminae(patch, length, laminae)
        return sum(part * place**2 for place, part in zip(middles, left, strict=True))

    fine = second_moment(_FINE)
    return (second_moment(count) - second_moment(REFERENCE_LAMINAE)) / fine if fine > 0.0 else 0.0


def lever_error(patch: Patch, length: float, count: int) -> float:
    """Compute by how much laminae misplace the load lost over a patch, per quarter of the length, [-].

    The covered share of a lamina acts at the lamina's middle.
    """
    step = length / count
    low = max(patch.offset - 0.5 * patch.length, -0.5 * length)
    high = min(patch.offset + 0.5 * patch.length, 0.5 * length)
    if high <= low:
        return 0.0
    moment = covered = 0.0
    for index in range(count):
        left = -0.5 * length + index * step
        share = max(min(high, left + step) - max(low, left), 0.0)
        covered += share
        moment += share * (left + 0.5 * step)
    return abs(moment / covered - 0.5 * (low + high)) / (0.25 * length)


@cache
def taking_error(patch: Patch, bearing: RollerBearing, coupling: LaminaCoupling, count: int) -> float:
    """Compute the error of coupled laminae in the load that a roller loses over a patch, [-].

    Relative to what the reference's laminae take.
    """

    def taken(laminae: int) -> float:
        cover = counted_cover(bearing, [patch], laminae, coupling)[0]
        depth = np.full(laminae, _DEPTH)
        gap = patch.depth * lamina_cover(bearing, patch, laminae) / np.maximum(cover, _NOTHING)
        joint, share = joint_depth(depth, gap, cover, part_exponent(coupling.strength))
        loads, _, _ = coupled_law(
            np.array([joint, depth]), 1.0, bearing_lamina_root(bearing, coupling, laminae)
        )
        return 1.0 - float(loads[0] @ share) / float(loads[1].sum())

    reference = taken(REFERENCE_LAMINAE)
    return abs(taken(count) / reference - 1.0) if reference > _NOTHING else 0.0


def steps(evidence: Evidence, effects: EffectSet, tier: str, laminae: int, vibration: bool) -> StepChoice:
    """Find the longest step that is converged at the current stiffness.

    Friction decides; what else a choice may change is taken as in the reference. A sensor that needs
    more steps for its rate gets them.
    """
    loads, scene = evidence.loads, evidence.scene
    band = evidence.band if vibration else 0.0
    if tier != "full":
        there = replace(scene, tier=tier, effects=effects)
        slow = vibration and scene.vibration_to is not None and band <= SLOW_BAND
        found = fast_steps(there, long=slow, band=band)
        return refine_for_outputs(with_modes(found, there, band), scene)
    radial = [math.hypot(case.force[0], case.force[2]) for case in loads.cases]
    found = choose_steps(
        scene.bearing,
        (min(radial), max(radial)),
        (abs(loads.typical.speed), loads.top_speed),
        effects,
        laminae,
        axial=loads.axial_high,
        end_play=scene.end_play,
        mounting=scene.mounting,
        band=band,
        bending=partial(bending_give, scene),
        noise=min((sensor.noise_density for sensor in scene.sensors), default=USUAL_NOISE),
    )
    return refine_for_outputs(with_modes(found, replace(scene, effects=effects), band), scene)


def tier(evidence: Evidence, name: str, laminae: int) -> Verdict | None:
    """Judge a tier against the full one, the lumped one by its equilibria; ``None`` where no spring fits."""
    if name == "full":
        return Verdict("every body has its own equations of motion", {})
    influence, reason = _without_roller_inertia(evidence, name)
    if name == "quasistatic":
        return Verdict(reason, {"deflection": _QUASISTATIC_SHARE, **influence})
    deflection = roller_load = 0.0
    for case in evidence.loads.cases:
        spring, exact = evidence.statics.solve_lumped(case, laminae), evidence.statics.at(case)
        if exact is None:
            continue
        if spring is None:
            return None
        straight = float((exact.displacement @ exact.displacement) ** 0.5)
        deflection = max(deflection, abs(spring[0] / max(straight, 1.0e-9) - 1.0))
        roller_load = max(roller_load, abs(spring[1] / max(exact.largest_roller_load, 1.0e-3) - 1.0))
    reason = (
        f"one spring a roller misses the deflection by {percent(deflection)} and the largest roller load by "
        f"{percent(roller_load)}; {reason}"
    )
    if deflection > FITTING_SPRING:
        influence["vibration"] = max(influence["vibration"], BEYOND[name])
        reason += f", where springs fit; here they may be off by {BEYOND[name]:g} dB"
    return Verdict(
        reason, {**influence, "deflection": deflection, "roller_load": influence["roller_load"] + roller_load}
    )


def third_octaves_found(choice: Choice) -> str:
    """Write by how much third octaves of shipped scenes were off in the tier of a choice; empty for `full`.

    Also empty where a choice has no vibration to judge.
    """
    if choice.tier == "full" or not choice.expected.get("vibration", 0.0) > 0.0:
        return ""
    low, high = IN_MIDDLE_BAND[choice.tier], BEYOND[choice.tier]
    if is_coupled(choice):
        low, high = COUPLED_IN_MIDDLE_BAND, COUPLED_BEYOND
    if choice.vibration_to <= LOW_BAND:
        low = min(low, choice.expected["vibration"])
    above = f", {high:g} dB above" if choice.vibration_to > MIDDLE_BAND else ""
    return f"up to {low:.2g} dB to {1e-3 * min(choice.vibration_to, MIDDLE_BAND):g} kHz{above}"


def is_coupled(choice: Choice) -> bool:
    """Check whether a choice is `quasistatic` with coupled laminae and vibration of a box that bends.

    That is what the figures of coupled laminae were found with.
    """
    effects = choice.effects
    return (
        choice.tier == "quasistatic"
        and effects.lamina_coupling is not None
        and effects.structure is not None
        and choice.expected.get("vibration", 0.0) > 0.0
    )


def least_errors(evidence: Evidence, name: str) -> Influence:
    """Compute the errors that a tier has whatever its laminae and springs are."""
    return {} if name == "full" else _without_roller_inertia(evidence, name)[0]


def _without_roller_inertia(evidence: Evidence, name: str) -> tuple[dict[str, float], str]:
    bounce = roller_bounce(evidence)
    # response of a mass on springs over that of the springs alone, at the end of the band
    ratio = 1.0 / abs(1.0 - min((evidence.band / bounce) ** 2, 0.999))
    reason = f"its rollers do not bounce, which they do at {bounce / 1e3:.3g} kHz"
    pockets = evidence.torque_share(POCKETS[name] * _thicker_film(evidence, name) * evidence.losses.pocket)
    rings = IN_MIDDLE_BAND[name] if evidence.band <= MIDDLE_BAND else BEYOND[name]
    if evidence.band <= LOW_BAND and not evidence.patches:
        rings = IN_QUIET_BAND if evidence.band <= QUIET_BAND else IN_LOW_BAND
    influence = {
        "vibration": max(decibels(ratio), rings),
        "roller_load": _QUASISTATIC_SHARE,
        "torque": pockets,
    }
    reason += f"; third octaves of other scenes were off by up to {rings:g} dB"
    if pockets > 0.0:
        reason += f", {percent(pockets)} of the torque may be wrong by the pockets"
    if evidence.patches:
        overshoot = fault_overshoot(evidence, bounce)
        reason += f" and overshoots by {percent(overshoot)} behind a fault"
        influence["roller_load"] += overshoot
    return influence, reason


def _thicker_film(evidence: Evidence, name: str) -> float:
    """Bound what `quasistatic` misses of the friction of films in the pockets: its step keeps them too thick.

    Friction goes with the root of radius over gap. In cold oil a step of a sample bounds the gap to 15 um
    (20 C) and more, where 2 um are physical: 0.8 s of `healthy_80` have 7 % too little torque at 20 C, 11 %
    at -15 C.
    """
    cage = evidence.scene.effects.cage
    film = pocket_film_params(evidence.scene, _LONGEST_STEP)
    if name != "quasistatic" or film is None or not isinstance(cage, Cage) or cage.lubrication is None:
        return 1.0
    return math.sqrt(film.thinnest / cage.lubrication.switch_thickness)


def roller_bounce(evidence: Evidence) -> float:
    """Compute the frequency at which a roller with the mean load bounces between the raceways, [Hz]."""
    bearing = evidence.scene.bearing
    pressed = evidence.typical.cone_load[evidence.typical.cone_load > 0.0]
    load = float(pressed.mean()) if pressed.size else 1.0
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    # Q = K d^(10/9): tangent (10/9) K^(9/10) Q^(1/10), of both raceways together
    tangent = 10.0 / 9.0 * factor**0.9 * load**0.1
    return math.sqrt(2.0 * tangent / bearing.roller_mass) / (2.0 * math.pi)


def edge_time(evidence: Evidence, patch: Patch) -> float:
    """Compute how long a roller takes over the edge of a patch, [s]; infinite at rest.

    What it takes from the roller rises over that time: beyond 1/pi of its inverse it shakes less and less.
    """
    bearing = evidence.scene.bearing
    speed = cage_speed(bearing, abs(evidence.loads.top_speed)) * surface_radius(bearing, "cup")
    edge = min(0.5 * patch.width, math.sqrt(bearing.roller_diameter * max(patch.depth, 1.0e-9)))
    return edge / speed if speed > 0.0 else math.inf


def fault_overshoot(evidence: Evidence, bounce: float) -> float:
    """Compute the overshoot of a roller that leaves the steepest edge of all patches, [-].

    A spring-mass answers to a ramp of duration t with at most 1/(pi f t).
    """
    edge = min(edge_time(evidence, patch) for patch in evidence.patches)
    return min(1.0 / (math.pi * bounce * edge), 1.0)
