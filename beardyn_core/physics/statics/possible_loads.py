"""Loads that a bearing can carry at all: refusals before a search for its equilibrium."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import FEWEST_OF_ELLIPSE
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.statics.roller_contacts import ContactModel

# Of the load, and [N] without one: where a search may end.
ACCEPTABLE = 1.0e-8
ACCEPTABLE_FORCE = 1.0e-3
# Along the axle, of the length of a roller: a prop that yields more lets a row slide off its raceways.
_MOST_YIELD = 0.5


def require_possible(
    bearing: RollerBearing, load: Float, laminae: int, coupling: LaminaCoupling | None
) -> None:
    """Refuse what a kind of bearing cannot carry, and what its contacts are not made for.

    Parameters
    ----------
    load : float64 array, shape [5]
        Force on the cone and its moment about x and z, [N], [N m].

    Raises
    ------
    InputError
        All that is wrong at once.
    """
    problems = []
    if isinstance(bearing, CylindricalBearing) and load[1] != 0.0 and not bearing.carries_thrust:
        problems.append(
            f"{bearing.name} carries no axial load, and {load[1]:g} N are given: no row has a rib of the "
            "inner ring with one of the outer ring at the other end of its rollers (cone_ribs, cup_ribs)."
        )
    radial = math.hypot(load[0], load[2])
    if (
        isinstance(bearing, CylindricalBearing)
        and laminae < 2
        and abs(load[1]) > bearing.largest_thrust * radial
    ):
        problems.append(
            f"laminae is 1, and the axial load of {load[1]:g} N is more than {bearing.largest_thrust:g} of "
            "the radial one: it tips the rollers, which takes 2 laminae or more."
        )
    if bearing.self_aligning:
        if load[3] or load[4]:
            problems.append(
                f"moment is {load[3]:g}, {load[4]:g} N m; {bearing.name} is self-aligning and carries none."
            )
        if laminae < FEWEST_OF_ELLIPSE:
            problems.append(
                f"laminae is {laminae}; a spherical roller bearing needs at least {FEWEST_OF_ELLIPSE}, of "
                "which its contact ellipses are made."
            )
        if coupling is not None:
            problems.append(
                "laminae of a spherical roller bearing cannot be coupled: its slices are those of Hertz's "
                "ellipse as they are."
            )
    if problems:
        raise InputError(problems)


def require_held(model: ContactModel, load: Float, axial_stiffness: float) -> None:
    """Refuse a single row that leaves its raceways along the axle, by its own thrust or for want of a rib.

    Parameters
    ----------
    load : float64 array, shape [5]
        Force on the cone and its moment about x and z, [N], [N m].
    axial_stiffness : float
        Of a prop that holds the cone against the cup along the axle, [N/m].

    Raises
    ------
    ValidityError
        With the force that is lacking, and what gives it.
    """
    if len(model.centre) > 1:
        return
    across, pressed = math.hypot(load[0], load[2]), float(load[1])
    if isinstance(model.bearing, CylindricalBearing):
        thrust, lacking = 0.0, _lacks_a_rib(model.bearing, pressed)
    else:
        thrust = _own_thrust(model, across)
        lacking = thrust - pressed
    if lacking <= ACCEPTABLE * across + ACCEPTABLE_FORCE:
        return
    word, yields = "a prop", ""
    if axial_stiffness > 0.0:
        gives_way = lacking / axial_stiffness
        if gives_way <= _MOST_YIELD * model.bearing.effective_length:
            return
        word = "a stiffer prop"
        yields = f"; its prop would yield by {1e3 * gives_way:.3g} mm, more than half a roller"
    prop = f"{word} (mounting.axial_prop_stiffness_MN_per_m)"
    if isinstance(model.bearing, CylindricalBearing):
        raise ValidityError(_unheld_cylinders(model.bearing, pressed, yields, prop))
    raise ValidityError(
        f"static equilibrium of {model.bearing.name} does not exist: a single row under {across:.4g} N "
        f"across the axle drives its rings apart unless more than {thrust:.4g} N press them together along "
        f"it, and {pressed:.4g} N do{yields}. Give more axial load, or {prop}."
    )


def _own_thrust(model: ContactModel, across: float) -> float:
    """Compute the thrust of a single row of cones under a load [N] across the axle, at least, [N].

    Every cup load has the angle of the cup, so their sum along the axle is at least its tangent times their
    sum across, in any pose. Across they carry the load, and centrifugal forces where rollers are missing:
    those of the others add up to no more than the missing ones would have.
    """
    uneven = float(model.inertia_load[0]) * np.count_nonzero(model.missing)
    return math.tan(model.bearing.cup_angle) * max(across - uneven, 0.0)


def _lacks_a_rib(bearing: CylindricalBearing, thrust: float) -> float:
    """Find how much of the thrust [N] on a single row of cylinders no rib carries, [N]."""
    return 0.0 if math.copysign(1.0, thrust) in bearing.thrust_rib_sides else abs(thrust)


def _unheld_cylinders(bearing: CylindricalBearing, thrust: float, yields: str, prop: str) -> str:
    """Say which way a single row of cylinders has no rib, and what holds it."""
    way = "+y" if thrust > 0.0 else "-y"
    return (
        f"static equilibrium of {bearing.name} does not exist: {abs(thrust):.4g} N push the axle towards "
        f"{way}, and its single row (rows: 1) has no rib of the inner ring for this way with one of the "
        f"outer ring at the other ends of its rollers (cone_ribs {bearing.cone_ribs}, cup_ribs "
        f"{bearing.cup_ribs}){yields}. Turn the thrust round, give both rings ribs "
        f"on both sides as NUP has, or {prop}."
    )
