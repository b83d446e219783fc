"""Laminae as springs: their force and tangent stiffness, summed, for rollers that take implicit steps."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.layout import LAMINA_DROP, LAMINA_PLACE
from beardyn_core.physics.defect import find_damage, springs_of
from beardyn_core.physics.laminae import (
    SMALLEST_APPROACH,
    add_moments,
    contact_spring,
    deepest_approach,
    prepare_coupling,
)
from beardyn_core.physics.lanes.lane_math import at_least, magnitude, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import scale
from beardyn_core.physics.slice_law import force_share, quick_secant, tangent_share


@inline
def lamina_springs(lanes, block, approach, bend, azimuths, laminae, reach, patches, coupling, ellipse=None):
    """Sum elastic force with x^0, x^1 and tangent stiffness with x^0, x^1, x^2 over the laminae.

    ``approach`` (2 numbers): factors of x^0 and x^1 in the approach [m]; ``bend`` (2 numbers): factors of x^2
    and x^3; ``reach``: half length of the roller [m]; ``coupling``: `CouplingParams` or ``None``;
    ``ellipse``: `EllipseParams` of barrels or ``None``.

    References
    ----------
    Palmgren's line contact; see `physics.raceway.lamina_sums`.
    """
    surface, roller_surface, damage = patches
    near = find_damage(lanes, block, azimuths, laminae.shape[1], (surface, roller_surface), damage)
    return _near_or_far(lanes, near, approach, bend, laminae, reach, damage, (coupling, ellipse))


@inline
def cup_springs(lanes, block, approach, crown, azimuths, laminae, reach, faults, coupling):
    """Sum the springs on the cup, where only the error of a roller's profile bends the line; see above."""
    patches = (faults.cup, faults.roller, faults.cup_damage)
    if faults.crowns is None:
        return lamina_springs(lanes, block, approach, None, azimuths, laminae, reach, patches, coupling)
    bend = (crown, 0.0 * crown)
    return lamina_springs(lanes, block, approach, bend, azimuths, laminae, reach, patches, coupling)


@inline
def _near_or_far(lanes, near, approach, bend, laminae, reach, damage, laws):
    if damage is None:
        return _sound_moments(lanes, approach, bend, laminae, reach, laws)
    if near:
        return _spring_moments(lanes, approach, bend, laminae, damage, laws)
    return _sound_moments(lanes, approach, bend, laminae, reach, laws)


@inline
def _sound_moments(lanes, approach, bend, laminae, reach, laws):
    # where no roller of the block is in contact this look is all
    if any_positive(_deepest(approach, bend, reach, laws[1])):
        return _pressed_moments(lanes, approach, bend, laminae, laws)
    zero = lanes.constant(0.0)
    return (zero, zero), (zero, zero, zero)


@inline
def _deepest(approach, bend, reach, ellipse):
    if ellipse is None:
        return approach[0] + reach * magnitude(approach[1]) + most_bend(bend, reach)
    return deepest_approach(_all_factors(approach, bend), reach, ellipse)[0]


@inline
def _pressed_moments(lanes, approach, bend, laminae, laws):
    coupling, ellipse = laws
    if coupling is not None:
        return _spring_moments(lanes, approach, bend, laminae, None, laws)
    zero = lanes.constant(0.0)
    forces, stiffness = (zero, zero), (zero, zero, zero)
    for k in range(laminae.shape[1]):
        x = laminae[LAMINA_PLACE, k]
        depth = approach[0] + x * approach[1] + _bend(bend, x) - laminae[LAMINA_DROP, k]
        touching = at_least(depth, SMALLEST_APPROACH)
        tangent = quick_secant(touching, k, laminae, ellipse)
        tangent = where_greater(depth, 0.0, tangent, 0.0 * depth)
        force = tangent * touching
        forces = (forces[0] + force, forces[1] + x * force)
        stiffness = add_moments(stiffness, tangent, x)
    return forces, scale(tangent_share(ellipse), stiffness)


@inline
def _bend(bend, x):
    """Work out the part of the approach that is not affine in the abscissa, [m]."""
    if bend is None:
        return 0.0
    return (x * x) * (bend[0] + x * bend[1])


@inline
def most_bend(bend, reach):
    """Bound of `_bend` along the roller, [m]."""
    if bend is None:
        return 0.0
    return (reach * reach) * (magnitude(bend[0]) + reach * magnitude(bend[1]))


@inline
def _all_factors(approach, bend):
    if bend is None:
        zero = 0.0 * approach[0]
        return approach[0], approach[1], zero, zero
    return approach[0], approach[1], bend[0], bend[1]


@inline
def _spring_moments(lanes, approach, bend, laminae, damage, laws):
    coupling, ellipse = laws
    zero = lanes.constant(0.0)
    forces, stiffness = (zero, zero), (zero, zero, zero)
    factors = _all_factors(approach, bend)
    prepare_coupling(lanes, factors, laminae, damage, coupling)
    laminae, springs = springs_of(laminae, damage, coupling)
    for k in range(springs):
        x = laminae[LAMINA_PLACE, k]
        share, depth, tangent, _energy = contact_spring(lanes, factors, k, laminae, damage, coupling, ellipse)
        tangent = share * tangent
        force = force_share(ellipse) * tangent * at_least(depth, 0.0)
        forces = (forces[0] + force, forces[1] + force * x)
        stiffness = add_moments(stiffness, tangent, x)
    return forces, stiffness
