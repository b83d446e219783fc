"""Films, starvation and inlet heating against published numbers.

The numbers of D-BRAIN (NSK) are those of the unit tests in its public repository, kojik-umich/D-BRAIN,
gtest/src/Mechanics/TribologyTest.cpp, where the inputs stand too.
"""

from __future__ import annotations

import math

import pytest

from beardyn_core.bearing.film_thickness import (
    LINE_FORMULAS,
    gupta_cheng_factor,
    line_film,
    point_film_central,
    point_film_minimum,
    rigid_line_film,
    starvation_central,
    starvation_minimum,
    thermal_factor,
    thermal_loading,
)
from test.literature.test_film_literature import example_film

HALF_WIDTH = 76.762e-6  # of the ball's contact, along the entrainment


def ball_on_inner_ring() -> tuple[float, float]:
    """Flooded central film and radius Rx of D-BRAIN's HamrockDowson_case1, at the epicyclic ball spin."""
    ball, race, groove, steel = 4.365e-3, 40.635e-3, 2.3571e-3, 207e9 / (1.0 - 0.3**2)
    radius_x, radius_y = 1.0 / (2.0 / ball + 1.0 / race), 1.0 / (2.0 / ball - 1.0 / groove)
    pitch = 2.0 * race + ball
    spin = 0.5 * (pitch / ball - ball / pitch) * 1e4 * math.pi / 30.0
    speed = 0.5 * ball * spin
    film = point_film_central(136.0, speed, radius_x, radius_y, steel, 43.691e-3, 0.2 / 9.8067e6)
    return film, radius_x


def test_central_film_of_hamrock_and_dowson() -> None:
    """D13, flooded; D-BRAIN 1.33431846824466 um."""
    assert ball_on_inner_ring()[0] == pytest.approx(1.33431846824466e-6, rel=1e-5)


def test_starved_central_film() -> None:
    """D13, meniscus one half width before the contact; D-BRAIN factor 0.821192401315268."""
    film, radius = ball_on_inner_ring()
    factor = starvation_central(film, radius, HALF_WIDTH, HALF_WIDTH)
    assert factor == pytest.approx(0.821192401315268, rel=1e-5)
    assert film * factor == pytest.approx(1.09573218705714e-6, rel=1e-5)
    assert starvation_central(film, radius, 3.0 * HALF_WIDTH, HALF_WIDTH) == 1.0


def test_minimum_film_of_hamrock_and_dowson() -> None:
    """D14; D-BRAIN HamrockDowson_case2, 1.07933 um printed with six digits."""
    film = point_film_minimum(100.0, 10.0, 20e-3, 30e-3, 200e9, 40e-3, 2e-8)
    assert film == pytest.approx(1.07933e-6, rel=1e-5)


def test_starved_minimum_film() -> None:
    """D-BRAIN Starvation_case2: H = 6e-4, Rx = 2 mm, b = 60 um."""
    factor = starvation_minimum(6e-4 * 2e-3, 2e-3, 6e-5, 6e-5)
    assert factor == pytest.approx(0.784506626, rel=1e-6)


def test_inlet_heating_of_murch_and_wilson() -> None:
    """D15; D-BRAIN ErtelGrubin0, 0.938371825085712."""
    loading = thermal_loading(43.691e-3, 7.5e-4, 22.36094193, 0.145)
    assert thermal_factor(loading, "murch_wilson") == pytest.approx(0.938371825085712, abs=1e-6)


@pytest.mark.parametrize(
    ("formula", "film"),
    [
        ("dowson_higginson", 0.38),
        ("pan_hamrock", 0.345),
        ("pan_hamrock_central", 0.41),
        ("dowson_toyoda", 0.49),
    ],
)
def test_line_films_of_the_worked_example(formula: str, film: float) -> None:
    """Dossier B.6: P1, 2000 rpm, 10 kN, L055 at 100 degrees C, on the cone: 0.38, 0.345, 0.41, 0.49 um.

    Two digits are given, of lumped geometry; ours is that of mid-length: 5 %.
    """
    assert example_film("cone", formula) * 1e6 == pytest.approx(film, rel=0.05)


def test_exponents_are_those_of_the_formulas() -> None:
    """Doubling speed, oil and load, against the printed exponents."""
    arguments = (1e5, 5.0, 0.012, 226e9, 0.02, 2e-8)
    printed = {
        "dowson_higginson": (0.7, 0.54, -0.13),
        "pan_hamrock": (0.694, 0.568, -0.128),
        "pan_hamrock_central": (0.692, 0.470, -0.166),
        "dowson_toyoda": (0.69, 0.56, -0.10),
    }
    assert set(printed) == set(LINE_FORMULAS)
    for formula, exponents in printed.items():
        base = line_film(*arguments, formula)
        for place, exponent in ((1, exponents[0]), (5, exponents[1]), (0, exponents[2])):
            factors = [2.0 if at == place else 1.0 for at in range(6)]
            load, speed, radius, modulus, oil, alpha = (
                each * factor for each, factor in zip(arguments, factors, strict=True)
            )
            doubled = line_film(load, speed, radius, modulus, oil, alpha, formula)
            assert math.log2(doubled / base) == pytest.approx(exponent, abs=1e-12)


def test_rigid_film_of_martin() -> None:
    """H = 4.9 U / W is h = 4.9 eta u R / w whatever the modulus: 0.02 Pa s, 5 m/s, 10 mm, 500 N/m: 9.8 um."""
    assert rigid_line_film(500.0, 5.0, 0.01, 0.02) == pytest.approx(9.8e-6, rel=1e-12)


def test_heating_formulas_agree_where_they_share_a_regime() -> None:
    """Gupta-Cheng without load and slide is its entry of the table; all say nothing of a slow inlet."""
    assert gupta_cheng_factor(0.5, 0.0, 226e9, 0.0) == pytest.approx(thermal_factor(0.5, "gupta_cheng"))
    by_hand = (1.0 - 13.2 * 1e9 / 226e9) / (1.0 + 0.213 * (1.0 + 2.23 * 0.1**0.83))
    assert gupta_cheng_factor(1.0, 1e9, 226e9, 0.1) == pytest.approx(by_hand, rel=1e-12)
    for formula in ("murch_wilson", "wilson", "gupta_cheng"):
        assert thermal_factor(1e-9, formula) == pytest.approx(1.0, abs=1e-5)
        assert 0.3 < thermal_factor(5.0, formula) < 0.9
