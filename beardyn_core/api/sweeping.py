"""Make a set of labelled runs, and open one."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import folder_problems

if TYPE_CHECKING:
    from beardyn_core.experiments import Cluster
    from beardyn_core.experiments.loop import Progress
    from beardyn_core.population.labelled_set import LabelledSet

_TOLD_EVERY_S = 10.0


def sweep(
    sweep: str | Path | Mapping[str, Any],
    output: str | Path,
    *,
    workers: int | None = None,
    scheduler: str = "",
    tls: Mapping[str, str | Path] | None = None,
    memory_GB: float | None = None,
    force: bool = False,
    progress: bool | Callable[[Progress], None] = False,
    **changes: Any,
) -> LabelledSet:
    """Make a set of labelled runs over a population of bearings, on all cores or a Dask cluster.

    Draw runs from the distributions of a sweep file, simulate them on all cores of this machine or on the
    workers of a Dask scheduler; keep signals (Zarr), labels with units (Parquet), features, a data card and
    checksums in a folder. Parts for training and testing share no bearing. An interrupted sweep goes on where
    it was when it is asked for again; the same seed gives the same bits on any number of workers.

    Parameters
    ----------
    sweep : str, Path or mapping
        Shipped sweep (`beardyn scenes sweeps` lists them) or YAML file. Or a mapping with the keys of one.
    output : Path
        Folder of the set. It is made.
    workers : int, optional
        Processes of this machine; default one for each core.
    scheduler : str, optional
        Address of the Dask scheduler whose workers do the runs, tcp://host:8786; default this machine.
    tls : mapping, optional
        ``ca``, ``cert`` and ``key``: files that a scheduler at ``tls://`` is reached with.
    memory_GB : float, optional
        Memory of a worker, GB, above which it is started anew; default its share of the machine's.
    force : bool
        Start over in a folder that holds a set, and lose it.
    progress : bool or callable
        Print a line now and then on standard error; or a function that is called after every task.
    **changes
        Keys in place of those of the sweep's file: ``runs=50``, ``seed=2``.

    Returns
    -------
    LabelledSet
        The same bits from any number of workers of one kind of processor.

    Raises
    ------
    InputError
        With every mistake in the sweep and in the scenes of its runs; nothing has run.
    """
    from beardyn_core.experiments import EngineError
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.population.request import make_plan
    from beardyn_core.population.sweeping import conduct

    tell: Callable[[Progress], None] = progress if callable(progress) else Lines() if progress else _nothing
    cluster = cluster_of(workers, scheduler, tls, memory_GB)
    problems = cluster.problems() + folder_problems("output", Path(output))
    try:
        plan = make_plan(sweep, _say, **changes)
    except InputError as error:
        problems += error.problems
    if problems:
        raise InputError(problems)
    try:
        conduct(plan, Path(output), cluster, force=force, report=tell, say=_say)
    except EngineError as error:
        raise InputError(str(error)) from error
    return LabelledSet(output)


def open_set(folder: str | Path) -> LabelledSet:
    """Open a set of labelled runs: its table, its signals as xarray when they are asked for.

    Parameters
    ----------
    folder : Path
        That `sweep` or ``beardyn sweep`` has made.

    Raises
    ------
    InputError
        It is no set.

    Examples
    --------
    >>> runs = open_set("my_set")                             # doctest: +SKIP
    >>> runs.signals.vibration.sel(run=3, axis="z")           # doctest: +SKIP
    """
    from beardyn_core.population.labelled_set import LabelledSet

    return LabelledSet(folder)


def cluster_of(
    workers: int | None, scheduler: str, tls: Mapping[str, str | Path] | None, memory_GB: float | None
) -> Cluster:
    """Say where the work is done."""
    from beardyn_core.experiments import Cluster, Tls

    given = {name: Path(path) for name, path in (tls or {}).items() if path is not None}
    unknown = set(given) - {"ca", "cert", "key"}
    if unknown:
        raise InputError(f"tls has the key {min(unknown)!r}; allowed are ca, cert, key")
    memory = None if memory_GB is None else memory_GB * 1e9
    return Cluster(workers, scheduler, Tls(**given), memory)


class Lines:
    """Progress as lines on standard error, one in a while."""

    def __init__(self) -> None:
        self.done = 0
        self._next = 0.0
        self._linked = False

    def __call__(self, now: Progress) -> None:
        """Print a line when it is time."""
        self.done = now.done
        if not self._linked and now.dashboard:
            _say(f"dashboard {now.dashboard}")
            self._linked = True
        if now.seconds >= self._next or now.done == now.total:
            self._next = now.seconds + _TOLD_EVERY_S
            _say(sentence(now))

    def close(self) -> None:
        """End the lines, of which none is open."""


def sentence(now: Progress) -> str:
    """Write progress as a line: runs, rate, time left, failures."""
    left = "" if not now.here or now.done == now.total else f", {clock(now.remaining)} left"
    failed = f", {now.failed} failed" if now.failed else ""
    return f"{now.done}/{now.total} runs, {now.rate:.2f} a second on {now.workers} workers{left}{failed}"


def clock(seconds: float) -> str:
    """Write a time as ``1:02:03``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def _say(text: str) -> None:
    print(f"beardyn: {text}", file=sys.stderr, flush=True)


def _nothing(_now: Progress) -> None:
    """Tell nothing."""
