"""Traction of the kernels against published numbers."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.config import load_lubricant
from beardyn_core.effects import CoulombTraction, LineFilm, LoadSharingTraction, MixedTraction
from beardyn_core.kernels.lanes import Lanes
from beardyn_core.model.contact_parameters import LAMINA_PRESSURE
from beardyn_core.model.parameters import Parameters
from beardyn_core.model.traction_params import aihara_params
from test.kernels.casting import through
from test.kernels.entries import frictions
from test.kernels.test_traction_laws import parameters

KGF_PER_MM2 = 9.80665e6
NO_ASPERITIES = -200.0  # log2 of a roughness that leaves the film all the load


def coefficient(p: Parameters, load: float, slip: float, speed: float) -> float:
    """Friction over normal load; the kernel adds 1 mm/s to the entrainment speed."""
    case = np.array([[load, slip**2, speed - 1e-3]])
    return float(through(Lanes(1), frictions, case, 2, 2, 0, p)[0, 1] * slip / load)


@pytest.mark.parametrize(
    ("pressure", "slip", "speed", "expected"),
    [
        (149.980489558372, 48.8863222878130e-3, 896.117562552404e-3, 6.017253174237477e-2),
        (70.8668300974355, 18.7016744160132e-3, 904.002621182389e-3, 9.483619302366691e-3),
    ],
)
def test_traction_of_aihara(pressure: float, slip: float, speed: float, expected: float) -> None:
    """D16; D-BRAIN (NSK), gtest/src/Mechanics/TribologyTest.cpp, AiharaT1 and AiharaT2; largest pressure.

    The second case has s_max = 0.2, so the usual limit of 0.25 must leave both alone.
    """
    p = parameters(LoadSharingTraction(), LineFilm())
    sharing = p.effects.load_sharing
    assert sharing is not None
    oil = load_lubricant("L055")
    oil = replace(oil, density=oil.density * 72.9029224284153e-3 / oil.dynamic_viscosity(343.15))
    aihara = aihara_params(oil, 343.15, LoadSharingTraction().largest_slide)
    sharing = sharing._replace(aihara=aihara, log2_roughness=NO_ASPERITIES)
    p = p._replace(effects=p.effects._replace(load_sharing=sharing))
    mean_pressure = math.pi / 4.0 * pressure * KGF_PER_MM2
    load = mean_pressure**2 / p.laminae[LAMINA_PRESSURE, 2]
    assert coefficient(p, load, slip, speed) == pytest.approx(expected, abs=1e-5)
    assert coefficient(p, load, slip, speed) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize(
    ("film_parameter", "share"),
    [(0.3, 0.3459), (0.5, 0.5432), (1.0, 0.8347), (1.5, 0.9465), (2.0, 0.9840)],
)
def test_share_of_the_film(film_parameter: float, share: float) -> None:
    """f = 1 - exp(-1.8 Lambda^1.2) to four digits; dossier B.8 prints 0.35, 0.54, 0.84, 0.95, 0.98.

    (Its 0.84 is 0.835 rounded once more.)

    A film without shear stress leaves what the asperities carry, at a slip where their arctangent is 1.
    """
    p = parameters(LoadSharingTraction(film_traction="bair_winer"), LineFilm())
    sharing = p.effects.load_sharing
    assert sharing is not None
    assert sharing.bair_winer is not None
    film = 2.0 ** float(through(Lanes(1), frictions, np.array([[500.0, 1.0, 4.999]]), 2, 2, 0, p)[0, 0])
    sharing = sharing._replace(
        slope=1e9,
        log2_roughness=math.log2(film / film_parameter),
        bair_winer=sharing.bair_winer._replace(limiting_shear=1e-12),
    )
    p = p._replace(effects=p.effects._replace(load_sharing=sharing))
    assert 1.0 - coefficient(p, 500.0, 1.0, 5.0) / 0.1 == pytest.approx(share, abs=1e-4)


@pytest.mark.parametrize("traction", [CoulombTraction(regularisation="ambrosio"), MixedTraction()])
def test_dry_mode_has_a_tenth_of_the_normal_force(traction: CoulombTraction | MixedTraction) -> None:
    """D4, Santos (2017): F_t / F_n = 0.100 in the dry and boundary setting, to 1e-6.

    Ambrosio's law is at full friction from its regularisation speed on. The blend is so below
    Lambda_bd = 0.01, which a rough surface brings about.
    """
    if isinstance(traction, MixedTraction):
        p = parameters(replace(traction, regularisation="ambrosio"), LineFilm())
        film = p.effects.film
        assert film is not None
        p = p._replace(effects=p.effects._replace(film=film._replace(roughness=1e-3)))
    else:
        p = parameters(traction, None)
    for slip in (0.0201, 0.1, 5.0):
        assert coefficient(p, 800.0, slip, 5.0) == pytest.approx(0.1, rel=1e-9)


def test_smooth_dry_mode_reaches_a_tenth_in_the_limit_of_full_slip() -> None:
    """D4 with u / sqrt(u^2 + u_r^2): short of 0.1 by (u_r / u)^2 / 2."""
    for slip, missing in ((0.1, 5e-3), (1.0, 5e-5), (20.0, 1.25e-7)):
        found = coefficient(parameters(CoulombTraction(), None), 800.0, slip, 5.0)
        assert 1.0 - found / 0.1 == pytest.approx(missing, rel=0.02)


def test_threlfalls_law_has_95_percent_at_and_beyond_its_speed() -> None:
    """Dossier B.8: 1 - exp(-3) = 0.9502 at v_r, 0.95 beyond; half of it at v_r ln(1/0.525) / 3."""
    p = parameters(CoulombTraction(regularisation="threlfall"), None)
    assert coefficient(p, 800.0, 0.01, 5.0) == pytest.approx(0.1 * (1.0 - math.exp(-3.0)), rel=1e-6)
    assert coefficient(p, 800.0, 0.5, 5.0) == pytest.approx(0.095, rel=1e-12)
    assert coefficient(p, 800.0, 0.01 * math.log(1.0 / 0.525) / 3.0, 5.0) == pytest.approx(0.0475, rel=1e-6)


def test_newtonian_film_at_small_slip_and_limiting_shear_at_large() -> None:
    """Ends of Bair and Winer's law: mu = eta(p) u / (h p), and mu = tau_L / p = 0.045.

    At 500 N on the lamina (0.3 GPa) Barus thickens the oil by exp(alpha p), here computed by hand.
    """
    p = parameters(LoadSharingTraction(film_traction="bair_winer"), LineFilm())
    sharing, film = p.effects.load_sharing, p.effects.film
    assert sharing is not None
    assert film is not None
    p = p._replace(effects=p.effects._replace(load_sharing=sharing._replace(log2_roughness=NO_ASPERITIES)))
    load, slip = 500.0, 1e-7
    thickness = 2.0 ** float(through(Lanes(1), frictions, np.array([[load, 1.0, 4.999]]), 2, 2, 0, p)[0, 0])
    pressure = math.sqrt(load * p.laminae[LAMINA_PRESSURE, 2])
    viscosity = film.viscosity * math.exp(film.pressure_viscosity * pressure)
    assert coefficient(p, load, slip, 5.0) == pytest.approx(viscosity * slip / thickness / pressure, rel=1e-3)
    assert coefficient(p, load, 100.0, 5.0) == pytest.approx(0.045, rel=1e-3)
