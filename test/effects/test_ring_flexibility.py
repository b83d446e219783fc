"""Bending of the cup: thin-ring formulas, what it does to the load zone, energy, and its absence."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.ring_bending import ThinRing, cup_ring, housing_ring, rectangular_ring
from beardyn_core.effects import EffectSet, RingFlexibility
from beardyn_core.integrate.static import solve
from beardyn_core.kernels.lanes import Lanes
from beardyn_core.kernels.ring_flexibility import bend_cup, bent_cup, kick_flex
from beardyn_core.model.flexibility_params import flexibility_params
from beardyn_core.model.layout import (
    CONTACT_OUTPUT,
    ENERGY_LOST,
    ENERGY_TERMS,
    LOSS_RING_BENDING,
    OUTPUT_FORCE,
    SIGNAL_FORCE,
    SUM_FIELDS,
)
from beardyn_core.model.parameters import FlexibilityParams
from test.kernels.rig import Float, Rig, constant_load, scene_with, standard_scene, started

FLEXIBLE = replace(EffectSet(), ring_flexibility=RingFlexibility())
STEPS = 512


def deflection(ring: ThinRing, loads: Float, angles: Float, at: Float, highest: int) -> Float:
    """Radial deflection under outward point loads, a sum over the modes."""
    total = np.zeros_like(at)
    for n in range(2, highest + 1):
        k = ring.modal_stiffness(n)
        a = float(loads @ np.cos(n * angles)) / k
        b = float(loads @ np.sin(n * angles)) / k
        total += a * np.cos(n * at) + b * np.sin(n * at)
    return total


def test_two_opposite_loads_open_a_ring_as_in_the_tables() -> None:
    """Roark's formulas for stress and strain, circular rings, case 1: 0.1488 and 0.1366 W R^3 / EI."""
    ring = ThinRing(radius=0.12, rigidity=2.3e3, mass=8.0)
    pair = np.array([0.0, math.pi])
    unit = 1e4 * ring.radius**3 / ring.rigidity
    opened = deflection(ring, np.array([1e4, 1e4]), pair, np.array([0.0, 0.5 * math.pi]), 60)
    assert 2.0 * opened[0] / unit == pytest.approx(0.1488, abs=1e-4)
    assert 2.0 * opened[1] / unit == pytest.approx(-0.1366, abs=1e-4)
    # up to four waves it is 0.8 % short of that
    short = deflection(ring, np.array([1e4, 1e4]), pair, np.array([0.0]), 4)
    assert 2.0 * short[0] / unit == pytest.approx(0.1488, rel=0.015)


@pytest.mark.parametrize("waves", [2, 3, 4])
def test_frequency_of_a_free_ring(waves: int) -> None:
    """Rayleigh (1894), art. 233: w^2 = EI / (m R^4) n^2 (n^2 - 1)^2 / (n^2 + 1), m per length."""
    ring = rectangular_ring(0.1, 0.01, 0.16, 206e9, 8.0)
    per_length = ring.mass / (2.0 * math.pi * ring.radius)
    expected = ring.rigidity / (per_length * ring.radius**4)
    expected *= waves**2 * (waves**2 - 1) ** 2 / (waves**2 + 1)
    assert ring.modal_stiffness(waves) / ring.modal_mass(waves) == pytest.approx(expected, rel=1e-12)


def test_mass_of_the_cup_ring_is_that_of_its_section() -> None:
    """The wall taken at mid-length and the width give the stated mass of the cup within 10 %."""
    bearing = standard_scene().bearing
    ring = cup_ring(bearing)
    wall = 2.0 * (0.5 * bearing.outer_diameter - ring.radius)
    section = wall * bearing.width * bearing.material.density * 2.0 * math.pi * ring.radius
    assert section == pytest.approx(bearing.cup_mass, rel=0.1)
    housing = housing_ring(bearing, 0.025, 170e9, 7100.0)
    assert housing.mass == pytest.approx(7100.0 * 0.16 * math.pi * (0.14**2 - 0.115**2), rel=1e-12)


def kernel_inputs(width: int) -> tuple[Lanes, Float, Float]:
    rng = np.random.default_rng(5)
    return Lanes(width), rng.normal(0.0, 1e-5, (3, 2, 2)), rng.uniform(-np.pi, np.pi, width)


def test_bent_raceway_is_the_sum_over_the_modes() -> None:
    """Kernel in plain Python against the series with cosines of its own; v keeps the length of the ring."""
    lanes, flex, angle = kernel_inputs(8)
    zero = np.zeros(8)
    view = tuple((zero, zero, zero) for _ in range(4))
    params = flexibility_params(standard_scene().bearing, FLEXIBLE)
    (origin, _, velocity, _), shift = bent_cup.py_func(
        lanes, flex, view, np.cos(angle), np.sin(angle), params
    ) if hasattr(bent_cup, "py_func") else bent_cup(lanes, flex, view, np.cos(angle), np.sin(angle), params)
    n = np.arange(2, 5)[:, None]
    cosine, sine = np.cos(n * angle), np.sin(n * angle)
    a, b = flex[:, 0, :, None], flex[:, 1, :, None]
    place, speed = 0, 1
    np.testing.assert_allclose(origin[0], (a[:, place] * cosine + b[:, place] * sine).sum(axis=0), atol=1e-18)
    slope = (n * (b[:, place] * cosine - a[:, place] * sine)).sum(axis=0)
    np.testing.assert_allclose(origin[1], slope, atol=1e-18)
    np.testing.assert_allclose(velocity[0], (a[:, speed] * cosine + b[:, speed] * sine).sum(axis=0), atol=1e-18)
    around = ((b[:, speed] * cosine - a[:, speed] * sine) / n).sum(axis=0)
    np.testing.assert_allclose(velocity[1], around, atol=1e-18)
    assert shift[0] is origin[0] or np.array_equal(shift[0], origin[0])
