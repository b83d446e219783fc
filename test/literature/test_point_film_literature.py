"""Limits of the formulas of film, starvation and inlet heating; their published numbers are anchors."""

from __future__ import annotations

import math

import pytest

from beardyn_core.bearing.film_thickness import (
    LINE_FORMULAS,
    line_film,
    rigid_line_film,
    thermal_factor,
)
from evidence.validation.ball_contact import gupta_cheng_factor, starvation_central
from evidence.validation.films import HALF_WIDTH, ball_on_inner_ring


def test_far_meniscus_starves_nothing() -> None:
    film, radius = ball_on_inner_ring()
    assert starvation_central(film, radius, 3.0 * HALF_WIDTH, HALF_WIDTH) == 1.0


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
