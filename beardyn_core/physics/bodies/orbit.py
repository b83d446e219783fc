"""Motion of the rollers in frames that turn with their orbit, and the rings seen from there."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import load_vector
from beardyn_core.physics.lanes.lane_math import cos_sin, sqrt
from beardyn_core.physics.lanes.vectors import Vector, add, add_scaled, cross, dot, scale, subtract, turn_in


class Orbit(NamedTuple):
    """A block of rollers after its drift; vectors but the axis in the frame half way through the turn."""

    radius: Any  # radial place of the centre of mass [m]
    azimuth: Any  # [rad]
    axial: Any  # [m]
    velocity: Vector  # [m/s]
    momentum: Vector  # angular, about the centre of mass [N m s]
    axis: Vector  # in the frame at the end of the turn
    half_cosine: Any  # of half the turn
    half_sine: Any
    rate: Any  # turn over the step [rad/s]
    cosine: Any  # of the azimuth
    sine: Any


class Body(NamedTuple):
    """A roller as its contacts see it, in its orbit frame."""

    place: Vector  # of the centre of mass from the cup's origin [m]
    axis: Vector
    velocity: Vector  # of the centre of mass [m/s]
    omega: Vector  # [rad/s]
    orbit_rate: Any  # [rad/s]


class View(NamedTuple):
    """A ring or cage in the orbit frame of a roller."""

    origin: Vector  # from the cup's origin [m]
    axis: Vector  # a cage shows its small rotation without the spin here, [rad]
    velocity: Vector  # of the origin [m/s]
    omega: Vector  # [rad/s]


@inline
def angular_velocity(momentum, axis, roller):
    """Work out the angular velocity of a body of revolution from its angular momentum, [rad/s]."""
    extra = dot(momentum, axis) * (1.0 / roller.axial_inertia - 1.0 / roller.transverse_inertia)
    return add_scaled(scale(1.0 / roller.transverse_inertia, momentum), extra, axis)


@inline
def drift(lanes, rollers, block, reference_velocity, step, roller):
    """Move one block of rollers along its velocities and turn the orbit frames with it.

    ``rollers`` [block, ROLLER_FIELDS, lane]: read; the rotation about the own axis is written;
    ``reference_velocity``: of the cup's origin, in its ring frame [m/s]. Velocity and momentum of the `Orbit`
    stand in the frame half way through the turn, where a steady orbit has no radial velocity.
    """
    radius = lanes.load(rollers, block, layout.RADIUS)
    azimuth = lanes.load(rollers, block, layout.ANGLE)
    velocity = load_vector(lanes, rollers, block, layout.VELOCITY)
    axis = load_vector(lanes, rollers, block, layout.AXIS)
    momentum = load_vector(lanes, rollers, block, layout.MOMENTUM)
    cosine, sine = cos_sin(azimuth)
    relative = subtract(velocity, turn_in(reference_velocity, cosine, sine))
    outward = radius + step * relative[0]
    ahead = step * relative[1]
    new_radius = sqrt(outward * outward + ahead * ahead)
    tangent = ahead / outward
    tangent2 = tangent * tangent
    turn = tangent * (1.0 - tangent2 * (1.0 / 3.0 - tangent2 * (1.0 / 5.0)))
    half = 0.5 * turn
    half2 = half * half
    half_cosine = 1.0 - half2 * (0.5 - half2 * (1.0 / 24.0))
    half_sine = half * (1.0 - half2 * (1.0 / 6.0 - half2 * (1.0 / 120.0)))

    spin_rate = dot(momentum, axis) / roller.axial_inertia
    spin = lanes.load(rollers, block, layout.SPIN) + step * spin_rate - turn * axis[2]
    lanes.store(rollers, block, layout.SPIN, spin)
    turning = scale(step / roller.transverse_inertia, momentum)
    first = cross(turning, axis)
    axis = add(add(axis, first), scale(0.5, cross(turning, first)))
    axis = scale(1.0 / sqrt(dot(axis, axis)), axis)
    axis = turn_in(turn_in(axis, half_cosine, half_sine), half_cosine, half_sine)

    axial = lanes.load(rollers, block, layout.AXIAL) + step * relative[2]
    # the order of the sums decides which products are fused: another one has other last bits
    new_azimuth = azimuth + turn
    velocity = turn_in(velocity, half_cosine, half_sine)
    momentum = turn_in(momentum, half_cosine, half_sine)
    azimuth_cosine = cosine * half_cosine - sine * half_sine
    azimuth_sine = sine * half_cosine + cosine * half_sine
    cosine = azimuth_cosine * half_cosine - azimuth_sine * half_sine
    sine = azimuth_sine * half_cosine + azimuth_cosine * half_sine
    return Orbit(
        new_radius, new_azimuth, axial, velocity, momentum, axis, half_cosine, half_sine, turn / step,
        cosine, sine,
    )  # fmt: skip


@inline
def ring_view(lanes, rings, ring, cosine, sine):
    """Turn a ring into the orbit frames of a block of rollers: a `View`."""
    return View(
        turn_in(load_vector(lanes, rings, ring, layout.RING_ORIGIN), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, layout.RING_AXIS), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, layout.RING_VELOCITY), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, layout.RING_OMEGA), cosine, sine),
    )


@inline
def entrainment_speed(line, centre, body, view):
    """Work out the mean surface speed of roller and ring against their contact point, [m/s].

    Around the ring, at mid-length; the contact point orbits with the roller.
    """
    arm, around = line.arm, line.around
    point = add(centre, arm)
    ring_surface = dot(add(view.velocity, cross(view.omega, point)), around)
    roller_surface = dot(add(body.velocity, cross(body.omega, arm)), around)
    contact = dot(view.velocity, around) + body.orbit_rate * point[0]
    return 0.5 * (ring_surface + roller_surface) - contact


@inline
def rotate_weight(cosine, sine, mass, gravity):
    """Turn the weight of a roller into its orbit frame, [N]."""
    if gravity is None:
        return 0.0 * cosine, 0.0 * cosine, 0.0 * cosine
    return -mass * gravity.acceleration * cosine, mass * gravity.acceleration * sine, 0.0 * cosine
