"""The rolling couple of a starved inlet, beside other solutions of the same inlet."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.optimize import brentq

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
