"""Sets of effects."""

from __future__ import annotations

from dataclasses import dataclass, fields

from beardyn_core.effects.audit import Audit
from beardyn_core.effects.cage import Cage, CageModel
from beardyn_core.effects.contact_damping import ContactDamping
from beardyn_core.effects.drag import Drag
from beardyn_core.effects.film import LineFilm
from beardyn_core.effects.gravity import Gravity
from beardyn_core.effects.lamina_coupling import LaminaCoupling
from beardyn_core.effects.rib import Rib
from beardyn_core.effects.ring_flexibility import RingFlexibility
from beardyn_core.effects.rolling_resistance import RollingResistance
from beardyn_core.effects.seal import Seal
from beardyn_core.effects.small_rib import SmallRib
from beardyn_core.effects.thermal import Thermal
from beardyn_core.effects.traction import MixedTraction, Traction


@dataclass(frozen=True)
class EffectSet:
    """Which effects a scene simulates, and their options; ``None`` is absent at no cost.

    Faults are not listed: they are present when the scene has defects.
    """

    contact_damping: ContactDamping | None = ContactDamping()
    lamina_coupling: LaminaCoupling | None = None
    traction: Traction | None = MixedTraction()
    film: LineFilm | None = LineFilm()
    rolling_resistance: RollingResistance | None = None
    drag: Drag | None = None
    rib: Rib | None = Rib()
    small_rib: SmallRib | None = None
    cage: CageModel | None = Cage()
    seal: Seal | None = None
    ring_flexibility: RingFlexibility | None = None
    gravity: Gravity | None = Gravity()
    thermal: Thermal | None = None
    audit: Audit | None = Audit()

    def __repr__(self) -> str:
        """Give the names of the effects that are present."""
        return f"EffectSet({', '.join(self.names()) or 'none'})"

    def names(self) -> tuple[str, ...]:
        """Names of the effects that are present, in the order of the catalogue."""
        return tuple(field.name for field in fields(self) if getattr(self, field.name) is not None)
