"""Messages that nothing vouches for: every array of their run is a result or a sentence."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.record.arrays import Timed
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.reading import run_of_messages
from beardyn_core.record.run import Run
from beardyn_core.record.tables import SIGNALS
from beardyn_core.record.topics import relative_name
from test.record.synthetic_run import description
from test.recordings import write_recording


def answer(run: Run, name: str) -> object:
    """What a run has under a name, or the sentence that it refuses with."""
    try:
        return getattr(run, name)
    except InputError as error:
        return str(error)


@pytest.mark.filterwarnings("ignore:invalid value encountered")
def test_damaged_messages_give_arrays_or_a_sentence(tmp_path: Path) -> None:
    whole: dict[str, list[bytes]] = defaultdict(list)
    for message in McapScan(write_recording(tmp_path / "run.mcap", 3)).messages():
        whole[relative_name(message.topic)].append(message.cdr)
    random = np.random.default_rng(7)
    sentences: list[str] = []
    for _ in range(60):
        cdrs = {name: list(parts) for name, parts in whole.items()}
        for parts in cdrs.values():
            number = int(random.integers(len(parts)))
            damaged = bytearray(parts[number])
            for place in random.integers(4, min(len(damaged), 400), 6):
                damaged[place] = int(random.integers(256))
            parts[number] = bytes(damaged)
        run = run_of_messages(cdrs, description(), path=tmp_path / "run.mcap")
        for name in (*SIGNALS, "diagnostics", "results", "sensors", "truth", "duration", "summary"):
            found = answer(run, name)
            sentences += [found] if isinstance(found, str) else []
            assert name not in SIGNALS or isinstance(found, str | Timed)
    assert len(sentences) > 20
    assert all("run.mcap" in sentence for sentence in sentences)


def test_the_messages_themselves_are_whole(tmp_path: Path) -> None:
    whole: dict[str, list[bytes]] = defaultdict(list)
    for message in McapScan(write_recording(tmp_path / "run.mcap", 3)).messages():
        whole[relative_name(message.topic)].append(message.cdr)
    run = run_of_messages(whole, description())
    assert [name for name in SIGNALS if not len(getattr(run, name))] == ["temperature"]
    with pytest.raises(InputError, match="in memory"):
        run_of_messages({"force": [b"\0" * 40]}, None).force.time  # noqa: B018
