"""From the messages of a recording, or of a live graph, to a `Run`."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.record import arrays
from beardyn_core.record.bag_scanning import BagScan, scan_recording
from beardyn_core.record.checking import MessageChecker, take_out_malformed
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import COMPLETE, DESCRIPTION_FILE, END_RECORD, MEASURED_FILE, SCENE_FILE
from beardyn_core.record.message_source import MessageSource
from beardyn_core.record.messages import decode_string
from beardyn_core.record.run import Run
from beardyn_core.record.topics import NAMESPACE, namespace_of, relative_name


def read_run(path: Path | str, namespace: str | None = None) -> Run:
    """Read the arrays of a recording; of a cut-off one everything up to the last complete chunk.

    Parameters
    ----------
    namespace : str, optional
        Of the axlebox to read, such as ``axle_1_left``; by default the first one in the file. All of them
        are in `Run.boxes`.

    Raises
    ------
    InputError
        The file is absent, not MCAP, or holds not one usable message of the namespace.
    """
    return read_with_times(path, namespace)[0]


def read_with_times(
    path: Path | str, namespace: str | None = None
) -> tuple[Run, McapScan | BagScan, dict[tuple[str, str], list[int]]]:
    """Read a recording as `read_run` does, in the same pass also what a report needs.

    Returns
    -------
    run : Run
    scan : McapScan or BagScan
        Its pass is over.
    times : dict of (topic, type) to list of int
        Log times of every topic of the file, [ns].
    """
    scan = scan_recording(path)
    recorded: dict[str, list[bytes]] = defaultdict(list)
    types: dict[str, str] = {}
    times: dict[tuple[str, str], list[int]] = defaultdict(list)
    for message in scan.messages():
        recorded[message.topic].append(message.cdr)
        types[message.topic] = message.type
        times[message.topic, message.type].append(message.log_time)
    boxes = _Boxes(scan, recorded, types)
    if namespace is None:
        return boxes.first(), scan, times
    wanted = namespace.strip("/")
    if wanted not in boxes:
        names = ", ".join(boxes)
        found = f"it has {names or ', '.join(sorted(recorded)) or scan.problem or 'no messages'}"
        raise InputError(f"{scan.path}: no messages under the namespace /{wanted}; {found}")
    return boxes[wanted], scan, times


class _Boxes(Mapping[str, Run]):
    """The axleboxes of a recording, each read when it is asked for."""

    def __init__(
        self, scan: McapScan | BagScan, recorded: Mapping[str, list[bytes]], types: Mapping[str, str]
    ) -> None:
        self._scan, self._recorded, self._types = scan, recorded, types
        self._names = [each.strip("/") for each in namespaces_in(recorded)]
        self._read: dict[str, Run] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __getitem__(self, name: str) -> Run:
        if name not in self._names:
            raise KeyError(name)
        if name not in self._read:
            self._read[name] = self._made(name)
        return self._read[name]

    def first(self) -> Run:
        """Read the first axlebox; raises `InputError` where there is none."""
        if not self._names:
            found = f"it has {', '.join(sorted(self._recorded))}" if self._recorded else ""
            what = found or self._scan.problem or "it has no messages"
            raise InputError(f"{self._scan.path}: no messages under the namespace {NAMESPACE}; {what}")
        return self[self._names[0]]

    def _made(self, name: str) -> Run:
        space = f"/{name}"
        own = {
            path: relative_name(path, space)
            for path in self._recorded
            if len(self) == 1 or path.startswith(f"{space}/") or namespace_of(path) is None
        }
        with arrays.decoding_checked(self._scan.path):
            cdrs = {short: self._recorded[path] for path, short in own.items()}
            types = {short: self._types[path] for path, short in own.items()}
            return _run(self._scan, cdrs, types, self, name if len(self) > 1 else "")


def namespaces_in(paths: Iterable[str]) -> list[str]:
    """List the namespaces of the axleboxes that absolute topic names tell of, axle 2 before axle 10.

    In a live recording the boxes begin in any order.
    """
    found = {space for space in map(namespace_of, paths) if space is not None}
    return sorted(
        found,
        key=lambda space: [
            (part.zfill(9) if part.isdecimal() else part) for part in re.split(r"(\d+)", space)
        ],
    )


def namespace_in(paths: Iterable[str]) -> str:
    """Find the first of `namespaces_in`."""
    return next(iter(namespaces_in(paths)), NAMESPACE)


def _run(
    scan: McapScan | BagScan,
    cdrs: dict[str, list[bytes]],
    types: Mapping[str, str],
    boxes: Mapping[str, Run],
    box: str,
) -> Run:
    """Make a run of the messages of one axlebox; ``box`` is its name where there are several."""
    malformed = take_out_malformed(cdrs, types, MessageChecker())
    description = _description(scan, cdrs, alone=not box)
    if description is not None:
        known = MessageChecker(len(description.body_names), description.roller_count)
        malformed += take_out_malformed(cdrs, types, known, ("bodies", "contacts"))
    scene_text = "" if box else scan.attachments.get(SCENE_FILE, b"").decode(errors="replace")
    return run_of_messages(
        cdrs,
        description,
        box,
        path=scan.path,
        complete=scan.complete,
        problem=scan.problem,
        status=scan.metadata[END_RECORD].get("status") or COMPLETE if END_RECORD in scan.metadata else None,
        scene_text=scene_text or (description.scene_text if description else ""),
        malformed=malformed,
        measured=_read_measured(scan),
        boxes=boxes,
    )


def run_of_messages(
    cdrs: Mapping[str, Sequence[bytes]], description: RunDescription | None, box: str = "", **facts: Any
) -> Run:
    """Gather a run of messages by the name of their topic, from a file or from a live graph.

    The messages are decoded when their array is first used. What else is known goes to `Run`. A name of one
    axlebox of several selects the diagnostics that are its own.
    """
    sensors = tuple((facts.get("measured") or {}).get("sensors", ()))
    return Run(MessageSource(cdrs, description, sensors, box), description, box=box, **facts)


def _description(
    scan: McapScan | BagScan, cdrs: Mapping[str, list[bytes]], alone: bool
) -> RunDescription | None:
    truth = cdrs.get("truth", ())
    if alone and DESCRIPTION_FILE in scan.attachments:
        with suppress(InputError):  # damaged: the topic says the same
            return RunDescription.from_json(scan.attachments[DESCRIPTION_FILE].decode(errors="replace"))
    return RunDescription.from_json(decode_string(truth[0])) if truth else None


def _read_measured(scan: McapScan | BagScan) -> dict[str, Any]:
    """Give what a measured recording says about itself; empty for a simulated one."""
    if MEASURED_FILE not in scan.attachments:
        return {}
    with suppress(ValueError):
        found = json.loads(scan.attachments[MEASURED_FILE])
        if isinstance(found, dict):
            return found
    raise InputError(f"{scan.path}: its record of the measured files is damaged ({MEASURED_FILE})")
