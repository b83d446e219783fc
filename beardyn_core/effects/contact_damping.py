"""Damping of contacts under load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import At
from beardyn_core.effects.about import RACEWAY_HEAT, About


@dataclass(frozen=True)
class ContactDamping:
    """Velocity-proportional loss of raceway and rib contacts, against gaps that move under a roller too."""

    about: ClassVar[About] = About(
        loss="contact_damping",
        heat=RACEWAY_HEAT,
        adds="Velocity-proportional normal loss in raceway and rib contacts.",
        states="none",
        cost="low",
        validity="Persistent, lubricated contacts; impacts lose less than a restitution law gives.",
        source="Kraemer (1992), damping time 2.5e-6 to 2.5e-5 s of whole bearings; what it changes: "
        "docs/evidence/damping.md; clipped so that a contact never pulls",
    )

    time_constant: A[
        float, At("us", gt=0.0, le=1000.0), "damping force over tangent stiffness and normal velocity"
    ] = 5e-6
