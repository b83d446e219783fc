"""Files that would hang a reader or exhaust its memory: each is a sentence, soon."""

from __future__ import annotations

import json
import os
import time
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
import zstandard
from hypothesis import given
from hypothesis import strategies as st
from mcap.data_stream import RecordBuilder
from mcap.exceptions import McapError
from mcap.records import Chunk, Footer, Header

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import DEEPEST, LONGEST_TEXT, read_object
from beardyn_core.config.yaml_text import read_mapping
from beardyn_core.follow.estimator import read_estimator
from beardyn_core.rail.measured import read_measurement
from beardyn_core.rail.transfer_path import read_transfer_path
from beardyn_core.record.chunk_reading import (
    _RECORD,
    ALWAYS_READ,
    ALWAYS_UNPACKED,
    LARGEST_CHUNK,
    LARGEST_RATIO,
    ChunkReader,
)
from beardyn_core.structure.nastran import read_nastran
from beardyn_core.structure.table import read_table
from test.record.hostile import MAGIC, told

SOON_S = 10.0  # the whole command on a busy machine; the bombs took over 100 s


EMPTY_MESSAGE = _RECORD.pack(5, 22) + bytes(22)


def stored(data: bytes) -> Chunk:
    """Make a chunk that is not packed."""
    return Chunk("", data, 0, 0, 0, len(data))


def bomb(path: Path, sizes: list[int], stated: int | None = None) -> Path:
    """Write a recording of chunks full of zeros, which are records without content."""
    builder = RecordBuilder()
    Header(profile="ros2", library="").write(builder)
    for size in sizes:
        packed = zstandard.ZstdCompressor().compress(bytes(size))
        Chunk("zstd", packed, 0, 0, 0, size if stated is None else stated).write(builder)
    Footer(0, 0, 0).write(builder)
    path.write_bytes(MAGIC + builder.end() + MAGIC)
    return path


@pytest.mark.parametrize(
    ("sizes", "stated"),
    [([1 << 30], None), ([1 << 29], 100), ([LARGEST_CHUNK] * 20, None)],
    ids=["a chunk of 1 GB", "a chunk that states less", "many chunks"],
)
def test_a_small_file_of_huge_chunks_is_a_sentence_soon(
    sizes: list[int], stated: int | None, tmp_path: Path
) -> None:
    path = bomb(tmp_path / "bomb.mcap", sizes, stated)
    begin = time.monotonic()
    code, said = told("report", str(path))
    assert time.monotonic() - begin < SOON_S
    assert code == 2
    assert str(path) in said
    assert "Traceback" not in said


def test_a_chunk_is_never_unpacked_beyond_its_bound() -> None:
    reader = ChunkReader(0)
    for stated in (1 << 30, 100):
        packed = zstandard.ZstdCompressor().compress(bytes(1 << 27))
        with pytest.raises(McapError, match=r"allowed here are|holds more than"):
            reader.records(Chunk("zstd", packed, 0, 0, 0, stated))
    assert ALWAYS_UNPACKED < LARGEST_CHUNK < LARGEST_RATIO * (1 << 20)


@pytest.mark.parametrize("record", [_RECORD.pack(0, 0), _RECORD.pack(200, 0), EMPTY_MESSAGE])
def test_records_that_hold_nothing_are_counted_before_they_are_read(record: bytes) -> None:
    reader = ChunkReader(0)
    assert len(reader.records(stored(record * 10))) in (0, 10)
    for _ in range(2):
        with pytest.raises(McapError, match="more records than one of its size can"):
            reader.records(stored(record * (ALWAYS_READ + 1)))


def test_a_chunk_that_states_another_checksum_is_refused() -> None:
    data = bytes(9)
    chunk = Chunk("", data, 0, 0, zlib.crc32(b"other"), len(data))
    with pytest.raises((McapError, ValueError)):
        ChunkReader(100).records(chunk)


READERS: dict[str, Callable[[Path], object]] = {
    "load.csv": read_measurement,
    "path.csv": read_transfer_path,
    "path.uff": read_transfer_path,
    "modes.csv": read_table,
    "modes.pch": lambda path: read_nastran(path, path),
    "known.npz": read_estimator,
}


@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_a_pipe_or_a_device_is_a_sentence_and_not_waited_for(name: str, kind: str, tmp_path: Path) -> None:
    path = tmp_path / name
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")
    with pytest.raises(InputError, match=str(path)):
        READERS[name](path)


@pytest.mark.parametrize("command", ["simulate", "explain", "bearing", "structure", "monitor", "report"])
def test_a_command_that_is_given_a_device_ends_with_a_sentence(command: str, tmp_path: Path) -> None:
    path = tmp_path / "zero.yaml"
    path.symlink_to("/dev/zero")
    code, said = told(command, str(path))
    assert code == 2
    assert "Traceback" not in said


@pytest.mark.parametrize(
    "value",
    [
        "9" * 6000,
        "-" + "1" * 6000,
        "!!timestamp 2026-99-99",
        "!!int x",
        "!!float x",
        "!!binary é",
        "!!bool x",
    ],
)
def test_a_value_that_yaml_cannot_hold_is_a_sentence(value: str) -> None:
    for text in (f"a: {value}", f"a: [{{b: {value}}}]"):
        with pytest.raises(InputError, match=r"scene\.yaml"):
            read_mapping(text, "scene.yaml")


@given(st.integers(min_value=-(10**99), max_value=10**99))
def test_a_whole_number_of_a_hundred_digits_is_read(value: int) -> None:
    assert read_mapping(f"a: {value}", "scene.yaml") == {"a": value}


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(),
    lambda below: st.lists(below, max_size=3) | st.dictionaries(st.text(), below, max_size=3),
)


@given(st.text() | st.builds(json.dumps, JSON))
def test_any_text_is_an_object_or_a_sentence(text: str) -> None:
    with suppress(InputError):
        assert isinstance(read_object(text), dict)


@pytest.mark.parametrize("opening", ["[", '{"a":', '[{"a":', '{"a":[['])
@pytest.mark.parametrize("count", [DEEPEST + 1, 5000, 1_000_000])
def test_deep_json_is_a_sentence(opening: str, count: int) -> None:
    for text in (opening * count, f'{{"a": {"[" * count}{"]" * count}}}'):
        with pytest.raises(InputError):
            read_object(text)


@pytest.mark.parametrize(
    "text", ["hello", "", "3", "[1]", "null", '"x"', '{"a": "\\ud800"}', '{"a": ' + "9" * 6000 + "}"]
)
def test_what_is_no_object_or_holds_what_nobody_can_write_is_a_sentence(text: str) -> None:
    with pytest.raises(InputError):
        read_object(text)


def test_a_text_that_is_too_long_and_a_missing_key_are_sentences() -> None:
    with pytest.raises(InputError, match="characters"):
        read_object(" " * (LONGEST_TEXT + 1))
    with pytest.raises(InputError, match="'replay' is missing"):
        read_object("{}", {"replay": dict})
    with pytest.raises(InputError, match="'replay' is a list"):
        read_object('{"replay": []}', {"replay": dict})
