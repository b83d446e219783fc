"""Recordings into the store: identity checked first, analysed several at a time, one transaction each."""

from __future__ import annotations

import hashlib
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from dataclasses import dataclass, field, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.experiments import Cluster, Engine, EngineError, core_count
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.fleet.analysis import NO_ESTIMATOR, SHIPPED, Analysis, analyse
from beardyn_core.fleet.consistency import find_contradictions
from beardyn_core.fleet.identity import FleetRecording
from beardyn_core.fleet.store import EXCHANGED, FleetStore

_AHEAD = 3  # recordings a process has waiting
_PARENT_S = 1.0  # between two looks of a process whether the one that started it is there
_CHUNK = 1 << 20
_READERS = 4  # files that are hashed at once


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
    cluster: Cluster,
    progress: Callable[[int, int], None] | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Intake:
    """Analyse recordings and add them to a store.

    Parameters
    ----------
    estimator : str
        See `analyse`.
    cluster : Cluster
        Processes of this machine that analyse, one: this process; or a Dask cluster, whose workers read the
        files by the same paths. This process alone writes the store.
    progress : callable, optional
        Called with how many are done, and how many there are.
    say : callable, optional
        Called when workers and schedulers come and go.

    Raises
    ------
    InputError
        Recordings contradict each other or the store, and then nothing is added; or the workers cannot be
        reached, or have another beardyn.
    """
    hashed = _hashed(recordings)
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
    analysed = (
        _on_cluster(fresh, estimator, cluster, say)
        if cluster.scheduler
        else _analysed(fresh, estimator, cluster.worker_count)
    )
    with closing(analysed):  # which ends the workers
        for done, (recording, analysis) in enumerate(analysed, 1):
            if isinstance(analysis, Analysis):
                store.add(recording, analysis)
                found.added += 1
            else:
                found.refused += analysis
            if progress is not None:
                progress(done, len(fresh))
    return found


def _hashed(recordings: Sequence[FleetRecording]) -> list[FleetRecording]:
    """Give recordings with the hashes of their files, several read at once."""
    with ThreadPoolExecutor(min(core_count(), _READERS)) as pool:
        hashes = list(pool.map(_hash, [each.path for each in recordings]))
    return [replace(each, sha256=found) for each, found in zip(recordings, hashes, strict=True)]


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
) -> Generator[tuple[FleetRecording, Analysis | list[str]]]:
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


def _on_cluster(
    recordings: Sequence[FleetRecording], estimator: str, cluster: Cluster, say: Callable[[str], None]
) -> Generator[tuple[FleetRecording, Analysis | list[str]]]:
    """Give recordings with their analysis by the workers of a Dask cluster, as they come."""
    if not recordings:
        return
    own = simulator_digest()
    try:
        with Engine(cluster, say) as engine:
            tasks = [replace(each, path=each.path.absolute()) for each in recordings]
            by_key = {each.key: each for each in recordings}
            named = estimator if estimator in (SHIPPED, NO_ESTIMATOR) else str(Path(estimator).absolute())
            for ended in engine.run(_attempt_on_worker, tasks, named):
                recording = by_key[ended.task.key]
                if ended.killed:
                    why = f"{ended.killed} processes died while they analysed it, one after the other"
                    yield recording, [f"{recording.path}: {why}: out of memory, or a crash"]
                    continue
                code, analysis = ended.value
                if code != own:
                    raise InputError(
                        f"--scheduler {cluster.scheduler}: a worker has another beardyn (digest {code}, here "
                        f"{own}); install the same version on every machine"
                    )
                yield recording, analysis
    except EngineError as error:
        raise InputError(
            f"{error}; what was committed is in the store, and the same command goes on"
        ) from error


def _attempt_on_worker(recording: FleetRecording, estimator: str) -> tuple[str, Analysis | list[str]]:
    """Analyse a recording; gives the digest of the worker's code, too."""
    return simulator_digest(), _attempt(recording, estimator)


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
