"""The catalogue of effects: what each adds, what it costs, where it holds; and sets of them.

An effect is present when its member of `EffectSet` is an options object and absent when the member is
``None``; the kernels are compiled for the members that are present.
"""

from __future__ import annotations

from beardyn_core.effects.about import About
from beardyn_core.effects.audit import Audit
from beardyn_core.effects.cage import Cage
from beardyn_core.effects.contact_damping import ContactDamping
from beardyn_core.effects.effect_set import EffectSet
from beardyn_core.effects.film import LineFilm
from beardyn_core.effects.gravity import Gravity
from beardyn_core.effects.rib import Rib
from beardyn_core.effects.ring_flexibility import RingFlexibility
from beardyn_core.effects.thermal import Thermal
from beardyn_core.effects.traction import CoulombTraction, MixedTraction, ShearedFilmTraction, Traction

__all__ = [
    "About",
    "Audit",
    "Cage",
    "ContactDamping",
    "CoulombTraction",
    "EffectSet",
    "Gravity",
    "LineFilm",
    "MixedTraction",
    "Rib",
    "RingFlexibility",
    "ShearedFilmTraction",
    "Thermal",
    "Traction",
]
