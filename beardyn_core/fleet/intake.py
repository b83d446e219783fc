"""Recordings into the store: identity checked first, analysed several at a time, one transaction each."""

from __future__ import annotations

import hashlib
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.fleet.analysis import NO_ESTIMATOR, SHIPPED, Analysis, analyse
from beardyn_core.fleet.consistency import find_contradictions
from beardyn_core.fleet.identity import FleetRecording
from beardyn_core.fleet.store import EXCHANGED, FleetStore

_AHEAD = 3  # recordings a process has waiting
_PARENT_S = 1.0  # between two looks of a process whether the one that started it is there
_CHUNK = 1 << 20


@dataclass
class Intake:
    """What became of recordings."""

    added: A[int, "recordings that are in the store now"] = 0
    known: A[int, "that were there before"] = 0
    refused: A[list[str], "why others are not, a sentence each"] = field(default_factory=list)


def add_recordings(
    store: FleetStore,
    recordings: Sequence[FleetRecording],
    *,
    estimator: str = SHIPPED,
    workers: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Intake:
    """Analyse recordings and add them to a store.

    Parameters
    ----------
    estimator : str
        See `analyse`.
    workers : int
        Processes that analyse; 1: this one.
    progress : callable, optional
        Told of how many are done, and of how many there are.

    Raises
    ------
    InputError
        Recordings contradict each other or the store; then nothing is added.
    """
    hashed = [replace(each, sha256=_hash(each.path)) for each in recordings]
    exchanges = [(each.axlebox, each.time) for each in store.entries() if each.kind == EXCHANGED]
    known = store.known()
    problems = _bearing_problems(hashed)
    problems += find_contradictions(hashed, known, exchanges, time.time())
    if estimator not in (SHIPPED, NO_ESTIMATOR) and not Path(estimator).is_file():
        problems.append(f"--estimator {estimator}: does not exist; give a file, {SHIPPED} or {NO_ESTIMATOR}")
    if problems:
        raise InputError(problems)
    there = {each.key for each in known}
    fresh = [each for each in hashed if each.key not in there]
    found = Intake(known=len(hashed) - len(fresh))
    for done, (recording, analysis) in enumerate(_analysed(fresh, estimator, workers), 1):
        if isinstance(analysis, Analysis):
            store.add(recording, analysis)
            found.added += 1
        else:
            found.refused += analysis
        if progress is not None:
            progress(done, len(fresh))
    return found


def _bearing_problems(recordings: Sequence[FleetRecording]) -> list[str]:
    """List the bearings that are not known, each once, with the first file."""
    from beardyn_core.config import load_plate

    problems: list[str] = []
    for name in dict.fromkeys(each.bearing for each in recordings if each.bearing):
        try:
            load_plate(name)
        except InputError as error:
            first = next(each.path for each in recordings if each.bearing == name)
            problems += [f"{first}: bearing {name}: {each}" for each in error.problems]
    return problems


def _hash(path: Path) -> str:
    found = hashlib.sha256()
    try:
        with path.open("rb") as file:
            while chunk := file.read(_CHUNK):
                found.update(chunk)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    return found.hexdigest()


def _analysed(
    recordings: Sequence[FleetRecording], estimator: str, workers: int
) -> Iterator[tuple[FleetRecording, Analysis | list[str]]]:
    """Give recordings with their analysis, or why there is none, a few of them in the making."""
    if workers <= 1 or len(recordings) <= 1:
        for each in recordings:
            yield each, _attempt(each, estimator)
        return
    # spawned: a forked process would hold the lock of the store after this one is killed
    pool = ProcessPoolExecutor(
        min(workers, len(recordings)), get_context("spawn"), _end_with_parent, (os.getpid(),)
    )
    try:
        waiting: deque[tuple[FleetRecording, Future[Analysis | list[str]]]] = deque()
        for each in recordings:
            waiting.append((each, pool.submit(_attempt, each, estimator)))
            if len(waiting) >= _AHEAD * workers:
                first, future = waiting.popleft()
                yield first, future.result()
        while waiting:
            first, future = waiting.popleft()
            yield first, future.result()
    except BrokenProcessPool:
        raise InputError(
            "a process that analysed a recording was ended from outside, as where memory runs out; what was "
            "committed is in the store, and the same command goes on: take fewer --workers"
        ) from None
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _attempt(recording: FleetRecording, estimator: str) -> Analysis | list[str]:
    """Analyse a recording; the sentences of an error in place of it."""
    try:
        return analyse(recording, estimator)
    except InputError as error:
        name = str(recording.path)
        return [each if each.startswith(name) else f"{name}: {each}" for each in error.problems]


def _end_with_parent(parent: int) -> None:
    """End this process when the one that started it has gone: a killed one cannot say so."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_PARENT_S)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
