"""Traction of the kernels against published numbers."""

from __future__ import annotations

import math

import pytest

from beardyn_core.effects import CoulombTraction, LineFilm, LoadSharingTraction
from beardyn_core.physics.bodies.layout import LAMINA_PRESSURE
from evidence.validation.films import (
    NO_ASPERITIES,
    boundary_blend,
    coefficient,
    dry,
    film_and_friction,
    film_of,
    film_share,
    parameters,
    sharing_of,
)


@pytest.mark.parametrize("slip", [0.0201, 0.1, 5.0])
def test_dry_mode_has_a_tenth_of_the_normal_force(slip: float) -> None:
    """Santos (2017): F_t / F_n = 0.100 in the dry and boundary setting, from the regularisation on."""
    for p in (dry(), boundary_blend()):
        assert coefficient(p, 800.0, slip, 5.0) == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize(
    ("film_parameter", "share"),
    [(0.3, 0.3459), (0.5, 0.5432), (1.0, 0.8347), (1.5, 0.9465), (2.0, 0.9840)],
)
def test_share_of_the_film(film_parameter: float, share: float) -> None:
    """f = 1 - exp(-1.8 Lambda^1.2) to four digits; derived to two."""
    assert film_share(film_parameter) == pytest.approx(share, abs=1e-4)


def test_smooth_dry_mode_reaches_a_tenth_in_the_limit_of_full_slip() -> None:
    """The same with u / sqrt(u^2 + u_r^2): short of 0.1 by (u_r / u)^2 / 2."""
    for slip, missing in ((0.1, 5e-3), (1.0, 5e-5), (20.0, 1.25e-7)):
        found = coefficient(parameters(CoulombTraction(), None), 800.0, slip, 5.0)
        assert 1.0 - found / 0.1 == pytest.approx(missing, rel=0.02)


def test_threlfalls_law_has_95_percent_at_and_beyond_its_speed() -> None:
    """Derived: 1 - exp(-3) = 0.9502 at v_r, 0.95 beyond; half of it at v_r ln(1/0.525) / 3."""
    p = parameters(CoulombTraction(regularisation="threlfall"), None)
    assert coefficient(p, 800.0, 0.01, 5.0) == pytest.approx(0.1 * (1.0 - math.exp(-3.0)), rel=1e-6)
    assert coefficient(p, 800.0, 0.5, 5.0) == pytest.approx(0.095, rel=1e-12)
    assert coefficient(p, 800.0, 0.01 * math.log(1.0 / 0.525) / 3.0, 5.0) == pytest.approx(0.0475, rel=1e-6)


def test_newtonian_film_at_small_slip_and_limiting_shear_at_large() -> None:
    """Ends of Bair and Winer's law: mu = eta(p) u / (h p), and mu = tau_L / p = 0.045.

    At 500 N on the lamina (0.3 GPa) Barus thickens the oil by exp(alpha p), here computed by hand.
    """
    p = parameters(LoadSharingTraction(film_traction="bair_winer", inlet_shear=False), LineFilm())
    film = film_of(p)
    p = p._replace(
        effects=p.effects._replace(load_sharing=sharing_of(p)._replace(log2_roughness=NO_ASPERITIES))
    )
    load, slip = 500.0, 1e-7
    thickness = film_and_friction(p, load, 1.0, 5.0)[0]
    pressure = math.sqrt(load * p.laminae[LAMINA_PRESSURE, 2])
    viscosity = film.viscosity * math.exp(film.pressure_viscosity * pressure)
    assert coefficient(p, load, slip, 5.0) == pytest.approx(viscosity * slip / thickness / pressure, rel=1e-3)
    assert coefficient(p, load, 100.0, 5.0) == pytest.approx(0.045, rel=1e-3)
