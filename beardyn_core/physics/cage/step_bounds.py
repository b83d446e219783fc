"""How much a cage may be resisted: it is explicit, and must follow within a step what pushes it."""

from __future__ import annotations

import math

from beardyn_core.bearing.roller_bearing import RollerBearing

BAR_PLACE = 0.35  # of rollers on a bar, from their middle, over their length
# Of what swings from step to step for good, where all rollers press one bar of their pockets and the explicit
# cage and rollers answer a step late, and what the film has of it at least, whatever the dry wall takes.
_MOST_OF_STABLE, _LEAST_OF_FILM = 5.0 / 6.0, 1.0 / 8.0


def least_inertia(bearing: RollerBearing) -> float:
    """Work out the mass of a cage as its pockets feel it along the pitch circle, [kg]."""
    return min(bearing.cage.mass, bearing.cage.polar_inertia / (0.5 * bearing.pitch_diameter) ** 2)


def _yielding(bearing: RollerBearing) -> float:
    """Sum what rollers and cage yield to one force at each end of a bar of every pocket, [1/kg]."""
    arm = BAR_PLACE * bearing.effective_length
    of_roller = max(1.0 / bearing.roller_mass, arm**2 / bearing.roller_transverse_inertia)
    return 2.0 * (of_roller + bearing.roller_count / least_inertia(bearing))


def film_share(bearing: RollerBearing, lean: float, step: float) -> float:
    """Work out what bounds the film, so that it, damper and spring of the wall do not swing together.

    Steps h that move with the new velocity are stable up to h c Y + h^2 k Y / 2 of 2, for dampers c and
    springs k that act on what yields by Y. Bars that lean push along the pitch circle with the cosine, and
    the cage across, where it yields by half at any lean.
    """
    cage, yields = bearing.cage, _yielding(bearing) * max(math.cos(lean) ** 2, 0.5)
    dry = step * (cage.damping + 0.5 * step * cage.stiffness) * yields
    return step * yields / (2.0 * max(_MOST_OF_STABLE - 0.5 * dry, _LEAST_OF_FILM))
