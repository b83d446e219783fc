"""Parametric surfaces of revolution and lines, each with a moving frame and its derivatives.

A surface sweeps a plane meridian about an axis: a straight meridian makes cones and cylinders, an arc makes
spheres, tori and barrels. A line is a circle or a straight line. Point, tangent t, binormal b and normal n
are functions of the parameters; t and b span the tangent plane of a surface.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float

# layout of a shape as numbers, for the compiled search
KIND, FIRST, SECOND, SIDE, ORIGIN, EAST, NORTH, POLE = 0, 1, 2, 3, 4, 7, 10, 13
SHAPE_NUMBERS = 16
CONE, ARC, CIRCLE, FACE_CIRCLE, STRAIGHT = range(5)


def unit(vector: ArrayLike) -> Float:
    """Scale a vector to length one, shape [3]."""
    found = np.asarray(vector, dtype=np.float64)
    return found / math.sqrt(found @ found)


@dataclass(frozen=True)
class Placement:
    """Where a shape is: origin and three orthonormal axes, shape [3] each."""

    origin: A[Float, "[m]"]
    east: A[Float, "direction of the sweep angle 0 deg"]
    north: A[Float, "direction of the sweep angle 90 deg"]
    pole: A[Float, "axis of revolution, direction of a straight line"]


def place_along(origin: ArrayLike, pole: ArrayLike, east: ArrayLike = (1.0, 0.0, 0.0)) -> Placement:
    """Place along an axis; `east` is made square to it, or replaced when it is parallel."""
    axis = unit(pole)
    wanted = np.asarray(east, dtype=np.float64)
    across = wanted - (wanted @ axis) * axis
    if across @ across < 1e-8 * (wanted @ wanted):
        across = np.eye(3)[int(np.argmin(np.abs(axis)))]
        across = across - (across @ axis) * axis
    first = unit(across)
    return Placement(np.asarray(origin, dtype=np.float64), first, np.cross(axis, first), axis)


@dataclass(frozen=True)
class Frame:
    """A point of a shape with its vectors."""

    point: A[Float, "shape [3], [m]"]
    vectors: A[Float, "shape [3, 3], rows t, b, n"]
    point_slopes: A[Float, "shape [parameter, 3]"]
    vector_slopes: A[Float, "shape [parameter, 3, 3]"]


@dataclass(frozen=True)
class Shape(ABC):
    """A surface or a line in space."""

    place: Placement
    parameter_count: ClassVar[int] = 1  # 2 of a surface

    @abstractmethod
    def frame(self, parameters: Float) -> Frame:
        """Return the frame at ``parameters``: along meridian and sweep angle, or along a line."""

    @abstractmethod
    def _numbers(self) -> tuple[int, float, float, float]: ...

    @abstractmethod
    def nearest_parameters(self, point: Float) -> Float:
        """Return parameters near the point of the shape that is nearest to `point`."""

    def encode(self) -> Float:
        """Return the surface as numbers, shape [SHAPE_NUMBERS]."""
        place = self.place
        return np.concatenate([self._numbers(), place.origin, place.east, place.north, place.pole])

    def _directions(self, v: float) -> tuple[Float, Float]:
        """Return the radial and the circumferential direction at a sweep angle."""
        cosine, sine = math.cos(v), math.sin(v)
        here = self.place
        return cosine * here.east + sine * here.north, cosine * here.north - sine * here.east

    def _local(self, point: Float) -> tuple[float, float, float]:
        """Return distance from the axis, angle and height of a point."""
        arm = point - self.place.origin
        east, north = float(arm @ self.place.east), float(arm @ self.place.north)
        return math.hypot(east, north), math.atan2(north, east), float(arm @ self.place.pole)


class _Revolved(Shape):
    """What all surfaces of revolution share; a subclass describes the meridian."""

    parameter_count = 2

    @abstractmethod
    def _meridian(self, u: float) -> tuple[Float, Float, Float, Float, Float, Float]:
        """Compute place, tangent, normal, and their derivatives by u; components along radius and axis."""

    def frame(self, parameters: Float) -> Frame:
        u, v = float(parameters[0]), float(parameters[1])
        place, tangent, normal, place_slope, tangent_slope, normal_slope = self._meridian(u)
        out, around = self._directions(v)
        basis = np.array([out, self.place.pole])
        zero = np.zeros(3)
        return Frame(
            point=self.place.origin + place @ basis,
            vectors=np.array([tangent @ basis, around, normal @ basis]),
            point_slopes=np.array([place_slope @ basis, place[0] * around]),
            vector_slopes=np.array(
                [
                    [tangent_slope @ basis, zero, normal_slope @ basis],
                    [tangent[0] * around, -out, normal[0] * around],
                ]
            ),
        )


@dataclass(frozen=True)
class Cone(_Revolved):
    """Cone or cylinder without ends."""

    radius: A[float, "at the origin, [m]"]
    angle: A[float, "between generator and axis, + when it widens along the pole, [rad]"] = 0.0
    side: A[float, "+1: the body is inside, its normal points outwards; -1: the body is outside"] = 1.0

    def _meridian(self, u: float) -> tuple[Float, Float, Float, Float, Float, Float]:
        tangent = np.array([math.sin(self.angle), math.cos(self.angle)])
        normal = self.side * np.array([tangent[1], -tangent[0]])
        zero = np.zeros(2)
        return np.array([self.radius, 0.0]) + u * tangent, tangent, normal, tangent, zero, zero

    def _numbers(self) -> tuple[int, float, float, float]:
        return CONE, self.radius, self.angle, self.side

    def nearest_parameters(self, point: Float) -> Float:
        """Return the foot of the square on the generator at the azimuth of the point."""
        distance, angle, height = self._local(point)
        along = (distance - self.radius) * math.sin(self.angle) + height * math.cos(self.angle)
        return np.array([along, angle])


@dataclass(frozen=True)
class Arc(_Revolved):
    """Sphere, torus or barrel: an arc swept about the axis."""

    ring_radius: A[float, "of the arc's centre from the axis: 0 for a sphere, negative for a barrel, [m]"]
    radius: A[float, "of the arc, [m]"]
    side: A[float, "+1: the body is inside the arc; -1: it is outside"] = 1.0

    def _meridian(self, u: float) -> tuple[Float, Float, Float, Float, Float, Float]:
        outward, ahead = np.array([math.cos(u), math.sin(u)]), np.array([-math.sin(u), math.cos(u)])
        place = np.array([self.ring_radius, 0.0]) + self.radius * outward
        return place, ahead, self.side * outward, self.radius * ahead, -outward, self.side * ahead

    def _numbers(self) -> tuple[int, float, float, float]:
        return ARC, self.ring_radius, self.radius, self.side

    def nearest_parameters(self, point: Float) -> Float:
        """Return the direction of the point from the centre of the arc at its azimuth."""
        distance, angle, height = self._local(point)
        return np.array([math.atan2(height, distance - self.ring_radius), angle])


@dataclass(frozen=True)
class Circle(Shape):
    """Circle about the pole, its centre in the origin; its normal is radial and its binormal axial."""

    radius: A[float, "[m]"]

    def frame(self, parameters: Float) -> Frame:
        """Return the frame at a place along the line."""
        out, around = self._directions(float(parameters[0]))
        return Frame(
            point=self.place.origin + self.radius * out,
            vectors=np.array([around, self.place.pole, out]),
            point_slopes=np.array([self.radius * around]),
            vector_slopes=np.array([[-out, np.zeros(3), around]]),
        )

    def _numbers(self) -> tuple[int, float, float, float]:
        return CIRCLE, self.radius, 0.0, 1.0

    def nearest_parameters(self, point: Float) -> Float:
        """Return the azimuth of the point."""
        return np.array([self._local(point)[1]])


@dataclass(frozen=True)
class FaceCircle(Circle):
    """The same circle as the edge of a flat end: its normal is axial and its binormal radial."""

    side: A[float, "+1 when the end looks along the pole, else -1"] = 1.0

    def frame(self, parameters: Float) -> Frame:
        """Return the frame at a place along the line."""
        out, around = self._directions(float(parameters[0]))
        return Frame(
            point=self.place.origin + self.radius * out,
            vectors=np.array([around, out, self.side * self.place.pole]),
            point_slopes=np.array([self.radius * around]),
            vector_slopes=np.array([[-out, around, np.zeros(3)]]),
        )

    def _numbers(self) -> tuple[int, float, float, float]:
        return FACE_CIRCLE, self.radius, 0.0, self.side


@dataclass(frozen=True)
class Straight(Shape):
    """Straight line along the pole through the origin; its normal is `east`."""

    def frame(self, parameters: Float) -> Frame:
        """Return the frame at a place along the line."""
        here = self.place
        return Frame(
            point=here.origin + float(parameters[0]) * here.pole,
            vectors=np.array([here.pole, here.north, here.east]),
            point_slopes=np.array([here.pole]),
            vector_slopes=np.zeros((1, 3, 3)),
        )

    def _numbers(self) -> tuple[int, float, float, float]:
        return STRAIGHT, 0.0, 0.0, 1.0

    def nearest_parameters(self, point: Float) -> Float:
        """Return the foot of the square on the line."""
        return np.array([self._local(point)[2]])
