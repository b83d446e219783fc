"""Coupled laminae: the kernel's passes against a minimiser, the half-space and its own energy."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.bearing.lamina_coupling import coupled_law, rectangle_influence
from beardyn_core.effects import EffectSet, LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.bodies.layout import LAMINA_STIFFNESS
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive_coupling
from test.kernels.casting import through
from test.kernels.entries import couplings
from test.kernels.rig import parameters_of
from test.scenes import scene_with, standard_scene

Float = NDArray[np.float64]
COUPLED = LaminaCoupling()
LENGTH = standard_scene().bearing.effective_length
# of the largest lamina load, by lamina count; see `couple_laminae`
ACCURACY = {6: 1.0e-3, 20: 6.0e-3, 40: 1.2e-2}
# error of a load as a gradient, over the largest load: of 95 % of the laminae, and of one just coming free
GRADIENT = {6: (1.0e-3, 3.0e-3), 20: (2.0e-3, 2.0e-2)}


@cache
def parameters(laminae: int, width: int, coupling: LaminaCoupling = COUPLED) -> Parameters:
    scene = scene_with(replace(EffectSet(), lamina_coupling=coupling), laminae=laminae)
    return parameters_of(scene, width)


def root(laminae: int, coupling: LaminaCoupling = COUPLED) -> Float:
    return bearing_lamina_root(standard_scene().bearing, coupling, laminae).root


def factor(laminae: int) -> float:
    return float(parameters(laminae, 8).laminae[LAMINA_STIFFNESS, 0])


def places(laminae: int) -> Float:
    return ((np.arange(laminae) + 0.5) / laminae - 0.5) * LENGTH


def lines(laminae: int) -> dict[str, Float]:
    """Penetrations of a line: pressed all along, over a part, profiled, over a hole."""
    x = places(laminae)
    logarithm = -1.04e-6 * np.log1p(-np.minimum((2 * x / LENGTH) ** 2, 1 - 1e-6))
    return {
        "uniform": np.full(laminae, 6.7e-6),
        "tilted": 6.7e-6 + 1.5e-4 * x,
        "half": 4e-4 * x,
        "edge": -6e-6 + 4e-4 * x,
        "crowned": 2e-6 - 2e-5 * (2 * x / LENGTH) ** 2,
        "profiled": 6e-6 - logarithm,
        "lightly profiled": 1e-6 - logarithm + 1e-5 * x,
        "hole": np.where(np.abs(x) < 0.01, -1e-5, 6e-6),
        "hole beside": np.where(np.abs(x - 0.01) < 5e-3, -1e-5, 6e-6),
        "apart": np.full(laminae, -1e-6),
    }


def kernel(lanes: Any, depths: Float, coupling: LaminaCoupling = COUPLED) -> tuple[Float, Float]:
    """Loads [case, lamina] and energy [case]."""
    count = depths.shape[1]
    p = parameters(count, lanes.width, coupling)
    found = through(lanes, couplings, depths, 2 * count, p.laminae, p.effects.coupling)
    return found[:, :count], found[:, count:].sum(axis=1)


def random_lines(laminae: int, count: int = 60) -> Float:
    rng = np.random.default_rng(3)
    x = places(laminae)
    crown = (2 * x / LENGTH) ** 2
    return np.array(
        [
            rng.uniform(-4e-6, 6e-6) + rng.uniform(-4e-4, 4e-4) * x - rng.uniform(0, 2e-5) * crown
            for _ in range(count)
        ]
    )


@pytest.mark.parametrize("laminae", [6, 20, 40])
def test_loads_are_those_of_the_least_energy(lanes: Any, laminae: int) -> None:
    cases = lines(laminae)
    loads, energies = kernel(lanes, np.array(list(cases.values())))
    for name, load, energy in zip(cases, loads, energies, strict=True):
        expected, least = naive_coupling.by_minimiser(cases[name], factor(laminae), root(laminae))
        assert np.max(np.abs(load - expected)) <= ACCURACY[laminae] * expected.max(), name
        assert abs(load.sum() - expected.sum()) <= ACCURACY[laminae] * expected.sum(), name
        assert least * (1 - 1e-9) <= energy <= least * (1 + 1e-3), name


@pytest.mark.parametrize("laminae", [6, 20])
def test_pressed_all_along_the_loads_are_exact(lanes: Any, laminae: int) -> None:
    depths = np.array([lines(laminae)[name] for name in ("uniform", "tilted", "profiled")])
    loads, energies = kernel(lanes, depths)
    expected, _, energy = coupled_law(
        depths, factor(laminae), bearing_lamina_root(standard_scene().bearing, LaminaCoupling(), laminae)
    )
    np.testing.assert_allclose(loads, expected, rtol=1e-10)
    np.testing.assert_allclose(energies, energy, rtol=1e-10)


@pytest.mark.parametrize("laminae", [6, 20])
def test_load_is_the_gradient_of_the_energy(lanes: Any, laminae: int) -> None:
    depths = random_lines(laminae)
    loads, _ = kernel(lanes, depths)
    touching = loads.max(axis=1) > 0.0
    step = 1e-10
    error = np.zeros_like(loads)
    for k in range(laminae):
        shift = step * np.eye(laminae)[k]
        slope = (kernel(lanes, depths + shift)[1] - kernel(lanes, depths - shift)[1]) / (2 * step)
        error[:, k] = np.abs(slope - loads[:, k])
    share = error[touching] / loads[touching].max(axis=1, keepdims=True)
    usual, worst = GRADIENT[laminae]
    assert np.quantile(share, 0.95) < usual
    assert share.max() < worst


def test_no_lamina_pulls_and_loads_change_continuously_as_laminae_come_free(lanes: Any) -> None:
    """A line that is lifted by 0.1 nm a case: no load changes by more than twice its mean tangent allows."""
    x = places(20)
    lift = np.arange(0.0, 2e-7, 1e-10)
    depths = 4e-4 * x + 1e-6 - lift[:, None]
    loads, _ = kernel(lanes, depths)
    assert loads.min() >= 0.0
    stiffest = 10.0 / 9.0 * factor(20) * 1e-5 ** (1.0 / 9.0) * 2.0
    assert np.abs(np.diff(loads, axis=0)).max() < stiffest * 1e-10


def test_without_strength_laminae_are_independent(lanes: Any) -> None:
    """Palmgren lamina by lamina to 1e-12, the accuracy of the ninth root twice over."""
    depths = random_lines(20)
    loads, energies = kernel(lanes, depths, LaminaCoupling(strength=0.0))
    expected = factor(20) * np.maximum(depths, 0.0) ** (10.0 / 9.0)
    np.testing.assert_allclose(loads, expected, rtol=5e-12, atol=1e-12)
    energy = 9.0 / 19.0 * np.sum(expected * np.maximum(depths, 0.0), axis=1)
    np.testing.assert_allclose(energies, energy, rtol=5e-12, atol=1e-20)


def test_influence_of_a_rectangle_is_boussinesq_integrated_over_it() -> None:
    modulus, length, half_width = 226.4e9, 2.5e-3, 2.4e-4
    distances = np.array([1.0, 2.0, 5.0, 19.0]) * length
    found = rectangle_influence(distances, length, half_width, modulus)
    expected = [
        naive_coupling.influence_by_quadrature(float(d), length, half_width, modulus) for d in distances
    ]
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    # in the middle of its own patch: four right-angled corners, Love (1929)
    own = rectangle_influence(np.zeros(1), length, half_width, modulus)[0]
    a, b = half_width, 0.5 * length
    corners = 4 * (a * np.arcsinh(b / a) + b * np.arcsinh(a / b))
    assert own == pytest.approx(corners / (np.pi * 0.5 * modulus * 4 * a * b), rel=1e-12)


@pytest.mark.parametrize(
    ("name", "share", "total"),
    [("uniform", 0.02, 2e-3), ("tilted", 0.02, 5e-3), ("half", 0.03, 0.02), ("edge", 0.07, 0.06),
     ("profiled", 0.025, 0.015), ("hole", 0.04, 0.02)],
)  # fmt: skip
@pytest.mark.parametrize("laminae", [6, 20])
def test_loads_are_near_those_of_laminae_on_a_half_space(
    laminae: int, name: str, share: float, total: float
) -> None:
    """delta_k = a F_k^0.9 + sum of C_kj F_j: its linear part is that at 10 kN, ours goes with the load.

    Independent laminae are 11 to 27 % off in the total of the lines that touch over a part.
    """
    bearing = standard_scene().bearing
    pitch = LENGTH / laminae
    modulus = bearing.material.contact_modulus
    half_width = bearing.roller_diameter * 1e9 / (0.5 * modulus)
    row = rectangle_influence(pitch * np.arange(laminae, dtype=np.float64), pitch, half_width, modulus)
    index = np.arange(laminae)
    influence = row[np.abs(index[:, None] - index)]
    line = lines(laminae)[name]
    approach = (1e4 / (laminae * factor(laminae))) ** 0.9
    expected = naive_coupling.on_half_space(line, influence, 1e4, approach)
    matrices = bearing_lamina_root(bearing, LaminaCoupling(), laminae)
    found, _, _ = coupled_law(line, factor(laminae), matrices)
    assert np.max(np.abs(found - expected)) < share * expected.max()
    assert found.sum() == pytest.approx(expected.sum(), rel=total)
    if name in ("half", "edge", "hole"):
        independent = factor(laminae) * np.maximum(line, 0.0) ** (10.0 / 9.0)
        assert independent.sum() < 0.9 * expected.sum()
