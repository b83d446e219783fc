"""One description of a set of runs: what each is, by a key of its own, and what is there of it already."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated as A
from typing import Any, Generic, TypeVar

from beardyn_core.experiments.engine import EngineError

Item = TypeVar("Item")
Result = TypeVar("Result")


def _refuse_loss(item: Any, killed: int) -> Any:
    """End the set with a run that kills whatever process computes it."""
    raise EngineError(f"{item}: {killed} processes died while they computed it")


def _never_fails(_result: Any) -> bool:
    return False


@dataclass(frozen=True)
class Task(Generic[Item]):
    """Runs that one process does one after the other."""

    keys: tuple[str, ...]
    items: A[tuple[Item, ...], "what each run is"]

    def __str__(self) -> str:
        return ", ".join(self.keys)


@dataclass(frozen=True)
class Plan(Generic[Item, Result]):
    """A set of runs that need nothing of one another.

    Notes
    -----
    The axleboxes of a train (`study.train_run`) are no such set: they advance in step, in threads of one
    process and into one recording, so that none of them begins, ends or is taken up again by itself.
    """

    items: A[Mapping[str, Item], "what each run is, by its key, in the order of the results"]
    work: A[
        Callable[[Sequence[Item], Any], Sequence[Result]],
        "gives the results of some items from the request; of a module that the workers can import",
    ]
    request: A[Any, "what all runs have in common"] = None
    digests: A[
        Mapping[str, str], "of all that a run depends on, request and code, by key; empty: nothing is kept"
    ] = field(default_factory=dict)
    order: A[tuple[str, ...], "keys in the order in which runs begin; empty: that of the items"] = ()
    together: A[int, "runs of a task, neighbours in that order"] = 1
    lost: A[
        Callable[[Item, int], Result],
        "result of a run that so many processes died of, one after the other; it may raise instead",
    ] = _refuse_loss
    keeps_lost: A[bool, "whether such a result is kept, so that the run is not tried again"] = True
    has_failed: A[Callable[[Result], bool], "whether a result is that of a failure"] = _never_fails
    kept: A[Mapping[str, Result], "results of an earlier go whose digest is still the same, by key"] = field(
        default_factory=dict
    )
    outdated: A[int, "runs of an earlier go, of other code or files; kept until they are run again"] = 0
    fresh: A[bool, "whether the store starts over"] = False

    @property
    def missing(self) -> tuple[str, ...]:
        """Keys of the runs that are still to be done, in the order in which they begin."""
        return tuple(key for key in self.order or self.items if key not in self.kept)

    def tasks(self, done: Container[str] = ()) -> Iterator[Task[Item]]:
        """Put the runs that are not done together in tasks.

        Where a task begins depends on no run that is done: the runs of one are the same in every go.
        """
        order = self.order or tuple(self.items)
        for first in range(0, len(order), self.together):
            keys = tuple(key for key in order[first : first + self.together] if key not in done)
            if keys:
                yield self.task_of(keys)

    def task_of(self, keys: tuple[str, ...]) -> Task[Item]:
        """Make the task of some runs."""
        return Task(keys, tuple(self.items[key] for key in keys))


def do_task(task: Task[Item], work: Callable[..., Sequence[Result]], request: Any) -> Sequence[Result]:
    """Do a task, in whatever process this is."""
    return work(task.items, request)
