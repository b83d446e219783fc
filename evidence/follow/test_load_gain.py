"""A load buys what its covariance with the errors is worth, and nothing where there is none."""

from __future__ import annotations

import numpy as np
import pytest

from evidence.follow.load_gain import NAMES, Errors, _verdict, row_of


def errors(slope: float, count: int = 400) -> Errors:
    random = np.random.default_rng(2)
    load = np.log(random.uniform(40e3, 90e3, count))
    error = slope * (load - load.mean()) + random.normal(0.0, 1.0, count) + 3.0
    return Errors(error, load, np.repeat(np.arange(count // 2), 2).astype(str))


def test_what_follows_from_the_load_goes_away_and_the_rest_stays() -> None:
    found = errors(8.0)
    left = found.conditioned(0.0)
    assert np.std(left) == pytest.approx(1.0, rel=0.1)
    assert np.std(found.centred()) > 1.8
    assert np.std(left) < np.std(found.conditioned(0.5)) < np.std(found.centred())


def test_without_a_covariance_the_load_buys_nothing_and_the_page_says_so() -> None:
    found = errors(0.0)
    assert np.std(found.conditioned(0.03)) == pytest.approx(np.std(found.centred()), rel=0.02)
    said = _verdict({name: errors(8.0 if name == "lateral_load" else 0.0) for name in NAMES})
    assert "mean lateral load on the journal: 5" in said
    assert "end play of the bearing as mounted: nothing" in said
    assert row_of("end_play", found).count("|") == 9
    few = Errors(found.error[:4], found.load[:4], found.bearing[:4])
    assert "| 4 | - |" in row_of("width", few)
