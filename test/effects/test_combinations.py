"""Effects in combination: every pair of choices of two factors in one of sixteen scenes.

Every scene compiles a kernel of its own (half a minute each), hence slow.
"""

from __future__ import annotations

from dataclasses import fields
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from beardyn_core.effects import Cage, EffectSet
from beardyn_core.physics.bodies.layout import CAGE_BODY, ENERGY_LOST, POSITION
from beardyn_core.physics.bodies.losses import LOSS_NAMES, LOSSES
from beardyn_core.physics.tiers.status import is_fatal
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from test.effects.combination_scenes import FACTORS, OUTSIDE, ROWS, label, scene_of
from test.effects.covering import pairs_of
from test.kernels.momentum import momenta
from test.kernels.rig import Float
from test.kernels.states import shaken
from test.runs import advance_blocks, constant_load, started
from test.scenes import SPEED

BLOCKS, BLOCKS_WITHOUT_RIB = 5, 2  # nothing but the rib keeps rollers from leaving sideways
HEAVY, LIGHT = 8e4, 4e3
RICH = {"thermal", "faults", "structure", "film", "rolling_resistance"}
EXPLICIT = ("pocket", "cage_land", "suspension")
SOURCES = {
    "rolling_resistance": "rolling_resistance",
    "rib": "rib",
    "drag": "drag",
    "seal": "seal",
    "structure": "structure",
}
EVERY = pytest.mark.parametrize("index", range(len(ROWS)), ids=[label(row) for row in ROWS])


def test_every_pair_of_choices_occurs_and_every_effect_is_a_factor() -> None:
    covered = set().union(*(pairs_of(row) for row in ROWS))
    wanted = sum(len(FACTORS[a]) * len(FACTORS[b]) for a, b in combinations(FACTORS, 2))
    assert len(covered) == wanted
    members = {field.name for field in fields(EffectSet)} - {"thermal"}  # a choice of the audit
    assert members == set(FACTORS) - set(OUTSIDE)


ROUNDING = 1e-15  # of all losses: what is left of those of a contact that has no damper


@cache
def scene(index: int) -> Scene:
    return scene_of(ROWS[index])


@cache
def blocks(index: int, load: float) -> tuple[Block, ...]:
    """All blocks of a run; a fatal status raises."""
    count = BLOCKS if scene(index).effects.rib else BLOCKS_WITHOUT_RIB
    return advance_blocks(scene(index), constant_load((0.0, 0.0, load), SPEED), count)


def carried(given: Scene) -> float:
    """Weight of what stands between journal and cup, [N]."""
    if given.effects.gravity is None:
        return 0.0
    bearing = given.bearing
    cages = 2.0 * bearing.cage.mass if given.effects.cage else 0.0
    return given.effects.gravity.acceleration * (2 * bearing.roller_count * bearing.roller_mass + cages)


def momentum(given: Scene, block: Block, snapshot: int) -> Float:
    """Of journal, cages and rollers at a snapshot; cages that follow the rings have none, [N s]."""
    twist = block.body_twist[snapshot, :, :3]
    cage = given.bearing.cage.mass if isinstance(given.effects.cage, Cage) else 0.0
    return np.asarray(
        given.mounting.journal_mass * twist[1]
        + cage * twist[2:4].sum(axis=0)
        + given.bearing.roller_mass * twist[4:].sum(axis=0)
    )


def unbalanced(given: Scene, run: tuple[Block, ...], load: float) -> float:
    """Load less weight, mean force on the cup and the momentum won, between two snapshots, [N].

    From the end of the first block to 5 ms before the end of the last: the waveform, stamped with its true
    time, comes later by the delay of its filter.
    """
    times = np.concatenate([block.waveform_time_ns for block in run])
    first, last = run[0].snapshot_time_ns[-1], run[-1].snapshot_time_ns[-2]
    within = (times > first) & (times <= last)
    force = np.concatenate([block.force_waveform for block in run])[within, :3].mean(axis=0)
    won = momentum(given, run[-1], -2) - momentum(given, run[0], -1)
    pushed = np.array([0.0, 0.0, load - carried(given)])
    return float(np.linalg.norm(pushed - force - won / (1e-9 * (last - first))))


@pytest.mark.slow
@EVERY
@pytest.mark.parametrize("load", [HEAVY, LIGHT])
def test_combination_runs_and_its_forces_balance(index: int, load: float) -> None:
    """Force on the cup is load less weight less inertia, to 3 N and less than 0.01 % of the load (found).

    Without a rib the rollers slide out and the force falls by half within the block; the ends of the window
    then count: 0.5 % of the load were found.
    """
    run = blocks(index, load)
    for block in run:
        assert not is_fatal(block.status)
        for name, value in block.arrays().items():
            assert np.isfinite(value).all(), name
    share = 1e-4 if scene(index).effects.rib else 0.01
    assert unbalanced(scene(index), run, load) < share * load + 3.0
    # the rollers do carry it
    if scene(index).effects.rib:
        assert run[-1].force[:, 2].mean() > 0.5 * load


@pytest.mark.slow
@EVERY
@pytest.mark.parametrize("load", [HEAVY, LIGHT])
def test_energy_of_a_combination_balances(index: int, load: float) -> None:
    """Found: 7e-3 of what is lost where gaps change between blocks (growth, heat), 7e-4 elsewhere.

    What a growing spall or a growing part does to the springs is the work of no force of the audit: with
    heat it goes with the square of the gaps' change, 1.5e-4 without it and 1.4e-3 with it in one box.
    """
    last = blocks(index, load)[-1].audit
    assert (last is None) == (scene(index).effects.audit is None)
    if last is None:
        return
    assert last.dissipated > 0.0
    effects = scene(index).effects
    growing = effects.thermal is not None or bool(scene(index).defects)
    assert last.residual < (1e-2 if growing else 1e-3)
    lost = dict(zip(LOSS_NAMES, last.losses, strict=True))
    for source, effect in SOURCES.items():
        assert (lost[source] > 0.0) == (getattr(effects, effect) is not None), source
    assert min(last.losses) >= -ROUNDING * last.dissipated


@pytest.mark.slow
@EVERY
def test_what_rollers_win_in_a_combination_the_bodies_lose(index: int) -> None:
    """Momentum and angular momentum of one step, to rounding; all places and velocities are disturbed."""
    rig = shaken(11, scene=scene(index))
    p = rig.parameters
    # cages that follow the rings hand their weight on, which is no pair
    gravity = p.effects.gravity
    weightless = gravity if gravity is None else gravity._replace(acceleration=0.0)
    rig.parameters = p._replace(effects=p.effects._replace(gravity=weightless))
    linear_before, angular_before, size = momenta(rig)
    rig.run(1)
    linear_after, angular_after, _ = momenta(rig)
    wrenches, bodies = rig.work.wrenches, rig.state.bodies
    force, moment = np.zeros(3), np.zeros(3)
    place = 0.0 if p.effects.cage is None else p.effects.cage.place
    for body in range(4):
        lift = np.array([0.0, place * (1.0 if body == 3 else -1.0), 0.0])
        arm = bodies[body, POSITION : POSITION + 3] + (lift if body >= CAGE_BODY else 0.0)
        force += wrenches[body, :3]
        moment += wrenches[body, 3:] + np.cross(arm, wrenches[body, :3])
    assert np.abs(wrenches[:CAGE_BODY, :3]).max() > 1e3
    assert np.abs(linear_after - linear_before + p.step * force).max() < 1e-12 * size
    assert np.abs(angular_after - angular_before + p.step * moment).max() < 1e-13 * size


@pytest.mark.slow
@EVERY
def test_no_force_of_a_combination_makes_energy(index: int) -> None:
    """Source by source and step by step, from a disturbed state; explicit forces in the sum of 200 steps.

    An explicit force (pocket, land, suspension) that turns a velocity round within a step may book a gain.
    """
    rig = shaken(12, scene=scene(index))
    if rig.parameters.effects.audit is None:
        return
    rig.state.energy[:] = 0.0
    spent = np.empty((200, LOSSES))
    for step in range(len(spent)):
        before = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].copy()
        rig.run(1)
        spent[step] = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES] - before
    for source, name in enumerate(LOSS_NAMES):
        if name in EXPLICIT:
            assert spent[:, source].sum() >= 0.0, name
        else:
            assert spent[:, source].min() >= -ROUNDING * spent.sum(), name


@pytest.mark.slow
def test_restart_of_a_rich_combination_is_bit_identical() -> None:
    """A spall that grows, heat, a bent cup, films and a cage that follows the rings."""
    index = next(i for i in range(len(ROWS)) if set(scene(i).effect_names) >= RICH)
    load = constant_load((0.0, 0.0, HEAVY), SPEED)
    one, two = started(scene(index), load), started(scene(index), load)
    one.advance()
    kept = one.snapshot()
    ahead = [one.advance() for _ in range(3)]
    two.restore(kept)
    for block in ahead:
        again = two.advance()
        others = again.arrays()
        for name, array in block.arrays().items():
            np.testing.assert_array_equal(others[name], array, err_msg=name)
        assert again.audit == block.audit
