"""What `quasistatic` is expected to miss of the torque where oil is cold."""

from __future__ import annotations

from dataclasses import replace

import pytest

from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.choice import load_scene
from beardyn_core.choice.discretisation_error import least_errors
from beardyn_core.choice.reference_solution import Evidence
from test.choice.test_verified import measured

TIERS = ("full", "quasistatic")


@pytest.mark.slow
@pytest.mark.parametrize("celsius", [70.0, 20.0, -15.0])
def test_what_a_bounded_film_misses_is_expected(celsius: float) -> None:
    """A step keeps films of cold oil thicker than they are, so that they rub less than in `full`."""
    scenes = (load_scene("healthy_80", effects="all", tier=each, duration=0.8) for each in TIERS)
    full, fast = (replace(scene, temperature=celsius + ZERO_CELSIUS) for scene in scenes)
    off = measured(fast, 0.4).torque / measured(full, 0.4).torque - 1.0
    expected = least_errors(Evidence(full), "quasistatic")["torque"]
    assert abs(off) <= expected
    assert expected < 0.3
