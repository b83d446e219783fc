"""The 6x6 system of a roller against dense linear algebra."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from beardyn_core.physics.lanes.lanes import Lanes
from test.kernels.casting import through
from test.kernels.entries import contact_matrices, solves

LOWER = np.tril_indices(6)
Float = NDArray[np.float64]


def roller_like_matrix(rng: np.random.Generator) -> Float:
    """Mass and inertia of a roller with contacts up to a million times stiffer than its inertia."""
    matrix = np.diag([0.23, 0.23, 0.23, 6.1e-5, 6.1e-5, 2.0e-5])
    for _ in range(6):
        direction = rng.normal(size=3)
        arm = rng.normal(size=3) * 0.015
        row = np.concatenate([direction, np.cross(arm, direction)])
        matrix += 10.0 ** rng.uniform(-6.0, 2.0) * np.outer(row, row)
    return matrix


def solution(matrices: Float, right: Float, lanes: Any) -> Float:
    systems = np.concatenate([matrices[:, LOWER[0], LOWER[1]], right], axis=1)
    return through(lanes, solves, systems, 6)


def test_solution_is_that_of_dense_elimination(lanes: Any) -> None:
    """Both lose the condition number times 2e-16."""
    rng = np.random.default_rng(1)
    matrices = np.array([roller_like_matrix(rng) for _ in range(400)])
    right = rng.normal(size=(400, 6))
    exact = np.linalg.solve(matrices, right[..., None])[..., 0]
    limit = 30.0 * np.finfo(float).eps * np.linalg.cond(matrices) * np.linalg.norm(exact, axis=1)
    assert np.all(np.linalg.norm(solution(matrices, right, lanes) - exact, axis=1) <= limit)


@given(seed=st.integers(0, 2**32 - 1), scale=st.floats(1e-6, 1e6))
@settings(max_examples=50, deadline=None)
def test_solution_satisfies_its_equations(seed: int, scale: float) -> None:
    """Backward stable: the residual is rounding of |A| |x|."""
    rng = np.random.default_rng(seed)
    matrix = roller_like_matrix(rng) * scale
    right = rng.normal(size=6)
    x = solution(matrix[None], right[None], Lanes(8))[0]
    residual = np.abs(matrix @ x - right)
    assert np.all(residual <= 1e-12 * (np.abs(matrix) @ np.abs(x) + np.abs(right)).max())


def outer_products(directions: Any, arm: Float, slope: Float, places: Any, weights: Any) -> Float:
    """Sum over contacts and directions of the resistance of each."""
    matrix = np.zeros((6, 6))
    for x, weight in zip(places, weights, strict=True):
        for direction in directions:
            row = np.concatenate([direction, np.cross(arm + x * slope, direction)])
            matrix += weight * np.outer(row, row)
    return matrix


def test_contact_matrices_are_sums_of_outer_products_over_laminae(lanes: Any) -> None:
    rng = np.random.default_rng(2)
    places = np.linspace(-0.025, 0.025, 7)
    cases, lines, points, all_lines, all_points = [], [], [], [], []
    for _ in range(50):
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        arm, slope = rng.normal(size=3) * 0.013, rng.normal(size=3)
        resistance = rng.uniform(0.0, 10.0, len(places))
        weights = [float(np.sum(resistance * places**power)) for power in range(3)]
        cases.append(np.concatenate([direction, arm, slope, weights]))
        lines.append(outer_products([direction], arm, slope, places, resistance)[LOWER])
        all_lines.append(outer_products(np.eye(3), arm, slope, places, resistance)[LOWER])
        points.append(outer_products([direction], arm, slope, [0.0], weights[:1])[LOWER])
        all_points.append(outer_products(np.eye(3), arm, slope, [0.0], weights[:1])[LOWER])
    found = through(lanes, contact_matrices, np.array(cases), 84)
    for index, expected in enumerate((lines, points, all_lines, all_points)):
        part = found[:, 21 * index : 21 * index + 21]
        np.testing.assert_allclose(part, expected, rtol=1e-10, atol=1e-12)
