"""The fast encoders say byte for byte what the reference serializer says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.record.clouds import CloudTemplate, cloud_times, cloud_to_arrays, encode_points, points_of
from beardyn_core.record.encoding import (
    BODIES,
    CONTACTS,
    VIBRATION,
    WAVEFORM,
    BlockEncoder,
    force_template,
    imu_template,
    joint_template,
    orbit_joints,
)
from beardyn_core.record.load_stream import LOAD, decode_load, encode_load, encode_loads
from beardyn_core.record.messages import (
    CLOCK,
    TIME,
    Diagnostic,
    Template,
    decode,
    decode_diagnostics,
    decode_string,
    encode_clock,
    encode_diagnostics,
    encode_string,
    encode_time,
    header_stamp,
    make,
    serialize,
    time,
)
from beardyn_core.record.topics import TOPICS, namespace_of, relative_name, topic
from beardyn_core.scene.load import LoadHistory
from beardyn_core.sensors.block import CONTACT_KINDS
from test.record.synthetic_run import SyntheticRun

STAMPS = np.array([0, 1, 999_999_999, 1_000_000_000, 12_345_678_901_234], np.int64)
NAMES = orbit_joints(17)


@pytest.mark.parametrize(
    ("template", "slots"),
    [
        (force_template("axlebox"), {"wrench": 6}),
        (force_template("left/axlebox_1"), {"wrench": 6}),
        (imu_template("axlebox"), {"acceleration": 3}),
        (joint_template(("shaft",), "axlebox", effort=False), {"position": 1, "velocity": 1}),
        (
            joint_template(NAMES, "box", effort=True),
            {"position": len(NAMES), "velocity": len(NAMES), "effort": len(NAMES)},
        ),
    ],
)
def test_template_messages_equal_the_reference_serializer(template: Template, slots: dict[str, int]) -> None:
    random = np.random.default_rng(3)
    values = {name: random.normal(0.0, 1e3, (len(STAMPS), size)) for name, size in slots.items()}
    made = template.encode(STAMPS, **values)
    for i, stamp in enumerate(STAMPS):
        message = template._build(**{name: value[i] for name, value in values.items()})
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(int(stamp), 1_000_000_000)
        assert made[i] == serialize(message)
        assert header_stamp(made[i]) == stamp
    rows = template.decode(made)
    assert rows is not None
    for name, value in values.items():
        np.testing.assert_array_equal(rows[name], value)


def test_template_refuses_to_decode_a_message_with_other_fixed_content() -> None:
    here, there = force_template("axlebox_a"), force_template("axlebox_b")
    assert here.decode(there.encode(STAMPS, wrench=np.zeros((len(STAMPS), 6)))) is None


@pytest.mark.parametrize("dtype", [WAVEFORM, VIBRATION, BODIES, CONTACTS, LOAD])
@pytest.mark.parametrize("count", [0, 1, 513])
@pytest.mark.parametrize("frame", ["a", "ab", "abc", "axlebox"])
def test_cloud_template_equals_the_reference_serializer(dtype: np.dtype, count: int, frame: str) -> None:
    points = points_of(dtype, 7, 5_000_000_123 + np.arange(count) * 39_062, 5_000_000_100)
    names = dtype.names or ()
    for name in names[2:]:
        points[name] = np.arange(count) % 200
    cdr = CloudTemplate(dtype, frame).encode(points, 5_000_000_100)
    assert cdr == encode_points(points, 5_000_000_100, frame)
    back = cloud_to_arrays(cdr)
    assert back.dtype.names == names
    for name in names:
        np.testing.assert_array_equal(back[name], points[name])
    np.testing.assert_array_equal(cloud_times(cdr, back), 5_000_000_123 + np.arange(count) * 39_062)


def test_sample_index_wraps_at_32_bits() -> None:
    points = points_of(VIBRATION, 2**32 - 2, np.arange(4), 0)
    assert points["sample"].tolist() == [2**32 - 2, 2**32 - 1, 0, 1]


def test_times_and_clock_equal_the_reference_serializer() -> None:
    for stamp in STAMPS.tolist():
        assert encode_time(stamp) == serialize(time(stamp))
        assert encode_clock(stamp) == serialize(make(CLOCK, clock=time(stamp)))
        assert header_stamp(encode_time(stamp)) == stamp
        assert decode(TIME, encode_time(stamp)).sec == stamp // 1_000_000_000


def test_text_and_diagnostics_come_back() -> None:
    assert decode_string(encode_string("Wälzlager")) == "Wälzlager"
    sent = (Diagnostic("beardyn monitor", 1, "cup fault", (("score_dB", "18.2"),)), Diagnostic("b", 0, "ok"))
    stamp, got = decode_diagnostics(encode_diagnostics(77, "axlebox", sent))
    assert (stamp, got) == (77, sent)
    assert got[0].value("score_dB") == "18.2"
    assert got[1].value("score_dB") is None


def test_load_comes_back_bit_identical() -> None:
    random = np.random.default_rng(5)
    history = LoadHistory(
        np.arange(400, dtype=np.int64) * 500_000 + 3_000_000_000,
        random.normal(0, 8e4, (400, 6)),
        random.normal(100, 1, 400),
        random.normal(0, 1e-3, (400, 3)),
    )
    back, sample = decode_load(encode_load(history, 1200))
    np.testing.assert_array_equal(sample, 1200 + np.arange(400))
    for name in ("time_ns", "wrench", "shaft_speed", "bogie"):
        np.testing.assert_array_equal(getattr(back, name), getattr(history, name))


def test_loads_encoded_at_once_are_the_messages_one_by_one() -> None:
    random = np.random.default_rng(6)
    times = np.arange(1200, dtype=np.int64) * 100_000 + 3_999_990_000
    numbers = random.normal(0, 8e4, (1200, 6)), random.normal(100, 1, 1200), random.normal(0, 1e-3, (1200, 3))
    history = LoadHistory(times, *numbers)
    rows = encode_loads(history, 2**32 - 500, 400, "axle_1_left")
    for k, row in enumerate(rows):
        part, first = history.part(400 * k, 400 * (k + 1)), 2**32 - 500 + 400 * k
        points = points_of(LOAD, first, part.time_ns, int(part.time_ns[0]))
        assert LOAD.names is not None
        for name, column in zip(LOAD.names[2:], np.column_stack(numbers).T, strict=True):
            points[name] = column[400 * k : 400 * (k + 1)]
        assert row.tobytes() == encode_points(points, int(part.time_ns[0]), "axle_1_left")
        assert row.tobytes() == encode_load(part, first, "axle_1_left")


def test_an_empty_load_block_ends_the_stream() -> None:
    nothing = LoadHistory(np.zeros(0, np.int64), np.zeros((0, 6)), np.zeros(0), np.zeros((0, 3)))
    history, sample = decode_load(encode_load(nothing, 5))
    assert len(history) == len(sample) == 0


def test_a_load_message_longer_than_its_clock_is_refused() -> None:
    times = np.array([0, 4_300_000_000], np.int64)
    with pytest.raises(ValueError, match=r"at most 4\.29 s"):
        encode_load(LoadHistory(times, np.zeros((2, 6)), np.zeros(2), np.zeros((2, 3))), 0)


def test_block_messages_hold_the_numbers_of_the_block() -> None:
    block = SyntheticRun(sensor_count=2).block(3)
    messages: dict[str, list[tuple[int, bytes]]] = {}
    for name, stamp, cdr in BlockEncoder(17, ("top", "end")).encode(block):
        assert header_stamp(cdr) == stamp
        messages.setdefault(name, []).append((stamp, cdr))
    assert [stamp for stamp, _ in messages["force"]] == block.trend_time_ns.tolist()
    force = decode(topic("force").type, messages["force"][5][1])
    assert force.wrench.force.z == block.force[5, 2]
    assert force.header.frame_id == "axlebox"
    imu = decode(topic("imu").type, messages["imu"][2][1])
    assert imu.orientation_covariance[0] == -1.0
    assert imu.linear_acceleration.x == block.specific_force[2, 0]
    shaft = decode(topic("shaft").type, messages["shaft"][7][1])
    assert (list(shaft.name), shaft.position[0]) == (["shaft"], block.shaft_angle[7])
    assert len(messages["joint_states"]) == 4
    joints = decode(topic("joint_states").type, messages["joint_states"][1][1])
    angles = dict(zip(joints.name, joints.position, strict=True))
    assert angles["cage_1"] == block.cage_angle[2, 1]
    assert angles["roller_1_16"] == block.roller_angle[2, 1, 16]
    assert dict(zip(joints.name, joints.effort, strict=True))["shaft"] == block.shaft_torque[2]
    for name, sensor in (("vibration", 0), ("vibration/end", 1)):
        cloud = cloud_to_arrays(messages[name][0][1])
        np.testing.assert_array_equal(cloud["az"], block.acceleration[sensor, :, 2].astype(np.float32))
        np.testing.assert_array_equal(cloud["sample"], block.waveform_sample + np.arange(512))
    bodies = cloud_to_arrays(messages["bodies"][0][1]).reshape(4, -1)
    np.testing.assert_array_equal(bodies["qw"], block.body_pose[:, :, 6].astype(np.float32))
    np.testing.assert_array_equal(bodies["sample"][:, 5], block.snapshot_sample + np.arange(4))
    contacts = cloud_to_arrays(messages["contacts"][0][1])
    loaded = np.any(block.contacts[..., 3:6] != 0.0, axis=-1)
    assert len(contacts) == loaded.sum()
    first = contacts[(contacts["kind"] == CONTACT_KINDS.index("cone")) & (contacts["row"] == 1)][0]
    expected = block.contacts[first["sample"] - block.snapshot_sample, 1, first["roller"], 1]
    assert first["fz"] == np.float32(expected[5])


@pytest.mark.parametrize(
    ("trends", "expected"), [(0, []), (1, ["force", "imu", "shaft", "joint_states"])], ids=["none", "one"]
)
@pytest.mark.parametrize("trend_sample", [4, 5])
def test_a_block_that_ended_early_has_no_empty_messages(
    trends: int, expected: list[str], trend_sample: int
) -> None:
    block = SyntheticRun().block(0)
    trend_fields = (
        "trend_time_ns",
        "force",
        "specific_force",
        "shaft_angle",
        "shaft_speed",
        "shaft_torque",
        "cage_angle",
        "cage_speed",
        "roller_angle",
        "roller_speed",
    )
    short = replace(
        block,
        trend_sample=trend_sample,
        waveform_time_ns=block.waveform_time_ns[:0],
        snapshot_time_ns=block.snapshot_time_ns[:0],
        **{name: getattr(block, name)[:trends] for name in trend_fields},
    )
    names = [name for name, _, _ in BlockEncoder(17, ("axlebox_top",)).encode(short)]
    # Joint states are every second trend sample, so an odd one has none.
    assert names == [name for name in expected if trend_sample % 2 == 0 or name != "joint_states"]


def test_times_before_zero_are_exact_in_the_header() -> None:
    block = SyntheticRun().block(0)
    received = block.vibration[0]
    early = replace(block, vibration=(replace(received, time_ns=received.time_ns - 700_000),))
    for name, stamp, cdr in BlockEncoder(17, ("axlebox_top",)).encode(early):
        if name == "vibration":
            assert stamp == -700_000
            np.testing.assert_array_equal(cloud_times(cdr, cloud_to_arrays(cdr)), early.vibration[0].time_ns)


def test_topic_names_are_unique_and_come_back_from_their_path() -> None:
    assert len({entry.name for entry in TOPICS}) == len(TOPICS)
    for entry in TOPICS:
        assert relative_name(entry.path("/train/left"), "/train/left") == entry.name
        if not entry.name.startswith("/"):
            assert namespace_of(entry.path("/train/left")) == "/train/left"
    assert topic("vibration/rear").type == topic("vibration").type
    with pytest.raises(KeyError):
        topic("temperatur")
