"""Shipped bearings by kind."""

from __future__ import annotations

from beardyn_core.config import load_any_bearing, shipped_names

TAPERED, CYLINDRICAL, SPHERICAL = (
    tuple(name for name in shipped_names("bearings") if load_any_bearing(name).kind == kind)
    for kind in ("tapered", "cylindrical", "spherical")
)
