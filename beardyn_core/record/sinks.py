"""Sinks: receivers of the blocks of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Protocol

import numpy as np

from beardyn_core.physics.bodies.rates import BLOCK_NS
from beardyn_core.record.chunk_writing import QUICK_LEVEL
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import (
    DIAGNOSTICS_EVERY,
    USUAL_NAME,
    Batch,
    BlockEncoder,
    block_diagnostic,
    single,
)
from beardyn_core.record.load_stream import encode_loads
from beardyn_core.record.mcap_writing import COMPLETE, McapWriter
from beardyn_core.record.messages import encode_diagnostics, encode_string
from beardyn_core.record.run import Run
from beardyn_core.record.topics import FRAME, NAMESPACE
from beardyn_core.sensors.block import Block
from beardyn_core.sensors.summary import RunSummary

LOAD_MESSAGE_SAMPLES = 400


class Sink(Protocol):
    """Receives a run: once `open`, every block, once `close`."""

    def open(self, run: RunDescription) -> None:
        """Prepare for a run."""

    def write(self, block: Block) -> None:
        """Take a block."""

    def close(self, status: str = "") -> None:
        """End the run; ``status`` is a sentence, empty when the run ended as asked."""


class MemorySink:
    """Keeps every block.

    Attributes
    ----------
    status : str or None
        ``None`` until closed.
    """

    def __init__(self) -> None:
        self.run: RunDescription | None = None
        self.blocks: list[Block] = []
        self.status: str | None = None

    def open(self, run: RunDescription) -> None:
        """Begin a run; blocks of an earlier one are dropped."""
        self.run, self.blocks, self.status = run, [], None

    def write(self, block: Block) -> None:
        """Keep a block."""
        self.blocks.append(block)

    def close(self, status: str = "") -> None:
        """End the run."""
        self.status = status

    def to_run(self, summary: Callable[[], RunSummary] | None = None) -> Run:
        """Give the blocks so far as named arrays; ``summary`` is that of the simulation."""
        status = COMPLETE if self.status == "" else self.status
        return Run.of_blocks(self.blocks, self.run, status, summary)


class McapSink:
    """Writes a run to an MCAP file: the same topics and bytes that a node publishes.

    Parameters
    ----------
    replace : bool
        Whether an existing file is replaced; otherwise `open` raises an `InputError`.
    """

    def __init__(self, path: Path | str, *, replace: bool = False) -> None:
        self._path = Path(path)
        self._replace = replace
        self._writer: McapWriter | None = None

    def open(self, run: RunDescription) -> None:
        """Create the file; it holds the description from the first moment on."""
        self._messages = RunMessages(run)
        self._writer = McapWriter(self._path, NAMESPACE, replace=self._replace)
        self._writer.describe(run)

    def write(self, block: Block) -> None:
        """Append the messages of a block."""
        writer = self._open_writer()
        for batch in self._messages.of(block):
            writer.add_rows(*batch)

    def close(self, status: str = "") -> None:
        """Finish the file."""
        if self._writer is not None:
            self._writer.close(status)

    def _open_writer(self) -> McapWriter:
        if self._writer is None:
            raise RuntimeError("McapSink.write before McapSink.open")
        return self._writer


class TrainSink:
    """Writes the runs of several axleboxes to one MCAP file, each in a namespace of its name.

    Parameters
    ----------
    replace : bool
        See `McapSink`.
    pictures : bool
        Whether bodies and contacts are recorded.
    """

    def __init__(self, path: Path | str, *, replace: bool = False, pictures: bool = True) -> None:
        self._path = Path(path)
        self._replace, self._pictures = replace, pictures
        self._writer: McapWriter | None = None

    def open(self, runs: Mapping[str, RunDescription]) -> None:
        """Create the file."""
        self._messages = {box: RunMessages(run, box, self._pictures) for box, run in runs.items()}
        namespace = f"/{next(iter(runs))}"
        self._writer = McapWriter(self._path, namespace, replace=self._replace, level=QUICK_LEVEL)

    def encode(self, box: str, block: Block) -> list[Batch]:
        """Make the messages of a block; for different boxes from different threads."""
        return list(self._messages[box].of(block))

    def write(self, batches: Iterable[Batch]) -> None:
        """Append messages."""
        if self._writer is None:
            raise RuntimeError("TrainSink.write before TrainSink.open")
        for batch in batches:
            self._writer.add_rows(*batch)

    def close(self, status: str = "") -> None:
        """Finish the file."""
        if self._writer is not None:
            self._writer.close(status)


class RunMessages:
    """The messages of a run, block by block: its truth, the load it has used, what it gives, diagnostics.

    Parameters
    ----------
    box : str
        Name of one axlebox of several, whose topics then have a namespace of their own.
    pictures : bool
        Whether bodies and contacts are among them.
    """

    def __init__(self, run: RunDescription, box: str = "", pictures: bool = True) -> None:
        self._run, self._box, self._frame, self._pictures = run, box, box or FRAME, pictures
        self._encoder = BlockEncoder(run.roller_count, run.sensor_names, self._frame)
        self._load_written = 0
        self._first = True

    def of(self, block: Block) -> Iterator[Batch]:
        """Make the messages of a block."""
        for batch in self._own_messages(block):
            absolute = not self._box or batch.topic.startswith("/")
            yield batch if absolute else batch._replace(topic=f"/{self._box}/{batch.topic}")

    def _own_messages(self, block: Block) -> Iterator[Batch]:
        if self._first:
            self._first = False
            yield single("truth", block.start_ns, encode_string(self._run.to_json()))
        yield from self._load(block.end_ns)
        yield from self._encoder.batches(block, self._pictures)
        count = (block.end_ns - block.start_ns) // BLOCK_NS
        if -block.index % DIAGNOSTICS_EVERY < count or block.status != 0:
            status = block_diagnostic(block, f"{self._box}/twin" if self._box else USUAL_NAME)
            yield single(
                "/diagnostics", block.end_ns, encode_diagnostics(block.end_ns, self._frame, [status])
            )

    def _load(self, until_ns: int) -> Iterator[Batch]:
        load = self._run.load
        if load is None:
            return
        # The sample at or after the end of the block belongs to it: the twin interpolates towards it.
        last = min(int(np.searchsorted(load.time_ns, until_ns)) + 1, len(load))
        whole = (last - self._load_written) // LOAD_MESSAGE_SAMPLES * LOAD_MESSAGE_SAMPLES
        for count, each in ((whole, LOAD_MESSAGE_SAMPLES), (last - self._load_written - whole,) * 2):
            if count:
                part = load.part(self._load_written, self._load_written + count)
                rows = encode_loads(part, self._load_written, each, self._frame)
                yield Batch("load/blocks", part.time_ns[::each], rows)
                self._load_written += count
