"""Load and speed of a recording take the place of a model; bad recordings in a sentence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.rail.measured import read_measurement, speed_points
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import header, make, serialize
from beardyn_core.record.topics import FRAME, JOINTS, NAMESPACE, TWIST, WRENCH
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import MeasuredOperation

Messages = list[tuple[str, int, bytes]]


def history(samples: int = 3001, rate: float = 10_000.0, start_ns: int = 0) -> LoadHistory:
    rng = np.random.default_rng(4)
    time_ns = start_ns + np.arange(samples, dtype=np.int64) * round(1e9 / rate)
    wrench = 1e4 * rng.normal(size=(samples, 6))
    return LoadHistory(time_ns, wrench, 100 + rng.normal(size=samples), 1e-3 * rng.normal(size=(samples, 3)))


def recorded(path: Path, messages: Messages) -> Path:
    writer = McapWriter(path, NAMESPACE)
    for name, stamp, cdr in messages:
        writer.add(name, stamp, cdr)
    writer.close("")
    return path


def blocks(load: LoadHistory, length: int = 500) -> Messages:
    parts = range(0, len(load), length)
    sent: Messages = [
        ("load/blocks", int(load.time_ns[at]), encode_load(load.part(at, min(at + length, len(load))), at))
        for at in parts
    ]
    return [*sent, ("load/blocks", int(load.time_ns[-1]), encode_load(load.part(0, 0), len(load)))]


def vector(x: float, y: float, z: float) -> object:
    return make("geometry_msgs/msg/Vector3", x=x, y=y, z=z)


def wrench_message(name: str, stamp: int, values: np.ndarray) -> tuple[str, int, bytes]:
    content = make("geometry_msgs/msg/Wrench", force=vector(*values[:3]), torque=vector(*values[3:]))
    return name, stamp, serialize(make(WRENCH, header=header(stamp, FRAME), wrench=content))


def twist_message(stamp: int, speed: float) -> tuple[str, int, bytes]:
    turning = make("geometry_msgs/msg/Twist", linear=vector(0.0, 0.0, 0.0), angular=vector(0.0, speed, 0.0))
    return "load/shaft", stamp, serialize(make(TWIST, header=header(stamp, FRAME), twist=turning))


def joint_message(stamp: int, speed: float) -> tuple[str, int, bytes]:
    one = np.array([speed])
    content = make(
        JOINTS, header=header(stamp, FRAME), name=["shaft"], position=0 * one, velocity=one, effort=one[:0]
    )
    return "shaft", stamp, serialize(content)


def test_a_recorded_stream_comes_back_bit_by_bit_at_its_own_rate(tmp_path):
    load = history()
    path = recorded(tmp_path / "run.mcap", blocks(load))
    again = load_history(MeasuredOperation(path), Mounting(), 0.2, 1)
    count = 2001
    assert len(again) == count
    for name in ("time_ns", "wrench", "shaft_speed", "bogie"):
        assert np.array_equal(getattr(again, name), getattr(load, name)[:count])


def test_a_scene_takes_a_recording(tmp_path):
    recorded(tmp_path / "run.mcap", blocks(history()))
    text = "scene: mine\nbearing: HS130x230\nlubricant: L055\nduration_s: 0.25\n"
    (tmp_path / "mine.yaml").write_text(text + "operation: {kind: mcap, path: run.mcap}\n")
    scene = load_scene(tmp_path / "mine.yaml")
    load = load_history(scene.operation, scene.mounting, scene.duration, scene.seed)
    assert np.array_equal(load.wrench, history().wrench[:2501])


def test_a_stream_that_begins_late_begins_at_zero(tmp_path):
    path = recorded(tmp_path / "run.mcap", blocks(history(start_ns=5_000_000_000)))
    again = load_history(MeasuredOperation(path), Mounting(), 0.2, 1)
    assert again.time_ns[0] == 0
    assert np.array_equal(again.wrench, history().wrench[:2001])


def test_of_a_stream_that_began_again_the_last_one_is_taken(tmp_path):
    first, second = history(), history(2001)
    cut = blocks(first)[:3]
    path = recorded(tmp_path / "run.mcap", [*cut, *blocks(second)])
    stream = read_measurement(path).stream
    assert stream is not None
    assert np.array_equal(stream.wrench, second.wrench)


@pytest.mark.parametrize("pair", ["live", "twin"])
def test_force_and_speed_topics_are_a_load_too(tmp_path, pair):
    load = history(801, 400.0)
    force = "load/wrench" if pair == "live" else "force"
    messages = []
    for at in range(len(load)):
        stamp = int(load.time_ns[at])
        messages.append(wrench_message(force, stamp, load.wrench[at]))
        speed = float(load.shaft_speed[at])
        messages.append(twist_message(stamp, speed) if pair == "live" else joint_message(stamp, speed))
    path = recorded(tmp_path / "run.mcap", messages)
    again = load_history(MeasuredOperation(path), Mounting(), 1.5, 1)
    assert again.wrench[::5] == pytest.approx(load.wrench[: len(again.wrench[::5])])
    assert again.shaft_speed[::5] == pytest.approx(load.shaft_speed[: len(again.wrench[::5])])
    # one of the two alone
    force_only = MeasuredOperation(path, "force", ((0.0, 10.0),), 1.0)
    only = load_history(force_only, Mounting(), 1.5, 1)
    assert np.allclose(only.shaft_speed, 20.0)
    assert np.array_equal(only.wrench, again.wrench)
    profile = np.array(speed_points(path, 1.0))
    assert profile[:, 1] == pytest.approx(50.0, abs=1.0)


def test_one_topic_of_a_pair_is_enough_for_what_is_taken(tmp_path):
    path = recorded(tmp_path / "run.mcap", [twist_message(at * 10_000_000, 30.0) for at in range(100)])
    assert read_measurement(path, "speed").shaft_speed == pytest.approx(30.0)
    for take, words in (("both", "no load in it"), ("force", "no force in it")):
        with pytest.raises(InputError, match=rf"{words}, it has load/shaft; needed are load/blocks"):
            read_measurement(path, take)


def test_bad_recordings_are_refused_in_a_sentence(tmp_path):
    load = history()
    with pytest.raises(InputError, match=r"none\.mcap: cannot read the recording"):
        read_measurement(tmp_path / "none.mcap")
    (tmp_path / "text.mcap").write_text("time_s,fz_N\n")
    with pytest.raises(InputError, match="is not an MCAP file"):
        read_measurement(tmp_path / "text.mcap")
    lost = blocks(load)
    del lost[2]
    with pytest.raises(InputError, match="samples 1000 to 1499 of load/blocks are missing"):
        read_measurement(recorded(tmp_path / "lost.mcap", lost))
    load.wrench[700, 2] = np.nan
    with pytest.raises(InputError, match="NaN"):
        read_measurement(recorded(tmp_path / "nan.mcap", blocks(load)))
    with pytest.raises(InputError, match="has no sample in it"):
        read_measurement(recorded(tmp_path / "end.mcap", blocks(load)[-1:]))
    holed = [wrench_message("load/wrench", at * 10_000_000, np.ones(6)) for at in (*range(50), 300, 301)]
    with pytest.raises(InputError, match=r"jumps by 2\.51 s at 0\.49 s where the usual step is 0\.01 s"):
        read_measurement(recorded(tmp_path / "hole.mcap", holed), "force")
    short = recorded(tmp_path / "short.mcap", blocks(history()))
    with pytest.raises(InputError, match=r"covers 0\.3 s; the run needs 1 s"):
        load_history(MeasuredOperation(short), Mounting(), 1.0, 1)
