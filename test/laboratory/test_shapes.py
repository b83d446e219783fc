"""Frames of the shapes: orthonormal, and with the derivatives that differences give."""

import math

import numpy as np
import pytest

from beardyn_core.laboratory.shapes import (
    Arc,
    Circle,
    Cone,
    FaceCircle,
    Placement,
    Shape,
    Straight,
    place_along,
)

PLACE = place_along((0.01, -0.02, 0.03), (0.3, -0.5, 0.8), (1.0, 0.2, 0.1))
SHAPES: tuple[Shape, ...] = (
    Cone(PLACE, 0.02),
    Cone(PLACE, 0.02, math.radians(12.0), -1.0),
    Arc(PLACE, 0.0, 0.05),
    Arc(PLACE, -0.067, 0.08),
    Arc(PLACE, 0.135, 0.0816, -1.0),
    Circle(PLACE, 0.013),
    FaceCircle(PLACE, 0.013, -1.0),
    Straight(PLACE),
)
AT = np.array([0.37, -1.1])


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
class TestFrame:
    def test_vectors_are_orthonormal(self, shape: Shape) -> None:
        table = shape.frame(AT).vectors
        np.testing.assert_allclose(table @ table.T, np.eye(3), atol=1e-14)

    def test_slopes_are_those_of_central_differences(self, shape: Shape) -> None:
        frame, step = shape.frame(AT), 1e-6
        for i in range(shape.parameter_count):
            away = np.zeros(2)
            away[i] = step
            ahead, behind = shape.frame(AT + away), shape.frame(AT - away)
            np.testing.assert_allclose(
                frame.point_slopes[i], (ahead.point - behind.point) / (2.0 * step), atol=1e-10
            )
            np.testing.assert_allclose(
                frame.vector_slopes[i], (ahead.vectors - behind.vectors) / (2.0 * step), atol=1e-9
            )

    def test_tangents_follow_the_point(self, shape: Shape) -> None:
        frame = shape.frame(AT)
        for slope, tangent in zip(frame.point_slopes, frame.vectors, strict=False):
            assert np.linalg.norm(np.cross(slope, tangent)) < 1e-15
            assert abs(slope @ frame.vectors[2]) < 1e-15

    def test_nearest_parameters_lead_to_the_nearest_point(self, shape: Shape) -> None:
        away = np.array([0.07, 0.05, -0.04])
        found = shape.nearest_parameters(away)
        nearest = np.linalg.norm(shape.frame(found).point - away)
        around = [
            np.linalg.norm(shape.frame(found + shift).point - away)
            for shift in 1e-4 * np.random.default_rng(1).normal(size=(40, found.size))
        ]
        # of a circle it is exact as well: its azimuth does not depend on the height of the point
        assert nearest <= min(around) + 1e-15


def test_a_pole_along_the_wanted_east_gets_another_east() -> None:
    place: Placement = place_along((0, 0, 0), (1, 0, 0), (1, 0, 0))
    axes = np.array([place.east, place.north, place.pole])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0)
