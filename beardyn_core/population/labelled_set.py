"""A set of labelled runs, opened: its table at once, its signals when they are asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.population.difficulty import difficulty_line
from beardyn_core.population.finalizing import verify
from beardyn_core.population.folder import read_about
from beardyn_core.population.signal_store import RUN, SIGNALS, zarr_library
from beardyn_core.population.table import FEATURES, RUNS, units_of

if TYPE_CHECKING:
    from beardyn_core.population.torch_data import TorchRuns

TRAIN, VALIDATION, TEST = PARTS = "train", "validation", "test"
_AXES = {"axis": ("x", "y", "z"), "component": ("fx", "fy", "fz", "mx", "my", "mz")}
_SHOWN = ("split", "bearing_id", "condition", "status")


class LabelledSet:
    """A set of labelled runs in a folder that `sweep` has made.

    Parameters
    ----------
    folder : Path

    Attributes
    ----------
    folder : Path
    about : dict
        What the set states about itself: sweep, scene that every run starts from, versions, seconds a run.

    Raises
    ------
    InputError
        The folder is no set, or its sweep has not got to its end.
    """

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder)
        self.about = read_about(self.folder)
        if not (self.folder / RUNS).is_file():
            raise InputError(
                f"{folder}: has no {RUNS} yet: its sweep is not finished; the same command goes on"
            )

    def __len__(self) -> int:
        """Count the runs."""
        return len(self.table)

    def __repr__(self) -> str:
        """Describe the set in three lines."""
        parts = ", ".join(f"{name} {count}" for name, count in self.about["parts"].items())
        return (
            f"LabelledSet {self.about['sweep']}: {len(self)} runs, {self.about['failed']} failed\n"
            f"  parts: {parts}; signals: {', '.join(self.signal_names)}\n  {difficulty_line(self.difficulty)}"
        )

    @property
    def difficulty(self) -> dict[str, Any] | None:
        """What the shipped monitor finds in the set, and how far apart its conditions are.

        See `population.difficulty.difficulty_of`; ``None`` of one condition, or of an earlier version.
        """
        found: dict[str, Any] | None = self.about.get("difficulty")
        return found

    @cached_property
    def table(self) -> Any:
        """``pandas.DataFrame``: a row a run, every drawn key and every label; `units` has the units."""
        return library("pandas", "a set of runs", "sweep").read_parquet(self.folder / RUNS)

    @cached_property
    def features(self) -> Any:
        """``pandas.DataFrame``: features of each run, in the order of `table`."""
        return library("pandas", "a set of runs", "sweep").read_parquet(self.folder / FEATURES)

    @cached_property
    def units(self) -> dict[str, str]:
        """Units of the columns of both tables; '' for what has none."""
        return {**units_of(self.folder / FEATURES), **units_of(self.folder / RUNS)}

    @cached_property
    def arrays(self) -> dict[str, Any]:
        """Signals as arrays of Zarr, shape [run, sample, ...]: nothing is read before it is indexed."""
        group = zarr_library().open_group(str(self.folder / SIGNALS), mode="r")
        found = {name: group[name] for name in group.array_keys()}
        return {name: each for name, each in found.items() if each.metadata.dimension_names[0] == RUN}

    @property
    def signal_names(self) -> tuple[str, ...]:
        """Names of the signals."""
        return tuple(sorted(self.arrays))

    @cached_property
    def signals(self) -> Any:
        """``xarray.Dataset`` of all signals, read when it is asked for; dims run, time and axis.

        Part, bearing, condition and status of each run are coordinates: ``signals.vibration.sel(run=3)``,
        ``signals.where(signals.split == "train", drop=True)``. The signals of a failed run end in NaN.
        """
        xarray = library("xarray", "a set of runs", "sweep")
        found = xarray.open_zarr(self.folder / SIGNALS, consolidated=False, chunks=None, zarr_format=3)
        count = len(self.table)
        found = found.isel({RUN: slice(0, int(self.table[RUN].max()) + 1)})
        if count == found.sizes[RUN]:
            found = found.assign_coords(
                {name: (RUN, self.table[name].astype(str).to_numpy()) for name in _SHOWN}
            )
            found = found.assign_coords({RUN: self.table[RUN].to_numpy()})
        names = {dim: list(labels) for dim, labels in _AXES.items() if found.sizes.get(dim) == len(labels)}
        return found.assign_coords(names).assign_attrs(
            sweep=self.about["sweep"], licence=self.about["licence"], code=self.about["code"]
        )

    def runs_of(self, part: str | None = None) -> NDArray[np.int64]:
        """List the numbers of the complete runs of a part, of all parts by default."""
        if part is not None and part not in PARTS:
            raise InputError(f"part is {part!r}; allowed are {', '.join(PARTS)}")
        chosen = self.table["status"] == "complete"
        if part is not None:
            chosen &= self.table["split"] == part
        return np.asarray(self.table.loc[chosen, RUN], np.int64)

    def labels_of(self, runs: Sequence[int] | NDArray[np.int64], names: Sequence[str]) -> dict[str, Any]:
        """Take columns of the table, or of the features, for some runs."""
        both = self.table.set_index(RUN).join(self.features.set_index(RUN))
        for name in names:
            if name not in both:
                near = ", ".join(sorted(both)[:60])
                raise InputError(f"{self.folder}: has no label {name!r}; there are {near}, ...")
        return {name: both.loc[list(runs), name].to_numpy() for name in names}

    def batches(
        self,
        size: int = 32,
        *,
        part: str | None = TRAIN,
        signals: Sequence[str] = ("vibration",),
        labels: Sequence[str] = ("condition",),
        seed: int = 0,
        buffer: int = 256,
        share: tuple[int, int] = (0, 1),
    ) -> Iterator[dict[str, Any]]:
        """Give the runs of a part once, shuffled, a batch at a time, without holding more than a buffer.

        Files are read whole and in random order, each once; batches are drawn at random from the runs that
        are in memory. So a set of any size streams at the speed of its disk.

        Parameters
        ----------
        size : int
            Runs of a batch; the last may have fewer.
        part : str or None
            ``train``, ``validation`` or ``test``; ``None``: all.
        signals, labels : sequence of str
            Of `signal_names`, and columns of `table` or `features`.
        seed : int
            Of the order: another one for every epoch.
        buffer : int
            Runs in memory.
        share : tuple of 2 ints
            Of several readers, which one this is and how many there are: each reads files of its own.

        Yields
        ------
        dict
            ``run``, and an array by the name of every signal and label, runs along the first axis.
        """
        chosen = self.runs_of(part)
        known = self.labels_of(chosen, labels)
        place = {int(run): k for k, run in enumerate(chosen)}
        random = np.random.default_rng(seed)
        held: list[tuple[int, dict[str, NDArray[Any]]]] = []

        def drawn(count: int) -> dict[str, Any]:
            taken = [held.pop(int(random.integers(len(held)))) for _ in range(min(count, len(held)))]
            runs = np.array([run for run, _ in taken])
            places = [place[run] for run, _ in taken]
            arrays = {name: np.stack([found[name] for _, found in taken]) for name in signals}
            return {RUN: runs, **arrays, **{name: known[name][places] for name in labels}}

        for runs in self._files_of(chosen, signals, random)[share[0] :: share[1]]:
            first, last = int(runs[0]), int(runs[-1]) + 1
            blocks = {name: self.arrays[name][first:last] for name in signals}
            held += [
                (int(run), {name: block[int(run) - first] for name, block in blocks.items()}) for run in runs
            ]
            while len(held) >= max(buffer, size):
                yield drawn(size)
        while held:
            yield drawn(size)

    def _files_of(
        self, chosen: NDArray[np.int64], signals: Sequence[str], random: np.random.Generator
    ) -> list[NDArray[np.int64]]:
        """Put runs together that lie in one file, in random order."""
        for name in signals:
            if name not in self.arrays:
                raise InputError(
                    f"{self.folder}: has no signal {name!r}; there are {', '.join(self.signal_names)}"
                )
        together = self.arrays[signals[0]].shards[0] if signals else 1
        number = chosen // together
        files = [chosen[number == each] for each in np.unique(number)]
        return [files[k] for k in random.permutation(len(files))]

    def torch(
        self,
        part: str | None = TRAIN,
        *,
        signals: Sequence[str] = ("vibration",),
        labels: Sequence[str] = ("condition",),
    ) -> TorchRuns:
        """Give the runs of a part as a ``torch.utils.data.Dataset``: see `torch_data.TorchRuns`."""
        library("torch", "a set as a PyTorch dataset", "torch")
        from beardyn_core.population.torch_data import TorchRuns

        return TorchRuns(self, part, tuple(signals), tuple(labels))

    def verify(self) -> list[str]:
        """List the files that are not what they were when the set was closed; empty when all are."""
        return verify(self.folder)
