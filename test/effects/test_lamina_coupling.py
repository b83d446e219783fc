"""Coupled laminae in the whole bearing: none, of no strength, and in earnest.

Every set of effects is compiled afresh (half a minute each), hence slow.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.profile import Profile
from beardyn_core.effects import EffectSet, LaminaCoupling
from test.effects.fresh_kernels import run_afresh
from test.kernels.rig import Float, Rig
from test.runs import Record, record
from test.scenes import scene_with, standard_scene

pytestmark = pytest.mark.slow


def with_coupling(coupling: LaminaCoupling | None) -> EffectSet:
    return replace(EffectSet(), lamina_coupling=coupling)


@cache
def signals(coupling: LaminaCoupling | None, laminae: int = 6) -> Float:
    """20 ms from equilibrium at 80 kN."""
    rig = Rig.at_equilibrium(scene_with(with_coupling(coupling), laminae=laminae))
    return rig.run(2048)[0]


def test_coupling_of_no_strength_is_none() -> None:
    """To 1e-12 of the load after 10 steps; after 2048 what rounding has grown to in a bearing that slips."""
    none, zero = signals(None), signals(LaminaCoupling(strength=0.0))
    np.testing.assert_allclose(zero[:10, :3], none[:10, :3], rtol=0.0, atol=1e-12 * 8e4)
    np.testing.assert_allclose(zero[:, :3], none[:, :3], rtol=0.0, atol=1e-8 * 8e4)


def test_coupling_is_felt() -> None:
    assert np.abs(signals(LaminaCoupling())[:, :3] - signals(None)[:, :3]).max() > 1.0


def test_absent_coupling_leaves_no_code() -> None:
    without, coupled = (
        run_afresh(scene_with(with_coupling(each)), 1).instructions for each in (None, LaminaCoupling())
    )
    assert without < coupled


@cache
def run(kind: str, coupling: LaminaCoupling | None, laminae: int) -> Record:
    scene = standard_scene()
    assert isinstance(scene.bearing, Bearing)
    pressure = 1.0e9 if kind == "lundberg" else None
    return record(
        replace(
            scene,
            bearing=replace(scene.bearing, profile=Profile(kind, design_pressure=pressure)),
            effects=with_coupling(coupling),
            numerics=replace(scene.numerics, laminae=laminae),
        ),
        0.4,
    )


@pytest.mark.parametrize(
    ("kind", "laminae"), [("straight", 6), ("lundberg", 6), ("lundberg", 20), ("iso_16281", 20)]
)
def test_energy_audit_closes_with_coupled_laminae(kind: str, laminae: int) -> None:
    """The loads are the gradient of an energy, but for laminae about to come free: ADORE.jl has 0.02 %."""
    coupled = run(kind, LaminaCoupling(), laminae)
    assert coupled.status == 0
    assert coupled.residual < 2e-4


def test_coupled_bearing_starts_in_equilibrium_and_carries_the_load() -> None:
    """No transient of the start: the force of the first 20 ms stays within 0.5 % of the load."""
    coupled = run("lundberg", LaminaCoupling(), 20)
    force = coupled.trend("force")[:, 2]
    assert np.abs(force / force.mean() - 1.0).max() < 5e-3
    assert abs(force.mean()) == pytest.approx(8e4, rel=5e-3)
