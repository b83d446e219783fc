"""Spherical roller bearing through the general search, against formulas that know no search."""

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.laboratory.barrel import BARREL_22317, ROWS, solve_barrel
from beardyn_core.laboratory.search import search

FORCE = 25.0e3


@pytest.fixture(scope="module")
def loads():
    return solve_barrel(BARREL_22317, FORCE)


def test_geometry_closes_to_a_usual_clearance() -> None:
    # radial clearance group N of bores over 80 to 100 mm: 55 to 80 um (ISO 5753-1)
    radial = 2.0 * BARREL_22317.clearance / math.cos(BARREL_22317.contact_angle)
    assert 55e-6 < radial < 80e-6


def test_the_centred_roller_shares_its_free_travel() -> None:
    gaps = [
        search(pair, start).gap
        for pair, start in zip(
            BARREL_22317.pairs(np.zeros(3), np.zeros(3)), BARREL_22317.starts(), strict=True
        )
    ]
    np.testing.assert_allclose(gaps, 0.5 * BARREL_22317.clearance, atol=1e-12)


def test_search_finds_the_contact_of_a_tilted_roller_on_the_sphere() -> None:
    """Distance of the arc's centre from the sphere's is all that matters."""
    position = np.array([5e-6, -8e-6, 1e-3])
    pair = BARREL_22317.pairs(position, np.zeros(3))[0]
    found = search(pair, BARREL_22317.starts()[0])
    roller = BARREL_22317.roller(position)
    arc_centre = roller.place.origin + roller.ring_radius * roller.place.east
    expected = BARREL_22317.outer_sphere - roller.radius - np.linalg.norm(arc_centre)
    assert found.converged
    assert found.gap == pytest.approx(expected, abs=1e-12)


def test_roller_loads_carry_the_load(loads) -> None:
    along = loads.load * np.cos(loads.azimuth) * np.cos(loads.contact_angle)
    assert ROWS * along.sum() == pytest.approx(FORCE, rel=1e-3)
    assert loads.balance < 1e-6


def test_roller_loads_are_those_of_the_formula(loads) -> None:
    np.testing.assert_allclose(loads.load, loads.formula, atol=2e-3 * loads.load.max())
    assert loads.displacement == pytest.approx(loads.formula_displacement, rel=1e-3)


def test_contact_angle_changes_under_load_as_little_as_the_difference_needs(loads) -> None:
    pressed = loads.load > 0.0
    change = np.degrees(np.abs(loads.contact_angle - BARREL_22317.contact_angle))
    assert change[pressed].max() < 0.05
    assert change[~pressed].max() == 0.0


def test_without_clearance_the_largest_load_is_sjoevalls() -> None:
    """Harris (2001), Eq. 7.21: 4.37 F / (Z cos alpha) for point contact without clearance."""
    distance = BARREL_22317.centre_distance
    tight = replace(BARREL_22317, outer_sphere=distance + 0.5 * BARREL_22317.roller_diameter + 1e-9)
    loads = solve_barrel(tight, 50.0e3)
    harris = 4.37 * 50.0e3 / (ROWS * tight.roller_count * math.cos(tight.contact_angle))
    assert loads.integral_largest == pytest.approx(harris, rel=0.01)
    assert loads.load.max() == pytest.approx(harris, rel=0.02)


def test_more_load_spreads_over_more_rollers(loads) -> None:
    light = solve_barrel(BARREL_22317, 5.0e3)
    assert (light.load > 0.0).sum() < (loads.load > 0.0).sum()
