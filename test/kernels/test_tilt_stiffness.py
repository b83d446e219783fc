"""What the lengths of the rollers hold of the tilt of cone against cup, beside a sum roller by roller."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.jit import entry
from beardyn_core.kernels.kinematic_rings import add_stiffness, store_stiffness
from beardyn_core.kernels.lanes import Lanes
from beardyn_core.kernels.spring_roller import add_tilt, tilt_stiffness
from beardyn_core.model.layout import SUM_FIELDS
from beardyn_core.model.parameters import DampingParams

Float = NDArray[np.float64]
GYRATION, TIME = 2.1e-4, 3e-6


class Spring(NamedTuple):
    """What `tilt_stiffness` reads of the springs."""

    gyration: float


class Params(NamedTuple):
    """What it reads of the parameters."""

    spring: Spring


@entry
def tilt_wrench(lanes, sums, rollers, direction, motion, damping, p, wrench):
    """Sum the stiffness of rollers [block, (tangent, cosine, sine), lane]; write what a tilt pushes by."""
    zero = lanes.constant(0.0)
    stiff = (zero, zero, zero, zero, zero, zero)
    for block in range(rollers.shape[0]):
        tangent = lanes.load(rollers, block, 0)
        stiff = add_stiffness(stiff, tangent, lanes.load(rollers, block, 1), lanes.load(rollers, block, 2))
    store_stiffness(lanes, sums[0], stiff)
    tilted = add_tilt((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), tilt_stiffness(sums, direction, p), motion, damping)
    for i in range(6):
        wrench[i] = tilted[i]


@pytest.mark.parametrize("damped", [False, True])
def test_each_roller_turns_the_cup_after_the_cone(lanes: Lanes, damped: bool) -> None:
    """In the meridian plane at its azimuth: the part of the tilt there, times stiffness and gyration."""
    if lanes.width == 1:
        pytest.skip("rows lie in halves of the lanes")
    random = np.random.default_rng(3)
    tangent, pocket = random.uniform(0.0, 1e9, (3, lanes.width)), random.uniform(0.0, 7.0, (3, lanes.width))
    turn, tilt, rate = 0.7, np.array([3e-4, -2e-4]), np.array([0.4, 0.1])
    sums, wrench = np.zeros((1, 1, SUM_FIELDS, lanes.width)), np.zeros(6)
    rollers = np.ascontiguousarray(np.stack([tangent, np.cos(pocket), np.sin(pocket)], axis=1))
    motion = ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (tilt[0], rate[0]), (tilt[1], rate[1]))
    damping = DampingParams(TIME) if damped else None
    direction = (np.cos(turn), np.sin(turn))
    tilt_wrench(lanes, sums, rollers, direction, motion, damping, Params(Spring(GYRATION)), wrench)
    azimuth = (pocket + turn).ravel()
    plane = np.stack([np.cos(azimuth), -np.sin(azimuth)])  # how far tilts about x and z tilt it
    moving = tilt + (TIME * rate if damped else 0.0)
    moment = GYRATION * (plane * tangent.ravel()) @ (plane.T @ moving)
    np.testing.assert_allclose(wrench, [1, 2, 3, 4 + moment[0], 5, 6 + moment[1]], rtol=1e-12)
