"""Thermal closure of the end play, the thermal network, and a bearing that warms itself."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.thermal import (
    PartTemperatures,
    Temperatures,
    ThermalNetwork,
    end_play_per_kelvin,
    play_change,
)
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.cli import simulate
from beardyn_core.config import load_bearing, scene_text
from beardyn_core.effects import EffectSet, LineFilm, Thermal
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.thermal import BOX_NODE, NODES, heat_shares, moving_air, thermal_network
from beardyn_core.rail.build import load_history
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.messages import decode
from beardyn_core.record.topics import topic
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.study import desk_run
from test.analytic.test_symmetries_of_effects import scene_of
from test.bearings import TAPERED
from test.kernels.rig import Float
from test.runs import assert_same, constant_load, started
from test.scenes import LOAD_80_KN, scene_with, standard_scene, tapered

FILM = 7  # of the contact fields
QUICK = Thermal(time_scale=2e3)


@pytest.mark.parametrize("name", TAPERED)
def test_hot_inside_closes_the_end_play_as_in_the_engineering_manual(name: str) -> None:
    """Timken, Engineering manual, indirect mounting: alpha dT [(D1 cot a1 + D2 cot a2)/2 - L]."""
    bearing = load_bearing(name)
    along = bearing.apex_distance / math.cos(bearing.half_angle)
    raceway = 2.0 * along * math.sin(bearing.cup_angle)
    # contacts stand where the generator is as far from the apex as the roller's mid-length
    apex = 0.5 * bearing.row_spacing - bearing.apex_distance * math.cos(bearing.contact_angle)
    spacing = 2.0 * (apex + along * math.cos(bearing.cup_angle))
    expected = -12e-6 * 10.0 * (raceway / math.tan(bearing.cup_angle) - spacing)
    found = play_change(bearing, PartTemperatures(0.0, 10.0, 10.0), 12e-6)
    assert found == pytest.approx(expected, rel=1e-9)
    assert -2.5e-4 < found < -5e-5


def test_rollers_alone_close_it_by_their_growth_across_both_rows() -> None:
    """alpha dT D over sin(alpha_o) for each row; D at the large end, 6 % above the mean diameter."""
    bearing = tapered(standard_scene())
    found = play_change(bearing, PartTemperatures(0.0, 0.0, 10.0), 12e-6)
    mean = -2.0 * 12e-6 * 10.0 * bearing.roller_diameter / math.sin(bearing.cup_angle)
    assert found == pytest.approx(mean, rel=0.06)
    assert abs(found) > abs(mean)


def test_the_same_warming_everywhere_leaves_the_end_play() -> None:
    """Everything grows alike: gaps grow with the bearing, by a millionth per kelvin of themselves."""
    rate = end_play_per_kelvin(tapered(standard_scene()))
    assert rate.cup + rate.cone + rate.rollers == pytest.approx(0.0, abs=1e-12 * rate.cup)
    assert rate.cup > 0.0 > rate.cone


def test_scene_with_temperatures_runs_at_the_closed_end_play() -> None:
    """Cone 20 K and rollers 15 K above the cup, all above the assembly: 0.2 mm less than mounted."""
    scene = load_scene("static_80kN")
    text = scene_text(scene) + "temperatures: {assembly_C: 20, cup_C: 60, cone_C: 80, rollers_C: 75}\n"
    hot = scene_from_text(text)
    rate = end_play_per_kelvin(tapered(scene))
    expected = scene.end_play + 40.0 * rate.cup + 60.0 * rate.cone + 55.0 * rate.rollers
    assert hot.end_play == pytest.approx(expected, rel=1e-12)
    assert -2.5e-4 < hot.end_play - scene.end_play < -1.5e-4
    assert hot.temperatures == Temperatures(333.15, 353.15, 348.15)
    assert scene_from_text(scene_text(hot)).end_play == hot.end_play


def test_thermal_without_the_audit_is_refused() -> None:
    text = scene_text(load_scene("static_80kN")).replace("audit: {}", "audit: false\n  thermal: true")
    with pytest.raises(InputError, match="thermal needs the audit"):
        scene_from_text(text)


def test_a_fast_tier_needs_no_audit_to_warm() -> None:
    text = scene_text(load_scene("static_80kN")).replace("audit: {}", "audit: false\n  thermal: true")
    scene = scene_from_text(text.replace("tier: full", "tier: lumped"))
    assert scene.tier == "lumped"
    assert scene.effects.thermal is not None
    assert not {"thermal", "audit"} & set(scene.missing_effects)


def random_network(seed: int) -> ThermalNetwork:
    rng = np.random.default_rng(seed)
    between = rng.uniform(0.0, 50.0, (6, 6))
    return ThermalNetwork(rng.uniform(100.0, 1e4, 6), between + between.T, rng.uniform(0.5, 5.0, 6))


@pytest.mark.parametrize("duration", [1e-2, 10.0, 1e4])
def test_step_is_exact_whatever_its_length(duration: float) -> None:
    """Against 4000 steps of fourth order on the equation written out node by node."""
    network = random_network(1)
    heat, ambient = np.array([10.0, 0.0, 300.0, 5.0, -1.0, 40.0]), 290.0
    start = np.array([300.0, 310.0, 350.0, 290.0, 320.0, 295.0])

    def rate(t: Float) -> Float:
        out = np.zeros(6)
        for i in range(6):
            flow = heat[i] - network.to_ambient[i] * (t[i] - ambient)
            for j in range(6):
                if i != j:
                    flow -= network.conductance[i, j] * (t[i] - t[j])
            out[i] = flow / network.capacity[i]
        return out

    t, h = start, min(duration, 400.0) / 4000
    found = network.after(start, heat, ambient, 4000 * h)
    for _ in range(4000):
        k1 = rate(t)
        k2 = rate(t + 0.5 * h * k1)
        k3 = rate(t + 0.5 * h * k2)
        t = t + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rate(t + h * k3))
    np.testing.assert_allclose(found, t, atol=1e-8)
    half = network.after(start, heat, ambient, 0.5 * duration)
    np.testing.assert_allclose(
        network.after(half, heat, ambient, 0.5 * duration),
        network.after(start, heat, ambient, duration),
        atol=1e-9,
    )


def test_heat_in_is_heat_stored_and_heat_carried_off() -> None:
    """Over 100 s: stored plus convected, the latter by Simpson's rule."""
    network = random_network(2)
    heat, ambient, start = np.array([10.0, 0.0, 300.0, 5.0, 1.0, 40.0]), 290.0, np.full(6, 300.0)
    times = np.linspace(0.0, 100.0, 2001)
    path = np.array([network.after(start, heat, ambient, t) for t in times])
    carried = (path - ambient) @ network.to_ambient
    weights = np.array([1.0] + [4.0, 2.0] * 999 + [4.0, 1.0]) * (times[1] / 3.0)
    stored = network.capacity @ (path[-1] - start)
    assert stored + weights @ carried == pytest.approx(heat.sum() * 100.0, rel=1e-7)


def test_steady_state_of_two_nodes() -> None:
    """A source behind one resistance in a box behind another: T = Ta + q/h, and + q/g before it."""
    network = ThermalNetwork(
        np.array([50.0, 500.0]), np.array([[0.0, 8.0], [8.0, 0.0]]), np.array([0.0, 4.0])
    )
    steady = network.steady(np.array([100.0, 0.0]), 300.0)
    np.testing.assert_allclose(steady, [300.0 + 25.0 + 12.5, 325.0], rtol=1e-14)
    late = network.after(np.array([280.0, 400.0]), np.array([100.0, 0.0]), 300.0, 1e5)
    np.testing.assert_allclose(late, steady, rtol=1e-12)


def test_all_heat_goes_somewhere_but_that_of_the_suspension() -> None:
    shares = heat_shares()
    for source, name in enumerate(LOSS_NAMES):
        assert shares[source].sum() == pytest.approx(0.0 if name == "suspension" else 1.0)


def test_axlebox_in_the_wind() -> None:
    """Churchill and Bernstein (1977) at Re 2e6, and 50 to 170 W/(m2 K) at the speed of trains."""
    nusselt = 0.62 * math.sqrt(2.0e6) * 0.71 ** (1.0 / 3.0) / 1.1386 * (1.0 + 7.0922**0.625) ** 0.8
    assert moving_air(100.0, 0.3) == pytest.approx(nusselt * 0.026 / 0.3, rel=1e-3)
    assert moving_air(0.0, 0.3) == 0.0
    assert 50.0 < moving_air(22.2, 0.345) < moving_air(83.3, 0.345) < 170.0
    bearing, thermal = tapered(standard_scene()), Thermal()
    fast = thermal_network(bearing, thermal, 100.0, 200.0).to_ambient[BOX_NODE]
    assert fast > thermal_network(bearing, thermal, 100.0, 0.0).to_ambient[BOX_NODE] > 0.0


def test_time_scale_changes_no_steady_temperature() -> None:
    bearing, heat = tapered(standard_scene()), np.full(6, 100.0)
    slow, quick = (thermal_network(bearing, Thermal(time_scale=s), 100.0, 100.0) for s in (1.0, 50.0))
    np.testing.assert_allclose(slow.steady(heat, 290.0), quick.steady(heat, 290.0), rtol=1e-12)
    cold = np.full(6, 290.0)
    np.testing.assert_allclose(
        slow.after(cold, heat, 290.0, 100.0), quick.after(cold, heat, 290.0, 2.0), rtol=1e-12
    )


def warming_scene(thermal: Thermal | None) -> Scene:
    """With enough oil: a settled grease keeps its film nearly the same."""
    effects = replace(EffectSet(), thermal=thermal, film=LineFilm(supply="flooded"))
    return replace(scene_with(effects, end_play=1e-4), temperature=303.15)


def mean_film(block: Block) -> float:
    films = block.contacts[:, :, :, :2, FILM]
    return float(films[np.any(block.contacts[:, :, :, :2, 3:6] != 0.0, axis=-1)].mean())


def test_bearing_warms_itself_and_thins_its_film() -> None:
    """0.6 s at 2000 times the pace: parts above the air, viscosity and film down, end play down."""
    twin = started(warming_scene(QUICK), constant_load(LOAD_80_KN, 122.0))
    assert twin._warmth is not None
    blocks = [twin.advance() for _ in range(30)]
    first, last = blocks[2], blocks[-1]
    assert last.temperature is not None
    assert first.temperature is not None
    assert np.all(last.temperature > 303.15 - 1.0)
    parts = dict(zip(NODES, last.temperature, strict=True))
    # heat comes from rollers and raceways and leaves through box and axle
    assert parts["rollers"] > parts["cup"] > parts["axlebox"] > 293.15
    assert parts["rollers"] > 303.15 + 5.0
    assert mean_film(last) < 0.9 * mean_film(first)
    assert twin._warmth.play < 1e-4
    p = twin._parameters
    assert p.cup.gap == pytest.approx(0.5 * twin._warmth.play * p.cup.sine, rel=1e-12)
    assert last.audit is not None
    # growing parts press the contacts together: that work is in no force of the audit
    growth = 8e4 * 0.5 * abs(twin._warmth.play - 1e-4)
    assert last.audit.residual * last.audit.dissipated < 1e-4 * last.audit.dissipated + growth


def test_heat_of_the_network_is_what_the_run_has_lost() -> None:
    """Real pace, 0.2 s: stored heat is the audit's losses less what the air took."""
    twin = started(warming_scene(Thermal()), constant_load(LOAD_80_KN, 122.0))
    for _ in range(10):
        block = twin.advance()
    assert block.temperature is not None
    assert twin._state is not None
    network = thermal_network(twin.scene.bearing, Thermal(), twin.scene.mounting.box_mass, 122.0)
    stored = network.capacity @ (block.temperature - 303.15)
    carried = 0.2 * network.to_ambient @ (block.temperature - Thermal().ambient)
    warmth = twin._warmth
    assert warmth is not None
    lost = warmth.lost @ heat_shares().sum(axis=1)
    assert lost > 20.0
    assert stored + carried == pytest.approx(lost, rel=1e-3)


def test_thermal_without_heat_and_at_ambient_changes_nothing() -> None:
    """Air as warm as the bearing and a huge heat capacity: the blocks are those without it, bit by bit."""
    load = constant_load(LOAD_80_KN, 122.0)
    idle = Thermal(ambient=303.15, time_scale=1e-12)
    one, two = started(warming_scene(idle), load), started(warming_scene(None), load)
    for _ in range(3):
        a, b = one.advance(), two.advance()
        assert a.temperature is not None
        np.testing.assert_allclose(a.temperature, 303.15, atol=1e-9)
        assert_same(replace(a, temperature=None), b)


def test_restart_of_a_warming_bearing_is_bit_identical() -> None:
    scene = warming_scene(QUICK)
    twin = started(scene, constant_load(LOAD_80_KN, 122.0))
    for _ in range(4):
        twin.advance()
    kept = twin.snapshot()
    ahead = [twin.advance() for _ in range(4)]
    fresh = started(scene, constant_load(LOAD_80_KN, 122.0))
    fresh.restore(kept)
    for block in ahead:
        assert_same(fresh.advance(), block)


def test_temperatures_are_messages_of_their_own_only_with_the_effect() -> None:
    """One sensor_msgs/Temperature per part every tenth block, in degrees Celsius, named by its frame."""
    twin = started(warming_scene(QUICK), constant_load(LOAD_80_KN, 122.0))
    block = twin.advance()
    assert block.temperature is not None
    encoder = BlockEncoder(twin.roller_count, ("axlebox_top",), "box_7")
    messages = [message for message in encoder.encode(block) if message[0] == "temperature"]
    decoded = [decode(topic("temperature").type, cdr) for _, _, cdr in messages]
    assert [message.header.frame_id for message in decoded] == [f"box_7/{node}" for node in NODES]
    np.testing.assert_allclose([m.temperature for m in decoded], block.temperature - 273.15, rtol=1e-14)
    assert all(stamp == block.end_ns for _, stamp, _ in messages)
    without = [name for name, _, _ in encoder.encode(replace(block, temperature=None))]
    assert "temperature" not in without


def test_summary_of_a_run_prints_the_temperatures() -> None:
    summary = desk_run.run(replace(warming_scene(QUICK), duration=0.04))
    assert [part for part, _ in summary.temperatures] == list(NODES)
    cup = dict(summary.temperatures)["cup"] - 273.15
    assert cup > 30.0
    assert f"cup {cup:.1f}, cone" in simulate.text(summary, None)
    printed = simulate.json_object(summary, None)["temperature_K"]
    assert printed["axlebox"] == dict(summary.temperatures)["axlebox"]
    plain = desk_run.run(replace(warming_scene(None), duration=0.02))
    assert "temperatures" not in simulate.text(plain, None)
    assert simulate.json_object(plain, None)["temperature_K"] is None


def test_damaged_springs_warm_with_the_sound_ones() -> None:
    """The film thins and the end play closes under a patch as beside it."""
    scene = scene_of("everything", "full")
    twin = started(scene, load_history(scene.operation, scene.mounting, 0.1, scene.seed))
    before = twin._parameters.laminae.copy()
    twin.advance()
    p = twin._parameters
    assert not np.array_equal(p.laminae, before)
    for damage in (p.effects.faults.cup_damage, p.effects.faults.cone_damage):
        assert damage is not None
        np.testing.assert_array_equal(damage.laminae, np.hstack([p.laminae, p.laminae]))
