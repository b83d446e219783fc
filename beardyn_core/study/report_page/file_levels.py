"""Level and verdict of each file of several: records of one axlebox, or the files of one measurement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Annotated as A

import numpy as np

from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.study.inspection import Inspection
from beardyn_core.study.monitored_recording import NOT_DIAGNOSABLE, WAITING, Finding, conclude
from beardyn_core.study.report_page.advice import in_words
from beardyn_core.study.report_page.identity import (
    fact_of,
    file_names,
    files_in_words,
    record_date,
    signal_of,
)

_SINGLE_ROWS = 14  # of more files, neighbours with the same verdict share a row


@dataclass(frozen=True)
class FileLevel:
    """One file of several."""

    name: str
    date: A[str, "by the clock of the file; empty where it does not know"]
    rms: A[float, "of all measured axes, without their mean, NaN without samples, [m/s^2]"]
    peak: A[float, "largest value of one axis, [m/s^2]"]
    verdict: str
    agreeing: A[int, "analyses with this verdict"]
    analyses: A[int, "that end in this file"]


def levels_of(history: Sequence[Inspection]) -> list[FileLevel]:
    """List the files of several records of a bearing, or those of the one measurement."""
    if len(history) == 1:
        return _files_of(history[0])
    found = []
    for each in history:
        whole = signal_of(each)
        names = files_in_words(file_names(each.run))
        found.append(_level(names, record_date(each.run), measured_axes(whole.values), each.results.findings))
    return found


def _files_of(inspection: Inspection) -> list[FileLevel]:
    files = fact_of(inspection.run.measured, "files", list)
    if len(files) < 2:
        return []
    signal = signal_of(inspection)
    values, time = measured_axes(signal.values), signal.time
    begins = [fact_of(each, "begin_s", float) for each in files]
    found = []
    for number, (each, begin) in enumerate(zip(files, begins, strict=True)):
        end = begins[number + 1] if number + 1 < len(begins) else np.inf
        first, last = np.searchsorted(time, (begin, end))
        own = [finding for finding in inspection.results.findings if begin < finding.time <= end]
        date = record_date(inspection.run, number)
        found.append(_level(fact_of(each, "name", str), date, values[first:last], own))
    return found


def _level(name: str, date: str, values: np.ndarray, findings: Sequence[Finding]) -> FileLevel:
    conclusion = conclude(findings)
    rms = peak = np.nan
    if len(values):
        varying = values - values.mean(axis=0)
        rms = float(np.sqrt(np.sum(varying**2) / len(varying)))
        peak = float(np.abs(varying).max())
    verdict = NOT_DIAGNOSABLE if conclusion.verdict == WAITING else conclusion.verdict
    return FileLevel(name, date, rms, peak, verdict, conclusion.agreeing, conclusion.analyses)


def level_rows(levels: Sequence[FileLevel]) -> tuple[tuple[str, ...], ...]:
    """Write the table: a row for each file, of many files a row for neighbours with the same verdict."""
    numbered = list(enumerate(levels, 1))
    groups = [[each] for each in numbered]
    if len(levels) > _SINGLE_ROWS:
        groups = [list(same) for _, same in groupby(numbered, key=lambda each: each[1].verdict)]
    return tuple(_row(group) for group in groups)


def _row(group: Sequence[tuple[int, FileLevel]]) -> tuple[str, ...]:
    (first, begin), (last, end) = group[0], group[-1]
    files = [each for _, each in group]
    dates = [each.date.partition(",")[0] for each in (begin, end) if each.date]
    agreeing, analyses = sum(each.agreeing for each in files), sum(each.analyses for each in files)
    return (
        f"{first}" if first == last else f"{first} to {last}",
        begin.name if first == last else f"{begin.name} to {end.name}",
        " to ".join(dict.fromkeys(dates)) or "not stated",
        _span([each.rms for each in files]),
        _span([each.peak for each in files]),
        f"{in_words(begin.verdict)}, {agreeing} of {analyses}" if analyses else "no analysis",
    )


def _span(values: Sequence[float]) -> str:
    there = [each for each in values if np.isfinite(each)]
    if not there:
        return "-"
    low, high = f"{min(there):.3g}", f"{max(there):.3g}"
    return low if low == high else f"{low} to {high}"
