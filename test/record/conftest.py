from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from beardyn_core.record.sinks import McapSink
from test.record.synthetic_run import SyntheticRun, description

BLOCKS = 60


def write_recording(
    path: Path, blocks: int, sensors: tuple[str, ...] = ("axlebox_top", "axlebox_end")
) -> Path:
    run = description(duration=blocks * 0.02, sensors=sensors)
    sink = McapSink(path)
    sink.open(run)
    for block in SyntheticRun(sensor_count=len(sensors)).blocks(blocks):
        sink.write(block)
    sink.close()
    return path


@contextmanager
def files_of_at_most(size: int) -> Iterator[None]:
    """Let no file of this process grow beyond a size, [byte]: what a full disk does to a large one."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("recording") / "run.mcap", BLOCKS)
