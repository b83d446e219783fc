"""Situations a twin meets besides the steady run: it carries on, or it says what is wrong."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.config import load_effects
from beardyn_core.effects import ContactDamping
from beardyn_core.physics.bodies.layout import CONE_BODY, LINEAR, PENETRATION, SIGNAL_FORCE
from beardyn_core.physics.tiers.build import spring_time
from beardyn_core.physics.tiers.status import Status, assess
from beardyn_core.scene.scene import Scene
from test.kernels.rig import Rig
from test.runs import Record, constant_load, record_under, started, stepped_load
from test.scenes import LOAD_80_KN, SPEED, scene_with, standard_scene

FREE_FALL = 9.80665


def carried(scene: Scene) -> float:
    bearing = scene.bearing
    return FREE_FALL * (2 * bearing.roller_count * bearing.roller_mass + 2 * bearing.cage.mass)


def last_force(record: Record, trends: int = 16) -> Any:
    return record.trend("force")[-trends:, :3].mean(axis=0)


def sane(record: Record, largest_residual: float = 1e-2) -> None:
    """Every channel finite, no penetration, energy balance closed."""
    for block in record.blocks:
        for name in ("force_waveform", "shaft_torque", "cage_speed", "roller_speed", "body_pose", "contacts"):
            assert np.isfinite(getattr(block, name)).all(), name
    assert not record.status & (Status.NOT_FINITE | Status.PENETRATION)
    assert record.residual < largest_residual


@pytest.mark.parametrize("force", [0.0, 1.0, 30.0], ids=["0 N", "1 N", "30 N"])
@pytest.mark.parametrize("end_play", [0.0, 1e-4], ids=["no play", "0.1 mm play"])
def test_bearing_runs_without_load_and_with_a_microload(force: float, end_play: float) -> None:
    """Only centrifugal force holds the rollers to the cup; forces stay those of weights and impacts."""
    scene = scene_with(end_play=end_play)
    record = record_under(scene, constant_load((0.0, 0.0, force), SPEED))
    sane(record)
    assert np.abs(record.trend("force")[:, :3]).max() < 500.0
    ratio = record.trend("cage_speed")[-8:].mean() / record.trend("shaft_speed")[-1] / 0.429
    assert 0.8 < ratio < 1.1


def test_load_that_reverses_through_the_play_is_carried_by_the_other_side() -> None:
    """+50 kN to -50 kN in 10 ms with 0.2 mm of play: an impact, then the load zone at the bottom."""
    scene = scene_with(end_play=2e-4)
    load = stepped_load(
        [(0.0, (0.0, 0.0, 5e4), SPEED), (0.05, (0.0, 0.0, 5e4), SPEED), (0.06, (0.0, 0.0, -5e4), SPEED),
         (10.0, (0.0, 0.0, -5e4), SPEED)]
    )  # fmt: skip
    record = record_under(scene, load, 15)
    sane(record)
    assert last_force(record)[2] == pytest.approx(-5e4 - carried(scene), rel=0.03)
    cup = record.blocks[-1].contacts[-1, :, :, 0].reshape(-1, 9)
    heaviest = cup[np.argmax(np.linalg.norm(cup[:, 3:6], axis=-1))]
    assert heaviest[2] < -0.8 * math.hypot(heaviest[0], heaviest[2])


def test_impact_of_200_g_on_the_unsprung_mass_is_survived() -> None:
    """A wheel flat's pulse, 1 ms triangle of 200 g on box and journal: 1.8 MN peak for half of it."""
    scene = scene_with(cup="suspended")
    peak = 8e4 + 200.0 * FREE_FALL * 907.0
    load = stepped_load(
        [(0.0, LOAD_80_KN, SPEED), (0.05, LOAD_80_KN, SPEED), (0.0505, (0.0, 0.0, peak), SPEED),
         (0.051, LOAD_80_KN, SPEED), (10.0, LOAD_80_KN, SPEED)]
    )  # fmt: skip
    record = record_under(scene, load)
    sane(record)
    before, after = record.force_waveform[:1000, 2].max(), record.force_waveform[:, 2].max()
    assert after > 1.2 * before


def test_standing_bearing_stands() -> None:
    """No speed: nothing turns, the cup carries the load less the weights to 10 N, nothing creeps."""
    scene = standard_scene()
    record = record_under(scene, constant_load(LOAD_80_KN, 0.0))
    # the rough residual is 50 uJ over a floor of 1 mJ: nothing dissipates here
    sane(record, largest_residual=0.2)
    assert record.status == 0
    assert last_force(record)[2] == pytest.approx(8e4 - carried(scene), abs=10.0)
    assert np.abs(record.trend("cage_speed")[-1]).max() < 0.05
    turned = record.trend("roller_angle")[-1] - record.trend("roller_angle")[0]
    assert np.abs(turned).max() < 5e-3
    assert abs(float(record.trend("shaft_torque")[-16:].mean())) < 0.05


def test_journal_of_a_standing_bearing_rings_down_alike_with_any_step() -> None:
    """Rollers stick to the rings and carry the load along them: a mode of 830 Hz, axial, damped by 73 /s.

    Held at the rings' velocity of the step before they made it grow by 52 /s at the production step.
    """
    decay = []
    for steps_per_sample in (4, 8):
        scene = replace(scene_with(steps_per_sample=steps_per_sample), effects=load_effects("all"))
        rig = Rig.at_equilibrium(scene, speed=0.0)
        rig.run(1024 * steps_per_sample)
        rig.state.bodies[CONE_BODY, LINEAR + 1] += 1e-5
        _, _, bodies = rig.run(512 * steps_per_sample, trends=512)
        along = bodies[:, CONE_BODY, LINEAR + 1]
        envelope = [np.abs(part).max() for part in (along[:128], along[-128:])]
        decay.append(math.log(envelope[0] / envelope[1]) / 0.015)
    assert decay[0] == pytest.approx(decay[1], rel=0.05)
    assert decay[0] == pytest.approx(73.0, rel=0.1)


def test_start_from_standstill_reaches_rolling() -> None:
    load = stepped_load(
        [
            (0.0, LOAD_80_KN, 0.0),
            (0.04, LOAD_80_KN, 0.0),
            (0.14, LOAD_80_KN, SPEED),
            (10.0, LOAD_80_KN, SPEED),
        ]
    )
    record = record_under(standard_scene(), load, 14)
    sane(record)
    np.testing.assert_allclose(record.trend("cage_speed")[-16:].mean(axis=0), 0.429 * SPEED, rtol=0.01)


def test_reversal_through_zero_speed_turns_everything_round() -> None:
    load = stepped_load(
        [
            (0.0, LOAD_80_KN, SPEED),
            (0.02, LOAD_80_KN, SPEED),
            (0.15, LOAD_80_KN, -SPEED),
            (10.0, LOAD_80_KN, -SPEED),
        ]
    )
    record = record_under(standard_scene(), load, 15)
    sane(record)
    np.testing.assert_allclose(record.trend("cage_speed")[-16:].mean(axis=0), -0.429 * SPEED, rtol=0.01)
    torque = record.trend("shaft_torque")
    assert torque[4] < 0.0 < torque[-16:].mean()


@pytest.mark.parametrize("roller_count", [13, 16, 19])
def test_any_number_of_rollers_carries_the_load(roller_count: int) -> None:
    """Prime, even, and filling the lanes otherwise; 17 is the standard."""
    scene = scene_with(roller_count=roller_count)
    record = record_under(scene, constant_load(LOAD_80_KN, SPEED), 6)
    sane(record)
    assert record.status == 0
    assert last_force(record)[2] == pytest.approx(8e4 - carried(scene), rel=0.01)


@pytest.mark.parametrize("cup", ["held", "suspended"])
@pytest.mark.parametrize(
    ("end_play", "fewest", "most"),
    [(8e-4, 17_000.0, 21_000.0), (-5e-5, 8_500.0, 9_800.0)],
    ids=["0.8 mm play", "50 um preload"],
)
def test_large_play_concentrates_the_load_and_preload_spreads_it(
    cup: str, end_play: float, fewest: float, most: float
) -> None:
    scene = scene_with(end_play=end_play, cup=cup)
    record = record_under(scene, constant_load(LOAD_80_KN, SPEED))
    sane(record)
    assert record.status == 0
    assert last_force(record)[2] == pytest.approx(8e4 - carried(scene), rel=0.01)
    settled = np.concatenate([block.contacts for block in record.blocks[2:]])
    assert fewest < np.linalg.norm(settled[..., 0, 3:6], axis=-1).max() < most


def test_bearing_with_large_play_starts_at_rest_under_an_axial_load() -> None:
    """The free row's rollers stand 0.4 mm off, beyond the room in their pockets, and so does their cage.

    0.14 J of pockets that are pressed at the start go into a light cage; the explicit pockets balance that to
    1.4 % with the production step, and better as it shrinks.
    """
    load = constant_load((0.0, 1.76e4, 0.0), 0.0)
    sane(record_under(scene_with(end_play=8e-4, steps_per_sample=16), load, 3), 2e-3)
    record = record_under(scene_with(end_play=8e-4), load, 3)
    sane(record, 2e-2)
    assert np.abs(record.force_waveform[:, 1] - 1.76e4).max() < 0.05 * 1.76e4


def test_combined_load_on_a_tilting_journal_in_a_suspended_box() -> None:
    """Everything may move: 80 kN radial and 15 kN axial, the axial force on the cup is the load's."""
    scene = scene_with(end_play=1e-4, cup="suspended", journal_tilt="free")
    record = record_under(scene, constant_load((0.0, 1.5e4, 8e4), SPEED))
    sane(record)
    force = last_force(record)
    assert force[1] == pytest.approx(1.5e4, rel=0.02)
    assert force[2] == pytest.approx(8e4 - carried(scene), rel=0.02)


def test_suspended_box_stays_where_it_hangs() -> None:
    """Preload of the suspension balances load and all weights: 60 N of error would sink the box by 50 um."""
    scene = scene_with(cup="suspended")
    record = record_under(scene, constant_load(LOAD_80_KN, SPEED))
    sane(record)
    height = np.concatenate([block.body_pose[:, 0, 2] for block in record.blocks])
    assert np.abs(height).max() < 5e-5


def test_one_lamina_is_refused_or_reported() -> None:
    """One lamina cannot hold a roller straight; to go on in silence with a wrong torque is no answer."""
    scene = scene_with(laminae=1)
    try:
        record = record_under(scene, constant_load(LOAD_80_KN, SPEED))
    except (InputError, ValidityError):
        return
    reference = record_under(standard_scene(), constant_load(LOAD_80_KN, SPEED))
    right = float(reference.trend("shaft_torque")[-40:].mean())
    assert record.status != 0 or float(record.trend("shaft_torque")[-40:].mean()) == pytest.approx(
        right, rel=0.1
    )


@pytest.mark.parametrize(
    ("factor", "status"),
    [(2, Status.FINE), (6, Status.CHATTER), *((factor, Status.NOT_FINITE) for factor in (16, 32, 128))],
)
def test_step_far_too_large_is_reported(factor: int, status: Status) -> None:
    """6 times the production step chatters, 16 times and more blow up; neither passes as fine."""
    rig = Rig.at_equilibrium(standard_scene())
    step = rig.parameters.step * factor
    implicit = spring_time(rig.scene.bearing, rig.parameters.laminae, step, True)
    rig.parameters = rig.parameters._replace(step=step, spring_time=implicit)
    rig.run(500)
    found = assess(rig.state, 500, rig.scene.bearing.large_end_radius)
    assert found == status if status == Status.FINE else found & status


@pytest.mark.parametrize("start", range(5))
def test_six_times_the_step_chatters_without_flying_apart(start: int) -> None:
    """Strikes that press with more than the force of their spring threw rollers from 2 of these 5 starts."""
    rig = Rig.at_equilibrium(scene_with(end_play=standard_scene().end_play + start * 1e-9))
    step = 6.0 * rig.parameters.step
    implicit = spring_time(rig.scene.bearing, rig.parameters.laminae, step, True)
    rig.parameters = rig.parameters._replace(step=step, spring_time=implicit)
    signals = rig.run(500)[0]
    assert np.isfinite(signals).all()
    assert rig.state.rollers[:, PENETRATION].max() < 1e-4
    assert signals[250:, SIGNAL_FORCE + 2].mean() == pytest.approx(8e4, rel=0.05)


@pytest.mark.parametrize("steps_per_sample", [2, 3, 4])
def test_undamped_rollers_that_skid_and_lift_off_make_no_energy(steps_per_sample: int) -> None:
    """5 kN, cages at half their speed, a damper of no time: with the least stable share at 2 steps 1.5 %."""
    scene = scene_with(steps_per_sample=steps_per_sample)
    undamped = replace(scene.effects, contact_damping=ContactDamping(time_constant=1e-12))
    rig = Rig.at_equilibrium(replace(scene, effects=undamped), (0.0, 0.0, 5e3), cage_ratio=0.5)
    parameters = rig.parameters
    implicit = spring_time(rig.scene.bearing, parameters.laminae, parameters.step, False)
    rig.parameters = parameters._replace(spring_time=implicit)
    force = np.concatenate([rig.run(512 * steps_per_sample)[0][:, SIGNAL_FORCE + 2] for _ in range(8)])
    assert np.isfinite(force).all()
    late = force[len(force) // 2 :]
    assert late.mean() == pytest.approx(5e3, rel=0.05)
    assert late.std() < 3e3


def test_load_beyond_the_contact_law_ends_the_run_with_a_sentence() -> None:
    twin = started(standard_scene(), constant_load((0.0, 0.0, 8e6), SPEED))
    with pytest.raises(ValidityError, match="pressed more than 200 um") as caught:
        twin.advance()
    assert caught.value.block is not None


def test_nan_load_is_refused() -> None:
    with pytest.raises(ValidityError, match="NaN"):
        started(standard_scene(), constant_load((0.0, 0.0, math.nan), SPEED))
    twin = started(standard_scene(), constant_load(LOAD_80_KN, SPEED, 0.02))
    bad = constant_load((math.nan, 0.0, 8e4), SPEED)
    assert not twin.feed(replace(bad, time_ns=bad.time_ns + 40_000_000))
    assert twin.load.refused == 1
    assert "NaN" in twin.load.reason


@pytest.mark.slow
def test_ten_seconds_do_not_drift() -> None:
    """Steady 80 kN: torque and cage speed of the last second are those of the second; axes stay unit."""
    twin = started(standard_scene(), constant_load(LOAD_80_KN, SPEED, 20.0))
    early, late = [], []
    for index in range(500):
        block = twin.advance()
        assert block.status == 0
        if 50 <= index < 100:
            early.append(block)
        if index >= 450:
            late.append(block)
    first, second = Record(standard_scene(), tuple(early)), Record(standard_scene(), tuple(late))
    for name, tolerance in (("shaft_torque", 0.01), ("cage_speed", 1e-3)):
        np.testing.assert_allclose(
            second.trend(name).mean(axis=0), first.trend(name).mean(axis=0), rtol=tolerance
        )
    assert second.residual < 1e-3
    rollers = twin.snapshot().state.rollers
    np.testing.assert_allclose(np.linalg.norm(rollers[:, 6:9], axis=1), 1.0, atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [400.0, 1500.0])
def test_high_speed_runs_stay_sane(speed: float) -> None:
    """3800 and 14 000 rpm, far above any train."""
    record = record_under(standard_scene(), constant_load(LOAD_80_KN, speed), 50)
    sane(record)
    assert last_force(record, 100)[2] == pytest.approx(8e4 - carried(standard_scene()), rel=0.01)
