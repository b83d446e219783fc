"""Sets of effects."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Annotated as A

from beardyn_core.base.edge import At
from beardyn_core.effects.audit import Audit
from beardyn_core.effects.cage import Cage, CageModel
from beardyn_core.effects.contact_damping import ContactDamping
from beardyn_core.effects.drag import Drag
from beardyn_core.effects.film import LineFilm
from beardyn_core.effects.gravity import Gravity
from beardyn_core.effects.lamina_coupling import LaminaCoupling
from beardyn_core.effects.rib import Rib
from beardyn_core.effects.rolling_resistance import RollingResistance
from beardyn_core.effects.seal import Seal
from beardyn_core.effects.small_rib import SmallRib
from beardyn_core.effects.structure import Structure
from beardyn_core.effects.thermal import Thermal
from beardyn_core.effects.traction import MixedTraction, Traction
from beardyn_core.effects.windage import Windage


@dataclass(frozen=True)
class EffectSet:
    """The effects of a scene, each with its options or absent.

    ``None`` is absent at no cost. Faults are not listed: they are present when the scene has defects.
    """

    contact_damping: A[
        ContactDamping | None, At(switch=True), "loss of contacts that are pressed together"
    ] = ContactDamping()
    lamina_coupling: A[
        LaminaCoupling | None, At(switch=True), "laminae of a raceway contact that sink with each other"
    ] = None
    traction: A[Traction | None, "friction of the raceway contacts"] = MixedTraction()
    film: A[LineFilm | None, At(switch=True), "lubricant film of the raceway contacts"] = LineFilm()
    rolling_resistance: A[
        RollingResistance | None, At(switch=True), "couple of the raceway contacts against rolling"
    ] = None
    drag: A[Drag | None, At(switch=True), "drag and churning of the rollers"] = None
    rib: A[Rib | None, At(switch=True), "roller ends on their ribs"] = Rib()
    small_rib: A[SmallRib | None, At(switch=True), "small roller ends on the small rib of the cone"] = None
    cage: A[CageModel | None, At(switch=True), "cage of each row"] = Cage()
    seal: A[Seal | None, At(switch=True), "friction of the seals"] = None
    windage: A[Windage | None, At(switch=True), "air drag of the cages"] = None
    structure: A[Structure | None, At(switch=True), "bending of the axlebox with the cup in it"] = None
    gravity: A[Gravity | None, At(switch=True), "weight of rollers, cages and axlebox"] = Gravity()
    thermal: A[Thermal | None, At(switch=True), "slow warming of the parts; needs the audit in tier full"] = (
        None
    )
    audit: A[Audit | None, At(switch=True), "energy balance kept while the model runs"] = Audit()

    def rules(self) -> Iterator[str]:
        """Check the effects against each other."""
        if self.film and self.drag and self.film.million_revolutions != self.drag.million_revolutions:
            yield "million_revolutions of film and drag differ; it is one grease, give both the same"
        for name in self.names():
            for needed in getattr(self, name).about.needs:
                if getattr(self, needed) is None:
                    yield f"{name} needs {needed}, which is absent; switch {needed} on, or {name} off"

    def __repr__(self) -> str:
        """Give the names of the effects that are present."""
        return f"EffectSet({', '.join(self.names()) or 'none'})"

    def names(self) -> tuple[str, ...]:
        """List the names of the effects that are present, in the order of the catalogue."""
        return tuple(field.name for field in fields(self) if getattr(self, field.name) is not None)
