"""What fast tiers miss of the torque, and what creep takes: ``python -m evidence.automatic.torque``.

Runs scenes with every effect in each tier, prints a table and writes it into docs/effects_auto.md. The rules
of the automatic choice bound what is found here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import beardyn_core as bd
from beardyn_core.choice.discretisation_error import POCKETS
from beardyn_core.choice.reference_solution import Evidence
from beardyn_core.config import load_effects
from beardyn_core.effects import Audit, ModalStructure
from beardyn_core.sensors.summary import RunSummary
from evidence.pages import DOCS, write_section

SCENES = (
    *("healthy_80", "smooth_run", "healthy_300", "freight_100", "service_metro", "light_coasting"),
    *("static_80kN", "static_5kN"),
)
SECONDS = 0.8
PAGE = DOCS / "effects_auto.md"
TITLE, NEXT = "## Torque of the fast tiers\n", "## How good the estimates are\n"
ABOUT = """
Written by `python -m evidence.automatic.torque`: {seconds} s of shipped scenes with every effect, in each
tier, in a rigid box (the set `all`) and in the box of finite elements that a scene names (*modes*); means
over the last whole turns of the cage. *Creep*: what the raceways lose by sliding over what the ribs lose,
by the audit of `full`, with its films and with `dry`. *Pockets*: their torque over all, by the audit and as
the rules estimate it. *Off*: torque of a tier over that of `full`, less one; in brackets over the pockets'
estimate, of which the rules allow {quasistatic:g} in `quasistatic` and {lumped:g} in `lumped`. The rollers
of `static_5kN` slip: what fast tiers miss there is judged by that, not by the pockets.

| scene | box | torque N m | creep % | dry % | pockets % | estimate % | `quasistatic` off % | `lumped` off % |
|---|---|--:|--:|--:|--:|--:|--:|--:|
"""


class Found(NamedTuple):
    """Torques of a scene."""

    full: float  # [N m]
    creep: float  # share of what the ribs lose
    dry: float  # the same without films
    pockets: float  # [N m], by the audit
    estimate: float  # [N m], by the rules
    quasistatic: float  # [N m]
    lumped: float  # [N m]


def _parts(summary: RunSummary) -> dict[str, float]:
    assert summary.budget is not None
    return {share.source: share.torque for share in summary.budget.shares}


def _creep(summary: RunSummary) -> float:
    parts = _parts(summary)
    return parts["raceway_sliding"] / parts["rib"]


def found(name: str, modes: bool) -> Found:
    """Run a scene in every tier, in its own box or in a rigid one."""
    own = bd.scene(name).effects.structure if modes else None

    def effects_of(preset: str, **more: Any) -> Any:
        effects = replace(load_effects(preset), **more)
        return replace(effects, structure=own) if modes else effects

    every = {
        tier: bd.simulate(name, effects=effects_of("all"), tier=tier, duration=SECONDS).summary
        for tier in ("full", "quasistatic", "lumped")
    }
    dry = effects_of("dry", audit=Audit())
    without = bd.simulate(name, effects=dry, tier="full", duration=SECONDS).summary
    losses = Evidence(bd.scene(name, effects=effects_of("all"), tier="full")).losses
    return Found(
        -every["full"].shaft_torque,
        _creep(every["full"]),
        _creep(without),
        _parts(every["full"])["pocket"],
        losses.pocket,
        -every["quasistatic"].shaft_torque,
        -every["lumped"].shaft_torque,
    )


def row(name: str, box: str, of: Found) -> str:
    """Write a scene as a row of the table."""

    def off(torque: float) -> str:
        return f"{100 * (torque / of.full - 1):+.1f} ({abs(torque - of.full) / of.estimate:.2f})"

    shares = (of.creep, of.dry, of.pockets / of.full, of.estimate / of.full)
    cells = [f"{of.full:.2f}", *(f"{100 * each:.1f}" for each in shares), off(of.quasistatic), off(of.lumped)]
    return f"| `{name}` | {box} | {' | '.join(cells)} |"


def main() -> None:
    """Run, print and write."""
    rows = []
    for name in SCENES:
        boxes = (False, True) if isinstance(bd.scene(name).effects.structure, ModalStructure) else (False,)
        for modes in boxes:
            rows.append(row(name, "modes" if modes else "rigid", found(name, modes)))
            print(rows[-1], flush=True)
    text = TITLE + ABOUT.format(seconds=SECONDS, **POCKETS) + "\n".join(rows) + "\n\n"
    write_section(PAGE, TITLE, text, NEXT)


if __name__ == "__main__":
    main()
