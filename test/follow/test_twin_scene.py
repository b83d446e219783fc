"""A twin runs in the state that is known of a bearing."""

from __future__ import annotations

from math import inf, nan

import pytest

from beardyn_core.api.twin_residual import scene_beside
from beardyn_core.base.edge import write_noun
from beardyn_core.config import read_scene
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.fault_location import PartEstimate
from beardyn_core.follow.quantities import BY_NAME

WIDTH = BY_NAME["width"]
READINGS = {
    "number": (Estimate(WIDTH, 6e-3, ((5.5e-3, 6.5e-3), (5e-3, 7e-3))), 6.0),
    "two readings": (Estimate(WIDTH, nan, ((5e-3, inf),) * 2, "at least 5 mm: either", 5e-3), 5.0),
    "nothing": (Estimate(WIDTH, nan, (), "not reported"), None),
}


@pytest.mark.parametrize("reading", READINGS)
def test_the_spall_of_a_twin_has_the_width_that_is_known_or_its_least(reading: str) -> None:
    width, wanted = READINGS[reading]
    part = PartEstimate("cup", 0.98, (("cup",),) * 2)
    scene = scene_beside(
        read_scene("service_high_speed").scene, Estimates(part, (width,), 0.5, 1, 19.0), "quasistatic", 1.65
    )
    faults = write_noun(scene)["defects"]
    assert [each["width_mm"] for each in faults] == ([] if wanted is None else [pytest.approx(wanted)])
