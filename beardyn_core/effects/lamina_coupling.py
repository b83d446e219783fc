"""Laminae of a raceway contact that sink with each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.bearing.lamina_coupling import LaminaRoot, lamina_root
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class LaminaCoupling:
    """Laminae coupled through the half-space, so that the ends of a contact are stiffer than its middle."""

    about: ClassVar[About] = About(
        loss="",
        adds="A loaded lamina sinks its neighbours: edge load, stiffer ends; Palmgren's total is kept.",
        states="none",
        cost="high",
        validity="Contact width nearly constant along the roller; the free end faces are left out.",
        bearings=("tapered", "cylindrical"),
        source="Teutsch and Sauer (2004), alternative slicing; rectangular patches after Love (1929)",
    )

    pressure: A[
        float,
        At("MPa", ge=10.0, le=5000.0),
        "Hertz pressure of the contact whose width is taken for the influence",
    ] = 1.0e9
    strength: A[float, SHARE, "share of the influence between different laminae"] = 1.0


def bearing_lamina_root(bearing: RollerBearing, coupling: LaminaCoupling, count: int) -> LaminaRoot:
    """Compute the matrices of the raceway contacts, with one width for both, by the roller's radius."""
    return lamina_root(
        count,
        bearing.effective_length,
        0.5 * bearing.roller_diameter,
        bearing.material.contact_modulus,
        coupling.pressure,
        coupling.strength,
    )
