"""Rule of a box that bends: rigid, with modes up to a frequency, or with all of them; what sensors miss."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.choice.reference_solution import MOST_DB, Evidence
from beardyn_core.choice.ringing import band_centres, levels
from beardyn_core.choice.rule import VIBRATION_TOLERANCE_DB, Alternative, Influence, Rule, absent, percent
from beardyn_core.effects import ModalStructure
from beardyn_core.physics.modal_body import ModalBody, body_of
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.scene.sensor import PASSBAND, RATES
from beardyn_core.structure.modes import Modes

# Up to here free modes may be kept, [Hz]; with the lowest none: the box bends and does not ring.
HIGHEST = (100.0, 1000.0, 2000.0, 4000.0, 6300.0, 8000.0, 10_000.0, 12_500.0, 16_000.0)


def structure(evidence: Evidence) -> Rule:
    """Decide on a box that bends: what of it changes load, deflection, or what the sensors measure."""
    scene, effect, body = evidence.scene, evidence.scene.effects.structure, evidence.statics.body
    if effect is None or body is None:
        return absent("structure")
    change = evidence.difference({"bending": False}, {"bending": True})
    torque = evidence.torque_share(evidence.torque_of_rigid_cup - evidence.torque)
    influence = {**change.influence(), "torque": torque}
    reason = (
        f"bending of the box changes the deflection by {percent(change.deflection)} and the largest roller "
        f"load by {percent(change.roller_load)}, the torque by {percent(torque)}"
    )
    if not evidence.moves:
        off = Alternative({"structure": None}, reason, influence, word="off")
        return Rule("structure", (_whole(evidence, body, reason), *_fewer(evidence, influence, None), off))
    whole = levels(scene, evidence.typical, body, evidence.edge)
    rigid_load = evidence.statics.at(evidence.loads.typical) or evidence.typical
    rigid = levels(scene, rigid_load, None, evidence.edge)
    left_out = np.abs(rigid - whole)
    influence["vibration"] = _most(left_out)
    reason += f"; in a rigid box third octaves to {_kilohertz(evidence.band)} are up to "
    reason += f"{left_out.max():.2g} dB off, {_worst(left_out)}"
    on = _whole(evidence, body, f"{reason}{_above_limit(evidence, effect, whole)}")
    off = Alternative({"structure": None}, reason, influence, word="off")
    return Rule("structure", (on, *_fewer(evidence, influence, whole), off))


def _whole(evidence: Evidence, body: ModalBody, reason: str) -> Alternative:
    effect, costs = evidence.scene.effects.structure, evidence.costs
    cost = costs.of_modes(body.rate.size) if body.modes is not None else costs.extra("structure")
    return Alternative({"structure": effect}, reason, {}, cost)


def _fewer(evidence: Evidence, rigid: Influence, whole: Float | None) -> Iterator[Alternative]:
    """Offer a box without its free modes above a frequency, where the scene does not say which it has."""
    effect, every = evidence.scene.effects.structure, evidence.statics.body
    if not isinstance(effect, ModalStructure) or effect.highest is not None or every is None:
        return
    kept = _free(every)
    for highest in reversed(HIGHEST):
        fewer = replace(effect, highest=highest)
        body = _body(evidence, fewer)
        if _free(body) == kept:
            continue
        kept = _free(body)
        softer = abs(_yield(body, evidence.typical) / _yield(every, evidence.typical) - 1.0)
        influence = {name: softer * error for name, error in rigid.items()}
        word = f"to {_kilohertz(highest)}" if kept else "static"
        reason = (
            f"bends by {percent(softer)} more or less than with all of its {_free(every)} free modes and "
        )
        reason += f"rings with {kept}, up to {_kilohertz(highest)}" if kept else "does not ring"
        if whole is not None:
            apart = np.abs(levels(evidence.scene, evidence.typical, body, evidence.edge) - whole)
            influence["vibration"] = _most(apart)
            reason += f"; third octaves are up to {apart.max():.2g} dB off, {_worst(apart)}"
        cost = evidence.costs.of_modes(body.rate.size)
        yield Alternative({"structure": fewer}, reason, influence, cost, word=word)


def _above_limit(evidence: Evidence, effect: object, whole: Float) -> str:
    """Say what the modes make that the scene itself leaves out with `highest_Hz`."""
    if not isinstance(effect, ModalStructure) or effect.highest is None:
        return ""
    every = _body(evidence, replace(effect, highest=None))
    apart = np.abs(whole - levels(evidence.scene, evidence.typical, every, evidence.edge))
    return (
        f"; the modes above {_kilohertz(effect.highest)}, which highest_Hz leaves out, would change third "
        f"octaves by up to {apart.max():.2g} dB, {_worst(apart)}"
    )


def rates_told(evidence: Evidence) -> Iterator[str]:
    """Say where the modes of the box and the band of a sensor end apart from each other."""
    body = evidence.statics.body
    if body is None or body.modes is None or not evidence.moves:
        return
    last = _last(body.modes)
    for index, sensor in enumerate(evidence.scene.sensors):
        receives = PASSBAND * sensor.rate
        said = f"sensor {sensor.name} at {sensor.rate / 1e3:g} kHz measures to {_kilohertz(receives)}"
        if receives > last:
            end = f"the modes of the box end at {_kilohertz(last)}"
            yield f"{said}, {end}: beyond, its signal has no resonances"
            continue
        beyond = band_centres(last) > receives
        rigid = levels(evidence.scene, evidence.typical, None, last)[index, beyond]
        louder = levels(evidence.scene, evidence.typical, body, last)[index, beyond] - rigid
        if louder.size and louder.max() > VIBRATION_TOLERANCE_DB:
            faster = [rate for rate in RATES if PASSBAND * rate > receives]
            remedy = f": rate_kHz {faster[0] / 1e3:g} measures it" if faster else ""
            count = int(np.count_nonzero(body.modes.frequency[: body.modes.free_count] > receives))
            yield (
                f"{said}, and {count} modes of the box ring above, to {_kilohertz(last)} and up to "
                f"{louder.max():.2g} dB louder than a rigid box{remedy}"
            )


def _body(evidence: Evidence, effect: ModalStructure) -> ModalBody:
    scene = evidence.scene
    body = body_of(replace(scene, effects=replace(scene.effects, structure=effect)))
    assert body is not None
    return body


def _free(body: ModalBody) -> int:
    return 0 if body.modes is None else body.modes.free_count


def _last(modes: Modes) -> float:
    return float(modes.frequency[: modes.free_count].max(initial=0.0))


def _yield(body: ModalBody, static: StaticSolution) -> float:
    """Work out how far the raceways give way under their loads, weighted with these, [N m]."""
    load = static.cup_load
    azimuth = 2.0 * np.pi * np.arange(load.shape[1]) / load.shape[1]
    pushed = np.einsum("rpm,rp->m", body.openings(azimuth), load)
    return float(pushed**2 @ (1.0 / body.stiffness))


def _most(decibels: Float) -> float:
    return min(float(decibels.max(initial=0.0)), MOST_DB)


def _worst(decibels: Float) -> str:
    """Name the band in which levels are farthest apart."""
    band = int(np.argmax(decibels.max(axis=0)))
    return f"most at {_kilohertz(float(band_centres(1e6)[band]))}"


def _kilohertz(frequency: float) -> str:
    return f"{1e-3 * frequency:.3g} kHz"
