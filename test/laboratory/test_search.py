"""The general search: its Jacobian, its three ways, its compiled twin, and where it must fail."""

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.laboratory import placements
from beardyn_core.laboratory.closed_forms import cylinders_gap
from beardyn_core.laboratory.compiled import batch
from beardyn_core.laboratory.nine_contacts import contacts_of
from beardyn_core.laboratory.placements import RANDOM_CASES, near_start, random_rollers
from beardyn_core.laboratory.search import (
    FORMS,
    LINES,
    LINES_ALONG_NORMAL,
    SURFACE_LINE,
    Pair,
    jacobian,
    numeric_jacobian,
    residual,
    search,
)
from beardyn_core.laboratory.shapes import Cone, Straight, place_along
from test.laboratory.bearings import bearing

NANOMETRE = 1e-9


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.name)
def test_jacobian_is_the_derivative_of_the_conditions(form) -> None:
    names = {SURFACE_LINE: "circle, cylinder", LINES: "circle, circle", LINES_ALONG_NORMAL: "circle, circle"}
    case = next(case for case in RANDOM_CASES if case.name == names.get(form, "sphere, cylinder"))
    pair = replace(case.draw(np.random.default_rng(2)), form=form)
    at = near_start(pair) + 0.1
    np.testing.assert_allclose(
        jacobian(pair, at), numeric_jacobian(pair, at, residual(pair, at)), atol=2e-6, rtol=1e-5
    )


@pytest.mark.parametrize("case", RANDOM_CASES, ids=lambda case: case.name)
def test_three_ways_and_the_compiled_search_agree(case) -> None:
    random = np.random.default_rng(5)
    pairs = [case.draw(random) for _ in range(6)]
    starts = [near_start(pair) for pair in pairs]
    for analytic in (True, False):
        parameters, iterations, gaps = batch(pairs, starts).solve(analytic=analytic)
        for i, pair in enumerate(pairs):
            plain = search(pair, starts[i], "analytic" if analytic else "numeric")
            assert plain.converged == (iterations[i] >= 0)
            assert plain.gap == pytest.approx(gaps[i], abs=1e-3 * NANOMETRE)
            np.testing.assert_allclose(parameters[i, : plain.parameters.size], plain.parameters, atol=1e-8)
    by_root_finder = [search(pair, start, "fsolve") for pair, start in zip(pairs, starts, strict=True)]
    good = [found for found in by_root_finder if found.converged]
    assert len(good) >= 5  # now and then it stalls
    newton = [search(pair, found.parameters) for pair, found in zip(pairs, by_root_finder, strict=True)]
    for found, near in zip(by_root_finder, newton, strict=True):
        if found.converged:
            assert found.gap == pytest.approx(near.gap, abs=1e-3 * NANOMETRE)


@pytest.mark.parametrize("name", ["sphere, sphere", "circle, sphere", "circle, circle", "line, line"])
def test_a_near_start_finds_the_least_distance(name: str) -> None:
    case = next(case for case in RANDOM_CASES if case.name == name)
    random = np.random.default_rng(8)
    for _ in range(20):
        pair = case.draw(random)
        found = search(pair, near_start(pair))
        assert found.converged
        assert found.gap == pytest.approx(case.truth(pair.p, pair.q), abs=NANOMETRE)


def test_a_far_start_ends_at_another_stationary_pair_and_counts_as_failure() -> None:
    random = np.random.default_rng(9)
    case = next(case for case in RANDOM_CASES if case.name == "sphere, sphere")
    elsewhere = 0
    for _ in range(20):
        pair = case.draw(random)
        found = search(pair, placements.random_start(pair, random))
        elsewhere += found.converged and abs(found.gap - case.truth(pair.p, pair.q)) > NANOMETRE
    assert elsewhere > 5


def test_closed_form_of_crossed_cylinders_is_the_least_of_many_points() -> None:
    random = np.random.default_rng(4)
    case = next(case for case in RANDOM_CASES if case.name == "cylinder, cylinder")
    for _ in range(3):
        pair = case.draw(random)
        assert isinstance(pair.p, Cone)
        assert isinstance(pair.q, Cone)
        ends = np.linspace(-0.5, 0.5, 2001)[:, None]
        p = pair.p.place.origin + ends * pair.p.place.pole
        arm = p - pair.q.place.origin
        across = arm - (arm @ pair.q.place.pole)[:, None] * pair.q.place.pole
        scanned = np.sqrt((across**2).sum(axis=1)).min() - pair.p.radius - pair.q.radius
        assert cylinders_gap(pair.p, pair.q) == pytest.approx(scanned, abs=1e-5)


def test_parallel_lines_have_no_single_pair_and_the_search_says_so() -> None:
    line = Straight(place_along((0, 0, 0), (0, 0, 1)))
    other = Straight(place_along((0.1, 0, 0.3), (0, 0, 1)))
    pair = Pair(line, other, LINES)
    assert not search(pair, [0.0, 0.0]).converged
    assert batch([pair], [np.zeros(2)]).solve()[1][0] == -1


def test_a_start_that_is_not_a_number_does_not_converge() -> None:
    contact = contacts_of(bearing(), next(random_rollers(bearing(), 1, 1)))[0]
    start = np.full(contact.start.size, np.nan)
    assert not search(contact.pair, start).converged
    assert batch([contact.pair], [start]).solve()[1][0] == -1
