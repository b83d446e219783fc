"""A row or a roller that is not there: no contact, no weight, no energy, and the others carry its share."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.base.errors import ValidityError
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    AXIS,
    CAGE_BODY,
    CONE_BODY,
    ENERGY_KINETIC,
    MOMENTUM,
    POSITION,
    RATE,
    VELOCITY,
)
from beardyn_core.physics.statics.static import solve
from beardyn_core.scene.defect import MissingRoller
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.rig import Rig
from test.kernels.states import shaken
from test.runs import advance_blocks, constant_load, started
from test.scenes import SPEED, scene_with, standard_scene

Float = NDArray[np.float64]

GONE = (MissingRoller(0, 0), MissingRoller(0, 16), MissingRoller(1, 5))
PROP = (1.0e9, 5.0e5)
RADIAL = (0.0, 0.0, 8.0e4)
BLOCKS = 10


def without_rollers(tier: str = "full") -> Scene:
    """The standard scene with three rollers missing, one of them in the middle of the load zone."""
    return replace(scene_with(), missing_rollers=GONE, tier=tier)


def one_row(tier: str = "full") -> Scene:
    """The standard scene with the inboard row alone on a journal that is propped axially."""
    scene = scene_with(axial_prop_stiffness=PROP[0], axial_prop_damping=PROP[1])
    numerics = replace(scene.numerics, steps_per_sample=4 if tier == "full" else 1)
    return replace(scene, rows=1, tier=tier, numerics=numerics)


SCENES = {"three missing rollers": without_rollers, "one row": one_row}


@cache
def blocks(name: str, tier: str = "full") -> tuple[Block, ...]:
    return advance_blocks(SCENES[name](tier), constant_load(RADIAL, SPEED), BLOCKS)


@pytest.mark.parametrize("width", [8, 1])
@pytest.mark.parametrize("missing", [(), ((0, 0), (0, 1), (1, 16))])
@pytest.mark.parametrize("rows", [1, 2])
def test_every_roller_has_one_lane_and_comes_back_from_it(
    rows: int, missing: tuple[tuple[int, int], ...], width: int
) -> None:
    kept = tuple(place for place in missing if place[0] < rows)
    arrangement = Arrangement(17, width, rows, kept)
    values = np.arange(rows * 17, dtype=float).reshape(rows, 17)
    lanes = arrangement.to_lanes(values)
    assert lanes.shape == (arrangement.block_count, width)
    assert arrangement.mask.sum() == rows * 17 - len(kept)
    there = arrangement.present
    np.testing.assert_array_equal(arrangement.to_rollers(lanes)[there], values[there])
    # what a masked lane shows is a roller that is there, of its own row
    assert there[arrangement.row, arrangement.roller].all()
    counted = np.sort(lanes[arrangement.mask > 0.0])
    np.testing.assert_array_equal(counted, values[there])


@pytest.mark.parametrize("width", [8, 1])
@pytest.mark.parametrize("name", SCENES)
def test_what_is_there_exchanges_momentum_with_the_rings(name: str, width: int) -> None:
    """To rounding, as with all rollers; only their weight is counted."""
    assert_momentum_is_exchanged(shaken(51, width, SCENES[name]()))


@pytest.mark.parametrize("name", SCENES)
def test_energy_balance_closes(name: str) -> None:
    audit = blocks(name)[-1].audit
    assert audit is not None
    assert audit.residual < 1e-3
    assert audit.dissipated > 0.1


@pytest.mark.parametrize("name", SCENES)
def test_kinetic_energy_is_that_of_the_rollers_that_are_there(name: str) -> None:
    rig = Rig.at_equilibrium(SCENES[name]())
    rig.run(1)
    roller, cage = rig.parameters.roller, rig.parameters.effects.cage
    assert cage is not None
    total = 0.5 * cage.polar_inertia * (rig.state.bodies[CAGE_BODY:, RATE] ** 2).sum()
    for field in np.moveaxis(rig.fields(), 0, -1)[rig.arrangement.present]:
        momentum, axis = field[MOMENTUM : MOMENTUM + 3], field[AXIS : AXIS + 3]
        along = float(momentum @ axis) ** 2
        total += 0.5 * roller.mass * (field[VELOCITY : VELOCITY + 3] ** 2).sum()
        total += 0.5 * along / roller.axial_inertia
        total += 0.5 * (float(momentum @ momentum) - along) / roller.transverse_inertia
    assert rig.audit[ENERGY_KINETIC] == pytest.approx(total, rel=1e-3)


def test_one_row_in_balance_is_that_row_of_a_bearing_under_the_same_displacement() -> None:
    """The row does not feel what is not there: loads of row 0 at the pose that one row alone would take."""
    bearing = standard_scene().bearing
    alone = solve(bearing, (0.0, 2.0e4, 8.0e4), end_play=0.0, laminae=6, rows=1)
    assert alone.cup_load.shape == (1, 17)
    angle = bearing.cup_angle
    azimuth = 2.0 * math.pi * np.arange(17) / 17
    normal = np.stack(
        [
            math.cos(angle) * np.sin(azimuth),
            np.full(17, math.sin(angle)),
            math.cos(angle) * np.cos(azimuth),
        ],
        axis=1,
    )
    # what holds the rollers on their places along the pitch circle is 1e-4 of the load, see `solve`
    np.testing.assert_allclose(alone.cup_load[0] @ normal, [0.0, 2.0e4, 8.0e4], atol=2e-4 * 8.0e4)
    # both rows under a load that leaves row 1 open
    pressed = (0.0, 6.0e4, 1.0e4)
    both = solve(bearing, pressed, end_play=0.0, laminae=6, rows=2)
    assert both.cone_load[1].max() == 0.0
    one = solve(bearing, pressed, end_play=0.0, laminae=6, rows=1)
    np.testing.assert_allclose(one.cup_load[0], both.cup_load[0], rtol=1e-8)
    np.testing.assert_allclose(one.displacement, both.displacement, rtol=1e-7, atol=1e-13)


def test_static_loads_of_missing_rollers_are_zero_and_the_others_carry_the_force() -> None:
    bearing = standard_scene().bearing
    places = tuple((each.row, each.roller) for each in GONE)
    whole = solve(bearing, RADIAL, end_play=0.0, laminae=6)
    some = solve(bearing, RADIAL, end_play=0.0, laminae=6, missing=places)
    for row, roller in places:
        assert some.cup_load[row, roller] == some.cone_load[row, roller] == some.rib_load[row, roller] == 0.0
    azimuth = 2.0 * math.pi * np.arange(17) / 17
    carried = math.cos(bearing.cup_angle) * (some.cup_load * np.cos(azimuth)).sum()
    assert carried == pytest.approx(RADIAL[2], rel=2e-4)
    assert some.displacement[2] > 1.1 * whole.displacement[2]
    assert some.cup_load.max() > 1.1 * whole.cup_load.max()


def test_a_single_row_without_axial_support_is_refused_with_the_way_out() -> None:
    with pytest.raises(ValidityError, match="axial_prop_stiffness_MN_per_m"):
        solve(standard_scene().bearing, RADIAL, end_play=0.0, rows=1)


def test_prop_takes_the_thrust_of_the_single_row() -> None:
    """Rest: the prop's spring carries what the row thrusts out, the cup feels load and thrust."""
    scene = one_row()
    block = blocks("one row")[-1]
    thrust = block.force[:, 1].mean()
    angle = scene.bearing.cup_angle
    cup = np.linalg.norm(block.contacts[:, 0, :, 0, 3:6], axis=-1).sum(axis=1).mean()
    assert thrust == pytest.approx(math.sin(angle) * cup, rel=0.03)
    place = block.body_pose[:, 1, 1].mean()
    assert PROP[0] * place == pytest.approx(-thrust, rel=0.03)
    weight = 9.80665 * (17 * scene.bearing.roller_mass + scene.bearing.cage.mass)
    assert block.force[:, 2].mean() == pytest.approx(RADIAL[2] - weight, rel=2e-3)


def test_prop_is_a_spring_with_a_damper_along_the_axle() -> None:
    """A journal that touches nothing swings with sqrt(k/m) and the prop's decay; the audit knows."""
    stiffness, damping = 4.0e7, 6.0e3
    scene = scene_with(axial_prop_stiffness=stiffness, axial_prop_damping=damping, end_play=4e-3)
    rig = Rig.at_equilibrium(scene, (0.0, 0.0, 0.0), 0.0)
    rig.state.rollers[:, VELOCITY : VELOCITY + 3] = 0.0
    p = rig.parameters
    p = p._replace(cup=p.cup._replace(gap=1.0), cone=p.cone._replace(gap=1.0))
    assert p.effects.rib is not None
    rib = p.effects.rib._replace(distance=p.effects.rib.distance + 1.0)
    rig.parameters = p._replace(effects=p.effects._replace(rib=rib))
    rig.state.bodies[CONE_BODY, POSITION + 1] = 1e-4
    mass = p.mounting.journal_mass
    decay, steps = 0.5 * damping / mass, 2000
    rate = math.sqrt(stiffness / mass - decay**2)
    time = steps * p.step
    rig.run(steps)
    phase = math.exp(-decay * time) * (math.cos(rate * time) + decay / rate * math.sin(rate * time))
    # half a step of the leapfrog is a first order error of phase
    assert rig.state.bodies[CONE_BODY, POSITION + 1] == pytest.approx(1e-4 * phase, abs=1e-4 * rate * p.step)


@pytest.mark.parametrize("name", SCENES)
def test_blocks_show_nothing_of_what_is_missing(name: str) -> None:
    scene, block = SCENES[name](), blocks(name)[-1]
    absent = np.zeros((2, 17), dtype=bool)
    absent[scene.rows :] = True
    for each in scene.missing_rollers:
        absent[each.row, each.roller] = True
    assert np.all(block.contacts[:, absent] == 0.0)
    assert np.all(np.abs(block.contacts[:, ~absent]).max(axis=(0, 2, 3)) > 0.0)
    assert block.contacts.shape[1:3] == (2, 17)
    for shown in ("body_pose", "body_twist", "roller_angle", "roller_speed", "cage_speed"):
        assert np.isfinite(getattr(block, shown)).all()
    # the places stay in order around the row
    pitch = np.diff(block.roller_angle[-1], axis=1)
    assert np.all(np.abs(pitch - 2.0 * math.pi / 17) < 0.02)


def test_truth_tells_missing_rollers_and_rows() -> None:
    truth = Twin(without_rollers()).truth()
    assert [(fault["kind"], fault["row"], fault["roller"]) for fault in truth["faults"]] == [
        ("missing", each.row, each.roller) for each in GONE
    ]
    assert "faults" in truth["effects"]
    assert Twin(one_row()).truth()["rows"] == 1


def test_a_missing_roller_makes_the_force_pulsate_with_the_cage() -> None:
    """Once a turn of the cage the gap passes the load zone: the deflection is larger there."""
    found = blocks("three missing rollers", "quasistatic")
    assert found[-1].force[:, 2].mean() == pytest.approx(RADIAL[2], rel=0.02)
    place = np.concatenate([block.body_pose[:, 1, 2] for block in found])
    assert np.ptp(place) > 0.03 * abs(place.mean())


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("tier", ["lumped", "quasistatic"])
def test_fast_tiers_agree_with_the_full_one(name: str, tier: str) -> None:
    """Mean force to 1 %, deflection to 5 %: the lumped spring is that much off on its own."""
    fast, full = blocks(name, tier), blocks(name)

    def means(run: tuple[Block, ...]) -> tuple[Any, float]:
        late = run[BLOCKS // 2 :]
        force = np.concatenate([block.force[:, :3] for block in late]).mean(axis=0)
        return force, float(np.concatenate([block.body_pose[:, 1, 2] for block in late]).mean())

    (force, deflection), (reference, of_full) = means(fast), means(full)
    np.testing.assert_allclose(force, reference, atol=0.01 * RADIAL[2])
    assert deflection == pytest.approx(of_full, rel=0.05)


def test_snapshot_of_a_bearing_with_missing_rollers_continues_to_the_bit() -> None:
    twin = started(without_rollers(), constant_load(RADIAL, SPEED))
    twin.advance()
    kept = twin.snapshot()
    first = twin.advance()
    twin.restore(kept)
    np.testing.assert_array_equal(twin.advance().force_waveform, first.force_waveform)
