"""Broken files: whatever is in them, the commands give a result or a sentence, never a traceback."""

from __future__ import annotations

import os
import struct
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.writer import CompressionType, Writer

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.reading import read_run
from test.examples import examples
from test.record.hostile import MAGIC, told
from test.recordings import write_recording


@pytest.fixture(scope="session")
def short_recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("short") / "run.mcap", 6)


@pytest.fixture(scope="session")
def loose_recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording whose messages nothing protects: no chunks, no checksums."""
    folder = tmp_path_factory.mktemp("loose")
    source = write_recording(folder / "run.mcap", 3)
    target = folder / "loose.mcap"
    scan = McapScan(source)
    messages = list(scan.raw_messages())
    with target.open("wb") as file:
        writer = Writer(
            file,
            use_chunking=False,
            enable_crcs=False,
            compression=CompressionType.NONE,
            use_statistics=False,
        )
        writer.start(profile="ros2", library="test")
        schemas = {
            key: writer.register_schema(schema.name, schema.encoding, schema.data)
            for key, schema in scan.schemas.items()
        }
        channels = {
            key: writer.register_channel(
                channel.topic, channel.message_encoding, schemas[channel.schema_id], dict(channel.metadata)
            )
            for key, channel in scan.channels.items()
        }
        for name, data in scan.attachments.items():
            writer.add_attachment(0, 0, name, "", data)
        for message in messages:
            writer.add_message(
                channels[message.channel_id], message.log_time, message.data, message.publish_time, 0
            )
        writer.finish()
    return target


def every_command_answers(path: Path) -> None:
    for words in (
        ["report", str(path), "--force"],
        ["report", str(path), "--json", "--force"],
        ["monitor", str(path)],
        ["view", str(path), "--save", str(path.with_suffix(".rrd")), "--force"],
    ):
        code, said = told(*words)
        assert code in (command.DONE, command.BAD_INPUT), said
        assert "Traceback" not in said
        if code == command.BAD_INPUT:
            assert "beardyn: " in said
            assert path.name in said or path.stem in said


GARBAGE = {
    "empty": b"",
    "zeros": bytes(5000),
    "text": b"time_s,fx_N\n0,1\n",
    "magic alone": MAGIC,
    "magic and zeros": MAGIC + bytes(5000),
    "magic and ones": MAGIC + b"\xff" * 5000,
    "two magics": MAGIC + MAGIC,
    "huge record": MAGIC + b"\x06" + struct.pack("<Q", 1 << 60) + bytes(100),
    "huge chunk": MAGIC
    + b"\x06"
    + struct.pack("<Q", 60)
    + struct.pack("<QQQIL", 0, 0, 1 << 50, 0, 4)
    + b"zstd"
    + struct.pack("<Q", 8)
    + bytes(100),
}


@pytest.mark.parametrize("content", GARBAGE.values(), ids=GARBAGE.keys())
def test_what_is_no_recording_is_a_sentence(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "garbage.mcap"
    path.write_bytes(content)
    for words in (["report"], ["monitor"], ["view", "--save", str(tmp_path / "x.rrd")]):
        code, said = told(*words, str(path))
        assert code == command.BAD_INPUT, said
        assert str(path) in said
        assert "Traceback" not in said
    assert not (tmp_path / "x.rrd").exists()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with a name are of POSIX")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    """Nobody writes into it: opening it would never end."""
    pipe = tmp_path / "run.mcap"
    os.mkfifo(pipe)
    imported = ("import", str(pipe), "--speed-rpm", "900", "--bearing", "HS130x230", "-o", "x.mcap")
    for words in (("report", str(pipe)), ("monitor", str(pipe)), ("estimate", str(pipe)), imported):
        code, said = told(*words)
        assert code == 2, words
        assert "a pipe or a device, not a file" in said, words


def test_a_folder_and_a_missing_file_are_sentences(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "absent.mcap"):
        for words in (["report"], ["monitor"], ["view", "--save", str(tmp_path / "x.rrd")]):
            code, said = told(*words, str(path))
            assert code == command.BAD_INPUT
            assert f"{path}: cannot read the recording" in said


QUICKLY = settings(
    max_examples=examples(30), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@QUICKLY
@given(share=st.floats(0.0, 1.0), zeros=st.booleans())
def test_a_truncated_file_is_a_result_or_a_sentence(
    share: float, zeros: bool, short_recording: Path, tmp_path: Path
) -> None:
    """Also with zeros in place of the end, as a crash of the machine leaves it."""
    path, content = tmp_path / "cut.mcap", short_recording.read_bytes()
    size = round(share * len(content))
    path.write_bytes(content[:size] + bytes(zeros * (len(content) - size)))
    every_command_answers(path)


@QUICKLY
@given(
    flips=st.lists(st.tuples(st.floats(0.0, 0.9999), st.integers(0, 7)), min_size=1, max_size=8),
    protected=st.booleans(),
)
def test_a_file_with_flipped_bits_is_a_result_or_a_sentence(
    flips: list[tuple[float, int]],
    protected: bool,
    short_recording: Path,
    loose_recording: Path,
    tmp_path: Path,
) -> None:
    damaged = bytearray((short_recording if protected else loose_recording).read_bytes())
    for share, bit in flips:
        damaged[int(share * len(damaged))] ^= 1 << bit
    path = tmp_path / "flipped.mcap"
    path.write_bytes(damaged)
    every_command_answers(path)


@settings(
    max_examples=examples(150), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(flips=st.lists(st.tuples(st.floats(0.0, 0.9999), st.integers(0, 255)), min_size=1, max_size=5))
def test_reading_damaged_messages_is_a_result_or_a_sentence(
    flips: list[tuple[float, int]], loose_recording: Path, tmp_path: Path
) -> None:
    damaged = bytearray(loose_recording.read_bytes())
    for share, value in flips:
        damaged[int(share * len(damaged))] = value
    path = tmp_path / "damaged.mcap"
    path.write_bytes(damaged)
    with suppress(InputError):
        read_run(path)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is always full")
def test_a_full_disk_behind_a_recovery_leaves_the_report_and_a_sentence(
    short_recording: Path, tmp_path: Path
) -> None:
    path = tmp_path / "cut.mcap"
    content = short_recording.read_bytes()
    path.write_bytes(content[: len(content) * 9 // 10])
    path.with_suffix(".recovered.mcap").symlink_to("/dev/full")
    code, said = told("report", str(path), "--force")
    assert code == command.BAD_INPUT
    assert "/axlebox/vibration" in said
    assert "cannot write the recovered recording (No space left on device)" in said
    assert "is as it was" in said


def test_a_view_that_cannot_be_written_is_a_sentence(short_recording: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    path.write_bytes(short_recording.read_bytes())
    code, said = told("view", str(path), "--save", str(tmp_path / "no" / "run.rrd"))
    assert code == command.BAD_INPUT
    assert "the folder" in said


def test_a_file_without_its_last_messages_does_not_say_how_the_run_ended(tmp_path: Path) -> None:
    recording = write_recording(tmp_path / "run.mcap", 40)  # of several chunks
    whole = recording.read_bytes()
    messages = sum(1 for _ in McapScan(recording).raw_messages())
    cut = tmp_path / "cut.mcap"
    short = []
    for size in range(len(whole) // 2, len(whole), max(len(whole) // 200, 1)):
        cut.write_bytes(whole[:size])
        if sum(1 for _ in McapScan(cut).raw_messages()) < messages:
            short.append(size)
            assert read_run(cut).status is None, size
    assert short
    cut.write_bytes(whole[: short[-1]])
    assert "not closed properly" in repr(read_run(cut))
