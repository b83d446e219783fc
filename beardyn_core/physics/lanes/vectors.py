"""Three-vectors of lane values as tuples: the kernels read like the formulas."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.lane_math import where_greater

Vector = Any  # a tuple of three lane values


class Wrench(NamedTuple):
    """Force and moment about a point."""

    force: Vector  # [N]
    moment: Vector  # [N m]


class Twist(NamedTuple):
    """Velocity of a point of a body, and the body's angular velocity."""

    velocity: Vector  # [m/s]
    omega: Vector  # [rad/s]


@inline
def dot(a, b):
    """Multiply two vectors to their scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inline
def cross(a, b):
    """Multiply two vectors to their vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@inline
def add(a, b):
    """Add two vectors."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@inline
def subtract(a, b):
    """Subtract vector ``b`` from vector ``a``."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@inline
def scale(factor, a):
    """Multiply a vector by a number."""
    return (factor * a[0], factor * a[1], factor * a[2])


@inline
def add_scaled(a, factor, b):
    """Add a multiple of vector ``b`` to vector ``a``."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


@inline
def turn_in(a, cosine, sine):
    """Turn a ring-fixed vector into the orbit frame at an azimuth given by cosine and sine."""
    return (a[0] * cosine + a[1] * sine, a[1] * cosine - a[0] * sine, a[2])


@inline
def turn_out(a, cosine, sine):
    """Turn an orbit-frame vector back into the ring frame; undoes `turn_in`."""
    return (a[0] * cosine - a[1] * sine, a[0] * sine + a[1] * cosine, a[2])


@inline
def choose_vector(a, b, first, second):
    """Take vector ``first`` in the lanes where ``a > b``, else ``second``."""
    return (
        where_greater(a, b, first[0], second[0]),
        where_greater(a, b, first[1], second[1]),
        where_greater(a, b, first[2], second[2]),
    )


@inline
def add_wrenches(a, b):
    """Add two wrenches about the same point."""
    return Wrench(add(a.force, b.force), add(a.moment, b.moment))
