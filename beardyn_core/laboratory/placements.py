"""Placements to search in: simple shapes at random, rollers at random, and all rollers of a loaded row."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory import closed_forms
from beardyn_core.laboratory.nine_contacts import RollerPose, nominal_centre, nominal_pose, turn_pose
from beardyn_core.laboratory.search import LINES, SURFACE_LINE, SURFACES, Form, Pair
from beardyn_core.laboratory.shapes import Arc, Circle, Cone, Placement, Shape, Straight, place_along
from beardyn_core.physics.statics.static import solve

Random = np.random.Generator

_SHIFT, _TURN = 50e-6, 2e-3  # of a roller at random: +-, [m] and [rad]
_CONE_SHIFT = 30e-6


def _place(random: Random) -> Placement:
    """Draw any direction at the origin."""
    random.uniform(size=3)  # the same numbers as ever for the directions
    return place_along(np.zeros(3), random.normal(size=3), random.normal(size=3))


def _sphere(random: Random) -> Arc:
    return Arc(_place(random), 0.0, random.uniform(0.01, 0.03))


def _circle(random: Random) -> Circle:
    return Circle(_place(random), random.uniform(0.01, 0.03))


def _cylinder(random: Random) -> Cone:
    return Cone(_place(random), random.uniform(0.01, 0.03))


def _line(random: Random) -> Straight:
    return Straight(_place(random))


@dataclass(frozen=True)
class RandomCase:
    """A pair of simple shapes apart from each other."""

    name: str
    form: Form
    p: A[Callable[[Random], Shape], "draws a shape, which is then moved away from Q"]
    q: A[Callable[[Random], Shape], "draws a shape"]
    truth: A[Callable[..., float], "of both shapes, least distance, [m]"]

    def draw(self, random: Random) -> Pair:
        """Draw one placement: P any way round, 8 to 12 cm from the origin."""
        q = self.q(random)
        p, direction = self.p(random), random.normal(size=3)
        origin = random.uniform(0.08, 0.12) * direction / np.linalg.norm(direction)
        return Pair(replace(p, place=replace(p.place, origin=origin)), q, self.form)


def _circle_cylinder_gap(p: Circle, q: Cone) -> float:
    return closed_forms.least_along(p, partial(closed_forms.line_distance, q)) - q.radius


def _circle_sphere_gap(p: Circle, q: Arc) -> float:
    return closed_forms.circle_distance(p, q.place.origin) - q.radius


def _circles_gap(p: Circle, q: Circle) -> float:
    return closed_forms.least_along(p, partial(closed_forms.circle_distance, q))


RANDOM_CASES = (
    RandomCase("sphere, sphere", SURFACES, _sphere, _sphere, closed_forms.sphere_sphere_gap),
    RandomCase("sphere, cylinder", SURFACES, _sphere, _cylinder, closed_forms.sphere_cylinder_gap),
    RandomCase("cylinder, cylinder", SURFACES, _cylinder, _cylinder, closed_forms.cylinders_gap),
    RandomCase("circle, sphere", SURFACE_LINE, _circle, _sphere, _circle_sphere_gap),
    RandomCase("circle, cylinder", SURFACE_LINE, _circle, _cylinder, _circle_cylinder_gap),
    RandomCase("circle, circle", LINES, _circle, _circle, _circles_gap),
    RandomCase("line, line", LINES, _line, _line, closed_forms.lines_gap),
)


def near_start(pair: Pair) -> Float:
    """Return the parameters of P nearest to Q's origin, and of Q nearest to that point of P."""
    first = pair.p.nearest_parameters(pair.q.place.origin)
    return np.concatenate([first, pair.q.nearest_parameters(pair.p.frame(first).point)])


def random_start(pair: Pair, random: Random) -> Float:
    """Draw any angles, and lengths within 10 cm."""

    def of(shape: Shape) -> Float:
        angles = random.uniform(-math.pi, math.pi, shape.parameter_count)
        if isinstance(shape, (Cone, Straight)):
            angles[0] = random.uniform(-0.1, 0.1)
        return angles

    return np.concatenate([of(pair.p), of(pair.q)])


def random_rollers(bearing: Bearing, count: int, seed: int) -> Iterator[RollerPose]:
    """Shift and turn rollers at random about their place, and shift the cone."""
    random = np.random.default_rng(seed)
    nominal = nominal_pose(bearing)
    for _ in range(count):
        shifted = RollerPose(
            nominal.centre + random.uniform(-_SHIFT, _SHIFT, 3),
            nominal.axis,
            random.uniform(-_CONE_SHIFT, _CONE_SHIFT, 3),
        )
        tilt, skew = random.uniform(-_TURN, _TURN, 2)
        yield turn_pose(shifted, float(tilt), float(skew))


def loaded_row(bearing: Bearing, force: float, end_play: float) -> list[RollerPose]:
    """Place the rollers of the row at +y as at the first time step: static equilibrium.

    The load is radial on the cone [N]; end play in [m].
    """
    static = solve(bearing, (0.0, 0.0, force), end_play=end_play, laminae=6)
    nominal, poses = nominal_pose(bearing), []
    centre = nominal_centre(bearing)
    # with end play the cup is that much farther along the axle
    play = np.array([0.0, 0.0, 0.5 * end_play])
    for k in range(bearing.roller_count):
        azimuth = 2.0 * math.pi * k / bearing.roller_count
        sine, cosine = math.sin(azimuth), math.cos(azimuth)
        x, y, z = static.displacement
        pose = RollerPose(
            centre + np.array([static.roller_radial[1, k], 0.0, static.roller_axial[1, k]]) + play,
            nominal.axis,
            np.array([x * sine + z * cosine, x * cosine - z * sine, y]) + play,
        )
        poses.append(turn_pose(pose, float(static.roller_tilt[1, k]), 0.0))
    return poses
