"""Laminae of a raceway contact that sink with each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class LaminaCoupling:
    """Laminae coupled through the half-space, so that the ends of a contact are stiffer than its middle.

    Parameters
    ----------
    pressure : float
        Hertz pressure of the contact whose width is taken for the influence between laminae, [Pa].
    strength : float
        Share of the half-space's influence between different laminae, 0 to 1, [-]. 0 is uncoupled.
    """

    about: ClassVar[About] = About(
        adds="A loaded lamina sinks its neighbours: edge load, stiffer ends; Palmgren's total is kept.",
        states="none",
        cost="high",
        validity="Contact width nearly constant along the roller; the free end faces are left out.",
        source="Teutsch and Sauer (2004), alternative slicing; rectangular patches after Love (1929)",
    )

    pressure: float = 1.0e9
    strength: float = 1.0
