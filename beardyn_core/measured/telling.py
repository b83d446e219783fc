"""How files were understood, in sentences; what is true of many files is said once."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from beardyn_core.measured.survey import Surveyed
    from beardyn_core.measured.tacho import Tacho

_APART = 3
_RPM = 30.0 / np.pi


def describe_files(files: Sequence[Surveyed], tacho: Tacho | None = None) -> tuple[str, ...]:
    """Say how files were understood."""
    paths = [each.chosen.path for each in files]
    sentences = [f"{each.chosen.path}: {line}" for each in files for line in _lines(each)]
    if files:
        sentences += [f"{files[0].chosen.path}{_others(len(files))}: {line}" for line in _levels(files)]
    sentences += [f"{each.chosen.path}: {_describe_speed(each)}" for each in files if tacho is None]
    if tacho is not None and (channel := files[0].chosen.speed.channel) is not None:
        turning = tacho.told(channel.name, files[-1].end_ns * 1e-9)
        sentences.append(f"{files[0].chosen.path}{_others(len(files))}: {turning}")
    return tuple(gather_sentences(sentences, paths, apart=1))


def gather_sentences(sentences: Iterable[str], paths: Iterable[Path], apart: int = _APART) -> list[str]:
    """Say once what is said of several files.

    Parameters
    ----------
    sentences : iterable of str
        Those of a file begin with its path.
    paths : iterable of Path
    apart : int
        Of up to so many files each has its own sentence.
    """
    names = {str(path) for path in paths}
    found: dict[str, list[str]] = {}  # what is said, of which files
    for sentence in dict.fromkeys(sentences):
        end = next((m.start() for m in re.finditer("[:,] ", sentence) if sentence[: m.start()] in names), 0)
        found.setdefault(sentence[end:], []).append(sentence[:end])
    return [
        f"{name}{others}{what}"
        for what, those in found.items()
        for name, others in (
            [(name, "") for name in those] if len(those) <= apart else [(those[0], _others(len(those)))]
        )
    ]


def _others(count: int) -> str:
    return f" and {count - 1} more" if count > 1 else ""


def _lines(each: Surveyed) -> list[str]:
    """Say how a file was understood, without levels and speed."""
    chosen = each.chosen
    lines = [*chosen.told]
    for name in dict.fromkeys(sensor.table for sensor in chosen.sensors):
        table = each.tables[name]
        time = chosen.times.get(name)
        lines.append(
            f"{table.count} samples at {table.rate:.9g} Hz, {table.count / table.rate:.6g} s"
            + (f", time in {time.name}" if time is not None else "")
        )
    return lines


def _describe_speed(each: Surveyed) -> str:
    """Say how the shaft of a file turns."""
    speed = each.chosen.speed
    if speed.kind == "constant":
        return f"the shaft turns with {speed.value * _RPM:.6g} rpm"
    if speed.channel is None:
        return "the speed of the shaft is not known"
    found = each.tables[speed.channel.table].ranges[speed.channel.name]
    low, high = (value * speed.factor * _RPM for value in (found.low, found.high))
    return f"the shaft turns with {low:.6g} to {high:.6g} rpm, from {speed.channel.name}"


def _levels(files: Sequence[Surveyed]) -> list[str]:
    """Say by how much each accelerometer varies, from the quietest file to the loudest."""
    levels: dict[str, dict[str, list[float]]] = {}
    for each in files:
        for sensor in each.chosen.sensors:
            for axis, found in sensor.axes.items():
                deviation = each.tables[sensor.table].ranges[found.channel.name].deviation
                levels.setdefault(sensor.name, {}).setdefault(axis, []).append(deviation * abs(found.factor))
    return [
        f"{sensor} varies by {', '.join(f'{axis} {_span(values)}' for axis, values in axes.items())} m/s2 rms"
        for sensor, axes in levels.items()
    ]


def _span(values: Sequence[float]) -> str:
    low, high = f"{min(values):.4g}", f"{max(values):.4g}"
    return low if low == high else f"{low} to {high}"
