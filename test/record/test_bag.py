"""A recording in several files: split by size and time, with an index that every command follows."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.highlevel import AnyReader

from beardyn_core.base.errors import InputError
from beardyn_core.record.bag_scanning import INDEX, BagScan, files_of, scan_recording
from beardyn_core.record.bag_writing import BagWriter, Splitting
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import encode_string
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.study.monitored_recording import EXIT_CODES
from test.examples import examples
from test.record.hostile import told
from test.record.synthetic_run import SyntheticRun, description
from test.recordings import write_recording

BLOCKS = 100
SECOND = 1_000_000_000


def write_bag(folder: Path, splitting: Splitting, *, close: bool = True, blocks: int = BLOCKS) -> BagWriter:
    run = description(duration=blocks * 0.02)
    writer = BagWriter(folder, "/axlebox", splitting)
    writer.describe(run)
    writer.add("truth", 0, encode_string(run.to_json()))
    encoder = BlockEncoder(run.roller_count, run.sensor_names)
    for block in SyntheticRun().blocks(blocks):
        for name, stamp, cdr in encoder.encode(block):
            writer.add(name, stamp, cdr)
        writer._writer.flush()  # a chunk a block, however fast the machine: what is cut keeps whole ones
    if close:
        writer.close()
    return writer


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bag") / "run"
    write_bag(folder, Splitting(longest_ns=SECOND // 2))
    return folder


def test_a_file_holds_at_most_the_stated_time(bag: Path) -> None:
    assert [path.name for path in files_of(bag)] == [f"run_{number}.mcap" for number in range(4)]
    for path in files_of(bag):
        times = [m.log_time for m in McapScan(path).messages() if m.topic.endswith("force")]
        assert max(times) - min(times) < SECOND // 2


def test_a_file_is_at_most_as_large_as_stated(tmp_path: Path) -> None:
    most = 1_000_000
    write_bag(tmp_path / "run", Splitting(most_bytes=most))
    files = files_of(tmp_path / "run")
    assert len(files) > 2
    assert all(path.stat().st_size <= most for path in files)
    assert sum(path.stat().st_size for path in files[:-1]) > 0.5 * most * (len(files) - 1)


def test_folder_and_index_are_read_as_one_run(bag: Path) -> None:
    for path in (bag, bag / INDEX):
        run = read_run(path)
        assert run.complete
        assert run.status == "complete"
        assert np.array_equal(run.vibration.sample, np.arange(BLOCKS * 512))
        assert report(path).gaps == ()
    assert read_run(bag / "run_1.mcap").status == "the recording goes on in run_2.mcap"
    assert read_run(bag / "run_1.mcap").described().scene == "synthetic"


def test_rosbags_reads_the_folder(bag: Path) -> None:
    with AnyReader([bag]) as reader:
        assert reader.message_count == sum(each.count for each in report(bag).topics)
        assert sum(1 for _ in reader.messages()) == reader.message_count


def test_every_command_follows_the_index(bag: Path, tmp_path: Path) -> None:
    for words in (
        ["report", str(bag)],
        ["report", str(bag / INDEX), "--json"],
        ["export", str(bag), "-o", str(tmp_path / "run.npz"), "--signals", "vibration"],
        ["monitor", str(bag), "--bearing", "HS130x230"],
        ["view", str(bag), "--save", str(tmp_path / "run.rrd")],
    ):
        code, said = told(*words)
        assert code == (EXIT_CODES["cup"] if words[0] == "monitor" else 0), said
        assert "Traceback" not in said
    assert len(np.load(tmp_path / "run.npz")["vibration.time"]) == BLOCKS * 512


def test_a_cut_last_file_and_one_that_is_gone_are_told_and_the_rest_is_read(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    write_bag(folder, Splitting(longest_ns=SECOND // 2))
    last = folder / "run_3.mcap"
    last.write_bytes(last.read_bytes()[: last.stat().st_size // 2])
    (folder / "run_1.mcap").unlink()
    run = read_run(folder)
    assert not run.complete
    assert run.status is None
    assert "run_1.mcap" in run.problem
    assert "run_3.mcap: the file was not closed properly" in run.problem
    assert set(np.arange(25 * 512)) <= set(run.vibration.sample.tolist())
    code, said = told("report", str(folder))
    assert code == 0, said
    assert "run_3.recovered.mcap" in said
    assert [path.name for path in files_of(folder)][-1] == "run_3.mcap"


def test_a_file_begun_after_the_index_belongs_to_the_run(tmp_path: Path) -> None:
    """As when the process is killed between the two."""
    folder = tmp_path / "run"
    write_bag(folder, Splitting(longest_ns=SECOND // 2))
    text = (folder / INDEX).read_text()
    (folder / INDEX).write_text(text.replace("  - run_3.mcap\n", ""))
    assert isinstance(scan_recording(folder), BagScan)
    assert len(files_of(folder)) == 4


def test_an_earlier_recording_is_refused_or_replaced_whole(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    write_bag(folder, Splitting(longest_ns=SECOND // 2))
    with pytest.raises(InputError, match="holds a recording already"):
        BagWriter(folder, "/axlebox", Splitting(longest_ns=SECOND))
    BagWriter(folder, "/axlebox", Splitting(longest_ns=SECOND), replace=True).close()
    assert [path.name for path in files_of(folder)] == ["run_0.mcap"]


@settings(
    max_examples=examples(60), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    content=st.one_of(
        st.binary(max_size=200),
        st.text(max_size=200).map(lambda text: text.encode(errors="replace")),
        st.recursive(
            st.none() | st.booleans() | st.integers() | st.text(max_size=8),
            lambda inner: (
                st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3)
            ),
            max_leaves=8,
        ).map(lambda value: f"rosbag2_bagfile_information:\n  relative_file_paths: {value!r}\n".encode()),
    )
)
def test_whatever_an_index_holds_is_a_result_or_a_sentence(content: bytes, tmp_path: Path) -> None:
    (tmp_path / INDEX).write_bytes(content)
    code, said = told("report", str(tmp_path))
    assert code in (0, 2)
    assert "Traceback" not in said
    assert "beardyn: " in said


def test_the_writer_keeps_little_for_each_chunk(tmp_path: Path) -> None:
    """A recorder of an hour has thousands; the library keeps some 2 kB for each of them."""
    run = SyntheticRun().block(0)
    messages = list(BlockEncoder(17, ("axlebox_top",)).encode(run))
    writer = McapWriter(tmp_path / "run.mcap")
    tracemalloc.start()
    begin = 0
    for chunk in range(220):
        if chunk == 20:
            begin = tracemalloc.get_traced_memory()[0]
        for name, stamp, cdr in messages:
            writer.add(name, stamp, cdr)
        writer._writer.flush()
    grown = tracemalloc.get_traced_memory()[0] - begin
    tracemalloc.stop()
    writer.close()
    assert grown / 200 < 500


def test_a_last_file_without_a_chunk_takes_nothing_from_the_others(tmp_path: Path) -> None:
    """Cut off right after a file was begun: the run is in the files before."""
    folder = tmp_path / "run"
    folder.mkdir()
    whole = write_recording(folder / "run_0.mcap", 6)
    (folder / "run_1.mcap").write_bytes(whole.read_bytes()[:300])
    code, said = told("report", str(folder))
    assert code == 0
    assert "run_1.mcap: the file holds no complete chunk" in said
    (folder / "run_0.mcap").unlink()
    assert told("report", str(folder))[0] == 2
