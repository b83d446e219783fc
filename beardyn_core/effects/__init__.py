"""The catalogue of effects: what each adds, what it costs, where it holds; and sets of them.

================== ==================================================
module             responsibility
================== ==================================================
about              what the catalogue says of an effect
contact_damping    loss of contacts that are pressed together
lamina_coupling    laminae that sink with each other
film               lubricant film of the raceway contacts
traction           friction of the raceway contacts
rolling_resistance resistance of the raceway contacts against rolling
rib                large roller end on the cone rib
small_rib          small roller end on the small rib
cage               cage of each row, its pockets and lands
drag               drag and churning of the rollers
seal               seals between cup and shaft
windage            air drag of the turning cages
gravity            weight
structure          bending of the axlebox with the cup in it
grease             what running leaves of a fill of grease
thermal            slow warming of bearing, grease and axlebox
audit              energy balance
effect_set         sets of effects, each present or absent
catalogue          every effect that a scene can switch on
================== ==================================================

An effect is present when its member of `EffectSet` is an options object and absent when the member is
``None``; the kernels are compiled for the members that are present.
"""

from __future__ import annotations

from beardyn_core.effects.about import About
from beardyn_core.effects.audit import Audit
from beardyn_core.effects.cage import Cage, CageModel, KinematicCage, LandGuidance, PocketFilm, RotatingCage
from beardyn_core.effects.contact_damping import ContactDamping
from beardyn_core.effects.drag import Drag
from beardyn_core.effects.effect_set import EffectSet
from beardyn_core.effects.film import LineFilm
from beardyn_core.effects.gravity import Gravity
from beardyn_core.effects.lamina_coupling import LaminaCoupling
from beardyn_core.effects.rib import Rib, RibMixedFilm, RibShearedFilm
from beardyn_core.effects.rolling_resistance import RollingResistance
from beardyn_core.effects.seal import Seal
from beardyn_core.effects.small_rib import SmallRib
from beardyn_core.effects.structure import ModalStructure, RingStructure, Structure
from beardyn_core.effects.thermal import Thermal
from beardyn_core.effects.traction import (
    CoulombTraction,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
    Traction,
)
from beardyn_core.effects.windage import Windage

__all__ = [
    "About",
    "Audit",
    "Cage",
    "CageModel",
    "ContactDamping",
    "CoulombTraction",
    "Drag",
    "EffectSet",
    "Gravity",
    "KinematicCage",
    "LaminaCoupling",
    "LandGuidance",
    "LineFilm",
    "LoadSharingTraction",
    "MixedTraction",
    "ModalStructure",
    "PocketFilm",
    "Rib",
    "RibMixedFilm",
    "RibShearedFilm",
    "RingStructure",
    "RollingResistance",
    "RotatingCage",
    "Seal",
    "ShearedFilmTraction",
    "SmallRib",
    "Structure",
    "Thermal",
    "Traction",
    "Windage",
]
