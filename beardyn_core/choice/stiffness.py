"""Rules of what gives way: bending of the cup, coupling of the laminae."""

from __future__ import annotations

from beardyn_core.choice.evidence import Evidence
from beardyn_core.choice.rule import Alternative, Rule, percent


def ring_flexibility(evidence: Evidence) -> Rule:
    """On when the bent cup's load distribution or deflection differs from the rigid one's."""
    effect = evidence.scene.effects.ring_flexibility
    if effect is None:
        return Rule("ring_flexibility", (Alternative({"ring_flexibility": None}, "not in the reference", word="off"),))
    change = evidence.difference({"bending": False}, {"bending": True})
    said = (
        f"bending of the cup changes the deflection by {percent(change.deflection)} and the largest roller load "
        f"by {percent(change.roller_load)}"
    )
    return Rule(
        "ring_flexibility",
        (
            Alternative({"ring_flexibility": effect}, said, {}, evidence.costs.extra("ring_flexibility")),
            Alternative({"ring_flexibility": None}, said, change.influence(), word="off"),
        ),
    )


def lamina_coupling(evidence: Evidence) -> Rule:
    """On when coupled laminae distribute the load otherwise than independent ones."""
    effect = evidence.scene.effects.lamina_coupling
    if effect is None:
        return Rule("lamina_coupling", (Alternative({"lamina_coupling": None}, "not in the reference", word="off"),))
    change = evidence.difference({"coupling": None}, {"coupling": effect}, heavy=True)
    said = (
        f"coupled laminae change the deflection by {percent(change.deflection)} and the largest roller load by "
        f"{percent(change.roller_load)}"
    )
    return Rule(
        "lamina_coupling",
        (
            Alternative({"lamina_coupling": effect}, said, {}, evidence.costs.extra("lamina_coupling")),
            Alternative({"lamina_coupling": None}, said, change.influence(), word="off"),
        ),
    )
