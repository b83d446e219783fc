"""Options of film and traction: of no size they change nothing, absent they leave no code, and runs hold."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numba
import numpy as np
import pytest

from beardyn_core.base.jit import OPTIONS
from beardyn_core.effects import CoulombTraction, EffectSet, LineFilm, LoadSharingTraction, MixedTraction
from beardyn_core.physics.film import RigidFilmParams, ThermalFilmParams
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.status import chatter_index
from test.effects.fresh_kernels import instruction_count
from test.kernels.entries import frictions
from test.kernels.rig import Float, Rig
from test.kernels.test_traction_laws import LOAD, SLIP, SPEED, parameters
from test.scenes import scene_with

BOTH = np.moveaxis(np.stack([LOAD, SLIP**2, SPEED]).reshape(3, -1, 8), 0, 1).copy()


def found(p: Parameters, kernel: Any = frictions) -> Float:
    out = np.zeros((len(BOTH), 2, 8))
    kernel(Lanes(8), BOTH, out, 2, 1, p)
    return out


def with_film(p: Parameters, **members: Any) -> Parameters:
    film = p.effects.film
    assert film is not None
    return p._replace(effects=p.effects._replace(film=film._replace(**members)))


def test_inlet_heating_of_no_size_is_no_heating() -> None:
    p = parameters(MixedTraction(), LineFilm())
    heated = with_film(p, thermal=ThermalFilmParams(-3.0, 0.0, 0.64))
    np.testing.assert_allclose(found(heated), found(p), rtol=1e-12)
    assert np.any(found(with_film(p, thermal=ThermalFilmParams(-3.0, 0.1, 0.64))) != found(p))


def test_rigid_film_of_no_size_is_no_guard() -> None:
    p = parameters(MixedTraction(), LineFilm())
    thin = with_film(p, rigid=RigidFilmParams(np.full((2, 6), -500.0)))
    np.testing.assert_allclose(found(thin), found(p), rtol=1e-12)


@pytest.mark.parametrize(
    "traction",
    [
        LoadSharingTraction(boundary_friction=0.0),
        LoadSharingTraction(boundary_friction=0.0, film_traction="eyring"),
        CoulombTraction(friction=0.0, regularisation="threlfall"),
        CoulombTraction(friction=0.0, regularisation="ambrosio"),
        CoulombTraction(friction=0.0, regularisation="arctangent"),
    ],
)
def test_traction_without_friction_is_no_traction(traction: Any) -> None:
    film = None if isinstance(traction, CoulombTraction) else LineFilm()
    np.testing.assert_array_equal(found(parameters(traction, film)), found(parameters(None, film)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("more", "less"),
    [
        ((MixedTraction(), LineFilm(thermal="wilson")), (MixedTraction(), LineFilm())),
        ((MixedTraction(), LineFilm(isoviscous=True)), (MixedTraction(), LineFilm())),
        ((MixedTraction(regularisation="threlfall"), LineFilm()), (MixedTraction(), LineFilm())),
        ((LoadSharingTraction(), LineFilm()), (LoadSharingTraction(), None)),
        ((LoadSharingTraction(), None), (None, None)),
        (
            (LoadSharingTraction(film_traction="eyring"), LineFilm(thickening="roelands")),
            (LoadSharingTraction(film_traction="eyring"), LineFilm()),
        ),
    ],
)
def test_option_not_taken_leaves_no_code(more: Any, less: Any) -> None:
    sizes = []
    for traction, film in (more, less):
        kernel = numba.njit(**OPTIONS)(frictions.py_func)
        found(parameters(traction, film), kernel)
        sizes.append(instruction_count(kernel))
    assert sizes[1] < sizes[0]


@pytest.mark.parametrize(
    "film",
    [LineFilm(formula="pan_hamrock"), LineFilm(formula="dowson_toyoda"), LineFilm(layer=0.3e-6)],
)
def test_choice_of_formula_compiles_nothing_new(film: LineFilm) -> None:
    found(parameters(MixedTraction(), LineFilm()))
    before = len(frictions.signatures)
    found(parameters(MixedTraction(), film))
    assert len(frictions.signatures) == before


@pytest.mark.slow
@pytest.mark.parametrize(
    ("traction", "film"),
    [
        (LoadSharingTraction(), LineFilm(isoviscous=True, thermal="murch_wilson")),
        (LoadSharingTraction(film_traction="eyring"), LineFilm(thickening="roelands")),
        (CoulombTraction(regularisation="ambrosio"), None),
    ],
)
def test_bearing_runs_with_the_option(traction: Any, film: LineFilm | None) -> None:
    """2048 steps, 20 ms under 80 kN: the load is carried and nothing chatters."""
    rig = Rig.at_equilibrium(scene_with(replace(EffectSet(), traction=traction, film=film)))
    signals, _, _ = rig.run(2048)
    assert np.isfinite(signals).all()
    assert signals[:, 2].mean() == pytest.approx(8e4, rel=0.02)
    assert chatter_index(rig.state, 2048).max() < 0.2
