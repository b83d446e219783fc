"""Film and mixed friction against published numbers and a second, independent calculation."""

from __future__ import annotations

import math

import numpy as np
import pytest

from beardyn_core.bearing.film_thickness import line_film
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.kernels.lanes import Lanes
from test.kernels.casting import through
from test.kernels.entries import frictions
from test.kernels.test_film_and_traction import parameters

HS = load_bearing("HS130x230")
L055 = load_lubricant("L055")


def example_film(side: str, formula: str = "dowson_higginson") -> float:
    """P1 at 2000 rpm, 10 kN on a roller, L055 at 100 degrees C (physics dossier B.6)."""
    shaft = 2000.0 * math.pi / 30.0
    radius = {"cup": HS.cup_angle, "cone": HS.cone_angle}[side]
    distance = HS.apex_distance / math.cos(HS.half_angle)
    raceway = distance * math.sin(radius)
    # cup at rest: its contact point moves with the cage, so both surfaces enter with w_c R
    speed = cage_speed(HS, shaft) * raceway if side == "cup" else (shaft - cage_speed(HS, shaft)) * raceway
    curvature = 1.0 / (distance * math.tan(HS.half_angle))
    curvature += (-1.0 if side == "cup" else 1.0) / (distance * math.tan(radius))
    return line_film(
        1e4 / HS.effective_length, speed, 1.0 / curvature, HS.material.contact_modulus,
        L055.dynamic_viscosity(373.15), L055.pressure_viscosity_at(373.15), formula,
    )  # fmt: skip


def test_film_of_the_worked_example_is_0_38_um() -> None:
    """Dossier B.6: h = 0.38 um (Dowson-Higginson) on the cone, Lambda about 1 at 0.3 um; two digits given."""
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
    ("film_parameter", "friction", "digits"),
    [(0.1, 0.075, 5e-4), (0.3, 0.042, 5e-4), (0.5, 0.027, 5e-4), (1.0, 0.0201, 5e-5)],
)
def test_mixed_friction_of_eq_8(film_parameter: float, friction: float, digits: float) -> None:
    """Santos (2017), Eq. 8 with 0.1 and 0.02: 0.075, 0.042, 0.027, 0.0201; dossier B.8, digits as printed.

    The kernel is asked at full slip (20 m/s) and at the entrainment speed that gives this film parameter.
    """
    assert mixed_coefficient(film_parameter) == pytest.approx(friction, abs=digits)


@pytest.mark.parametrize(
    ("film_parameter", "friction"), [(0.005, 0.1), (0.0101, 0.1), (1.5, 0.02), (4.0, 0.02)]
)
def test_mixed_friction_ends_at_the_boundary_and_the_film_value(
    film_parameter: float, friction: float
) -> None:
    assert mixed_coefficient(film_parameter) == pytest.approx(friction, rel=1e-3)


def mixed_coefficient(film_parameter: float) -> float:
    p = parameters()
    load = 1000.0
    log2_at_1 = p.laminae[4, 2] - 0.13 * math.log2(load)
    target = math.log2(film_parameter * 3e-7)
    speed = 2.0 ** ((target - log2_at_1) / 0.7) - 1e-3
    assert speed > 0.0 or film_parameter < 0.01
    case = np.array([[load, 20.0**2, max(speed, 0.0)]])
    found = through(Lanes(1), frictions, case, 2, 2, 0, p)[0]
    if speed > 0.0:
        assert 2.0 ** found[0] / 3e-7 == pytest.approx(film_parameter, rel=1e-6)
    return float(found[1] * 20.0 / load)


@pytest.mark.parametrize("film_parameter", [0.02, 0.1, 0.3, 0.5, 1.0, 1.4])
def test_blend_weight_is_the_sixth_power_law(film_parameter: float) -> None:
    """((1.5 - Lambda) / 1.49)^6: boundary share of a friction that goes from 0.02 to 0.1."""
    weight = (mixed_coefficient(film_parameter) - 0.02) / 0.08
    assert weight == pytest.approx(((1.5 - film_parameter) / 1.49) ** 6, rel=1e-4, abs=1e-6)
