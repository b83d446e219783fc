"""Motion of the rollers in frames that turn with their orbit, and the rings seen from there."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import load_vector
from beardyn_core.kernels.lane_math import cos_sin, sqrt
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract, turn_in
from beardyn_core.model.layout import (
    ANGLE,
    AXIAL,
    AXIS,
    MOMENTUM,
    RADIUS,
    RING_AXIS,
    RING_OMEGA,
    RING_ORIGIN,
    RING_VELOCITY,
    SPIN,
    VELOCITY,
)


@inline
def angular_velocity(momentum: Any, axis: Any, roller: Any) -> Any:
    """Angular velocity of a body of revolution from its angular momentum, [rad/s]."""
    extra = dot(momentum, axis) * (1.0 / roller.axial_inertia - 1.0 / roller.transverse_inertia)
    return add_scaled(scale(1.0 / roller.transverse_inertia, momentum), extra, axis)


@inline
def drift(lanes: Any, rollers: Any, block: Any, reference_velocity: Any, step: Any, roller: Any) -> Any:
    """Move one block of rollers along its velocities and turn the orbit frames with it.

    Returns
    -------
    place : tuple of 3 lane values
        Radius [m], azimuth [rad], axial place [m].
    velocity, momentum : vector
        In the frame half way through the turn, where a steady orbit has no radial velocity.
    axis : vector
        In the frame at the end of the turn.
    half_turn : tuple of 2 lane values
        Cosine and sine of half the turn.
    orbit_rate : lane value
        Turn over the step, [rad/s].
    direction : tuple of 2 lane values
        Cosine and sine of the azimuth.
    """
    radius = lanes.load(rollers, block, RADIUS)
    azimuth = lanes.load(rollers, block, ANGLE)
    velocity = load_vector(lanes, rollers, block, VELOCITY)
    axis = load_vector(lanes, rollers, block, AXIS)
    momentum = load_vector(lanes, rollers, block, MOMENTUM)
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
    spin = lanes.load(rollers, block, SPIN) + step * spin_rate - turn * axis[2]
    lanes.store(rollers, block, SPIN, spin)
    turning = scale(step / roller.transverse_inertia, momentum)
    first = cross(turning, axis)
    axis = add(add(axis, first), scale(0.5, cross(turning, first)))
    axis = scale(1.0 / sqrt(dot(axis, axis)), axis)
    axis = turn_in(turn_in(axis, half_cosine, half_sine), half_cosine, half_sine)

    axial = lanes.load(rollers, block, AXIAL) + step * relative[2]
    place = (new_radius, azimuth + turn, axial)
    velocity = turn_in(velocity, half_cosine, half_sine)
    momentum = turn_in(momentum, half_cosine, half_sine)
    azimuth_cosine = cosine * half_cosine - sine * half_sine
    azimuth_sine = sine * half_cosine + cosine * half_sine
    cosine = azimuth_cosine * half_cosine - azimuth_sine * half_sine
    sine = azimuth_sine * half_cosine + azimuth_cosine * half_sine
    return place, velocity, momentum, axis, (half_cosine, half_sine), turn / step, (cosine, sine)


@inline
def ring_view(lanes: Any, rings: Any, ring: Any, cosine: Any, sine: Any) -> Any:
    """Origin, axis, velocity and angular velocity of a ring in the orbit frames."""
    return (
        turn_in(load_vector(lanes, rings, ring, RING_ORIGIN), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, RING_AXIS), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, RING_VELOCITY), cosine, sine),
        turn_in(load_vector(lanes, rings, ring, RING_OMEGA), cosine, sine),
    )


@inline
def entrainment_speed(
    line: Any, centre: Any, velocity: Any, omega: Any, ring_velocity: Any, ring_omega: Any, orbit_rate: Any
) -> Any:
    """Mean surface speed of roller and ring against their contact point, around the ring, [m/s]."""
    arm, around = line[0], line[3]
    point = add(centre, arm)
    ring_surface = dot(add(ring_velocity, cross(ring_omega, point)), around)
    roller_surface = dot(add(velocity, cross(omega, arm)), around)
    contact = dot(ring_velocity, around) + orbit_rate * point[0]
    return 0.5 * (ring_surface + roller_surface) - contact


@inline
def weight(cosine: Any, sine: Any, mass: Any, gravity: Any) -> Any:
    """Weight of a roller in its orbit frame, [N]."""
    if gravity is None:
        return 0.0 * cosine, 0.0 * cosine, 0.0 * cosine
    return -mass * gravity.acceleration * cosine, mass * gravity.acceleration * sine, 0.0 * cosine
