"""The rolling couple of a starved inlet, beside other solutions of the same inlet."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.optimize import brentq

from beardyn_core.bearing.oil_layer import TRANSITION, layer_couple_shares, layer_thickness, starved_film
from beardyn_core.bearing.starvation import couple_shares


def test_a_flooded_inlet_leaves_the_whole_couple() -> None:
    assert couple_shares(1.0) == (1.0, 1.0)


def test_less_film_is_less_couple_and_elastic_surfaces_lose_more() -> None:
    shares = np.array([couple_shares(film) for film in np.linspace(0.02, 1.0, 50)])
    assert np.all(np.diff(shares, axis=0) > 0.0)
    assert np.all(shares[:-1, 1] < shares[:-1, 0])


def test_rigid_surfaces_agree_with_finite_differences_of_reynolds_equation() -> None:
    """The pressure solved as a boundary value problem, cavitation by pushing it up to zero."""

    def solved(meniscus: float, film: float) -> tuple[float, float]:
        x = np.linspace(-meniscus, 3.0, 4001)
        gap = film + x * x
        middle = 0.5 * (gap[1:] + gap[:-1])
        flow, step = middle**3, x[1] - x[0]
        pressure = np.zeros_like(x)
        # x grows along the flow: the oil that cannot be carried away is zero pressure
        last = len(x) - 1
        while True:
            size = last - 1
            matrix = np.zeros((3, size))
            matrix[0, 1:] = flow[1 : last - 1]
            matrix[1] = -(flow[: last - 1] + flow[1:last])
            matrix[2, :-1] = flow[1 : last - 1]
            right = 12.0 * step * (middle[1:last] - middle[: last - 1])
            pressure[:] = 0.0
            pressure[1:last] = solve_banded((1, 1), matrix, right)
            if pressure[last - 1] >= 0.0:
                break
            last -= 1
        return float(pressure.sum() * step), float(-(pressure * x).sum() * step)

    # films at equal load, flooded and with a meniscus near the contact
    load, flooded = solved(60.0, 1.0)
    film = brentq(lambda thin: solved(1.5, thin)[0] - load, 0.2, 1.0, xtol=1e-4)
    _, couple = solved(1.5, film)
    assert couple / flooded == pytest.approx(couple_shares(film).rigid, rel=0.05)


def test_shares_of_a_layer_are_those_of_its_film() -> None:
    """The fits that the kernels use, against Reynolds' equation, over films of 0.05 to 0.995."""
    for film in (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.995):
        ratio = (film**-TRANSITION - 1.0) ** (1.0 / TRANSITION)
        assert starved_film(ratio, 1.0) / ratio == pytest.approx(film, rel=1e-12)
        assert tuple(layer_couple_shares(ratio)) == pytest.approx(tuple(couple_shares(film)), rel=0.11)


def test_a_layer_is_all_that_a_starved_contact_has_and_nothing_to_a_thin_film() -> None:
    assert starved_film(1e-4, 1e-6) == pytest.approx(1e-6, rel=1e-6)
    assert starved_film(1e-7, 1e-5) == pytest.approx(1e-7, rel=1e-6)
    assert tuple(layer_couple_shares(1e-3)) == pytest.approx((1.0, 1.0), abs=1e-6)


def test_couple_of_a_settled_grease_falls_with_viscosity_as_the_replenishment_factor() -> None:
    """SKF (2018): exp(-6e-8 nu n (d + D) sqrt(6 / (2 (D - d)))) for a 130 x 230 bearing at 1165 rpm.

    Between 31 and 394 mm2/s, that is 70 and 20 deg C; the film of a loaded roller as in the model.
    """
    exponent = 6e-8 * 1165.0 * 360.0 * math.sqrt(6.0 / 200.0)
    wanted = math.exp(-exponent * (394.0 - 31.0))
    shares = []
    for viscosity, film in ((0.027, 0.46e-6), (0.343, 2.4e-6)):
        shares.append(layer_couple_shares(film / layer_thickness(0.6e-6, viscosity, 5.53)).elastic)
    assert shares[1] / shares[0] == pytest.approx(wanted, rel=0.15)
