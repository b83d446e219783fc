"""What the lengths of the rollers hold of the tilt of cone against cup, beside brute force."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.contact_output import store_vector
from beardyn_core.physics.bodies.layout import SUM_FIELDS
from beardyn_core.physics.contact_damping import DampingParams
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.massless_roller import (
    _LENGTH_CC,
    _in_cages_frame,
    add_length,
    add_tilt,
    tilt_stiffness,
)

Float = NDArray[np.float64]
REACH, TIME, FOUNDATION = 0.024, 3e-6, 1.3e11


@entry
def tilt_wrench(lanes, sums, rollers, direction, motion, damping, reach, wrench):
    """Write what a tilt pushes the cup by; ``rollers`` [block, (load, approach, cosine, sine), lane]."""
    zero = lanes.constant(0.0)
    lengths = (zero, zero, zero)
    tilt = _in_cages_frame(motion[3][0], motion[4][0], direction)
    for block in range(rollers.shape[0]):
        load, approach = lanes.load(rollers, block, 0), lanes.load(rollers, block, 1)
        cosine, sine = lanes.load(rollers, block, 2), lanes.load(rollers, block, 3)
        tilted = tilt[0] * cosine + tilt[1] * sine
        lengths = add_length(lengths, load, approach, tilted, cosine, sine, reach)
    store_vector(lanes, sums[0], 0, _LENGTH_CC, lengths)
    tilted = add_tilt((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), tilt_stiffness(sums, direction), motion, damping)
    for i in range(6):
        wrench[i] = tilted[i]


def naive_moment(load: float, tilt: float) -> float:
    """Moment of a row of springs of a 10/9 law whose rings tilt by half of it against the roller each."""
    place = np.linspace(-REACH, REACH, 20_001)
    width = place[1] - place[0]

    def pressure(depth: float) -> Float:
        return FOUNDATION * np.maximum(depth + 0.5 * tilt * place, 0.0) ** (10.0 / 9.0)

    depth = brentq(lambda depth: pressure(depth).sum() * width - load, -abs(tilt) * REACH, 1e-3, xtol=1e-18)
    return float((pressure(depth) * place).sum() * width)


@pytest.mark.parametrize("size", [2e-5, 3e-3], ids=["along the whole length", "ends lifted off"])
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("width", [4, 8])
def test_each_roller_turns_the_cup_after_the_cone(width: int, damped: bool, size: float) -> None:
    """In the meridian plane at its azimuth, by the moment of its row of springs."""
    lanes = Lanes(width)
    random = np.random.default_rng(3)
    load, pocket = random.uniform(1e3, 1e4, (3, width)), random.uniform(0.0, 7.0, (3, width))
    turn, tilt, rate = 0.7, size * np.array([1.0, -0.6]), np.array([0.4, 0.1])
    approach = 2.0 * (load / (2.0 * REACH * FOUNDATION)) ** 0.9  # of both contacts
    sums, wrench = np.zeros((1, 1, SUM_FIELDS, width)), np.zeros(6)
    rollers = np.ascontiguousarray(np.stack([load, approach, np.cos(pocket), np.sin(pocket)], axis=1))
    motion = ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (tilt[0], rate[0]), (tilt[1], rate[1]))
    damping = DampingParams(TIME) if damped else None
    tilt_wrench(lanes, sums, rollers, (np.cos(turn), np.sin(turn)), motion, damping, REACH, wrench)
    moment = np.zeros(2)
    for force, azimuth in zip(load.ravel(), (pocket + turn).ravel(), strict=True):
        plane = np.array([np.cos(azimuth), -np.sin(azimuth)])  # how far tilts about x and z tilt it
        turned = float(plane @ tilt)
        secant = naive_moment(force, turned) / turned
        moment += secant * plane * (plane @ (tilt + (TIME * rate if damped else 0.0)))
    added = wrench - [1, 2, 3, 4, 5, 6]
    np.testing.assert_allclose(added[[0, 1, 2, 4]], 0.0, atol=1e-12)
    assert np.linalg.norm(added[[3, 5]] - moment) < 0.02 * np.linalg.norm(moment)
