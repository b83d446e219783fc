"""Three-vectors of lane values as tuples: the kernels read like the formulas."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline

Vector = Any  # a tuple of three lane values


@inline
def dot(a: Vector, b: Vector) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inline
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@inline
def add(a: Vector, b: Vector) -> Vector:
    """Sum."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@inline
def subtract(a: Vector, b: Vector) -> Vector:
    """Difference."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@inline
def scale(factor: Any, a: Vector) -> Vector:
    """Vector times a number."""
    return (factor * a[0], factor * a[1], factor * a[2])


@inline
def add_scaled(a: Vector, factor: Any, b: Vector) -> Vector:
    """``a + factor * b``."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


@inline
def turn_in(a: Vector, cosine: Any, sine: Any) -> Vector:
    """Components of a ring-fixed vector in the orbit frame at an azimuth given by cosine and sine."""
    return (a[0] * cosine + a[1] * sine, a[1] * cosine - a[0] * sine, a[2])


@inline
def turn_out(a: Vector, cosine: Any, sine: Any) -> Vector:
    """Components of an orbit-frame vector in the ring frame; undoes `turn_in`."""
    return (a[0] * cosine - a[1] * sine, a[0] * sine + a[1] * cosine, a[2])
