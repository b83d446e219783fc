"""Rolling resistance, drag and seals: zero amplitude is absence, and absence leaves no code."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.effects import Drag, EffectSet, RollingResistance, Seal
from beardyn_core.physics.bodies.layout import (
    ENERGY_LOST,
    LOSS_DRAG,
    LOSS_ROLLING,
    LOSS_SEAL,
    ROLLER_STATES,
)
from test.effects.fresh_kernels import Variant, run_afresh
from test.kernels.rig import Rig
from test.scenes import scene_with

pytestmark = pytest.mark.slow

STEPS = 64
PRESENT: dict[str, object] = {
    "rolling_resistance": RollingResistance(),
    "drag": Drag(),
    "seal": Seal(),
}
# air alone drags too: no medium is no coefficient
ZERO: dict[str, object] = {
    "rolling_resistance": RollingResistance(supply=0.0),
    "drag": Drag(drag_coefficient=0.0, churning=0.0),
    "seal": Seal(torque=0.0, speed_coefficient=0.0),
}
SOURCES = {"rolling_resistance": LOSS_ROLLING, "drag": LOSS_DRAG, "seal": LOSS_SEAL}


def run(effects: EffectSet) -> Rig:
    rig = Rig.at_equilibrium(scene_with(effects))
    rig.run(STEPS)
    return rig


@cache
def variant(member: str | None) -> Variant:
    """Freshly compiled with one of the effects, or with none."""
    effects = EffectSet() if member is None else replace(EffectSet(), **{member: PRESENT[member]})  # type: ignore[arg-type]
    return run_afresh(scene_with(effects), STEPS)


@pytest.mark.parametrize("member", PRESENT)
def test_zero_amplitude_is_absence(member: str) -> None:
    """States to 1e-12 of their size over 64 steps; the source says zero."""
    zero = run(replace(EffectSet(), **{member: ZERO[member]}))  # type: ignore[arg-type]
    absent = run(EffectSet())
    found, expected = zero.fields()[:ROLLER_STATES], absent.fields()[:ROLLER_STATES]
    scale = np.abs(expected).max(axis=(1, 2), keepdims=True) + 1e-3
    assert np.max(np.abs(found - expected) / scale) < 1e-12
    assert np.abs(zero.state.bodies - absent.state.bodies).max() < 1e-12
    assert zero.state.energy[ENERGY_LOST + SOURCES[member]] == 0.0


@pytest.mark.parametrize("member", PRESENT)
def test_an_effect_loses_energy_and_its_absence_leaves_no_code(member: str) -> None:
    with_, without = variant(member), variant(None)
    assert with_.rig.state.energy[ENERGY_LOST + SOURCES[member]] > 0.0
    assert without.rig.state.energy[ENERGY_LOST + SOURCES[member]] == 0.0
    assert without.instructions < with_.instructions
    assert without.rig.parameters.effects._asdict()[member.replace("_resistance", "")] is None
