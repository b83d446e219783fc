"""Load and speed of a recording, for an operation that takes them from a file."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.rail.measured import GAP, Measurement
from beardyn_core.record.bag_scanning import scan_recording
from beardyn_core.record.load_stream import decode_load, joined_load
from beardyn_core.record.message_source import wrench_values
from beardyn_core.record.messages import decode, header_stamp
from beardyn_core.record.topics import JOINTS, TWIST, WRENCH, namespace_of, relative_name
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.load_check import problem_with

# pairs of topics of force and of speed, the better first
_PAIRS = (("load/wrench", "load/shaft"), ("force", "shaft"))
_ALLOWED = "load/blocks, load/wrench and load/shaft, or force and shaft"


def read_recorded_load(path: Path, take: str = "both") -> Measurement:
    """Read load and speed of the first axlebox in a recording.

    Parameters
    ----------
    path : Path
        MCAP file with ``load/blocks``; or with ``load/wrench`` and ``load/shaft``; or with ``force`` and
        ``shaft`` of a twin, which is the load less the inertia of the journal. One topic of a pair is
        enough when only force or only speed is taken.
    take : str
        ``both``, ``force`` or ``speed``.

    Raises
    ------
    InputError
        The file is absent, is not MCAP, holds no load, or holds one with a gap or numbers that are not
        finite.
    """
    found = _messages(path)
    if found.get("load/blocks"):
        stream = _stream(path, found["load/blocks"])
        time = (stream.time_ns - stream.time_ns[0]) * 1e-9
        return _check_load(path, Measurement(time, stream.wrench, stream.shaft_speed, stream.bogie, stream))
    for force, speed in _PAIRS:
        wanted = [name for name, left in ((force, "speed"), (speed, "force")) if take != left]
        if all(found.get(name) for name in wanted):
            return _check_load(path, _of_pair(found, force, speed, take))
    there = ", ".join(sorted(found)) or "no topic of an axlebox"
    raise InputError(
        f"{path}: no {'load' if take == 'both' else take} in it, it has {there}; needed are {_ALLOWED}"
    )


def _messages(path: Path) -> dict[str, list[bytes]]:
    scan = scan_recording(path)
    names = {"load/blocks", *(name for pair in _PAIRS for name in pair)}
    found: dict[str, list[bytes]] = defaultdict(list)
    space = None
    for message in scan.messages():
        at = namespace_of(message.topic)
        if at is None or (space is not None and at != space):
            continue
        space = at
        name = relative_name(message.topic, at)
        if name in names:
            found[name].append(message.cdr)
        else:
            found.setdefault(name, [])
    return found


def _stream(path: Path, cdrs: list[bytes]) -> LoadHistory:
    """Keep the stream from its last start; it restarts when a twin is reset."""
    parts: list[LoadHistory] = []
    expected = 0
    for cdr in cdrs:
        part, samples = decode_load(cdr)
        if len(part) == 0:
            continue  # the end of the stream
        if samples[0] == 0:
            parts, expected = [], 0
        if samples[0] > expected and parts:
            raise InputError(
                f"{path}: samples {expected} to {samples[0] - 1} of load/blocks are missing; record "
                "the topic whole, or give a CSV file without the gap"
            )
        if samples[0] == expected or not parts:
            parts.append(part)
            expected = int(samples[-1]) + 1
    if not parts:
        raise InputError(f"{path}: load/blocks has no sample in it; record the topic while a load is sent")
    load = joined_load(parts)
    return replace(load, time_ns=load.time_ns - load.time_ns[0])


def _of_pair(found: dict[str, list[bytes]], force: str, speed: str, take: str) -> Measurement:
    force_ns, wrench = _column(_wrenches(found[force])) if take != "speed" else (None, None)
    speed_ns, shaft = _column(_speeds(found[speed], speed)) if take != "force" else (None, None)
    if force_ns is None:
        assert speed_ns is not None
        assert shaft is not None
        zeros = np.zeros((len(speed_ns), 6))
        return Measurement((speed_ns - speed_ns[0]) * 1e-9, zeros, shaft[:, 0], zeros[:, :3])
    assert wrench is not None
    start = force_ns[0] if speed_ns is None else max(force_ns[0], speed_ns[0])
    end = force_ns[-1] if speed_ns is None else min(force_ns[-1], speed_ns[-1])
    inside = (force_ns >= start) & (force_ns <= end)
    time_ns, wrench = force_ns[inside], wrench[inside]
    turning = np.zeros(len(time_ns))
    if speed_ns is not None and shaft is not None:
        from beardyn_core.scene.band_limited import interpolate_columns  # compiled: not for who reads files

        turning = interpolate_columns(speed_ns, shaft, int(start), (time_ns - start).astype(float))[:, 0]
    return Measurement((time_ns - start) * 1e-9, wrench, turning, np.zeros((len(time_ns), 3)))


def _column(samples: Iterator[tuple[int, list[float]]]) -> tuple[Int, Float]:
    times, values = zip(*samples, strict=True)
    return np.array(times, dtype=np.int64), np.array(values, dtype=np.float64)


def _wrenches(cdrs: list[bytes]) -> Iterator[tuple[int, list[float]]]:
    for cdr in cdrs:
        yield header_stamp(cdr), wrench_values(decode(WRENCH, cdr))


def _speeds(cdrs: list[bytes], topic: str) -> Iterator[tuple[int, list[float]]]:
    for cdr in cdrs:
        if topic == "load/shaft":
            yield header_stamp(cdr), [decode(TWIST, cdr).twist.angular.y]
        else:
            yield header_stamp(cdr), [float(decode(JOINTS, cdr).velocity[0])]


def _check_load(path: Path, measured: Measurement) -> Measurement:
    """Check that the numbers of a measurement can be a load, and return it."""
    if len(measured.time) < 2:
        raise InputError(f"{path}: only {len(measured.time)} sample of load; at least two are needed")
    time_ns = np.round(measured.time * 1e9).astype(np.int64)
    history = LoadHistory(time_ns, measured.wrench, measured.shaft_speed, measured.bogie)
    problems = [problem] if (problem := problem_with(history, None)) else []
    step = np.diff(measured.time)
    usual = float(np.median(step))
    gaps = np.flatnonzero((step > GAP[0] * usual) & (step > GAP[1]))
    if len(gaps):
        problems.append(
            f"the time jumps by {step[gaps[0]]:g} s at {measured.time[gaps[0]]:g} s where the usual step is "
            f"{usual:g} s; record without the gap"
        )
    if problems:
        raise InputError([f"{path}: {problem}" for problem in problems])
    return measured
