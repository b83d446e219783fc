"""Steps of the fast tiers that are longer than a sample: as good as fine ones in the band they have."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.choice.fast_step import SLOW_BAND, fast_steps, fastest_mode
from beardyn_core.effects import ContactDamping, Gravity, RingStructure
from beardyn_core.physics.statics.static import solve
from beardyn_core.rail.build import load_history
from beardyn_core.run import blocks
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.runs import constant_load, started
from test.scenes import rigid_scene
from test.tiers.momentum import momentum_of_rolling_parts
from test.tiers.runs import Float, scene_of

DURATION, SETTLED = 1.2, 0.4
FINE = 8
LONG = [
    ("lumped", "static_80kN", 0.5),
    ("lumped", "static_80kN", 0.25),
    ("lumped", "smooth_run", 0.5),
]


def quiet(tier: str, name: str, steps: float) -> Scene:
    """A healthy bearing as drawn on smooth rails in a fast tier, without noise that hides differences."""
    scene = replace(scene_of(name, tier), scatter=None)
    if isinstance(scene.operation, QuarterVehicleOperation):
        smooth = replace(scene.operation.irregularity, short_waves="none")
        scene = replace(scene, operation=replace(scene.operation, irregularity=smooth))
    sensors = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    return replace(scene, sensors=sensors, numerics=replace(scene.numerics, steps_per_sample=steps))


@cache
def record(tier: str, name: str, steps: float) -> tuple[Block, ...]:
    return tuple(blocks(quiet(tier, name, steps), DURATION))


def waveform(tier: str, name: str, steps: float) -> Float:
    """Vertical force and acceleration at 25.6 kHz over the same time, shape [sample, 2]."""
    blocks = record(tier, name, steps)
    time = np.concatenate([block.waveform_time_ns for block in blocks]) * 1e-9
    values = np.column_stack(
        [
            np.concatenate([block.force_waveform[:, 2] for block in blocks]),
            np.concatenate([block.acceleration[0][:, 2] for block in blocks]),
        ]
    )
    return values[(time >= SETTLED) & (time < DURATION - 0.02)]


def bands(signal: Float) -> tuple[Float, Float]:
    """Third-octave levels, shapes [band] and [band, channel]."""
    window = np.hanning(len(signal))[:, None]
    power = np.abs(np.fft.rfft((signal - signal.mean(axis=0)) * window, axis=0)) ** 2
    power *= 2.0 / (len(signal) * float((window**2).sum()))
    frequency = np.fft.rfftfreq(len(signal), 1.0 / 25_600.0)
    centre = 1000.0 * 10.0 ** (np.arange(-10, 11) / 10.0)
    rows = [
        np.sqrt(power[(frequency >= f * 10**-0.05) & (frequency < f * 10**0.05)].sum(axis=0)) for f in centre
    ]
    return centre, np.array(rows)


def joined(tier: str, name: str, steps: float, channel: str) -> Float:
    blocks = record(tier, name, steps)
    begun = [block for block in blocks if block.start_ns >= SETTLED * 1e9]
    return np.concatenate([getattr(block, channel) for block in begun])


@pytest.mark.parametrize(("tier", "name", "steps"), LONG)
def test_force_deflection_and_roller_loads_are_those_of_fine_steps(
    tier: str, name: str, steps: float
) -> None:
    """Within 2e-4 of the load: the accuracy of the tier itself is 5 %."""
    force = {each: joined(tier, name, each, "force")[:, :3] for each in (FINE, steps)}
    ends = {each: record(tier, name, each)[-1].trend_time_ns[-1] for each in force}
    late = round((ends[FINE] - ends[steps]) / 2_500_000)
    one = force[FINE][: len(force[FINE]) - max(late, 0)]
    other = force[steps][len(force[steps]) - len(one) :] if late >= 0 else force[steps][: len(one)]
    assert len(one) == len(other)
    load = np.abs(force[FINE][:, 2]).mean()
    assert np.sqrt(np.mean((one - other) ** 2)) < 2e-4 * load
    pose = {each: joined(tier, name, each, "body_pose") for each in force}
    deflection = {each: pose[each][:, 1, 2] - pose[each][:, 0, 2] for each in force}
    np.testing.assert_allclose(
        deflection[steps], deflection[FINE], atol=1e-3 * np.abs(deflection[FINE]).max()
    )
    peak = {
        each: np.linalg.norm(joined(tier, name, each, "contacts")[..., 0, 3:6], axis=-1)
        .max(axis=(1, 2))
        .mean()
        for each in force
    }
    assert peak[steps] == pytest.approx(peak[FINE], rel=1e-3)


def test_a_spall_under_rings_is_right_to_1250_hz_in_steps_of_two_samples() -> None:
    """Levels within 0.5 dB, the largest roller load within 0.5 %: what `SLOW_BAND` stands on."""
    scene = scene_of("cup_spall", "lumped")
    sensors = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    scene = replace(scene, sensors=sensors, effects=replace(scene.effects, structure=RingStructure()))
    levels, loads = [], []
    for steps in (0.5, 2):
        given = replace(scene, numerics=replace(scene.numerics, steps_per_sample=steps))
        found = [each for each in blocks(given, DURATION) if each.start_ns >= SETTLED * 1e9]
        times = np.concatenate([each.waveform_time_ns for each in found]) * 1e-9
        kept = (times >= SETTLED) & (times < DURATION - 0.02)
        centre, level = bands(np.concatenate([each.acceleration[0][:, 2:] for each in found])[kept])
        levels.append(level[(centre >= 200.0) & (centre <= SLOW_BAND * 1.01), 0])
        force = np.linalg.norm(np.concatenate([each.contacts for each in found])[..., 0, 3:6], axis=-1)
        loads.append(float(force.max(axis=(1, 2)).mean()))
    assert np.abs(20.0 * np.log10(levels[0] / levels[1])).max() < 0.5
    assert loads[0] == pytest.approx(loads[1], rel=5e-3)


@pytest.mark.parametrize(("tier", "name", "steps"), LONG)
def test_third_octaves_hold_up_to_a_third_of_the_step_rate(tier: str, name: str, steps: float) -> None:
    """Within 1.5 dB wherever a band has a thousandth of the strongest one."""
    centre, fine = bands(waveform(tier, name, FINE))
    _, found = bands(waveform(tier, name, steps))
    judged = centre <= 0.33 * 25_600.0 * steps
    checked = 0
    for channel in range(2):
        loud = judged & (fine[:, channel] > 1e-3 * max(float(fine[:, channel].max()), 1e-6))
        checked += int(loud.sum())
        if not loud.any():
            continue  # a cup that is held
        level = 20.0 * np.log10(found[loud, channel] / fine[loud, channel])
        assert np.abs(level).max() < 1.5
    assert checked >= 5


@pytest.mark.parametrize(("tier", "name", "steps"), LONG)
def test_what_lies_beyond_the_band_is_less_than_the_sensors_noise(tier: str, name: str, steps: float) -> None:
    """The reason why a healthy bearing may have it: fine steps say hardly anything there.

    Beside the sensor's noise it would raise a band by less than 0.5 dB, a third of what bands may err.
    """
    centre, fine = bands(waveform(tier, name, FINE))
    beyond = centre > 0.4 * 25_600.0 * steps
    noise = scene_of(name, tier).sensors[0].noise_density * np.sqrt(0.2316 * centre)
    assert np.all(10.0 * np.log10(1.0 + (fine[beyond, 1] / noise[beyond]) ** 2) < 0.5)
    assert np.sqrt((fine[beyond, 0] ** 2).sum()) < 1e-4 * np.abs(waveform(tier, name, FINE)[:, 0]).mean()


def test_the_fastest_mode_keeps_its_frequency() -> None:
    """Free swinging of the box on its rollers: a fifth of the error of a plain step is left at most."""
    periods = {}
    for steps in (0.25, 0.5, 1, FINE):
        scene = quiet("lumped", "static_80kN", steps)
        scene = replace(
            scene,
            mounting=replace(scene.mounting, cup="suspended"),
            effects=replace(scene.effects, contact_damping=ContactDamping(0.0)),
        )
        twin = started(scene, constant_load((0.0, 0.0, 8e4), 122.0))
        assert twin._state is not None
        twin._state.bodies[0, 8] += 1e-3  # a push of the box upwards
        blocks = [twin.advance() for _ in range(12)]
        time = np.concatenate([block.waveform_time_ns for block in blocks]) * 1e-9
        force = np.concatenate([block.force_waveform[:, 2] for block in blocks])
        within = (time > 0.01) & (time < 0.2)
        periods[steps] = _strongest(force[within])
    errors = {steps: abs(periods[steps] / periods[FINE] - 1.0) for steps in (0.25, 0.5)}
    for steps, error in errors.items():
        turn = 2.0 * np.pi * periods[FINE] / (25_600.0 * steps)
        assert turn > 0.6
        assert error < 0.2 * turn**2 / 24.0


def _strongest(signal: Float) -> float:
    """Frequency of the strongest line above 0.8 kHz by a parabola through its logarithm, [Hz]."""
    count = 8 * len(signal)
    power = np.log(np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)), count)) + 1e-12)
    frequency = np.fft.rfftfreq(count, 1.0 / 25_600.0)
    k = int(np.argmax(np.where((frequency > 800.0) & (frequency < 2500.0), power, -np.inf)))
    shift = 0.5 * (power[k - 1] - power[k + 1]) / (power[k - 1] - 2 * power[k] + power[k + 1])
    return float((k + shift) * frequency[1])


@pytest.mark.parametrize(
    ("tier", "steps"),
    [("lumped", 0.25), ("lumped", 0.5), ("lumped", 1), ("quasistatic", 1)],
)
def test_momentum_of_axlebox_and_journal_is_that_of_what_acts_from_outside(tier: str, steps: float) -> None:
    """Free in space, without weight: what the rollers do to one ring they do to the other.

    In the quasistatic tier rollers and cages have momentum too, in frames that turn with the rollers: of what
    the load of 80 kN gives in this time, 3e-6 are not found again.
    """
    scene = quiet(tier, "static_80kN", steps)
    free = replace(
        scene.mounting, cup="suspended", journal_tilt="free", stiffness=(0.0,) * 3, damping=(0.0,) * 3,
        rotational_stiffness=(0.0,) * 3, rotational_damping=(0.0,) * 3,
    )  # fmt: skip
    scene = replace(scene, mounting=free, effects=replace(scene.effects, gravity=Gravity(0.0)))
    twin = started(scene, constant_load((0.0, 0.0, 8e4), 122.0))
    assert twin._state is not None
    mounting, bodies = twin._parameters.mounting, twin._state.bodies
    bodies[0, 6:9] += [2e-3, -1e-3, 3e-3]
    mass = np.array([mounting.box_mass, mounting.journal_mass])

    def momentum() -> Float:
        return np.asarray(mass @ bodies[:2, 6:9]) + momentum_of_rolling_parts(twin)

    before = momentum()
    for _ in range(5):
        twin.advance()
    # the load on the journal and the preload of the springs that hold it cancel
    swing = mounting.box_mass * 3e-3
    allowed = 1e-6 * swing if tier == "lumped" else 3e-6 * 8e4 * 5 * 0.02
    np.testing.assert_allclose(momentum(), before, atol=allowed)


@pytest.mark.parametrize("tier", ["lumped", "quasistatic"])
@pytest.mark.parametrize("frequency", [2.0, 20.0])
def test_an_axial_load_through_the_play_gives_the_forces_of_fine_steps(tier: str, frequency: float) -> None:
    """Rows that lose and find their contact while the stiffness of the step lags behind."""
    found = {}
    for steps in (0.5, FINE):
        scene = replace(quiet(tier, "smooth_run", steps), end_play=2e-4)
        twin = Twin(scene)
        load = load_history(scene.operation, scene.mounting, 0.5, scene.seed)
        load.wrench[:, 1] += 2e4 * np.sin(2e-9 * np.pi * frequency * load.time_ns)
        twin.start(load)
        blocks = [twin.advance() for _ in range(24)]
        assert all(block.status == 0 for block in blocks)
        found[steps] = {
            int(t): row
            for block in blocks
            for t, row in zip(block.trend_time_ns, block.force[:, :3], strict=True)
        }
    common = sorted(found[0.5].keys() & found[FINE].keys())
    assert len(common) > 150
    apart = np.array([found[0.5][t] - found[FINE][t] for t in common])
    assert np.sqrt(np.mean(apart**2)) < 100.0  # half a percent of the swing


def test_the_bound_of_the_fastest_mode_is_above_it() -> None:
    """Static stiffness under heavy loads, with cup held and suspended."""
    bearing = load_scene("static_80kN").bearing
    for force in ((0.0, 0.0, 8e4), (0.0, 0.0, 1.6e5), (0.0, 1e4, 8e4)):
        stiffness = solve(bearing, force, end_play=0.0, laminae=6, speed=122.0).stiffness_tilt_held
        for mounting in (Mounting(cup="held"), Mounting(), Mounting(box_mass=20.0)):
            give = 1.0 / (mounting.journal_mass + bearing.cone_mass)
            if mounting.cup == "suspended":
                give += 1.0 / (mounting.box_mass + bearing.cup_mass)
            mode = np.sqrt(np.linalg.eigvalsh(stiffness).max() * give)
            assert mode < fastest_mode(bearing, mounting, preloaded=False) < 2.0 * mode


@pytest.mark.parametrize(
    ("name", "lumped", "quasistatic"),
    [
        ("static_80kN", 0.25, 1),
        ("smooth_run", 1, 1),
        ("cup_spall", 1, 1),
        ("wheel_flat", 1, 1),
        ("measured_run", 1, 1),
    ],
)
def test_step_follows_mode_and_scene(name: str, lumped: float, quasistatic: float) -> None:
    assert rigid_scene(name, tier="lumped").numerics.steps_per_sample == lumped
    assert rigid_scene(name, tier="quasistatic").numerics.steps_per_sample == quasistatic


def test_only_a_bearing_as_drawn_has_longer_steps_on_a_track() -> None:
    made = rigid_scene("smooth_run", tier="lumped")
    assert fast_steps(replace(made, scatter=None)).steps_per_sample == 0.5


@pytest.mark.parametrize("tier", ["lumped", "quasistatic"])
def test_a_light_axlebox_has_shorter_steps(tier: str) -> None:
    scene = replace(scene_of("static_80kN", tier), mounting=Mounting(cup="held"))
    assert (fast_steps(scene).steps_per_sample < 1) == (tier == "lumped")
    scene = scene_of("smooth_run", tier)
    light = replace(scene, mounting=replace(scene.mounting, box_mass=10.0))
    assert fast_steps(light).steps_per_sample >= 1 >= fast_steps(scene).steps_per_sample
    feather = replace(
        scene, bearing=replace(scene.bearing, cup_mass=0.01), mounting=replace(scene.mounting, box_mass=0.01)
    )
    assert fast_steps(feather).steps_per_sample > 1
