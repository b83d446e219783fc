"""The sampling rate follows the third octaves that are asked for, and nothing else that is asked changes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.choice import explain_scene, load_scene, load_trial, scene_from_mapping, trial_scene
from beardyn_core.choice.discretisation_error import third_octaves_found
from beardyn_core.choice.sampling import rate_for
from beardyn_core.cli.explain import text
from beardyn_core.config import read_scene
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.run import start
from beardyn_core.scene.scene import NOTHING, Free, Scene
from beardyn_core.scene.sensor import PASSBAND, RATES, SLOW_RATES
from beardyn_core.sensors.block import Block
from test.scenes import rigid_scene

pytestmark = pytest.mark.usefixtures("shipped_configuration")
DURATION, SETTLED = 1.6, 0.3
ASKED = 1000.0


@cache
def asked() -> Scene:
    return rigid_scene("smooth_run", tier="lumped", vibration_to_Hz=ASKED)


def at(rate: float) -> Scene:
    """The same scene without noise, which another rate draws anew."""
    sensors = tuple(replace(sensor, rate=rate, noise_density=0.0) for sensor in asked().sensors)
    return replace(asked(), sensors=sensors)


@cache
def record(rate: float) -> tuple[Block, ...]:
    simulation = start(at(rate), DURATION)
    return tuple(simulation.blocks(simulation.twin.blocks_at_once))


def third_octaves(rate: float) -> Float:
    """Levels of acceleration and force up to what is asked for, shape [band, channel]."""
    blocks = record(rate)
    levels = []
    for times, values in (
        ([each.vibration[0].time_ns for each in blocks], [each.vibration[0].acceleration for each in blocks]),
        ([each.waveform_time_ns for each in blocks], [each.force_waveform[:, :3] for each in blocks]),
    ):
        time = np.concatenate(times) * 1e-9
        signal = np.concatenate(values)[(time >= SETTLED) & (time < DURATION - 0.05)]
        window = np.hanning(len(signal))[:, None]
        power = np.abs(np.fft.rfft((signal - signal.mean(axis=0)) * window, axis=0)) ** 2
        power *= 2.0 / (len(signal) * float((window**2).sum()))
        frequency = np.fft.rfftfreq(len(signal), 1.0 / rate)
        centre = ASKED * 10.0 ** (np.arange(-10, 1) / 10.0)
        edges = [(frequency >= f * 10**-0.05) & (frequency < f * 10**0.05) for f in centre]
        levels.append(10.0 * np.log10(np.array([power[band].sum(axis=0) for band in edges])))
    return np.hstack(levels)


@pytest.mark.parametrize("to", [200.0, 1000.0, 1250.0, 2000.0, 4000.0, 5000.0, 10_000.0])
def test_it_is_the_slowest_rate_that_holds_the_third_octave(to: float) -> None:
    scene = replace(read_scene("smooth_run").scene, vibration_to=to)
    found = rate_for(scene, Free())
    assert found is not None
    assert found.rate in (*SLOW_RATES, RATES[0])
    end = 10.0**0.05 * to
    slower = [rate for rate in SLOW_RATES if rate < found.rate]
    assert PASSBAND * found.rate >= end or found.rate == RATES[0]
    assert all(PASSBAND * rate < end for rate in slower)


def test_sensors_keep_their_rate_where_no_frequency_or_no_vibration_is_asked_for() -> None:
    scene = read_scene("smooth_run").scene
    assert rate_for(scene, Free()) is None
    assert rate_for(replace(scene, vibration_to=ASKED, quantities=("force",)), Free()) is None
    assert rate_for(replace(scene, vibration_to=ASKED), NOTHING) is None
    assert rate_for(replace(scene, vibration_to=ASKED), replace(Free(), rates=False)) is None


def test_a_rate_that_is_written_down_is_kept() -> None:
    data = {**read_file(find("scenes", "smooth_run")), "tier": "lumped", "effects": "auto"}
    data["vibration_to_Hz"] = ASKED
    sensors = [{**data["sensors"][0], "rate_kHz": 25.6}]
    scene = scene_from_mapping({**data, "sensors": sensors}, "mine", find("scenes", "smooth_run").parent)
    assert scene.waveform_rate == RATES[0]
    assert not any(each.startswith("rate ") for each in scene.chosen)


def test_named_effects_leave_nothing_to_choose() -> None:
    assert load_scene("smooth_run", effects="standard", vibration_to=ASKED).waveform_rate == RATES[0]


def test_it_is_told_with_its_reason() -> None:
    scene = asked()
    assert {sensor.rate for sensor in scene.sensors} == {3200.0} == {scene.waveform_rate}
    said = "the third octave at 1 kHz ends at 1.122 kHz, and 3.2 kHz measures to 1.28 kHz"
    assert f"rate 3.2 kHz: {said}" in scene.chosen
    found = explain_scene("smooth_run", tier="lumped", effects="auto", vibration_to=ASKED)
    assert "rate                 3.2 kHz" in text(found, verbose=True)
    assert found.current.to_json()["rate_Hz"] == 3200.0


def test_a_run_written_down_is_read_again_with_its_rate() -> None:
    scene = scene_from_mapping(write_noun(asked()), "again", find("scenes", "smooth_run").parent)
    assert scene.sensors == asked().sensors


def test_a_changed_scene_is_sampled_anew_and_one_of_another_rate_is_not() -> None:
    assert bd.scene(asked(), vibration_to_Hz=5000.0).waveform_rate == RATES[0]
    assert bd.scene(asked(), vibration_to_Hz=2000.0).waveform_rate == 6400.0
    sensors = tuple(replace(sensor, rate=12_800.0) for sensor in asked().sensors)
    assert bd.scene(replace(asked(), sensors=sensors), vibration_to_Hz=2000.0).waveform_rate == 12_800.0


def test_a_trial_receives_all_that_its_sensors_do() -> None:
    trial = load_trial("quick")
    cell = next(cell for cell in trial.cells() if cell.tier == "lumped" or cell.tier == trial.tier)
    assert {sensor.rate for sensor in trial_scene(trial, cell).sensors} == {RATES[0]}


def test_below_the_usual_rate_all_sensors_have_one() -> None:
    data = read_file(find("scenes", "static_80kN"))
    sensors = [{"name": "one", "rate_kHz": 3.2}, {"name": "two", "rate_kHz": 25.6}]
    with pytest.raises(InputError, match=r"sensor 'two' has 25\.6 kHz, another one 3\.2 kHz; below 25\.6"):
        scene_from_mapping(
            {**data, "effects": "dry", "sensors": sensors}, "mixed", find("scenes", "static_80kN").parent
        )


@pytest.mark.parametrize("rate", SLOW_RATES)
def test_third_octaves_that_are_asked_for_are_those_of_the_usual_rate(rate: float) -> None:
    """Within 0.05 dB without noise; runs of another seed differ by decibels."""
    np.testing.assert_allclose(third_octaves(rate), third_octaves(RATES[0]), atol=0.05)


@pytest.mark.parametrize("rate", SLOW_RATES)
def test_motion_is_the_same_to_the_bit_and_force_and_torque_are(rate: float) -> None:
    """Trends pass other filters: within 1e-4 of load and torque, and the sensor's noise in its trend."""
    slow, usual = record(rate), record(RATES[0])
    for name in ("body_pose", "contacts"):
        np.testing.assert_array_equal(
            np.concatenate([getattr(each, name) for each in slow]),
            np.concatenate([getattr(each, name) for each in usual]),
        )
    noise = asked().sensors[0].noise_density * np.sqrt(200.0)
    for name, most in (("force", 6.8), ("shaft_torque", 6e-4), ("specific_force", noise)):
        values = [
            dict(
                zip(
                    np.concatenate([each.trend_time_ns for each in blocks]).tolist(),
                    np.concatenate([getattr(each, name) for each in blocks]),
                    strict=True,
                )
            )
            for blocks in (slow, usual)
        ]
        common = sorted(values[0].keys() & values[1].keys())
        common = [each for each in common if each >= SETTLED * 1e9]
        assert len(common) > 400
        apart = np.array([values[0][each] - values[1][each] for each in common])
        assert np.sqrt(np.mean(apart**2)) < most


@pytest.mark.parametrize("rate", SLOW_RATES)
def test_samples_have_their_true_time(rate: float) -> None:
    blocks = record(rate)
    time = np.concatenate([each.waveform_time_ns for each in blocks])
    np.testing.assert_array_equal(time, np.arange(len(time)) * 1_000_000_000 // round(rate))
    assert all(np.array_equal(each.acceleration[0], each.vibration[0].acceleration) for each in blocks)


@pytest.mark.parametrize(
    ("to", "expected", "words"),
    [
        (300.0, 1.1, "up to 1.1 dB to 0.3 kHz"),
        (300.0, 20.0, "up to 6 dB to 0.3 kHz"),  # behind a spall
        (800.0, 2.0, "up to 2 dB to 0.8 kHz"),
        (4000.0, 6.0, "up to 6 dB to 4 kHz"),
        (10_000.0, 22.0, "up to 6 dB to 5 kHz, 22 dB above"),
    ],
)
def test_a_bound_of_third_octaves_is_of_the_bands_asked_for(to: float, expected: float, words: str) -> None:
    choice: Any = SimpleNamespace(
        tier="lumped", effects=None, expected={"vibration": expected}, vibration_to=to
    )
    assert third_octaves_found(choice) == words
