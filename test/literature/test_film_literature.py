"""Film and mixed friction against published numbers and a second, independent calculation."""

from __future__ import annotations

import math

import pytest

from beardyn_core.bearing.film_thickness import line_film
from evidence.validation.films import example_film, mixed_coefficient


def test_film_of_the_worked_example_is_0_38_um() -> None:
    """Derived: h = 0.38 um (Dowson-Higginson) on the cone, Lambda about 1 at 0.3 um; two digits given."""
    film = example_film("cone")
    assert film == pytest.approx(0.38e-6, abs=0.02e-6)
    assert film / 0.3e-6 == pytest.approx(1.27, abs=0.1)


def test_film_of_a_textbook_cylinder_pair() -> None:
    """Every group by hand: U = 5e-12, G = 4528, W = 4.4171e-5, H = 2.65 U^0.7 G^0.54 W^-0.13.

    ln H = ln 2.65 + 0.7 ln U + 0.54 ln G - 0.13 ln W = 0.974560 - 18.215200 + 4.545670 + 1.303545.
    """
    modulus, radius = 226.4e9, 0.01
    film = line_film(1e5, 5e-12 * modulus * radius / 0.02, radius, modulus, 0.02, 2e-8)
    assert math.log(film / radius) == pytest.approx(0.974560 - 18.215200 + 4.545670 + 1.303545, abs=2e-4)


def test_cup_film_is_thicker_than_cone_film() -> None:
    """Conforming contact: the larger equivalent radius carries the thicker film."""
    assert example_film("cup") > 1.05 * example_film("cone")


@pytest.mark.parametrize(
    ("film_parameter", "friction"), [(0.005, 0.1), (0.0101, 0.1), (1.5, 0.02), (4.0, 0.02)]
)
def test_mixed_friction_ends_at_the_boundary_and_the_film_value(
    film_parameter: float, friction: float
) -> None:
    assert mixed_coefficient(film_parameter) == pytest.approx(friction, rel=1e-3)


@pytest.mark.parametrize("film_parameter", [0.02, 0.1, 0.3, 0.5, 1.0, 1.4])
def test_blend_weight_is_the_sixth_power_law(film_parameter: float) -> None:
    """((1.5 - Lambda) / 1.49)^6: boundary share of a friction that goes from 0.02 to 0.1."""
    weight = (mixed_coefficient(film_parameter) - 0.02) / 0.08
    assert weight == pytest.approx(((1.5 - film_parameter) / 1.49) ** 6, rel=1e-4, abs=1e-6)
