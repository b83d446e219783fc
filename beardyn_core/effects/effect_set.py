"""Sets of effects."""

from __future__ import annotations

from dataclasses import dataclass, fields

from beardyn_core.effects.audit import Audit
from beardyn_core.effects.cage import Cage
from beardyn_core.effects.contact_damping import ContactDamping
from beardyn_core.effects.film import LineFilm
from beardyn_core.effects.gravity import Gravity
from beardyn_core.effects.rib import Rib
from beardyn_core.effects.ring_flexibility import RingFlexibility
from beardyn_core.effects.thermal import Thermal
from beardyn_core.effects.traction import MixedTraction, Traction


@dataclass(frozen=True)
class EffectSet:
    """Which effects a scene simulates, and their options; ``None`` is absent at no cost.

    Faults are not listed: they are present when the scene has defects.
    """

    contact_damping: ContactDamping | None = ContactDamping()
    traction: Traction | None = MixedTraction()
    film: LineFilm | None = LineFilm()
    rib: Rib | None = Rib()
    cage: Cage | None = Cage()
    ring_flexibility: RingFlexibility | None = None
    gravity: Gravity | None = Gravity()
    thermal: Thermal | None = None
    audit: Audit | None = Audit()

    def names(self) -> tuple[str, ...]:
        """Names of the effects that are present, in the order of the catalogue."""
        return tuple(field.name for field in fields(self) if getattr(self, field.name) is not None)
