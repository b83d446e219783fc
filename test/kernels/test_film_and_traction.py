"""Film thickness and friction of a lamina against the plain formulas."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.effects import LineFilm
from beardyn_core.physics.dry_friction import CoulombParams
from beardyn_core.physics.film_traction import ShearedFilmParams
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.scene.scene import Scene
from test.kernels import naive
from test.kernels.casting import through
from test.kernels.entries import frictions
from test.kernels.naive_traction import SIDES, equivalent_radius, lamina_friction
from test.kernels.rig import parameters_of
from test.kernels.states import only
from test.scenes import standard_scene

LANES8 = Lanes(8)
CASES = np.random.default_rng(1)
LOAD = 10.0 ** CASES.uniform(-2.0, 4.3, 200)
SLIP = 10.0 ** CASES.uniform(-6.0, 1.3, 200)
ENTRAINMENT = 10.0 ** CASES.uniform(-2.0, 1.3, 200)


def flooded_scene() -> Scene:
    """The standard scene with enough oil: with little `test_traction_laws` compares the film."""
    scene = standard_scene()
    return replace(scene, effects=replace(scene.effects, film=LineFilm(supply="flooded")))


@cache
def parameters(sheared: bool = False) -> Parameters:
    p = parameters_of(flooded_scene())
    assert p.effects.mixed is not None
    if not sheared:
        return p
    return p._replace(
        effects=p.effects._replace(mixed=p.effects.mixed._replace(sheared_film=ShearedFilmParams(0.045)))
    )


def results(p: Parameters, lanes: Any, lamina: int, ring: int, load: Any, slip: Any, speed: Any) -> Any:
    cases = np.stack(np.broadcast_arrays(load, np.square(slip), speed), axis=-1).astype(float)
    return through(lanes, frictions, cases, 2, lamina, ring, p)


@pytest.mark.parametrize("ring", [0, 1])
def test_film_thickness_is_that_of_dowson_and_higginson(lanes: Any, ring: int) -> None:
    """Table and logarithms against the formula with every group spelled out; log2 errors of 1e-10 each."""
    p, scene = parameters(), flooded_scene()
    bearing, oil = scene.bearing, scene.lubricant
    assert scene.effects.film is not None
    for lamina in (0, 3, 5):
        place = p.laminae[0, lamina] + p.roller.mass_offset
        numbers = naive.FilmLamina(
            bearing.effective_length / 6, equivalent_radius(bearing, place, SIDES[ring]),
            bearing.material.contact_modulus, oil.dynamic_viscosity(scene.temperature),
            oil.pressure_viscosity_at(scene.temperature), scene.effects.film,
        )  # fmt: skip
        found = 2.0 ** results(p, lanes, lamina, ring, LOAD, SLIP, ENTRAINMENT)[:, 0]
        exact = [naive.film_thickness(q, u + 1e-3, numbers) for q, u in zip(LOAD, ENTRAINMENT, strict=True)]
        np.testing.assert_allclose(found, exact, rtol=1e-9)


@pytest.mark.parametrize("sheared", [False, True])
@pytest.mark.parametrize("ring", [0, 1])
def test_mixed_friction_is_the_plain_blend(lanes: Any, ring: int, sheared: bool) -> None:
    """exp2 and log2 of the kernel are good to 1e-9 and 1e-10; the sixth power multiplies that."""
    p = parameters(sheared)
    found = results(p, lanes, 2, ring, LOAD, SLIP, ENTRAINMENT)[:, 1] * SLIP
    exact = [
        lamina_friction(flooded_scene(), p, ring, 2, q, s, u)
        for q, s, u in zip(LOAD, SLIP, ENTRAINMENT, strict=True)
    ]
    np.testing.assert_allclose(found, exact, rtol=1e-7)


def test_dry_friction_is_coulombs_with_the_corner_rounded(lanes: Any) -> None:
    p = only(parameters(), coulomb=CoulombParams(0.1, 0.01))
    found = results(p, lanes, 0, 0, LOAD, SLIP, ENTRAINMENT)[:, 1] * SLIP
    exact = [naive.coulomb_friction(q, s, 0.1, 0.01) for q, s in zip(LOAD, SLIP, strict=True)]
    np.testing.assert_allclose(found, exact, rtol=1e-12)


def test_without_traction_there_is_no_friction(lanes: Any) -> None:
    p = only(parameters())
    np.testing.assert_array_equal(results(p, lanes, 0, 0, LOAD, SLIP, ENTRAINMENT)[:, 1], 0.0)


@pytest.mark.parametrize("sheared", [False, True])
@given(
    load=st.floats(0.0, 2e4),
    slip=st.lists(st.floats(0.0, 20.0), min_size=8, max_size=8),
    speed=st.floats(0.0, 30.0),
)
@settings(max_examples=50, deadline=None)
def test_friction_is_bounded_by_the_boundary_friction_and_grows_with_slip(
    sheared: bool, load: float, slip: list[float], speed: float
) -> None:
    p = parameters(sheared)
    ordered = np.sort(slip)
    force = results(p, LANES8, 3, 0, load, ordered, speed)[:, 1] * ordered
    assert np.isfinite(force).all()
    assert np.all(force >= 0.0)
    assert np.all(force <= 0.1 * load * (1.0 + 1e-9))
    assert np.all(np.diff(force) >= -1e-9 * load)


def test_unloaded_lamina_has_no_friction_and_no_nan(lanes: Any) -> None:
    for sheared in (False, True):
        found = results(parameters(sheared), lanes, 0, 0, np.zeros(8), np.linspace(0.0, 1.0, 8), 5.0)
        np.testing.assert_array_equal(found[:, 1], 0.0)


@pytest.mark.parametrize("field", [0, 1, 2])
def test_a_nan_is_seen_in_the_friction(lanes: Any, field: int) -> None:
    cases = np.tile([500.0, 0.01, 5.0], (8, 1))
    cases[6, field] = np.nan
    for sheared in (False, True):
        found = through(lanes, frictions, cases, 2, 0, 0, parameters(sheared))
        assert np.isnan(found[6, 1])
        assert np.isfinite(np.delete(found, 6, axis=0)).all()
