"""The chosen step is converged where the rule was not made: other bearings, loads and speeds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing, load_effects
from beardyn_core.effects import CoulombTraction, EffectSet, LoadSharingTraction
from beardyn_core.physics.bodies.layout import SIGNAL_TORQUE
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.journal import bending_give
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, Status, chatter_index, describe
from beardyn_core.physics.tiers.step_choice import bounce_frequency, choose_steps
from beardyn_core.rail.build import load_history
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from test.kernels.rig import Float

HS = load_bearing("HS130x230")
STANDARD, FULL, DRY = load_effects("standard"), load_effects("all"), load_effects("dry")
LOADS, SPEEDS = (2.0e4, 8.0e4), (60.0, 120.0)


def steps(effects: EffectSet = STANDARD, band: float = 0.0, **given: object) -> float:
    return choose_steps(HS, LOADS, SPEEDS, effects, band=band, **given).steps_per_sample  # type: ignore[arg-type]


def test_vibration_that_is_asked_for_takes_smaller_steps() -> None:
    assert [steps(band=band) for band in (0.0, 5e3, 7e3, 1e4, 12.8e3)] == [2, 2, 2, 3, 4]
    assert [steps(FULL, band) for band in (7e3, 1e4, 12.8e3)] == [2, 2, 4]
    assert [steps(FULL, band, noise=4e-5) for band in (7e3, 1e4)] == [2, 3]  # a quieter sensor


def test_bounce_is_sampled_twice_a_period() -> None:
    """The mode of one roller between its raceways, from the static solution: 19 kHz at 60 kN."""
    for load in (5e3, 6e4, 1.5e5):
        static = solve(HS, (0.0, 0.0, load), end_play=0.0, laminae=6, speed=120.0)
        frequency = bounce_frequency(HS, static, 6)
        assert 1.6e4 < frequency < 2.1e4
        assert steps() * WAVEFORM_RATE >= 2.0 * frequency


def test_bounce_frequency_is_that_of_the_tangent_stiffness() -> None:
    """Against the change of the largest roller's load with a small change of the load on the bearing."""
    heavier, lighter = (
        bounce_frequency(HS, solve(HS, (0.0, 0.0, load), end_play=0.0, laminae=6), 6) for load in (8e4, 4e4)
    )
    # K delta^(10/9): the stiffness goes with Q^0.1, the frequency with its root
    assert heavier / lighter == pytest.approx(2.0**0.05, rel=0.01)


def test_steeper_dry_friction_takes_smaller_steps() -> None:
    found = [
        steps(replace(DRY, traction=CoulombTraction(friction=0.1, regularisation_speed=speed)))
        for speed in (0.1, 0.02, 0.01, 0.005)
    ]
    assert found == sorted(found)
    assert found[0] == 2
    assert found[2] == 4
    assert found[3] > 5


def test_few_laminae_take_smaller_steps() -> None:
    assert [steps(laminae=count) for count in (2, 6, 12)] == [3, 2, 2]


def test_load_sharing_without_a_film_is_steep_at_low_speed() -> None:
    dry = replace(STANDARD, traction=LoadSharingTraction(), film=None)
    slow = choose_steps(HS, LOADS, (1.0, 10.0), dry, band=0.0).steps_per_sample
    assert slow > steps(dry) > steps(FULL)


def test_a_light_axlebox_and_a_stiff_cage_take_smaller_steps() -> None:
    light = Mounting(box_mass=0.1, journal_mass=0.1)
    assert steps(mounting=light) > steps()
    stiff = replace(HS, cage=replace(HS.cage, stiffness=30.0 * HS.cage.stiffness))
    found = choose_steps(stiff, LOADS, SPEEDS, STANDARD, band=0.0)
    assert found.steps_per_sample > 4
    assert "pocket" in found.reason


def test_chatter_advises_the_automatic_step() -> None:
    assert "auto" in describe(Status.CHATTER)


@dataclass(frozen=True)
class Steady:
    """What a steady run settles to."""

    torque: float
    doubt: float  # standard error of the torque, from ten parts of the run
    scatter: float
    chatter: float
    levels: Float  # of third octaves from 1.6 kHz to 10 kHz, [dB]


DURATION = 6.3  # of 2 s the mean torque of dry contacts is known to 0.8 % only
THIRDS = 1e3 * 2.0 ** (np.arange(2, 11) / 3.0)


@cache
def steady(bearing: str, effects: str, force: tuple[float, float, float], speed: float, count: int) -> Steady:
    """The first 0.3 s left out; torque at every step, so that nothing hides between samples."""
    twin = Twin(scene_of(bearing, effects, force, speed, count))
    twin.start(load_history(twin.scene.operation, twin.scene.mounting, DURATION, 1))
    torque, vibration, chatter = [], [], []
    for index in range(round(DURATION / 0.02)):
        block = twin.advance()
        if index >= 15:
            torque.append(twin._signals[:, SIGNAL_TORQUE].copy())
            vibration.append(block.acceleration[0, :, 2])
            assert twin._state is not None
            chatter.append(chatter_index(twin._state, len(torque[-1])).max())
    signal = np.concatenate(torque)
    doubt = float(signal.reshape(10, -1).mean(axis=1).std(ddof=1) / np.sqrt(10.0))
    levels = third_octaves(np.concatenate(vibration))
    return Steady(float(signal.mean()), doubt, float(signal.std()), float(max(chatter)), levels)


def third_octaves(signal: Float) -> Float:
    window = np.hanning(4096)
    parts = [signal[i : i + 4096] - signal.mean() for i in range(0, len(signal) - 4095, 2048)]
    power = np.mean([np.abs(np.fft.rfft(window * part)) ** 2 for part in parts], axis=0)
    frequency = np.fft.rfftfreq(4096, 1.0 / WAVEFORM_RATE)
    edge = 2.0 ** (1.0 / 6.0)
    sums = [power[(frequency >= c / edge) & (frequency < c * edge)].sum() for c in THIRDS]
    return np.asarray(10.0 * np.log10(sums))


def scene_of(
    bearing: str, effects: str, force: tuple[float, float, float], speed: float, count: int
) -> Scene:
    scene = load_scene("static_80kN")
    return replace(
        scene,
        bearing=load_bearing(bearing),
        effects=load_effects(effects),
        operation=ConstantOperation(force=force, speed=speed),
        mounting=Mounting(),
        sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
        numerics=replace(scene.numerics, steps_per_sample=count),
        duration=DURATION,
    )


POINTS = {
    "metro 40 kN": ("METRO120x220", "standard", (0.0, 0.0, 4.0e4), 90.0),
    "freight 110 kN with thrust": ("FR130x230x150", "standard", (0.0, 1.0e4, 1.1e5), 140.0),
    "dry 30 kN": ("AARK_6.5x9", "dry", (0.0, 0.0, 3.0e4), 100.0),
}


def chosen(bearing: str, effects: str, force: tuple[float, float, float], speed: float, band: float) -> float:
    load = float(np.hypot(force[0], force[2]))
    return choose_steps(
        load_bearing(bearing), (load, load), (speed, speed), load_effects(effects), axial=force[1], band=band
    ).steps_per_sample


@pytest.mark.slow
@pytest.mark.parametrize("band", [0.0, 5e3, 1e4])
@pytest.mark.parametrize("point", POINTS)
def test_chosen_step_is_converged(point: str, band: float) -> None:
    """Design.md's definition against 16 steps per sample: torque 0.5 %, scatter 20 %, bands 1.5 dB.

    The system is chaotic: torque means of 6 s may differ by twice their standard error more than that.
    """
    count = chosen(*POINTS[point], band)
    run, fine = steady(*POINTS[point], count), steady(*POINTS[point], 16)
    assert count < 16
    doubt = float(np.hypot(run.doubt, fine.doubt))
    assert doubt < 5e-3 * abs(fine.torque)
    assert abs(run.torque - fine.torque) < 5e-3 * abs(fine.torque) + 2.0 * doubt
    assert run.scatter == pytest.approx(fine.scatter, rel=0.2)
    assert run.chatter < LARGEST_CHATTER_INDEX
    received = 1.02 * band >= THIRDS
    assert np.abs((run.levels - fine.levels)[received]).max(initial=0.0) < 1.5


def test_rings_on_an_axle_that_bends_get_another_step() -> None:
    """With two, rollers of this scene carried twice their load."""
    scene = load_scene("service_high_speed")
    of_scene = partial(steps, FULL, mounting=scene.mounting, axial=5e3, end_play=scene.end_play)
    assert (of_scene(), of_scene(bending=partial(bending_give, scene))) == (2, 3)


@pytest.mark.slow
def test_films_of_pockets_knock_alike_at_the_usual_step_and_a_finer_one() -> None:
    """Bounded three times as low as explicit pockets need it, they were 1.2 dB louder from 5 to 10 kHz.

    Now it is 0.6 dB; of 2 s chance makes 0.3 dB of it more or less, so 6 s are compared.
    """
    scene = load_scene("healthy_80", effects="all")
    sensors = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    levels = []
    for count in (3, 8):
        numerics = replace(scene.numerics, laminae=4, steps_per_sample=count)
        twin = Twin(replace(scene, numerics=numerics, sensors=sensors))
        load = load_history(scene.operation, scene.mounting, DURATION, scene.seed, bearing=scene.bearing)
        twin.start(load)
        received = [twin.advance().acceleration[0, :, 2] for _ in range(round(DURATION / 0.02))]
        levels.append(third_octaves(np.concatenate(received[20:]))[THIRDS > 4500.0].mean())
    assert abs(levels[0] - levels[1]) < 1.0
