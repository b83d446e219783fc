"""Land of a cage in a cylinder of cup or cone: short journal bearing, and solid contact at both edges.

Scalar and in world axes, once per cage and step.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.effects import Cage
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    ENERGY_LOST,
    LINEAR,
    LOSS_LAND,
    POSITION,
    RATE,
)
from beardyn_core.physics.bodies.rigid_bodies import body_vector, full_rotation, ring_direction
from beardyn_core.physics.cage.step_bounds import least_inertia
from beardyn_core.physics.lanes.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.scene.scene import Scene

_SMALLEST = 1e-30


class LandParams(NamedTuple):
    """Land of a cage in a cylinder of cup or cone."""

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


def land_params(scene: Scene, step: float) -> LandParams | None:
    """Lay the land that guides a cage; its film resists no more than the cage can follow within a step."""
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
    largest = 0.25 * least_inertia(bearing) / step
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
def short_bearing(eccentricity, velocity, axis, speed_sum, land):
    """Work out the film force on the inner or outer body of a short journal bearing against its eccentricity.

    Half-Sommerfeld film: seen from a frame that turns at half the sum of the two speeds it is a pure damper,
    so it never makes energy but lets a cage whirl. The thickness in the formulas is bounded
    (`most_eccentric`); neglects tilt, starvation, and that an opening film would cavitate.

    ``eccentricity``, ``velocity``: of the axis of this body from the other's, across it [m], [m/s]; ``axis``:
    unit axis; ``speed_sum``: sum of both angular speeds [rad/s]. Returns ``force``: on the body whose
    eccentricity is given [N]; ``ratio``: bounded eccentricity over clearance.

    References
    ----------
    Dubois, G. B. and Ocvirk, F. W. (1953), NACA Report 1157; whirl and squeeze as in Vance, J. M. (1988),
    Rotordynamics of Turbomachinery, ch. 6: with K = eta R L^3 / (2 C^2), e the ratio and
    w' = e (phi' - speed_sum / 2),
    F_r = -K [4 e |w'| / (1 - e^2)^2 + pi e' (1 + 2 e^2) / (1 - e^2)^2.5],
    F_t = -K [pi w' / (1 - e^2)^1.5 + 4 e e' s / (1 - e^2)^2]; the sign s of w' is smoothed here.
    """
    length = math.sqrt(dot(eccentricity, eccentricity))
    # any direction does for a centred cage: the film is the same damper in all of them
    outward = scale(1.0 / (length + _SMALLEST), eccentricity)
    if length < 1e-12:
        outward = cross(axis, (axis[1], -axis[0], 0.0))
        outward = scale(1.0 / math.sqrt(dot(outward, outward)), outward)
    ahead = cross(axis, outward)
    ratio = min(length / land.clearance, land.most_eccentric)
    opening = dot(velocity, outward) / land.clearance
    whirl = (dot(velocity, ahead) - 0.5 * speed_sum * length) / land.clearance
    sense = whirl / (math.sqrt(whirl * whirl + opening * opening) + _SMALLEST)
    flat = 1.0 - ratio * ratio
    root = math.sqrt(flat)
    squeezed = math.pi * opening * (1.0 + 2.0 * ratio * ratio) / (flat * flat * root)
    radial = -land.film * (4.0 * ratio * abs(whirl) / (flat * flat) + squeezed)
    around = -land.film * (math.pi * whirl / (flat * root) + 4.0 * ratio * opening * sense / (flat * flat))
    return add(scale(radial, outward), scale(around, ahead)), ratio


@inline
def land_twist(bodies, body, lift, land):
    """Work out the velocity of a cage against its guiding ring at the cage's origin, and angular velocity."""
    ring = int(land.body)
    cage_omega = full_rotation(bodies, body, ring_direction(bodies, body))
    ring_omega = full_rotation(bodies, ring, ring_direction(bodies, ring))
    place = subtract(body_vector(bodies, body, POSITION), body_vector(bodies, ring, POSITION))
    arm = (place[0], place[1] + lift, place[2])
    velocity = subtract(body_vector(bodies, body, LINEAR), body_vector(bodies, ring, LINEAR))
    return subtract(velocity, cross(ring_omega, arm)), subtract(cage_omega, ring_omega)


@inline
def land_contact(bodies, body, lift, land):
    """Work out the wrench of the guiding ring on one cage about the cage's origin.

    ``body``: of the cage; ``lift``: place of the cage at rest from the bearing centre along +y [m]. Returns
    ``force``, ``moment`` [N], [N m]; ``lost_force``, ``lost_moment``: without the elastic part; ``energy``:
    elastic energy of the edges [J].
    """
    ring = int(land.body)
    axis, ring_axis = ring_direction(bodies, body), ring_direction(bodies, ring)
    velocity, omega = land_twist(bodies, body, lift, land)
    side = 1.0 if lift > 0.0 else -1.0
    place = subtract(body_vector(bodies, body, POSITION), body_vector(bodies, ring, POSITION))
    origin = (place[0], place[1] + lift, place[2])  # of the cage from the ring's
    ring_spin = scale(bodies[ring, RATE], ring_axis)

    # the film acts half way between both axes, on both bodies alike
    along = side * land.place
    eccentricity = _across(add_scaled(origin, along, axis), ring_axis)
    # velocity of the cage's axis against the ring's axis: both spins taken out
    moving = add(velocity, cross(omega, scale(along, axis)))
    moving = _across(add(moving, cross(ring_spin, eccentricity)), ring_axis)
    speed_sum = bodies[body, RATE] + bodies[ring, RATE]
    film_force, ratio = short_bearing(eccentricity, moving, ring_axis, speed_sum, land)
    between = add_scaled(scale(along, axis), -0.5, eccentricity)
    drag = -land.drag * dot(omega, ring_axis) / math.sqrt(1.0 - ratio * ratio)
    lost_force = film_force
    lost_moment = add_scaled(cross(between, film_force), drag, ring_axis)
    force, moment, energy = lost_force, lost_moment, 0.0
    for end in range(2):
        edge = scale(along + (2.0 * end - 1.0) * land.half_width, axis)
        apart = _across(add(origin, edge), ring_axis)
        length = math.sqrt(dot(apart, apart))
        depth = length - land.clearance
        if depth > 0.0:
            normal = scale(1.0 / length, apart)
            arm = add_scaled(edge, land.outside * land.radius, normal)
            slip = add(velocity, cross(omega, arm))
            rate = dot(slip, normal)
            spring = land.stiffness * depth
            load = max(spring + land.damping * rate, 0.0)
            sliding = add_scaled(slip, -rate, normal)
            friction = land.friction * load / math.sqrt(dot(sliding, sliding) + land.regularisation**2)
            lost = add_scaled(scale(spring - load, normal), -friction, sliding)
            total = add_scaled(lost, -spring, normal)
            lost_force, lost_moment = add(lost_force, lost), add(lost_moment, cross(arm, lost))
            force, moment = add(force, total), add(moment, cross(arm, total))
            energy += 0.5 * spring * depth
    return force, moment, lost_force, lost_moment, energy


@inline
def _across(vector, axis):
    return add_scaled(vector, -dot(vector, axis), axis)


@inline
def _push(bodies, wrenches, body, cage, land):
    if body >= bodies.shape[0]:  # the cage of a row that is not there
        return _nothing()
    lift = cage.place if body > CAGE_BODY else -cage.place
    force, moment, lost_force, lost_moment, energy = land_contact(bodies, body, lift, land)
    ring = int(land.body)
    place = subtract(body_vector(bodies, body, POSITION), body_vector(bodies, ring, POSITION))
    about_ring = add(moment, cross((place[0], place[1] + lift, place[2]), force))
    for i in range(3):
        wrenches[body, i] += force[i]
        wrenches[body, 3 + i] += moment[i]
        wrenches[ring, i] -= force[i]
        wrenches[ring, 3 + i] -= about_ring[i]
    return lost_force, lost_moment, land_twist(bodies, body, lift, land), energy


@inline
def land_of(cage):
    """Take the land of a cage, ``None`` where there is none."""
    if cage is None:
        return None
    return cage.land


@inline
def push_lands(bodies, wrenches, cage, land):
    """Add the wrenches of both lands to cages and rings; without lands zeros, which nothing uses."""
    if land is None:
        return _nothing(), _nothing()
    return (
        _push(bodies, wrenches, CAGE_BODY, cage, land),
        _push(bodies, wrenches, CAGE_BODY + 1, cage, land),
    )


@inline
def _nothing():
    zero = (0.0, 0.0, 0.0)
    return zero, zero, (zero, zero), 0.0


@inline
def settle_lands(bodies, pushed, energy, step, cage, land):
    """Account for what the lands lost at the middle of the step, and return their elastic energy, [J]."""
    if land is None:
        return 0.0
    energy[ENERGY_LOST + LOSS_LAND] -= step * (
        _power(bodies, pushed[0], CAGE_BODY, cage, land)
        + _power(bodies, pushed[1], CAGE_BODY + 1, cage, land)
    )
    return pushed[0][3] + pushed[1][3]


@inline
def _power(bodies, pushed, body, cage, land):
    if body >= bodies.shape[0]:
        return 0.0
    lift = cage.place if body > CAGE_BODY else -cage.place
    force, moment, before, _energy = pushed
    after = land_twist(bodies, body, lift, land)
    return 0.5 * (dot(force, add(before[0], after[0])) + dot(moment, add(before[1], after[1])))
