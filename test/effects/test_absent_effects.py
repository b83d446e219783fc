"""Each member of the effect set as ``None``: it compiles, its effect is gone, and it costs nothing.

Every variant is compiled afresh (half a minute each), hence slow.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.effects import ContactDamping, EffectSet
from beardyn_core.physics.bodies.layout import (
    AXIAL,
    CAGE_BODY,
    CONE,
    CUP,
    ENERGY_EXTERNAL,
    ENERGY_LOST,
    LINEAR,
    OUTPUT_FILM,
    OUTPUT_SLIP,
    POCKET,
    RADIUS,
    RATE,
    RIB,
    ROLLER_STATES,
    SIGNAL_TORQUE,
)
from beardyn_core.physics.bodies.losses import LOSSES
from test.effects.fresh_kernels import Variant, run_afresh
from test.kernels.rig import Float, Rig
from test.scenes import scene_with

pytestmark = pytest.mark.slow

MEMBERS = EffectSet().names()  # what is absent by default has tests of its own
STEPS = 512


def effects_without(member: str | None) -> EffectSet:
    return EffectSet() if member is None else replace(EffectSet(), **{member: None})


@cache
def variant(member: str | None) -> Variant:
    return run_afresh(scene_with(effects_without(member)), STEPS)


@pytest.mark.parametrize("member", MEMBERS)
def test_absent_effect_compiles_and_runs(member: str) -> None:
    found = variant(member)
    assert np.isfinite(found.signals).all()
    assert np.isfinite(found.rig.fields()[:ROLLER_STATES]).all()
    assert member not in found.rig.scene.effects.names()
    if member != "rib":  # without it the rollers leave the load zone sideways
        assert found.signals[:, 2].mean() == pytest.approx(8e4, rel=0.02)


@pytest.mark.parametrize("member", MEMBERS)
def test_absent_effect_leaves_no_code(member: str) -> None:
    """A film without a traction that asks for it is still an effect: only smaller code counts."""
    assert variant(member).instructions < variant(None).instructions


def test_no_damping_loses_no_energy_in_normal_direction() -> None:
    with_, without = variant(None), variant("contact_damping")
    assert without.rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].sum() > 0.0
    assert not np.array_equal(with_.signals, without.signals)


def test_no_traction_means_forces_along_the_normal_of_the_cup() -> None:
    """A normal of the cup meets its axis: no moment about it. With traction the lever is micrometres."""

    def lever(found: Variant) -> Float:
        fields = found.rig.fields()
        force, arm = found.output(CUP, 0, 3), found.output(CUP, 3, 3)
        load = np.linalg.norm(force, axis=0)
        moment = (fields[RADIUS] + arm[0]) * force[1] - arm[1] * force[0]
        return np.abs(moment)[load > 1e3] / load[load > 1e3]

    assert lever(variant("traction")).max() < 1e-8
    assert lever(variant(None)).max() > 1e-6


def test_no_traction_leaves_the_rib_to_brake_the_shaft() -> None:
    """Raceways no longer give back what the rib takes: rib friction times its radius, 15 to 25 N m."""
    assert -30.0 < variant("traction").signals[:, SIGNAL_TORQUE].mean() < -10.0


def test_no_film_means_dry_friction_and_no_thickness() -> None:
    without = variant("film")
    np.testing.assert_array_equal(without.output(CUP, OUTPUT_FILM), 0.0)
    assert np.all(variant(None).output(CUP, OUTPUT_FILM) > 1e-8)
    assert without.rig.parameters.effects.coulomb is not None
    assert without.rig.parameters.effects.mixed is None


def test_no_rib_means_no_rib_force_and_rollers_that_move_out() -> None:
    np.testing.assert_array_equal(variant("rib").output(RIB, 0, 3), 0.0)
    assert np.abs(variant(None).output(RIB, 0, 3)).max() > 100.0
    outward = variant("rib").rig.fields()[AXIAL] - variant(None).rig.fields()[AXIAL]
    assert outward.max() > 1e-5


def test_no_cage_means_no_pocket_force_and_a_cage_that_coasts() -> None:
    without = variant("cage")
    np.testing.assert_array_equal(without.output(POCKET, 0, 3), 0.0)
    np.testing.assert_array_equal(without.rig.state.bodies[CAGE_BODY:, LINEAR : LINEAR + 3], 0.0)
    assert np.ptp(without.rig.state.bodies[CAGE_BODY:, RATE]) == 0.0


def test_no_gravity_means_the_cup_gets_the_whole_load() -> None:
    """Rollers and cages weigh 84 N: the mean cup force differs by that."""
    difference = variant("gravity").signals[:, 2].mean() - variant(None).signals[:, 2].mean()
    assert 0.0 < difference < 200.0


def test_no_audit_changes_no_motion() -> None:
    """Bookkeeping only: states agree to rounding, the energies are not kept."""
    with_, without = variant(None), variant("audit")
    np.testing.assert_allclose(without.signals[:, :3], with_.signals[:, :3], atol=1e-6)
    assert (
        without.rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].sum()
        != with_.rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].sum()
    )
    assert with_.rig.state.energy[ENERGY_EXTERNAL] > 0.0


def test_zero_gravity_is_no_gravity() -> None:
    """Zero amplitude and absence are the same motion to rounding (512 steps)."""
    base = EffectSet()
    assert base.gravity is not None
    zero = Rig.at_equilibrium(scene_with(replace(base, gravity=replace(base.gravity, acceleration=0.0))))
    signals, _, _ = zero.run(STEPS)
    absent = variant("gravity").signals
    np.testing.assert_allclose(signals[:, :3], absent[:, :3], atol=1e-12 * 8e4 * 100)


def test_zero_damping_is_no_damping() -> None:
    zero = Rig.at_equilibrium(scene_with(replace(EffectSet(), contact_damping=ContactDamping(0.0))))
    signals, _, _ = zero.run(STEPS)
    np.testing.assert_allclose(
        signals[:, :3], variant("contact_damping").signals[:, :3], atol=1e-12 * 8e4 * 100
    )


def test_slip_is_kept_without_any_friction() -> None:
    """Rollers without traction keep their spin: the slip of the raceways is not driven down."""
    without = variant("traction")
    for contact in (CUP, CONE):
        assert np.all(np.isfinite(without.output(contact, OUTPUT_SLIP)))
