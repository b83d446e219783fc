"""Kinds of sensors and backgrounds in a scene file: what a sensor takes from its kind, what is refused."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.choice.fast_step import fast_steps
from beardyn_core.config import load_background, load_sensor, scene_text, shipped_names
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.run import blocks
from beardyn_core.scene.background import Background, Knocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer, SensorType

RAIL = (
    "scene: mine\nbearing: HS130x230\nlubricant: L055\noperation: {kind: quarter_vehicle, vehicle: emu_300, "
    "speed_profile: [{time_s: 0, speed_kmh: 100}]}\n"
)
HELD = RAIL.partition("operation:")[0] + "operation: {kind: constant, force_kN: [0, 0, 60], speed_rpm: 600}\n"


def read(folder: Path, text: str) -> Scene:
    path = folder / "mine.yaml"
    path.write_text(text)
    return load_scene(str(path))


@pytest.mark.parametrize("name", shipped_names("sensors"))
def test_a_sensor_has_the_figures_of_its_kind_and_its_own_in_their_place(name: str, tmp_path: Path) -> None:
    kind = load_sensor(name)
    plain, own = read(
        tmp_path,
        HELD + f"sensors:\n  - {{name: a, type: {name}}}\n"
        f"  - {{name: b, type: {name}, range_m_per_s2: 7, mounting_resonance_Hz: 9000}}\n",
    ).sensors
    shared = {field.name for field in fields(SensorType)} & {field.name for field in fields(Accelerometer)}
    for field in shared - {"name"}:
        assert getattr(plain, field) == getattr(kind, field), field
    assert own == replace(plain, name="b", range=7.0, mounting_resonance=9000.0)


@pytest.mark.parametrize("name", shipped_names("sensors"))
def test_every_figure_of_a_kind_has_a_source_or_is_assumed(name: str) -> None:
    figures = set(read_file(find("sensors", name))) - {"name", "description"}
    assert all(any(key.startswith(told) for told, _ in load_sensor(name).sources) for key in figures)
    assert all(text for _, text in load_sensor(name).sources)


def test_a_sensor_of_no_kind_is_as_quiet_as_that_for_axleboxes() -> None:
    kind, usual = load_sensor("piezo_axlebox"), Accelerometer()
    assert (usual.noise_density, usual.range, usual.sensitivity) == (
        kind.noise_density,
        kind.range,
        kind.sensitivity,
    )


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_every_sensor_of_a_shipped_scene_is_of_a_shipped_kind(name: str) -> None:
    for sensor in load_scene(name).sensors:
        assert sensor.type is not None
        assert sensor.type.name in shipped_names("sensors")
        assert sensor.noise_density == sensor.type.noise_density


@pytest.mark.parametrize("name", ["service_metro", "service_freight_cone"])
def test_a_recorded_scene_keeps_kind_sources_and_background(name: str) -> None:
    scene = load_scene(name)
    again = scene_from_text(scene_text(scene))
    assert again == scene
    assert again.background == load_background(scene.background.name) if scene.background else False


@pytest.mark.parametrize("tier", ["lumped", "quasistatic", "full"])
def test_readings_end_at_the_range_in_every_tier(tier: str, tmp_path: Path) -> None:
    own = "range_m_per_s2: 9.9, noise_density_m_per_s2_per_sqrt_Hz: 0.1"
    text = HELD + f"sensors: [{{name: a, type: mems_50g, {own}}}]\n"
    scene = replace(read(tmp_path, text + f"tier: {tier}\n"), duration=0.1)
    read_z = np.concatenate([block.vibration[0].acceleration[:, 2] for block in blocks(scene)])
    assert read_z.max() == 9.9
    assert 0.3 < np.mean(read_z == 9.9) < 0.7  # gravity is 9.807, the noise 11 m/s2 rms


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (HELD + "sensors: [{name: a, type: iepe_10}]", "did you mean iepe_100"),
        (HELD + "sensors: [{name: a, type: {name: b}}]", "noise_density_m_per_s2_per_sqrt_Hz"),
        (HELD + "sensors: [{name: a, low_pass_Hz: 100}]", "low_pass_Hz is 100"),
        (HELD + "sensors: [{name: a, measured_paths: [{path: none.csv}]}]", "no such file"),
        (HELD + "background: driven_car", "driven_car"),
        (HELD + "background: driven_emu", "needs an operation of kind quarter_vehicle"),
        (
            RAIL.replace("vehicle: emu_300", "vehicle: emu_300, irregularity: {short_waves: iso_3095}")
            + "background: driven_emu",
            "the same waves",
        ),
        (
            HELD + "tier: lumped\nnumerics: {steps_per_sample: 0.5}\n"
            "background: {name: b, knocks: {rate_Hz: 1, impulse_N_s: 1}}",
            "a background with forces needs at least 1",
        ),
        (
            HELD + "background: {name: b, drive: {teeth: 40, gear_ratio: 3, mesh_force_kN: [1], "
            "motor_orders: [1]}}",
            "give one",
        ),
        (HELD + "background: {name: b, other_bearing: {passing_force_kN: [0], fault: cup}}", "go together"),
    ],
)
def test_what_cannot_be_is_answered_with_a_sentence(text: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, text + "\n")


def test_a_background_keeps_the_steps_of_fast_tiers_at_a_sample() -> None:
    scene = load_scene("static_80kN", tier="lumped")
    knocked = replace(scene, background=Background("b", "", knocks=Knocks(1.0, 1.0)))
    assert fast_steps(scene, long=True).steps_per_sample < 1
    assert fast_steps(knocked, long=True).steps_per_sample == 1
