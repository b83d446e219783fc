"""Every film and traction option of the kernels against scalar formulas, over more than a bearing meets."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.effects import (
    CoulombTraction,
    LineFilm,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
)
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive_traction
from test.kernels.casting import through
from test.kernels.entries import frictions, saturations
from test.kernels.naive_traction import SIDES, equivalent_radius
from test.kernels.rig import parameters_of
from test.scenes import standard_scene

LANES8 = Lanes(8)
LAYER_ERROR = 4e-5  # of a film with little oil: a fit replaces one logarithm and one power
CASES = np.random.default_rng(5)
LOAD = 10.0 ** CASES.uniform(-3.0, 4.3, 200)
SLIP = 10.0 ** CASES.uniform(-9.0, 1.3, 200)
SPEED = 10.0 ** CASES.uniform(-3.0, 1.5, 200)

ENOUGH = LineFilm(supply="flooded")
FILMS = (
    replace(ENOUGH, formula="pan_hamrock"),
    replace(ENOUGH, formula="pan_hamrock_central", thermal="murch_wilson"),
    LineFilm(formula="dowson_toyoda", thermal="wilson", starvation=1.0),
    replace(ENOUGH, thermal="gupta_cheng"),
    replace(ENOUGH, isoviscous=True),
    LineFilm(),
    LineFilm(formula="pan_hamrock", layer=2e-6, isoviscous=True),
    LineFilm(formula="pan_hamrock", thermal="wilson", isoviscous=True, starvation=0.5),
)
LAWS = (
    CoulombTraction(),
    CoulombTraction(regularisation="threlfall"),
    CoulombTraction(regularisation="ambrosio"),
    CoulombTraction(regularisation="ambrosio", regularisation_start=0.004),
    CoulombTraction(regularisation="arctangent"),
)
SHARED = (
    (LoadSharingTraction(), LineFilm()),
    (LoadSharingTraction(film_traction="eyring"), ENOUGH),
    (LoadSharingTraction(film_traction="bair_winer"), ENOUGH),
    (LoadSharingTraction(film_traction="eyring", eyring_stress=8e6), replace(ENOUGH, thickening="roelands")),
    (
        LoadSharingTraction(film_traction="bair_winer", limiting_shear=0.08),
        replace(ENOUGH, thickening="roelands", isoviscous=True, thermal="wilson"),
    ),
    (LoadSharingTraction(film_traction="bair_winer", inlet_shear=True), replace(ENOUGH, isoviscous=True)),
    (LoadSharingTraction(boundary_slope=200.0), None),
)
ALL = (
    *((law, LineFilm()) for law in LAWS),
    *SHARED,
    (MixedTraction(regularisation="ambrosio"), LineFilm()),
    (MixedTraction(regularisation="threlfall"), LineFilm(isoviscous=True)),
    (ShearedFilmTraction(regularisation="arctangent"), LineFilm(thickening="roelands")),
)


@cache
def parameters(traction: Any, film: LineFilm | None) -> Parameters:
    scene = standard_scene()
    changed = replace(scene, effects=replace(scene.effects, traction=traction, film=film))
    return parameters_of(changed)


def lamina(number: int, ring: int) -> naive_traction.Lamina:
    scene = standard_scene()
    bearing, p = scene.bearing, parameters(LAWS[0], None)
    place = p.laminae[0, number] + p.roller.mass_offset
    return naive_traction.Lamina(
        bearing.effective_length / 6, equivalent_radius(bearing, place, SIDES[ring]),
        bearing.material.contact_modulus, bearing.raceway_roughness, scene.lubricant, scene.temperature,
    )  # fmt: skip


def results(p: Parameters, lanes: Any, number: int, ring: int, load: Any, slip: Any, speed: Any) -> Any:
    """Film thickness [m] and friction rate [N s/m]; the kernel adds 1 mm/s to the speed."""
    cases = np.stack(np.broadcast_arrays(load, np.square(slip), speed), axis=-1).astype(float)
    found = through(lanes, frictions, cases, 2, number, ring, p)
    return 2.0 ** found[:, 0], found[:, 1]


@pytest.mark.parametrize("film", FILMS)
@pytest.mark.parametrize("ring", [0, 1])
def test_film_with_each_option_is_the_plain_formula(film: LineFilm, ring: int) -> None:
    for number in (0, 5):
        found = results(parameters(MixedTraction(), film), LANES8, number, ring, LOAD, SLIP, SPEED)[0]
        exact = [
            naive_traction.film(q, u + 1e-3, lamina(number, ring), film)
            for q, u in zip(LOAD, SPEED, strict=True)
        ]
        np.testing.assert_allclose(found, exact, rtol=3e-9 if film.oil_layer is None else LAYER_ERROR)


def test_rigid_film_rules_light_contacts_only() -> None:
    """The guard must change some of the cases, not all: else it is not tested."""
    plain = results(parameters(MixedTraction(), LineFilm()), LANES8, 2, 0, LOAD, SLIP, SPEED)[0]
    guarded = results(
        parameters(MixedTraction(), LineFilm(isoviscous=True)), LANES8, 2, 0, LOAD, SLIP, SPEED
    )[0]
    thicker = guarded > plain * (1.0 + 1e-9)
    assert LOAD[thicker].max() < 5e3
    assert 0.1 < thicker.mean() < 0.9
    np.testing.assert_array_equal(guarded[~thicker], plain[~thicker])


@pytest.mark.parametrize("law", LAWS)
def test_dry_friction_follows_its_named_law(lanes: Any, law: CoulombTraction) -> None:
    """exp2 is good to 1e-9, the series of small arguments to 1e-8 (`physics/lanes/lane_math.py`)."""
    found = results(parameters(law, None), lanes, 1, 0, LOAD, SLIP, SPEED)[1] * SLIP
    exact = [naive_traction.dry_friction(q, s, law) for q, s in zip(LOAD, SLIP, strict=True)]
    np.testing.assert_allclose(found, exact, rtol=2e-8, atol=1e-12)


@pytest.mark.parametrize(("traction", "film"), SHARED)
@pytest.mark.parametrize("ring", [0, 1])
def test_shared_load_has_the_friction_of_the_plain_formulas(
    traction: LoadSharingTraction, film: LineFilm | None, ring: int
) -> None:
    """Errors of exp2 and log2, 1e-9, times the exponents 1.2 and 1.8 and the series' 1e-7.

    That of a film of little oil, with up to the fifth power of the film in the blend.
    """
    p = parameters(traction, film)
    for number in (0, 3):
        found = results(p, LANES8, number, ring, LOAD, SLIP, SPEED)[1] * SLIP
        exact = [
            naive_traction.shared_friction(q, s, u + 1e-3, lamina(number, ring), traction, film)
            for q, s, u in zip(LOAD, SLIP, SPEED, strict=True)
        ]
        layered = film is not None and film.oil_layer is not None
        np.testing.assert_allclose(found, exact, rtol=5.0 * LAYER_ERROR if layered else 3e-7)


@pytest.mark.parametrize(("traction", "film"), SHARED[:6])
def test_every_film_traction_takes_part_in_the_cases_compared(
    traction: LoadSharingTraction, film: LineFilm
) -> None:
    """The film's own friction, neither cut off nor buried under asperities, in at least 20 cases."""
    where, seen = lamina(3, 0), 0
    for q, s, u in zip(LOAD, SLIP, SPEED + 1e-3, strict=True):
        thickness = naive_traction.film(q, u, where, film)
        wet = naive_traction.film_friction(q, s, u, thickness, where, traction, film.thickening)
        share = 1.0 - np.exp(-1.8 * (thickness / where.roughness) ** 1.2)
        seen += bool(wet < 0.1 * q and share > 0.9)
    assert seen >= 20


@pytest.mark.parametrize(("traction", "film"), ALL)
@given(
    load=st.floats(0.0, 1e5),
    slip=st.lists(st.floats(0.0, 50.0), min_size=8, max_size=8),
    speed=st.floats(-40.0, 40.0),
)
@settings(max_examples=40, deadline=None)
def test_friction_rate_is_finite_dissipates_and_keeps_to_the_dry_limit(
    traction: Any, film: LineFilm, load: float, slip: list[float], speed: float
) -> None:
    rate = results(parameters(traction, film), LANES8, 4, 1, load, slip, speed)[1]
    assert np.isfinite(rate).all()
    assert np.all(rate >= 0.0)
    # subnormal loads, below 1e-307 N, have no digits left to compare
    assert np.all(rate * slip <= 0.1 * load * (1.0 + 1e-9) + 1e-300)


@pytest.mark.parametrize(("traction", "film"), ALL)
def test_rate_at_zero_slip_is_the_limit_of_small_slip(lanes: Any, traction: Any, film: LineFilm) -> None:
    p = parameters(traction, film)
    load, speed = np.full(8, 500.0), np.full(8, 5.0)
    at_zero = results(p, lanes, 2, 0, load, np.zeros(8), speed)[1]
    nearly = results(p, lanes, 2, 0, load, np.full(8, 1e-9), speed)[1]
    np.testing.assert_allclose(at_zero, nearly, rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize(("traction", "film"), ALL)
def test_unloaded_lamina_has_no_friction(lanes: Any, traction: Any, film: LineFilm) -> None:
    rate = results(parameters(traction, film), lanes, 0, 0, np.zeros(8), np.linspace(0.0, 1.0, 8), 5.0)[1]
    np.testing.assert_array_equal(rate, 0.0)


@pytest.mark.parametrize(("traction", "film"), ALL)
@pytest.mark.parametrize("field", [0, 1])
def test_a_nan_is_seen_in_the_friction(lanes: Any, traction: Any, film: LineFilm, field: int) -> None:
    cases = np.tile([500.0, 0.01, 5.0], (8, 1))
    cases[6, field] = np.nan
    found = through(lanes, frictions, cases, 2, 0, 0, parameters(traction, film))
    assert np.isnan(found[6, 1])
    assert np.isfinite(np.delete(found, 6, axis=0)).all()


def test_saturating_functions_over_their_argument(lanes: Any) -> None:
    """Stated errors: 1e-8 of the decay, 1e-8 of asinh, 1e-9 of atan; both sides of every seam."""
    x = np.concatenate([10.0 ** np.linspace(-12.0, 12.0, 400), [0.0299999, 0.0300001, 0.9999999, 1.0000001]])
    found = through(lanes, saturations, x[:, None], 3)
    np.testing.assert_allclose(found[:, 0], -np.expm1(-x) / x, rtol=4e-8)
    np.testing.assert_allclose(found[:, 1], np.arcsinh(x) / x, rtol=1e-8)
    np.testing.assert_allclose(found[:, 2], np.arctan(x) / x, rtol=1e-9)
    np.testing.assert_array_equal(through(lanes, saturations, np.zeros((8, 1)), 3), 1.0)
