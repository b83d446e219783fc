"""Several accelerometers at once, from the scene file to the recording."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.sinks import McapSink
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.sensors.block import Block
from beardyn_core.study.desk_run import run
from beardyn_core.twin import Twin

SENSORS = """
sensors:
  - {name: top}
  - {name: magnet, position_mm: [100, 0, 120], mounting_resonance_Hz: 7000, mounting_damping_ratio: 0.05}
  - {name: fast, position_mm: [0, 80, 0], rate_kHz: 51.2, mounting_resonance_Hz: 30000, range_m_per_s2: 90}
"""


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    text = "scene: three\nbearing: HS130x230\nlubricant: L055\ntier: lumped\n"
    path = tmp_path_factory.mktemp("scenes") / "three.yaml"
    path.write_text(text + "operation: {kind: constant, force_kN: [0, 0, 60], speed_rpm: 600}\n" + SENSORS)
    return replace(load_scene(str(path)), duration=0.2)


def started(scene: Scene) -> Twin:
    return start(scene).twin


def blocks_of(scene: Scene, count: int = 6) -> list[Block]:
    twin = started(scene)
    return [twin.advance() for _ in range(count)]


def test_a_fast_sensor_brings_the_steps_that_it_needs(scene: Scene) -> None:
    assert scene.numerics.steps_per_sample == 8


def test_each_sensor_has_its_own_time_without_gaps(scene: Scene) -> None:
    blocks = blocks_of(scene)
    for number, rate in enumerate((25_600, 25_600, 51_200)):
        parts = [block.vibration[number] for block in blocks]
        sample = np.concatenate([part.sample + np.arange(len(part.time_ns)) for part in parts])
        assert np.array_equal(sample, np.arange(len(sample)))
        time_ns = np.concatenate([part.time_ns for part in parts])
        assert np.array_equal(time_ns, sample * 1_000_000_000 // rate)
        assert blocks[-1].end_ns - time_ns[-1] < 1_000_000
    assert blocks[-1].acceleration.shape == (2, 512, 3)
    assert np.abs(blocks[-1].vibration[2].acceleration).max() <= 90.0


def test_a_sensor_reads_the_same_whoever_sits_beside_it(scene: Scene) -> None:
    """The others only make the block come later: the same numbers at the same times."""
    both, alone = (
        np.concatenate([block.vibration[0].acceleration for block in blocks_of(each)])
        for each in (scene, replace(scene, sensors=scene.sensors[:1]))
    )
    assert 0 < len(alone) - len(both) <= 24
    assert np.array_equal(both, alone[: len(both)])


def test_restored_sensors_go_on_with_the_same_bits(scene: Scene) -> None:
    twin = started(replace(scene, sensors=scene.sensors[::-1]))
    for _ in range(3):
        twin.advance()
    kept = twin.snapshot()
    first = [twin.advance() for _ in range(3)]
    twin.restore(kept)
    for one, other in zip(first, [twin.advance() for _ in range(3)], strict=True):
        assert np.array_equal(one.specific_force, other.specific_force)
        for a, b in zip(one.vibration, other.vibration, strict=True):
            assert np.array_equal(a.acceleration, b.acceleration)


def test_trends_of_a_fast_first_sensor_stand_where_those_of_the_others_do(scene: Scene) -> None:
    """The same place received at both rates, decimated to 400 Hz, differs by noise and rounding only."""
    place = Accelerometer("here", (0.0, 0.0, 0.1), 0.0, 1e9, mounting_resonance=30_000.0)
    quiet = (place, replace(place, rate=51_200.0))
    usual, fast = (
        np.concatenate([block.specific_force for block in blocks_of(replace(scene, sensors=(each,)), 8)])
        for each in quiet
    )
    assert usual.shape == fast.shape
    np.testing.assert_allclose(usual, fast, atol=1e-3 * np.abs(usual - usual.mean(axis=0)).max())


def test_every_sensor_has_its_topic_in_the_recording(scene: Scene, tmp_path: Path) -> None:
    path = tmp_path / "three.mcap"
    run(scene, [McapSink(path)])
    found, blocks = read_run(path), blocks_of(scene, 10)
    topics = ("vibration", "vibration/magnet", "vibration/fast")
    assert set(found.sensor_topics) == set(topics)
    for number, name in enumerate(topics):
        values = np.concatenate([block.vibration[number].acceleration for block in blocks])
        np.testing.assert_array_equal(found.sensor_topics[name].values, values.astype(np.float32))
        time_ns = np.concatenate([block.vibration[number].time_ns for block in blocks])
        np.testing.assert_array_equal(found.sensor_topics[name].time_ns, time_ns)
    told = report(path)
    assert told.gaps == ()
    assert told.sensor_rates_Hz == {"top": 25_600.0, "magnet": 25_600.0, "fast": 51_200.0}
    assert "fast at 51.2 kHz" in told.to_text()
