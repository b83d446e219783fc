"""Films of pockets and lands against Reynolds' equation and the values of the classical papers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from beardyn_core.effects import Cage, PocketFilm
from test.kernels import naive_cage
from test.kernels.cage_entries import journals
from test.kernels.test_cage import land_params, parameters
from test.scenes import standard_scene


@pytest.mark.parametrize("gap", [2e-6, 2e-5, 1e-4])
def test_constants_of_the_pocket_film_are_those_of_reynolds_equation(gap: float) -> None:
    """Martin (1916) gives 4.9 rounded, so 1 %; squeeze 3 sqrt(2) pi, shear sqrt(2) pi are exact integrals."""
    cage = parameters(Cage(lubrication=PocketFilm())).effects.cage
    assert cage is not None
    assert cage.film is not None

    scene = standard_scene()
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    length, radius = 0.5 * scene.bearing.effective_length, 0.0135
    film = cage.film
    # the roller turns, the bar stands: the mean speed is half the roller's
    assert film.wedge * radius / gap == pytest.approx(
        length * naive_cage.wedge_load(viscosity, 0.5, radius, gap), rel=1e-2
    )
    assert film.squeeze * (radius / gap) ** 1.5 == pytest.approx(
        length * naive_cage.squeeze_resistance(viscosity, radius, gap), rel=1e-3
    )
    assert film.shear * (radius / gap) ** 0.5 == pytest.approx(
        length * naive_cage.shear_resistance(viscosity, radius, gap), rel=1e-3
    )


@pytest.mark.parametrize("ratio", [0.1, 0.4, 0.6, 0.8, 0.9])
def test_attitude_and_load_number_of_the_short_bearing_are_ocvirks(ratio: float) -> None:
    """Dubois and Ocvirk (1953), NACA Report 1157: tan phi = pi sqrt(1 - e^2) / 4e, load number S (L/D)^2 =
    (1 - e^2)^2 / (pi e sqrt(pi^2 (1 - e^2) + 16 e^2)); a steady load on a journal that turns alone."""
    land = land_params()
    speed = 170.0
    out = np.zeros((1, 3))
    journals(np.array([[0.0, ratio * land.clearance, 0.0, 0.0, speed]]), out, land)
    forward, radial = out[0, 0], out[0, 1]
    assert forward / -radial == pytest.approx(math.pi * math.sqrt(1.0 - ratio**2) / (4.0 * ratio), rel=1e-9)
    flat = 1.0 - ratio**2
    number = flat**2 / (math.pi * ratio * math.sqrt(math.pi**2 * flat + 16.0 * ratio**2))
    # S (L/D)^2 = eta N L D / W (R/C)^2 (L/D)^2 = (2 K C^2 / R L^3) (speed / 2 pi) L^3 / D / W (R/C)^2
    load = math.hypot(forward, radial)
    found = 2.0 * land.film * speed / (2.0 * math.pi) / (2.0 * load)
    assert found == pytest.approx(number, rel=1e-9)
