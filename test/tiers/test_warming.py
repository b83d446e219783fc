"""Fast tiers warm by the torque of every source that they have, without an energy audit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.steady_heat import steady_heat, torque_by_source
from beardyn_core.effects import Thermal
from beardyn_core.physics.bodies.layout import SIGNAL_TORQUE
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.thermal import NODES
from beardyn_core.run import Simulation, start
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from test.runs import assert_same

FAST = ("lumped", "quasistatic")
BLOCK_S = 0.02


def scene_of(tier: str, thermal: Thermal | None, blocks: int, name: str = "static_80kN") -> Scene:
    scene = load_scene(name, effects="all", tier=tier)
    return replace(scene, effects=replace(scene.effects, thermal=thermal), duration=blocks * BLOCK_S)


def ended(scene: Scene) -> Simulation:
    simulation = start(scene)
    for _ in simulation.blocks(simulation.twin.blocks_at_once):
        pass
    return simulation


def lost_by_source(twin: Twin) -> dict[str, float]:
    assert twin._warmth is not None
    return dict(zip(LOSS_NAMES, twin._warmth.lost.tolist(), strict=True))


@pytest.mark.parametrize("tier", FAST)
def test_what_warms_the_parts_is_the_work_of_the_shaft(tier: str) -> None:
    """Losses of all sources against the torque of every step; what ribs lose is held for 2.5 ms."""
    twin = start(scene_of(tier, Thermal(), 10)).twin
    speed, work = circumstances(twin.scene).typical.speed, 0.0
    for _ in range(10):
        twin.advance()
        work -= float(twin.step_signals[: twin._steps, SIGNAL_TORQUE].mean()) * speed * BLOCK_S
    assert sum(lost_by_source(twin).values()) == pytest.approx(work, rel=1e-3)
    assert work > 100.0


@pytest.mark.parametrize("tier", FAST)
def test_every_source_loses_what_a_static_equilibrium_says(tier: str) -> None:
    """Pockets of quasistatic rollers rub more: cages that may move are knocked about."""
    simulation = ended(scene_of(tier, Thermal(), 20))
    scene = simulation.twin.scene
    case = circumstances(scene).typical
    expected, lost = torque_by_source(scene, case), lost_by_source(simulation.twin)
    turned = abs(case.speed) * scene.duration
    for name in ("rolling_resistance", "rib", "drag", "seal"):
        assert lost[name] / turned == pytest.approx(expected[name], rel=0.03), name
    assert 0.9 < lost["pocket"] / turned / expected["pocket"] < 3.0
    silent = {"raceway_sliding", "contact_damping", "small_rib", "cage_land", "structure"}
    assert all(lost[name] == 0.0 for name in silent)


@pytest.mark.parametrize("tier", FAST)
def test_temperatures_are_those_of_the_balance(tier: str) -> None:
    """A run that warms 20 000 times as fast as it turns, over five time constants of the axlebox.

    The balance has no cages that are knocked about, as `lumped` has none; what rubs in the pockets of
    `quasistatic` rollers warms the bearing by a few per cent more.
    """
    scene = scene_of(tier, Thermal(time_scale=2e4), 40)
    cold = replace(scene, temperature=293.15, end_play=1e-4)
    twin, expected = ended(cold).twin, steady_heat(cold)
    assert twin._warmth is not None
    close = 0.03 if tier == "lumped" else 0.1
    for node, name in enumerate(NODES):
        rise = twin._warmth.temperature[node] - 293.15
        assert rise == pytest.approx(expected.rise(name), rel=0.2 if name == "cages" else close), name
    assert expected.rise("axlebox") > 10.0


@pytest.mark.parametrize("tier", FAST)
def test_warm_parts_thin_the_film_and_close_the_end_play(tier: str) -> None:
    scene = replace(scene_of(tier, Thermal(time_scale=2e3), 30), temperature=303.15, end_play=1e-4)
    film = replace(scene.effects.film, supply="flooded") if scene.effects.film is not None else None
    twin = start(replace(scene, effects=replace(scene.effects, film=film))).twin
    blocks = [twin.advance() for _ in range(30)]
    first, last = (block.contacts[:, :, :, :2, 7] for block in (blocks[2], blocks[-1]))
    assert 0.0 < float(last[last > 0.0].mean()) < 0.9 * float(first[first > 0.0].mean())
    assert twin._warmth is not None
    assert twin._warmth.play < 1e-4
    cup = twin._kernel_parameters.base.cup
    assert cup.gap == pytest.approx(0.5 * twin._warmth.play * cup.sine, rel=1e-12)


@pytest.mark.parametrize("tier", FAST)
def test_warming_at_the_temperature_of_the_air_changes_nothing(tier: str) -> None:
    """A huge heat capacity: the blocks are those without the effect, bit by bit."""
    idle = Thermal(ambient=load_scene("static_80kN").temperature, time_scale=1e-12)
    warm, plain = (start(scene_of(tier, thermal, 11)).twin for thermal in (idle, None))
    for _ in range(11):
        one, two = warm.advance(), plain.advance()
        assert one.temperature is not None
        assert_same(replace(one, temperature=None), two)


@pytest.mark.parametrize("tier", FAST)
def test_a_warming_run_in_long_blocks_and_from_a_snapshot_has_the_same_bits(tier: str) -> None:
    """Long blocks end where temperatures are advanced."""
    scene = replace(scene_of(tier, Thermal(time_scale=3.0), 12), end_play=1e-4, temperature=293.15)
    one, long = start(scene).twin, start(scene).twin
    assert long.blocks_at_once == 3
    long.advance(2)
    assert long.blocks_at_once == 1
    with pytest.raises(ValueError, match="blocks is 2; allowed is 1 to 1"):
        long.advance(2)
    kept, apart = long.snapshot(), [1, 3, 3, 3]
    ends = [long.advance(count) for count in apart]
    blocks = [one.advance() for _ in range(12)]
    assert ends[-1].temperature is not None
    assert blocks[-1].temperature is not None
    assert one._warmth is not None
    assert one._warmth.play < 1e-4
    np.testing.assert_array_equal(ends[-1].temperature, blocks[-1].temperature)
    torque = np.concatenate([block.shaft_torque for block in blocks[-3:]])
    np.testing.assert_array_equal(ends[-1].shaft_torque, torque)
    fresh = start(scene).twin
    fresh.restore(kept)
    for before, count in zip(ends, apart, strict=True):
        assert_same(fresh.advance(count), before)
