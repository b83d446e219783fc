"""Rules of compliance: bending of the cup, coupling of the laminae."""

from __future__ import annotations

import numpy as np

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lamina_coupling import bearing_lamina_root, coupled_law
from beardyn_core.choice.evidence import Evidence, decibels
from beardyn_core.choice.rule import Alternative, Rule, percent
from beardyn_core.effects import LaminaCoupling

_LAMINAE = 20
_DEPTH = 1.0e-5  # of a working load [m]


def ring_flexibility(evidence: Evidence) -> Rule:
    """Decide on a flexible cup: on when it changes load distribution or deflection."""
    effect = evidence.scene.effects.ring_flexibility
    if effect is None:
        return Rule(
            "ring_flexibility", (Alternative({"ring_flexibility": None}, "not in the reference", word="off"),)
        )
    change = evidence.difference({"bending": False}, {"bending": True})
    influence = {
        **change.influence(),
        "torque": evidence.torque_share(evidence.torque_of_rigid_cup - evidence.torque),
    }
    reason = (
        f"bending of the cup changes the deflection by {percent(change.deflection)} and the largest roller "
        f"load by {percent(change.roller_load)}, the torque by {percent(influence['torque'])}"
    )
    return Rule(
        "ring_flexibility",
        (
            Alternative({"ring_flexibility": effect}, reason, {}, evidence.costs.extra("ring_flexibility")),
            Alternative({"ring_flexibility": None}, reason, influence, word="off"),
        ),
    )


def lamina_coupling(evidence: Evidence) -> Rule:
    """Decide on coupled laminae: on when they distribute the load otherwise than independent ones."""
    effect = evidence.scene.effects.lamina_coupling
    if effect is None:
        return Rule(
            "lamina_coupling", (Alternative({"lamina_coupling": None}, "not in the reference", word="off"),)
        )
    change = evidence.difference({"coupling": None}, {"coupling": effect}, heavy=True)
    influence = change.influence()
    reason = (
        f"coupled laminae change the deflection by {percent(change.deflection)} and the largest roller load "
        f"by {percent(change.roller_load)}"
    )
    partial = [share for share in evidence.patch_shares if share < 1.0]
    if partial:
        share = max(partial)
        gain = beside_a_patch(evidence.scene.bearing, effect, share)
        loaded = max(int(np.count_nonzero(evidence.typical.cone_load > 0.0)) // 2, 1)
        # what the rest of the line carries more is not given to the neighbours
        influence["roller_load"] += (gain - 1.0) * (1.0 - share) * 2.0 / loaded
        influence["vibration"] += decibels((1.0 - (1.0 - share) * gain) / share)
        reason += f"; a line that a patch leaves {percent(1.0 - share)} of carries {percent(gain - 1.0)} more"
    return Rule(
        "lamina_coupling",
        (
            Alternative({"lamina_coupling": effect}, reason, {}, evidence.costs.extra("lamina_coupling")),
            Alternative({"lamina_coupling": None}, reason, influence, word="off"),
        ),
    )


def beside_a_patch(bearing: Bearing, coupling: LaminaCoupling, share: float) -> float:
    """Compute the load of a line with one end over a patch, coupled over independent laminae, [-]."""
    root = bearing_lamina_root(bearing, coupling, _LAMINAE)
    factor = line_contact_factor(bearing.material, bearing.effective_length) / _LAMINAE
    touching = round((1.0 - share) * _LAMINAE)
    if not 0 < touching < _LAMINAE:
        return 1.0
    depth = np.full(_LAMINAE, -_DEPTH)
    depth[:touching] = _DEPTH
    load = coupled_law(depth, factor, root)[0]
    return float(np.sum(load)) / (factor * _DEPTH ** (10.0 / 9.0) * touching)
