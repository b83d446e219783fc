"""Pockets of the cage: their films and lands as parameters, their contacts within a step, their torque.

A pocket has two bars and two ends. The full cage has disc against plane at two abscissae of both bars and end
against plane at both ends; the cheaper cages have two touches along the pitch circle only. Only sums over the
walls are kept until the step is settled: five walls with all they have would take more of the cache than all
else that a roller keeps.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.effects import Cage, KinematicCage, RotatingCage
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    account,
    account_loss,
    accumulate_vector,
    output_contact,
    react,
)
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LOSS_POCKET,
    LOST_ON_CAGE,
    POCKET,
    POCKET_ANGLE,
    RING_TURN,
)
from beardyn_core.physics.bodies.orbit import ring_view
from beardyn_core.physics.bodies.power import SMALLEST_LOAD
from beardyn_core.physics.defect import pocket_length, pocket_wear
from beardyn_core.physics.drag import drag_push
from beardyn_core.physics.lanes.lane_math import at_least, at_most, cos_sin, magnitude, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import (
    Vector,
    Wrench,
    add,
    add_scaled,
    add_wrenches,
    cross,
    dot,
    scale,
    subtract,
    turn_out,
)
from beardyn_core.scene.scene import Scene


class PocketFilmParams(NamedTuple):
    """Lubricant between roller and bar at one of two abscissae; see `physics.cage.pocket.pocket_loads`."""

    wedge: float  # load over rolling speed and radius over gap [N s/m]
    squeeze: float  # load over speed of approach and (radius over gap)^1.5 [N s/m]
    shear: float  # friction over slip and (radius over gap)^0.5 [N s/m]
    thinnest: float  # [m]
    inverse_layer: float  # of the thickness of the lubricant's layer [1/m]
    share: float  # over the squeeze resistance that explicit cage and rollers can follow [m/(N s)]


class LandParams(NamedTuple):
    """Land of a cage in a cylinder of cup or cone; see `physics.cage.land`."""

    body: float  # row of the ring in the array of bodies
    outside: float  # +1 when the cage runs inside the ring, -1 around it
    radius: float  # [m]
    clearance: float  # radial [m]
    half_width: float  # [m]
    place: float  # outward from the cage's centre of mass [m]
    film: float  # eta R L^3 / (2 C^2) [N s]
    drag: float  # Petroff's torque over speed [N m s]
    most_eccentric: float  # bound of the eccentricity ratio in the film's formulas
    stiffness: float  # of an edge [N/m]
    damping: float  # [N s/m]
    friction: float
    regularisation: float  # [m/s]


class RotatingCageParams(NamedTuple):
    """The cage follows the rings but for its spin."""

    follows: float


class KinematicCageParams(NamedTuple):
    """The cage follows the rings, its spin is prescribed."""

    speed_ratio: float  # over the shaft
    stiffness: float  # of each of two springs [N/m]
    damping: float  # [N s/m]


class CageParams(NamedTuple):
    """Pockets of a cage."""

    step: float  # [s]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    half_clearance: float  # along the pitch circle [m]
    half_end_clearance: float  # along the roller [m]
    bar_sine: float  # inclination of the bar faces
    bar_cosine: float
    bar_place: float  # contact points on the bars, from the centre of mass [m]
    roller_height: float  # nominal roller centre from the cage axis [m]
    roller_place: float  # nominal roller centre along the pocket axis, from the cage's centre of mass [m]
    axis_radial: float
    axis_axial: float
    friction: float
    regularisation: float  # [m/s]
    place: float  # axial place of its centre of mass from the middle plane [m]
    mass: float  # [kg]
    polar_inertia: float  # [kg m^2]
    transverse_inertia: float
    film: PocketFilmParams | None = None
    land: LandParams | None = None
    rotating: RotatingCageParams | None = None  # six degrees of freedom without this and the next
    kinematic: KinematicCageParams | None = None


# Of what swings from step to step for good, where all rollers press one bar of their pockets and the explicit
# cage and rollers answer a step late, and what the film has of it at least, whatever the dry wall takes.
_MOST_OF_STABLE, _LEAST_OF_FILM = 5.0 / 6.0, 1.0 / 8.0
BAR_PLACE = 0.35  # of rollers on a bar, from their middle, over their length
# A film may push back by W^2 / 4c when it opens; its friction pays for that while the bounded resistance c is
# no less than 1/39 of the physical one: 2.45^2 / (4 * 3 sqrt(2) pi * sqrt(2) pi) = 1/39.5.
_PAID = 39.0


def cage_params(scene: Scene, step: float) -> CageParams | None:
    """Lay cage pockets around the nominal rollers, for steps of `step` [s]."""
    bearing, cage = scene.bearing, scene.effects.cage
    if cage is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    radial = bearing.roller_orbit_radius
    axial = bearing.roller_mass_offset * cosine
    lean = cage.bar_inclination if isinstance(cage, Cage) else 0.0
    wear = 0.0 if isinstance(cage, KinematicCage) else cage.pocket_wear
    return CageParams(
        step=step,
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        half_clearance=0.5 * (bearing.cage.circumferential_clearance + wear),
        half_end_clearance=0.5 * bearing.cage.axial_clearance,
        bar_sine=math.sin(lean),
        bar_cosine=math.cos(lean),
        bar_place=BAR_PLACE * bearing.effective_length,
        roller_height=radial,
        roller_place=radial * sine + axial * cosine,
        axis_radial=sine,
        axis_axial=cosine,
        friction=0.0 if isinstance(cage, KinematicCage) else cage.friction,
        regularisation=1.0 if isinstance(cage, KinematicCage) else cage.regularisation_speed,
        place=0.5 * bearing.row_spacing,
        mass=bearing.cage.mass,
        polar_inertia=bearing.cage.polar_inertia,
        transverse_inertia=bearing.cage.transverse_inertia,
        film=_film(scene, step) if isinstance(cage, Cage) else None,
        land=_land(scene, step) if isinstance(cage, Cage) else None,
        rotating=RotatingCageParams(1.0) if isinstance(cage, RotatingCage) else None,
        kinematic=_kinematic(bearing, cage) if isinstance(cage, KinematicCage) else None,
    )


def _kinematic(bearing: Bearing, cage: KinematicCage) -> KinematicCageParams:
    return KinematicCageParams(
        speed_ratio=cage.speed_ratio * cage_speed(bearing, 1.0),
        stiffness=0.5 * cage.stiffness,
        damping=0.5 * cage.damping,
    )


def _least_inertia(bearing: Bearing) -> float:
    """Work out the mass of a cage as its pockets feel it along the pitch circle, [kg]."""
    return min(bearing.cage.mass, bearing.cage.polar_inertia / (0.5 * bearing.pitch_diameter) ** 2)


def _yielding(bearing: Bearing) -> float:
    """Sum what rollers and cage yield to one force at each end of a bar of every pocket, [1/kg]."""
    arm = BAR_PLACE * bearing.effective_length
    of_roller = max(1.0 / bearing.roller_mass, arm**2 / bearing.roller_transverse_inertia)
    return 2.0 * (of_roller + bearing.roller_count / _least_inertia(bearing))


def _share(bearing: Bearing, lean: float, step: float) -> float:
    """Work out what bounds the film, so that it, damper and spring of the wall do not swing together.

    Steps h that move with the new velocity are stable up to h c Y + h^2 k Y / 2 of 2, for dampers c and
    springs k that act on what yields by Y. Bars that lean push along the pitch circle with the cosine, and
    the cage across, where it yields by half at any lean.
    """
    cage, yields = bearing.cage, _yielding(bearing) * max(math.cos(lean) ** 2, 0.5)
    dry = step * (cage.damping + 0.5 * step * cage.stiffness) * yields
    return step * yields / (2.0 * max(_MOST_OF_STABLE - 0.5 * dry, _LEAST_OF_FILM))


def _film(scene: Scene, step: float) -> PocketFilmParams | None:
    """Work out the film of half a bar; all pockets together resist no more than the inertias allow."""
    if not isinstance(scene.effects.cage, Cage) or scene.effects.cage.lubrication is None:
        return None
    options, bearing = scene.effects.cage.lubrication, scene.bearing
    per_length = scene.lubricant.dynamic_viscosity(scene.temperature) * 0.5 * bearing.effective_length
    share = _share(bearing, scene.effects.cage.bar_inclination, step)
    squeeze = 3.0 * math.sqrt(2.0) * math.pi * per_length
    radius = 0.5 * bearing.roller_diameter
    bounded = radius * (squeeze * share / (_PAID - 1.0)) ** (2.0 / 3.0)
    return PocketFilmParams(
        wedge=0.5 * 4.9 * per_length,
        squeeze=squeeze,
        shear=math.sqrt(2.0) * math.pi * per_length,
        thinnest=max(options.switch_thickness, bounded),
        inverse_layer=1.0 / options.layer,
        share=share,
    )


def _land(scene: Scene, step: float) -> LandParams | None:
    if not isinstance(scene.effects.cage, Cage) or scene.effects.cage.guidance is None:
        return None
    options, bearing = scene.effects.cage.guidance, scene.bearing
    outside = 1.0 if options.on == "cup" else -1.0
    diameter = options.land_diameter
    if diameter is None:
        diameter = bearing.pitch_diameter + 0.5 * outside * bearing.roller_diameter
    offset = options.land_offset
    if offset is None:
        offset = 0.5 * bearing.roller_length * math.cos(bearing.contact_angle)
    radius, width, clearance = 0.5 * diameter, options.land_width, options.clearance
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    # the cage is explicit: a film of cold lubricant may not resist more than it can follow within a step
    largest = 0.25 * _least_inertia(bearing) / step
    film = min(viscosity * radius * width**3 / (2.0 * clearance**2), 0.5 * largest * clearance / math.pi)
    drag = 2.0 * math.pi * viscosity * radius**3 * width / clearance
    return LandParams(
        body=float(CUP_BODY if options.on == "cup" else CONE_BODY),
        outside=outside,
        radius=radius,
        clearance=clearance,
        half_width=0.5 * width,
        place=offset,
        film=film,
        drag=min(drag, 0.25 * bearing.cage.polar_inertia / step),
        most_eccentric=most_eccentric(film / clearance, largest),
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        friction=options.friction,
        regularisation=options.regularisation_speed,
    )


def most_eccentric(film: float, largest: float) -> float:
    """Find the eccentricity ratio where a land film resists less than `largest` [N s/m], at most 0.99."""
    low, high = 0.0, 0.99
    for _ in range(60):
        ratio = 0.5 * (low + high)
        flat = 1.0 - ratio**2
        resistance = film * (math.pi * (1.0 + 2.0 * ratio**2) / flat**2.5 + 8.0 * ratio / flat**2)
        low, high = (ratio, high) if resistance < largest else (low, ratio)
    return low


@inline
def is_reached(depth, film):
    """Tell whether the wall acts on any lane; a film acts within the thickness of its layer."""
    if film is None:
        return any_positive(depth)
    return any_positive(1.0 + film.inverse_layer * depth)


@inline
def pocket_loads(depth, pressed, rate, slip, direction, shape, film):
    """Split the load of a wall into that of its film, that which rubs solid on solid, and viscous friction.

    An isoviscous film between rigid faces carries the bar until the gap has closed to `film.thinnest`, where
    roughness keeps it; what is pressed further is carried by spring and damper on top of the film. Squeezing
    adds to the load and opening takes from it, down to zero: the film cavitates instead of pulling. A gap
    wider than the lubricant's layer is not bridged. Neglects side leakage and the heating of the film.

    ``depth``: approach beyond touching, negative for a gap [m]; ``pressed``: spring and damper of the dry
    wall [N]; ``rate``: speed of approach [m/s]; ``slip``: of the roller's surface against the bar [m/s];
    ``direction``: normal of the wall, towards it; ``shape``: axis of the
    roller, and its radius here [m]. Returns ``load``, ``solid`` [N]; ``shear``: friction force of the film
    over slip [N s/m].

    References
    ----------
    Martin, H. M. (1916): w = 4.9 eta u R l / h with the mean surface speed u, half of the roller's here.
    Squeezing from Reynolds' equation with h + x^2 / 2R: h^3 p' = 12 eta h' x gives p = -6 eta R h' / h^2 and
    w = -3 sqrt(2) pi eta l h' (R / h)^1.5; shearing: eta u l times the integral of dx / h over all x, which
    is sqrt(2) pi eta u l (R / h)^0.5.
    """
    if film is None:
        load = at_least(pressed, 0.0)
        return load, load, 0.0
    axis, radius = shape
    gap = at_least(-depth, film.thinnest)
    bridged = at_least(1.0 - film.inverse_layer * gap, 0.0)
    ratio = radius / gap
    root = sqrt(ratio)
    rolling = magnitude(dot(slip, cross(axis, direction)))
    squeeze = film.squeeze * bridged * ratio * root
    # the cage is explicit: a pocket may not resist more than its share of the cage can follow within a step
    squeeze = squeeze / (1.0 + film.share * squeeze)
    load = at_least(pressed + film.wedge * bridged * ratio * rolling + squeeze * rate, 0.0)
    solid = at_most(at_least(pressed, 0.0), load)
    return load, solid, film.shear * bridged * root


_SMALLEST_WAY = 1e-15


class Walls(NamedTuple):
    """Sums over the walls of a pocket."""

    force: Vector  # on the roller [N]
    moment: Vector  # about its centre of mass [N m]
    energy: Any  # elastic [J]
    power: Any  # lost at the present slip [W]
    lost_force: Vector  # lost part of the force, negated [N]
    lost_moment: Vector  # its moment [N m]


class PocketContact(NamedTuple):
    """A pocket contact before the solve."""

    centre: Vector  # of mass of the roller from the cage's origin [m]
    walls: Walls
    slip_squared: Any  # at the bar that presses more [m^2/s^2]
    bar: Vector  # contact with the nearer bar from the centre of mass [m]


class Motion(NamedTuple):
    """How a roller and its cage move, in the orbit frame."""

    velocity: Vector  # of the roller's centre of mass [m/s]
    omega: Vector  # [rad/s]
    cage_velocity: Vector  # of the cage's origin [m/s]
    cage_omega: Vector  # [rad/s]


class Pocket(NamedTuple):
    """Where a roller is in its pocket.

    The order of the members decides the last bits, see `contact_output.react`.
    """

    centre: Vector  # of mass of the roller from the cage's origin [m]
    axis: Vector  # of the roller
    motion: Motion
    advance: Any  # azimuth of the roller less that of its pocket [rad]
    tilt: Vector  # small rotation of the cage without its spin [rad]
    wear: Any  # half of the clearance added by wear and scatter [m]
    length: Any  # half of that added at the ends [m]


class Wall(NamedTuple):
    """A wall of a pocket that a roller may touch."""

    centre: Vector  # of mass of the roller from the cage's origin [m]
    arm: Vector  # where the roller touches it, from the centre of mass [m]
    direction: Vector  # normal of the wall, towards it
    depth: Any  # approach beyond touching, negative for a gap [m]


@inline
def prepare_pocket(lanes, rings, block, body, orbit, pockets, p, cage):
    """Work out the pocket contact of one block before the solve, a `PocketContact`; zeros without a cage.

    ``pockets`` [block, 2, lane] (or ``None``): half of the clearance added to pockets, along the pitch circle
    and at the ends [m].
    """
    if cage is None:
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        return PocketContact(nothing, empty_sums(zero), zero, nothing)
    view = ring_view(lanes, rings, CAGE_BODY, orbit.cosine, orbit.sine)
    place = lanes.load(rings, CAGE_BODY, RING_TURN) + lanes.load(p.rollers, block, POCKET_ANGLE)
    wear, length = pocket_wear(lanes, block, pockets), pocket_length(lanes, block, pockets)
    centre = subtract(body.place, view.origin)
    motion = Motion(body.velocity, body.omega, view.velocity, view.omega)
    pocket = Pocket(centre, body.axis, motion, orbit.azimuth - place, view.axis, wear, length)
    return _touch(pocket, p.roller, cage, cage.rotating, cage.kinematic)


@inline
def _touch(pocket, roller, cage, rotating, kinematic):
    if kinematic is not None:
        return kinematic_pocket(pocket, cage, kinematic)
    if rotating is not None:
        return rotating_pocket(pocket, roller, cage)
    return free_pocket(pocket, roller, cage)


@inline
def push_pocket(total, contact, cage):
    """Add the pocket's wrench to that of the roller."""
    if cage is None:
        return total
    return add_wrenches(total, Wrench(contact.walls.force, contact.walls.moment))


@inline
def settle_pocket(contact, change, here, cage, p):
    """Write reaction, output and audit of the pocket contact, which is explicit.

    The loss is taken at the middle of the step. It changes the roller's velocity here; what it changes in
    the cage's is known when all pockets have pushed, see `motion.settle_cages`. Kinetic energy is the
    mean of what the velocities before and after the step have, which lies above that of the instant by a
    quarter of what the springs give in the step: the elastic energy is booked without it.
    """
    if cage is None:
        return
    walls, zero = contact.walls, here.lanes.constant(0.0)
    react(CAGE_BODY, contact.centre, Wrench(walls.force, walls.moment), here)
    output = ContactOutput(walls.force, contact.bar, sqrt(contact.slip_squared), zero)
    output_contact(here.lanes, here.rollers, here.block, POCKET, output)
    lost = walls.power + 0.5 * (dot(walls.lost_force, change.velocity) + dot(walls.lost_moment, change.omega))
    account_loss(here, LOSS_POCKET, p.step * lost, p.effects.audit)
    spring = add(walls.force, walls.lost_force)
    turning = add(walls.moment, walls.lost_moment)
    kinetic = 0.25 * p.step * (dot(spring, change.velocity) + dot(turning, change.omega))
    account(here, zero, walls.energy - kinetic, p.effects.audit)
    _keep_lost(contact, here, p.effects.audit)


@inline
def _keep_lost(contact, here, audit):
    """Sum the lost part of the pocket's force, negated, and its moment about the cage's origin."""
    if audit is None:
        return
    walls = contact.walls
    if any_positive(walls.power):
        moment = add(walls.lost_moment, cross(contact.centre, walls.lost_force))
        force = turn_out(scale(here.mask, walls.lost_force), here.cosine, here.sine)
        turn = turn_out(scale(here.mask, moment), here.cosine, here.sine)
        accumulate_vector(here, LOST_ON_CAGE, force)
        accumulate_vector(here, LOST_ON_CAGE + 3, turn)


# --- the three kinds of pockets


@inline
def free_pocket(pocket, roller, cage):
    """Work out the force of a free cage on the roller, and what it loses, as a `PocketContact`.

    Disc against plane at two abscissae of both bars, and end against plane at both pocket ends: linear
    springs with damping that never pull, and regularised Coulomb friction; at the bars a lubricant film if
    the cage has one. The bar faces lean, so that the rollers guide the cage radially. Neglects the bending of
    the bars, and the turn of the touching points under skew (1 um per mrad).
    """
    centre, axis, tilt, motion = pocket.centre, pocket.axis, pocket.tilt, pocket.motion
    cosine, sine = cos_sin(pocket.advance)
    still = 0.0 * sine
    ahead = (sine, cosine, still)
    ahead = add(ahead, cross(tilt, ahead))
    outward = (cosine, -sine, still)
    outward = add(outward, cross(tilt, outward))
    pocket_axis = (cage.axis_radial * cosine, -cage.axis_radial * sine, cage.axis_axial + still)
    pocket_axis = add(pocket_axis, cross(tilt, pocket_axis))

    height = cage.bar_sine * (dot(outward, centre) - cage.roller_height)
    offset = cage.bar_cosine * dot(ahead, centre)
    skew = cage.bar_cosine * dot(ahead, axis)
    lift = cage.bar_sine * (dot(outward, axis) - cage.axis_radial)
    front = add_scaled(scale(cage.bar_cosine, ahead), cage.bar_sine, outward)
    behind = add_scaled(scale(-cage.bar_cosine, ahead), cage.bar_sine, outward)
    clearance = cage.bar_cosine * (cage.half_clearance + pocket.wear)
    small, large = -cage.bar_place, cage.bar_place
    small_radius = roller.radius - cage.bar_place * roller.taper
    large_radius = roller.radius + cage.bar_place * roller.taper
    small_arm, large_arm = scale(small, axis), scale(large, axis)
    small_end, large_end = (axis, small_radius), (axis, large_radius)
    small_front = add_scaled(small_arm, small_radius, front)
    small_behind = add_scaled(small_arm, small_radius, behind)
    walls = empty_sums(0.0 * still)
    depth = height + offset + small * (lift + skew) - clearance
    wall = Wall(centre, small_front, front, depth)
    walls = touch_wall(walls, wall, motion, cage, small_end, cage.film)
    large_front = add_scaled(large_arm, large_radius, front)
    depth = height + offset + large * (lift + skew) - clearance
    wall = Wall(centre, large_front, front, depth)
    walls = touch_wall(walls, wall, motion, cage, large_end, cage.film)
    pushed_back = walls.force
    depth = height - offset + small * (lift - skew) - clearance
    wall = Wall(centre, small_behind, behind, depth)
    walls = touch_wall(walls, wall, motion, cage, small_end, cage.film)
    large_behind = add_scaled(large_arm, large_radius, behind)
    depth = height - offset + large * (lift - skew) - clearance
    wall = Wall(centre, large_behind, behind, depth)
    walls = touch_wall(walls, wall, motion, cage, large_end, cage.film)
    pushed_on = subtract(walls.force, pushed_back)
    slip_squared = where_greater(
        dot(pushed_on, pushed_on),
        dot(pushed_back, pushed_back),
        _slip_squared(centre, small_behind, motion),
        _slip_squared(centre, small_front, motion),
    )
    slide = dot(pocket_axis, centre) - cage.roller_place
    side = where_greater(slide, 0.0, 1.0 + still, -1.0 + still)
    shorter = roller.half_length * (1.0 - dot(pocket_axis, axis))
    arm, direction = scale(side * roller.half_length, axis), scale(side, pocket_axis)
    end = Wall(centre, arm, direction, magnitude(slide) - shorter - cage.half_end_clearance - pocket.length)
    walls = touch_wall(walls, end, motion, cage, (axis, roller.radius), None)
    bar = scale(where_greater(offset, 0.0, roller.radius + still, -roller.radius + still), ahead)
    return PocketContact(centre, walls, slip_squared, bar)


@inline
def rotating_pocket(pocket, roller, cage):
    """Work out the contact with the nearer bar at both ends of the roller; as `free_pocket`.

    Without play there is no nearer bar; the side a roller is on then pushes it back, as both bars would.
    Neglects the lean of the bars, the lubricant, and the pocket ends.
    """
    centre, axis, motion = pocket.centre, pocket.axis, pocket.motion
    ahead, offset, skew = _along_pitch_circle(pocket)
    clearance = cage.half_clearance + pocket.wear
    small_place, large_place = -cage.bar_place, cage.bar_place
    small_offset = offset + small_place * skew
    large_offset = offset + large_place * skew
    small_side = where_greater(small_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    large_side = where_greater(large_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    small_radius = roller.radius + small_place * roller.taper
    large_radius = roller.radius + large_place * roller.taper
    small_normal, large_normal = scale(small_side, ahead), scale(large_side, ahead)
    small_arm = add_scaled(scale(small_place, axis), small_radius, small_normal)
    nothing = empty_sums(0.0 * offset)
    wall = Wall(centre, small_arm, small_normal, magnitude(small_offset) - clearance)
    small = touch_wall(nothing, wall, motion, cage, (axis, small_radius), None)
    large_arm = add_scaled(scale(large_place, axis), large_radius, large_normal)
    wall = Wall(centre, large_arm, large_normal, magnitude(large_offset) - clearance)
    both = touch_wall(small, wall, motion, cage, (axis, large_radius), None)
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small.force, both.force)
    bar = scale(
        where_greater(offset, 0.0, roller.radius + 0.0 * offset, -roller.radius + 0.0 * offset), ahead
    )
    return PocketContact(centre, both, slip_squared, bar)


@inline
def kinematic_pocket(pocket, cage, kinematic):
    """Hold the roller's axis at its pocket's place by two weak springs with dampers, without play.

    They hold the skew too.
    """
    centre, axis, motion = pocket.centre, pocket.axis, pocket.motion
    ahead, offset, skew = _along_pitch_circle(pocket)
    small_arm, large_arm = scale(-cage.bar_place, axis), scale(cage.bar_place, axis)
    nothing = empty_sums(0.0 * offset)
    small = add_kinematic_spring(
        nothing, centre, small_arm, ahead, offset - cage.bar_place * skew, motion, kinematic
    )
    both = add_kinematic_spring(
        small, centre, large_arm, ahead, offset + cage.bar_place * skew, motion, kinematic
    )
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small.force, both.force)
    return PocketContact(centre, both, slip_squared, scale(0.0, ahead))


@inline
def _along_pitch_circle(pocket):
    """Take the direction of growing azimuth at the pocket; offset [m] and skew of the roller along it."""
    cosine, sine = cos_sin(pocket.advance)
    ahead = (sine, cosine, 0.0 * sine)
    ahead = add(ahead, cross(pocket.tilt, ahead))
    return ahead, dot(ahead, pocket.centre), dot(ahead, pocket.axis)


@inline
def _pair_slip_squared(centre, small_arm, large_arm, motion, small_force, both_force):
    """Square the slip at the large end where more than half of the force is there, else at the small end."""
    large_force = subtract(both_force, small_force)
    small_slip, large_slip = wall_slip(centre, small_arm, motion), wall_slip(centre, large_arm, motion)
    return where_greater(
        4.0 * dot(large_force, large_force),
        dot(both_force, both_force),
        dot(large_slip, large_slip),
        dot(small_slip, small_slip),
    )


@inline
def _slip_squared(centre, arm, motion):
    slip = wall_slip(centre, arm, motion)
    return dot(slip, slip)


@inline
def wall_slip(centre, arm, motion):
    """Work out the velocity of the roller against the cage at a point, [m/s]."""
    velocity, omega, cage_velocity, cage_omega = motion
    return subtract(
        subtract(add(velocity, cross(omega, arm)), cage_velocity), cross(cage_omega, add(centre, arm))
    )


# --- walls


@inline
def empty_sums(zero):
    """Make sums over no walls from a zero, or a NaN, which stays one."""
    nothing = (zero, zero, zero)
    return Walls(nothing, nothing, zero, zero, nothing, nothing)


@inline
def _add_touch(walls, arm, slip, force, lost, energy):
    """Add one wall to the sums over the walls of a pocket."""
    return Walls(
        add(walls.force, force),
        add(walls.moment, cross(arm, force)),
        walls.energy + energy,
        walls.power + dot(lost, slip),
        add(walls.lost_force, lost),
        add(walls.lost_moment, cross(arm, lost)),
    )


@inline
def touch_wall(walls, wall, motion, cage, shape, film):
    """Add one wall to the sums: a spring-damper with friction; one that no roller reaches costs nothing.

    ``shape`` is the roller's axis and its radius at the wall, for the film if there is one.
    """
    if is_reached(wall.depth, film):
        slip = wall_slip(wall.centre, wall.arm, motion)
        return _press_wall(walls, wall.arm, slip, wall.direction, wall.depth, cage, shape, film)
    force = walls.force
    force = (force[0] + 0.0 * wall.depth, force[1], force[2])  # a NaN stays one
    return Walls(force, walls.moment, walls.energy, walls.power, walls.lost_force, walls.lost_moment)


@inline
def _press_wall(walls, arm, slip, direction, depth, cage, shape, film):
    inside = at_least(depth, 0.0)
    rate = dot(slip, direction)
    stored = 0.5 * cage.stiffness * inside * inside
    spring = cage.stiffness * _partial_contact_mean(inside, rate, cage.step)
    damping = where_greater(depth, 0.0, cage.damping + 0.0 * depth, 0.0 * depth)
    load, solid, shear = pocket_loads(depth, spring + damping * rate, rate, slip, direction, shape, film)
    tangential = add_scaled(slip, -rate, direction)
    speed = sqrt(dot(tangential, tangential) + cage.regularisation * cage.regularisation)
    friction = cage.friction * solid / speed + shear
    force = add_scaled(scale(-load, direction), -friction, tangential)
    lost = add_scaled(scale(load - spring, direction), friction, tangential)
    return _add_touch(walls, arm, slip, force, lost, stored)


@inline
def _partial_contact_mean(inside, rate, step):
    """Take what a wall's spring presses with where its contact begins or ends within a step, [m].

    A whole step of the force at the first or last instant of contact takes or gives k d (u h - d) / 2 more
    than the spring stores, d being its depth there and u the speed; this much less is exact. As in
    `laminae`, for a spring that is linear and explicit.
    """
    way = at_least(magnitude(rate) * step, _SMALLEST_WAY)
    return inside * (1.0 - 0.5 * at_least(1.0 - inside / way, 0.0))


@inline
def add_kinematic_spring(walls, centre, arm, direction, offset, motion, kinematic):
    """Add one spring-damper that pulls as well as it pushes."""
    slip = wall_slip(centre, arm, motion)
    damper = kinematic.damping * dot(slip, direction)
    spring = kinematic.stiffness * offset
    force, lost = scale(-spring - damper, direction), scale(damper, direction)
    return _add_touch(walls, arm, slip, force, lost, 0.5 * spring * offset)


@inline
def pocket_torque(cone_load, speeds, k, drag, pocket):
    """Work out the torque of the pockets of a block of rollers, along the shaft's rotation, [N m].

    A roller that the cone does not press is pushed round by its bar, against the medium and its weight; what
    it takes another roller in the load zone gives to its own bar. Neglects what ribs and rolling resistance
    drive or brake idle rollers with, and the rattle of those that the load holds.
    """
    if pocket is None:
        return 0.0 * cone_load
    push = pocket.weight + drag_push(speeds, k, drag)
    floor = pocket.regularisation
    torque = pocket.lever * push * (speeds[0] / math.sqrt(speeds[0] * speeds[0] + floor * floor))
    return where_greater(cone_load, SMALLEST_LOAD, 0.0 * cone_load, torque + 0.0 * cone_load)
