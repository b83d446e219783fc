"""When the tables of a file and the files of a measurement begin, on one time from 0 on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated as A

from beardyn_core.measured.claimed_start import Start

_SAME_START = 0.01  # share of a file within which starts say nothing: each file begins anew
_DRIFT = 1e-4  # share of a file by which two clocks may differ


@dataclass(frozen=True)
class Begun:
    """One table of a file, or one file."""

    what: A[str, "such as its channel"]
    start: Start | None
    seconds: A[float, "how long it lasts"]
    is_vibration: bool = True
    interval: A[float, "from its last sample to its end, [s]"] = 0.0


@dataclass
class Aligned:
    """Starts on one time, and what is to be said of them."""

    begin_ns: A[list[int], "from the beginning of the vibration, [ns]"]
    start: A[Start | None, "of the vibration, on the clock of the file"] = None
    problems: A[list[str], "sentences without the file"] = field(default_factory=list)
    warnings: A[list[str], "sentences without the file"] = field(default_factory=list)


def align_tables(tables: Sequence[Begun], log_delays: Sequence[int], longest_delay: int) -> Aligned:
    """Place the tables of one file; the vibration begins at 0.

    Parameters
    ----------
    tables : sequence of Begun
    log_delays : sequence of int
        Of tables whose messages were logged: from the stamp of the first one to the log, [ns]; else empty.
    longest_delay : int
        By which these may differ where all stamps are of one clock, [ns].
    """
    starts = [each.start for each in tables]
    out = Aligned([0] * len(tables))
    if log_delays and max(log_delays) - min(log_delays) > longest_delay:
        out.warnings.append(
            f"the stamps of {_list_tables(tables)} are of different clocks, "
            f"{(max(log_delays) - min(log_delays)) * 1e-9:.6g} s apart; they are aligned by the time of the "
            "log"
        )
        starts = [
            Start(start.ns + delay, True) if start is not None else None
            for start, delay in zip(starts, log_delays, strict=True)
        ]
    known = [start for start in starts if start is not None]
    if not known:
        return out
    first = next(
        (s for s, t in zip(starts, tables, strict=True) if s is not None and t.is_vibration), known[0]
    )
    zero = first.ns if first.dated else 0
    if any(start.dated != first.dated for start in known):
        zero = first.ns
        out.warnings.append(
            f"the times of {_list_tables(tables)} are of different clocks, a date and seconds; they are "
            "taken as begun together, which nothing in the file confirms"
        )
        starts = [start if start is not None and start.dated == first.dated else None for start in starts]
    elif len(known) < len(starts) and any(start.dated or start.ns for start in known):
        silent = [each for each, start in zip(tables, starts, strict=True) if start is None]
        when = "with the others" if first.dated else "at 0 s"
        out.warnings.append(f"does not state when {_list_tables(silent)} began; taken is {when}")
    ns = [zero if start is None else start.ns for start in starts]
    begin = min(at for at, each in zip(ns, tables, strict=True) if each.is_vibration)
    out.begin_ns = [at - begin for at in ns]
    out.start = Start(begin, first.dated)
    end = max(
        at + each.seconds * 1e9 for at, each in zip(out.begin_ns, tables, strict=True) if each.is_vibration
    )
    for at, each in zip(out.begin_ns, tables, strict=True):
        last = at + (each.seconds - each.interval) * 1e9
        if not each.is_vibration and each.seconds and end and (at >= end or last <= 0):
            out.problems.append(
                f"{each.what} is from {at * 1e-9:.6g} s to {last * 1e-9:.6g} s after the beginning of the "
                f"vibration, which lasts {end * 1e-9:.6g} s: they have no time together; give a channel of "
                "the same time, or --time-channel none if its time is wrong"
            )
    return out


def align_files(
    files: Sequence[tuple[Path, Begun]], interval: float | None, tolerance: float
) -> tuple[list[int], list[str]]:
    """Place files in the order given; gives the beginning of each [ns] and warnings.

    Parameters
    ----------
    interval : float, optional
        From the beginning of a file to that of the next, as asked, [s].
    tolerance : float
        That is no gap, such as one and a half samples, [s].
    """
    begins, end = [], 0
    for number, (_, each) in enumerate(files):
        begins.append(end if interval is None else round(number * interval * 1e9))
        end = begins[-1] + round(each.seconds * 1e9)
    starts = [each.start for _, each in files]
    known = [start for start in starts if start is not None]
    if len(files) < 2 or len(known) < len(files) or len({start.dated for start in known}) > 1:
        return begins, []
    shortest = min(each.seconds for _, each in files)
    by_stamps = [start.ns - known[0].ns for start in known]
    spread = (max(by_stamps) - min(by_stamps)) * 1e-9
    if not known[0].dated and spread <= _SAME_START * shortest:
        return begins, []  # each counts from its own beginning
    late = _first_out_of_order(files, by_stamps, tolerance)
    if late is not None:
        path, before = files[late][0], files[late - 1][0]
        apart = (by_stamps[late] - by_stamps[late - 1]) * 1e-9
        how = f"{apart:.6g} s after" if apart >= 0.0 else f"{-apart:.6g} s before"
        return begins, [
            f"{path}: begins by its own time {how} the beginning of {before}, which lasts "
            f"{files[late - 1][1].seconds:.6g} s; the files are joined in the order given: give them "
            "in the order of their times"
        ]
    if interval is not None:
        off = max(abs(at - begin) for at, begin in zip(by_stamps, begins, strict=True)) * 1e-9
        if off > tolerance + _DRIFT * begins[-1] * 1e-9:
            return begins, [
                f"{files[0][0]}: the own times of the files differ from --file-interval-s {interval:g} by up "
                f"to {off:.6g} s; taken is the interval, as asked"
            ]
        return begins, []
    placed, gaps = [0], []
    for number in range(1, len(files)):
        length = files[number - 1][1].seconds
        end = placed[-1] + round(length * 1e9)
        gap = (by_stamps[number] - by_stamps[number - 1]) * 1e-9 - length
        is_gap = gap > tolerance + _DRIFT * length
        placed.append(placed[-1] + by_stamps[number] - by_stamps[number - 1] if is_gap else end)
        gaps += [gap] if is_gap else []
    if not gaps:
        return placed, []
    return placed, [
        f"{files[0][0]}: by their times there are {len(gaps)} gaps between the files, up to {max(gaps):.6g} "
        f"s and {sum(gaps):.6g} s in all; they are kept"
    ]


def _first_out_of_order(
    files: Sequence[tuple[Path, Begun]], by_stamps: Sequence[int], tolerance: float
) -> int | None:
    for number in range(1, len(files)):
        length = files[number - 1][1].seconds
        apart = (by_stamps[number] - by_stamps[number - 1]) * 1e-9
        if apart < length * (1.0 - _DRIFT) - tolerance:
            return number
    return None


def _list_tables(tables: Sequence[Begun]) -> str:
    return " and ".join(each.what for each in tables)


def used_delays(tables: Sequence[str], delays: Mapping[str, int]) -> list[int]:
    """Give the delays of the tables that are used; empty where one has none."""
    found = [delays[table] for table in tables if table in delays]
    return found if len(found) == len(tables) else []
