"""Sources of loss by name: those of the kernels, then those that only the law of an effect names."""

from __future__ import annotations

from beardyn_core.effects.catalogue import heat_by_loss
from beardyn_core.physics.bodies import layout

_KNOWN_LOSSES = (
    "raceway_sliding", "contact_damping", "rolling_resistance", "rib", "small_rib", "pocket", "cage_land",
    "drag", "seal", "suspension", "structure",
)  # fmt: skip
LOSS_NAMES = (*_KNOWN_LOSSES, *(name for name in heat_by_loss() if name not in _KNOWN_LOSSES))
LOSSES = len(LOSS_NAMES)
ENERGY_TERMS = layout.ENERGY_LOST + LOSSES
