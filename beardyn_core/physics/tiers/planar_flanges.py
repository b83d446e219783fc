"""Ends of cylindrical rollers on the ribs of both rings in the quasistatic tier, and what grips the rollers.

A cylinder floats between the ribs of its ring. Where no rib holds it, its raceways do: each resists sliding
along its generator in proportion to the slip, by the law of `sliding`. Rollers pass what the ribs of the cone
push them with on to those of the cup, and lean over between both.

Neglected, as with the rib of tapered rollers: edges of the faces, and skew.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.contact_output import ContactOutput, output_contact
from beardyn_core.physics.bodies.layout import RIB
from beardyn_core.physics.flanges import flange_torque, of_output
from beardyn_core.physics.lanes.lane_math import at_least, where_greater
from beardyn_core.physics.lanes.vectors import Vector, choose_vector, scale
from beardyn_core.physics.tiers.planar_contacts import add_raceway, damper_force, rib_spring
from beardyn_core.physics.tiers.sliding import creep_of


class FlangeSpring(NamedTuple):
    """Contact with one rib before the solve."""

    force: Any  # with the damper [N]
    stiffness: Any  # tangent [N/m]
    way: Vector  # change of the approach with radial and axial place, and with tilt [-], [-], [m/rad]
    sphere: Vector  # centre of the end's sphere from the centre of mass [m]


class FlangeSprings(NamedTuple):
    """Contacts with all ribs, and resistance of the raceways to sliding along them."""

    cone_outer: FlangeSpring
    cone_inner: FlangeSpring
    cup_outer: FlangeSpring
    cup_inner: FlangeSpring
    grip: Any  # 2, of cup and cone [N s/m]
    slip: Any  # 2, of the roller along cup and cone, in its flight [m/s]


class FlangeLoads(NamedTuple):
    """What the ends of a block of rollers do at the end of a step."""

    each: Any  # 4, load on each rib, in the order of `FlangeParams` [N]
    total: Any  # of them [N]
    on_cup: Any  # 3, radial and axial force besides what `cup_wrench` has, and moment about the centre [N m]


@inline
def _from_side(vector, inner):
    if inner is None:
        return vector
    return scale(-1.0, vector)


@inline
def _spring(centre, axis, ring_axis, motion, flight, flange, damping):
    zero = 0.0 * centre[0]
    nothing = (zero, zero, zero)
    if flange is None:
        return FlangeSpring(zero, zero, nothing, nothing)
    end, rib = _from_side(axis, flange.inner), flange.rib
    force, stiffness, way, rate = rib_spring(centre, end, _from_side(ring_axis, flange.inner), motion, rib)
    rate = rate + way[0] * flight[0] + way[1] * flight[1] + way[2] * flight[2]
    force = force + damper_force(stiffness, rate, damping)
    return FlangeSpring(force, stiffness, way, scale(rib.sphere_place, end))


@inline
def flange_springs(place, centre, axis, ring_axis, motion, flight, raceways, level, flanges, p):
    """Linearise the contacts with all ribs: `FlangeSprings`, or ``None`` without ribs of this kind.

    ``place`` (2 numbers), ``centre`` (vector): of mass against cup and cone [m]; ``motion`` (2 vectors):
    velocity and angular velocity of the cone; ``raceways`` (2 numbers): loads of cup and cone [N];
    ``level``: of `sliding.rolling_level`.
    """
    if flanges is None:
        return None
    damping, zero = p.base.effects.damping, 0.0 * place[0]
    still, upright = (zero, zero, zero), (zero, zero, zero + 1.0)
    on_cup = (place[0], zero, place[1])
    rest = (still, still)
    cone_slides = motion[0][2] - motion[1][1] * p.kinematic.cone_radius
    return FlangeSprings(
        _spring(centre, axis, ring_axis, motion, flight, flanges.cone_outer, damping),
        _spring(centre, axis, ring_axis, motion, flight, flanges.cone_inner, damping),
        _spring(on_cup, axis, upright, rest, flight, flanges.cup_outer, damping),
        _spring(on_cup, axis, upright, rest, flight, flanges.cup_inner, damping),
        (raceway_grip(raceways[0], level, p.grip), raceway_grip(raceways[1], level, p.grip)),
        (flight[1], flight[1] - cone_slides),
    )


@inline
def raceway_grip(load, level, grip):
    """Work out what a raceway resists sliding along it with, [N s/m]; see `sliding.creep_of`."""
    if grip is None:
        return 0.0 * load
    return creep_of(at_least(load, 0.0), level, grip)


@inline
def _add(system, spring, factor):
    zero = 0.0 * spring.force
    only = (spring.stiffness, zero, zero)
    way = spring.way
    return add_raceway(system, (spring.force, zero), only, way, (way[2], zero), factor)


@inline
def add_flanges(system, springs, factor, rate):
    """Add all ribs and the grip of the raceways to matrix and right side; ``rate``: steps in a second."""
    if springs is None:
        return system
    system = _add(_add(system, springs.cone_outer, factor), springs.cone_inner, factor)
    system = _add(_add(system, springs.cup_outer, factor), springs.cup_inner, factor)
    m, r = system
    grip, slip = springs.grip, springs.slip
    held = grip[0] + grip[1]
    pushed = grip[0] * slip[0] + grip[1] * slip[1]
    return (m[0], m[1], m[2], m[3] + rate * held, m[4], m[5]), (r[0], r[1] - pushed, r[2])


@inline
def _load(spring, move, factor):
    way = spring.way
    deeper = way[0] * move[0] + way[1] * move[1] + way[2] * move[2]
    return at_least(spring.force + factor * spring.stiffness * deeper, 0.0)


@inline
def _on_ring(total, place, spring, load):
    """Add force and moment about the bearing centre of one contact on its ring."""
    way, sphere = spring.way, spring.sphere
    lever = (place[1] + sphere[2]) * way[0] - (place[0] + sphere[0]) * way[1]
    return total[0] + load * way[0], total[1] + load * way[1], total[2] + load * lever


@inline
def settle_flange_loads(springs, place, move, factor, rate, cup_radius):
    """Work out `FlangeLoads` after a move of the rollers; ``None`` without ribs of this kind."""
    if springs is None:
        return None
    cone_outer = _load(springs.cone_outer, move, factor)
    cone_inner = _load(springs.cone_inner, move, factor)
    cup_outer = _load(springs.cup_outer, move, factor)
    cup_inner = _load(springs.cup_inner, move, factor)
    zero = 0.0 * place[0]
    on_cup = _on_ring((zero, zero, zero), place, springs.cup_outer, cup_outer)
    on_cup = _on_ring(on_cup, place, springs.cup_inner, cup_inner)
    dragged = springs.grip[0] * (springs.slip[0] + rate * move[1])
    on_cup = (on_cup[0], on_cup[1] + dragged, on_cup[2] - cup_radius * dragged)
    total = cone_outer + cone_inner + cup_outer + cup_inner
    return FlangeLoads((cone_outer, cone_inner, cup_outer, cup_inner), total, on_cup)


@inline
def shown_load(rib, loads, flanges):
    """Take the load of the rib that the output has, [N]; ``rib``: that of a roller with one rib."""
    if loads is None:
        return rib
    each = loads.each
    of_cone, of_cup = at_least(each[0], each[1]), at_least(each[2], each[3])
    return of_output(of_cone, of_cup, flanges.cone_outer, flanges.cone_inner)


@inline
def all_flanges(rib, loads):
    """Add up the loads of all ribs, [N]; see `shown_load`."""
    if loads is None:
        return rib
    return loads.total


@inline
def flanges_torque(torque, loads, speed, flanges):
    """Work out the torque of all ribs on the shaft, [N m]; ``torque``: that of a roller with one rib."""
    if flanges is None:
        return torque
    total = 0.0 * loads.total
    total = _add_torque(total, loads.each[0], speed, flanges.cone_outer)
    total = _add_torque(total, loads.each[1], speed, flanges.cone_inner)
    total = _add_torque(total, loads.each[2], speed, flanges.cup_outer)
    return _add_torque(total, loads.each[3], speed, flanges.cup_inner)


@inline
def _add_torque(total, load, speed, flange):
    if flange is None:
        return total
    return total + flange_torque(load, speed, flange)


@inline
def show_flanges(lanes, rollers, block, axis, loads, speed, flanges):
    """Write force, place and slip of one rib contact of each roller, see `flanges`; rings do not lean."""
    if flanges is None:
        return
    zero = 0.0 * loads.total
    nothing = (zero, zero, zero)
    most, kept = zero, ContactOutput(nothing, nothing, zero, zero)
    most, kept = _heavier(most, kept, axis, loads.each[0], speed, flanges.cone_outer)
    most, kept = _heavier(most, kept, axis, loads.each[1], speed, flanges.cone_inner)
    most, of_cup = _heavier(most, kept, axis, loads.each[2], speed, flanges.cup_outer)
    most, of_cup = _heavier(most, of_cup, axis, loads.each[3], speed, flanges.cup_inner)
    kept = of_output(kept, of_cup, flanges.cone_outer, flanges.cone_inner)
    output_contact(lanes, rollers, block, RIB, kept)


@inline
def _heavier(most, kept, axis, load, speed, flange):
    if flange is None:
        return most, kept
    rib, zero = flange.rib, 0.0 * load
    radial = rib.normal_radial + zero
    axial = _signed(rib.normal_axial, flange.inner) + zero
    place = _signed(rib.sphere_place, flange.inner)
    arm = (
        place * axis[0] + rib.sphere_radius * radial,
        zero,
        place * axis[1] + rib.sphere_radius * axial,
    )
    force = (-load * radial, zero, -load * axial)
    found = ContactOutput(
        choose_vector(load, most, force, kept.force),
        choose_vector(load, most, arm, kept.arm),
        where_greater(load, most, abs(flange.slip * speed) + zero, kept.slip),
        zero,
    )
    return at_least(load, most), found


@inline
def _signed(value, inner):
    if inner is None:
        return value
    return -value


@inline
def add_axial(axial, counted, loads):
    """Add the axial forces of a block of rollers on the cup, outwards, [N]; nothing without these ribs."""
    if loads is None:
        return axial
    return axial + counted * loads.on_cup[1]


@inline
def axial_sum(plain, axial, direct):
    """Take the sum that `axial_sine` turns into axial force: of cup loads, or of axial forces, [N].

    ``direct``: ``None`` where the axial force of a roller goes with its cup load.
    """
    if direct is None:
        return plain
    return axial


@inline
def axial_sine(sine, direct):
    """Take the sine that goes with `axial_sum`: of the cup's angle, or -1 for forces along the axle."""
    if direct is None:
        return sine
    return -1.0


@inline
def radial_on_cup(loads, plain):
    """Take the radial force of a roller on the cup over the cosine of its angle, [N]."""
    if loads is None:
        return plain
    return plain + loads.on_cup[0]


@inline
def moment_on_cup(loads, plain):
    """Take the moment of a roller on the cup about the bearing centre in its meridian plane, [N m]."""
    if loads is None:
        return plain
    return plain + loads.on_cup[2]
