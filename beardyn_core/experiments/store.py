"""One way to keep the results of a set of runs and to go on with it: a file of JSON lines.

A run is done when the file has its result with the digest of today's request and code. A line that was cut
off counts for nothing; what is of other code or of another request stays until it has been done again.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A
from typing import Any, BinaryIO, Generic, NamedTuple, TypeVar

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import is_being_written, open_to_append, write_whole
from beardyn_core.experiments.plan import Item, Plan, Result

_ABOUT = "of"  # key of the line that describes the set

Kept = TypeVar("Kept")


class Entry(NamedTuple, Generic[Kept]):
    """A result in a store."""

    key: A[str, "of the run"]
    digest: A[str, "of all that it depended on"]
    result: Kept


@dataclass(frozen=True)
class Layout(Generic[Kept]):
    """How results stand in the lines of a file."""

    to_json: A[Callable[[Entry[Kept]], dict[str, Any]], "object of a result"]
    of_json: A[Callable[[dict[str, Any]], Entry[Kept]], "result of such an object"]
    group: A[
        str, "key of the list of results that a line holds for each task; empty: a line for each run"
    ] = ""
    default: A[Callable[[Any], Any] | None, "makes JSON of what has none, as that of `json.dumps`"] = None


class Store(Generic[Kept]):
    """Results in a file that gets a line for every task that ends.

    Parameters
    ----------
    path : Path or None
        ``None``: nothing is kept.
    layout : Layout
    about : mapping, optional
        Describes the set in the first line of the file.
    """

    def __init__(
        self, path: Path | None, layout: Layout[Kept], about: Mapping[str, Any] | None = None
    ) -> None:
        self.path, self._layout, self.about = path, layout, about
        self._count = 0
        self._file: BinaryIO | None = None

    @property
    def is_busy(self) -> bool:
        """Whether another process is writing it."""
        return self.path is not None and is_being_written(self.path)

    @property
    def described(self) -> dict[str, Any] | None:
        """What the file says of its set; ``None`` where it says nothing."""
        found = (row[_ABOUT] for row in self._rows() if isinstance(row.get(_ABOUT), dict))
        return next(found, None)

    def entries(self) -> list[Entry[Kept]]:
        """Read all results, those of other code and of other requests included."""
        found: list[Entry[Kept]] = []
        for row in self._rows():
            with suppress(ValueError, TypeError, KeyError, AttributeError):
                rows = row[self._layout.group] if self._layout.group else [row]
                found += [self._layout.of_json(each) for each in rows]
        return found

    def resume(self, plan: Plan[Item, Result]) -> Plan[Item, Result]:
        """Take up a set where the file has left it."""
        there = self.entries()
        kept: dict[str, Any] = {
            each.key: each.result for each in there if plan.digests.get(each.key) == each.digest
        }
        outdated = {each.key for each in there if each.key in plan.items and each.key not in kept}
        return replace(plan, kept=kept, outdated=len(outdated))

    @contextmanager
    def opened(self, plan: Plan[Item, Result]) -> Iterator[None]:
        """Lock the file for what a plan adds to it; it starts over where the plan does.

        Raises
        ------
        InputError
            Another process is writing it, or it cannot be written.
        """
        self._count = len(plan.kept)
        try:
            if self.path is not None:
                with self._sentences():
                    self._file = open_to_append(self.path, empty=plan.fresh)
                    if self.about is not None and (self._file.tell() == 0 or self.described is None):
                        self._write({_ABOUT: self.about})
            yield
        finally:
            if self._file is not None:
                self._file.close()  # which unlocks it
                self._file = None

    def add(self, entries: Sequence[Entry[Any]]) -> list[Entry[Any]]:
        """Add the results of a task; gives them as they are kept."""
        if self._file is not None:
            objects = [self._layout.to_json(each) for each in entries]
            with self._sentences():
                for row in [{self._layout.group: objects}] if self._layout.group else objects:
                    self._write(row)
        self._count += len(entries)
        return list(entries)

    def tidy(self, plan: Plan[Item, Result]) -> None:
        """Drop outdated results of runs that have been done again, and put those of the plan in order."""
        if self.path is None or not plan.outdated:
            return
        new = {e.key: e for e in self.entries() if plan.digests.get(e.key) == e.digest}
        self._rewrite(set(new), [new[key] for key in plan.items if key in new])

    def forget(self, keys: Sequence[str]) -> None:
        """Drop the results of some runs.

        Raises
        ------
        InputError
            Another process is writing the file.
        """
        if self.path is None or not self.path.is_file():
            return
        with self._sentences(), open_to_append(self.path):  # nobody else writes meanwhile
            self._rewrite(set(keys), [])

    def _rewrite(self, gone: set[str], first: Sequence[Entry[Any]]) -> None:
        """Write the file anew without some runs; what cannot be read any more stays as it is."""
        assert self.path is not None
        assert not self._layout.group
        rows = [{_ABOUT: self.about}] if self.about is not None else []
        rows += [self._layout.to_json(each) for each in first]
        rows += [row for row in self._rows() if _ABOUT not in row and self._key_of(row) not in gone]
        with self._sentences():
            write_whole(self.path, "".join(map(self._line, rows)))

    def _key_of(self, row: dict[str, Any]) -> Any:
        with suppress(ValueError, TypeError, KeyError, AttributeError):
            return self._layout.of_json(row).key
        return str(row.get("key"))

    def _rows(self) -> Iterator[dict[str, Any]]:
        if self.path is None or not self.path.is_file():
            return
        with self.path.open(encoding="utf-8", errors="replace") as lines:
            for line in lines:
                with suppress(ValueError):  # the last one may be cut off
                    found = json.loads(line)
                    if isinstance(found, dict):
                        yield found

    def _line(self, row: Mapping[str, Any]) -> str:
        return json.dumps(row, default=self._layout.default) + "\n"

    def _write(self, row: Mapping[str, Any]) -> None:
        assert self._file is not None
        rest = self._line(row).encode()
        while rest:  # a disk that is nearly full takes a part
            rest = rest[self._file.write(rest) :]

    @contextmanager
    def _sentences(self) -> Iterator[None]:
        """Turn a full disk into a sentence."""
        try:
            yield
        except OSError as error:
            raise InputError(
                f"{self.path}: cannot be written: {error.strerror or error}; the {self._count} runs before "
                "are kept, and the same command goes on from there"
            ) from error


def differing(mine: Mapping[str, Any], there: Mapping[str, Any]) -> list[str]:
    """Name what differs between two descriptions of sets, in the order of the first."""
    return [name for name in dict.fromkeys([*mine, *there]) if mine.get(name) != there.get(name)]
