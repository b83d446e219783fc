"""A set as a PyTorch dataset: runs by their number, or a stream for sets bigger than the memory."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import torch
from torch.utils.data import Dataset, IterableDataset, get_worker_info

if TYPE_CHECKING:
    from beardyn_core.population.labelled_set import LabelledSet

Item = tuple[dict[str, Any], dict[str, Any]]


class TorchRuns(Dataset):
    """Complete runs of a part; item k is ``(signals, labels)``.

    Both are mappings by name. Signals are tensors of the shape that the set keeps, ``vibration`` [sample,
    axis]; labels are numbers, and words as their place in `classes`. Every process of a ``DataLoader`` opens
    the set for itself.

    Attributes
    ----------
    classes : dict
        Words of every label of words, in the order of their numbers; those of all parts.
    """

    def __init__(
        self, runs: LabelledSet, part: str | None, signals: tuple[str, ...], labels: tuple[str, ...]
    ) -> None:
        self._folder = Path(runs.folder)
        self._set: LabelledSet | None = None
        self.part, self.signals, self.labels = part, signals, labels
        self.runs = runs.runs_of(part)
        every = runs.labels_of(runs.runs_of(None), labels)
        self.classes = {
            name: sorted({str(value) for value in values})
            for name, values in every.items()
            if values.dtype.kind not in "biuf"
        }
        own = runs.labels_of(self.runs, labels)
        self._labels = {name: self._numbers(name, values) for name, values in own.items()}

    def _numbers(self, name: str, values: Any) -> Any:
        if name not in self.classes:
            return np.asarray(values)
        order = {word: number for number, word in enumerate(self.classes[name])}
        return np.array([order[str(value)] for value in values], np.int64)

    def _open_set(self) -> LabelledSet:
        if self._set is None:
            from beardyn_core.population.labelled_set import LabelledSet

            self._set = LabelledSet(self._folder)
        return self._set

    def __getstate__(self) -> dict[str, Any]:
        """Leave the open set behind: another process opens it itself."""
        return {**self.__dict__, "_set": None}

    def __len__(self) -> int:
        """Count the runs."""
        return len(self.runs)

    def __getitem__(self, index: int) -> Item:
        """Read one run."""
        run = int(self.runs[index])
        arrays = self._open_set().arrays
        signals = {name: torch.from_numpy(np.asarray(arrays[name][run])) for name in self.signals}
        return signals, {name: torch.as_tensor(values[index]) for name, values in self._labels.items()}

    def stream(self, buffer: int = 256, seed: int = 0) -> TorchStream:
        """Give the same runs as a stream: whole files in random order, shuffled in a buffer."""
        return TorchStream(self, buffer, seed)


class TorchStream(IterableDataset):
    """Runs of a part in random order, file by file; each process of a ``DataLoader`` has its own share.

    Call `set_epoch` before every epoch for another order.
    """

    def __init__(self, runs: TorchRuns, buffer: int, seed: int) -> None:
        self._runs, self._buffer, self._seed, self._epoch = runs, buffer, seed, 0

    def set_epoch(self, epoch: int) -> None:
        """Choose the order of an epoch."""
        self._epoch = epoch

    def __iter__(self) -> Iterator[Item]:
        """Read the files of this process one after the other."""
        found = self._runs._open_set()
        info = get_worker_info()
        share = (0, 1) if info is None else (info.id, info.num_workers)
        place = {int(run): k for k, run in enumerate(self._runs.runs)}
        seed = self._seed * 1_000_003 + self._epoch
        batches = found.batches(
            1, part=self._runs.part, signals=self._runs.signals, labels=(), seed=seed, buffer=self._buffer,
            share=share,
        )  # fmt: skip
        for batch in batches:
            k = place[int(batch["run"][0])]
            signals = {name: torch.from_numpy(batch[name][0]) for name in self._runs.signals}
            labels = {name: torch.as_tensor(values[k]) for name, values in self._runs._labels.items()}
            yield signals, labels
