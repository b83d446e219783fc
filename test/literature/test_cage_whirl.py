"""Cage whirl of a tapered roller bearing under pure axial load: trends of published measurements."""

from __future__ import annotations

from dataclasses import replace

import pytest

from beardyn_core.study.validation.cage_whirl import WhirlCase, cage_whirl
from test.kernels.rig import standard_scene

pytestmark = pytest.mark.slow


def test_cage_whirls_under_axial_load_up_to_the_radial_play_of_its_pockets() -> None:
    """Physics anchor D28: whirl is present, grows with speed and axial load, ends at the radial play.

    Without weight across the axis, which pins a cage of 0.4 kg at these speeds. The growth with the load is
    found at 60 rad/s; at higher speeds ours does not grow with it, nor does a combined load even the spacing
    (docs/model.md). Two of the runs are a factor above the others, so 2 is a margin, not a fit.
    """
    scene = standard_scene()
    scene = replace(scene, effects=replace(scene.effects, gravity=None))
    slow, loaded, fast = WhirlCase(60.0, 2e3), WhirlCase(60.0, 4e4), WhirlCase(480.0, 2e3)
    found = cage_whirl(scene, [slow, loaded, fast])
    assert found.amplitude[0] > 1e-6
    assert found.amplitude[1] > 2.0 * found.amplitude[0]
    assert found.amplitude[2] > 2.0 * found.amplitude[0]
    # a bar yields some micrometres under the impacts that stop the cage
    assert found.reach.max() < found.radial_play + 10e-6
    assert found.amplitude[2] > 0.8 * found.radial_play
    # fully grown whirl goes round with the cage
    assert found.frequency[2] == pytest.approx(1.0, abs=0.05)
