"""In service: healthy bearings are left alone and faulty ones named, whatever else the sensor measures."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.run import blocks
from evidence.service.study import PARTS, SPANS_HZ, levels, receive, service_names, with_parts
from test.examples import fast_ones


@pytest.mark.parametrize("name", fast_ones(service_names(), 1, 5))
def test_the_monitor_says_what_is_so(name: str) -> None:
    """Every analysis of 3 s."""
    scene = load_scene(name, tier="quasistatic")
    truth = scene.defects[0].on if scene.defects else "healthy"
    assert set(receive(scene, 3.0).verdicts) == {truth}


@pytest.mark.parametrize("part", fast_ones(PARTS, 0))
def test_every_part_of_a_background_is_received(part: str) -> None:
    """The same run with it reads otherwise, by more than the noise of the sensor in some band."""
    scene = load_scene("service_high_speed", tier="quasistatic")
    without, with_it = (
        np.concatenate([block.vibration[0].acceleration[:, 2] for block in blocks(each, 3.0)])
        for each in (with_parts(scene), with_parts(scene, part))
    )
    rate, density = scene.sensors[0].rate, scene.sensors[0].noise_density
    noise = [density * np.sqrt(high - low) for low, high in SPANS_HZ]
    change = levels(with_it - without, rate)
    assert max(np.divide(change, noise)) > 2.0
