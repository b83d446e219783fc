"""One loop over a set of runs: what is kept and taken up again, what becomes of losses and interrupts."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.experiments import Ended, EngineError, ThisProcess
from beardyn_core.experiments.loop import Progress, run_plan
from beardyn_core.experiments.plan import Plan, Task
from beardyn_core.experiments.store import Entry, Layout, Store, differing

LINES = Layout[int](
    lambda each: {"key": each.key, "digest": each.digest, "value": each.result},
    lambda row: Entry(row["key"], row["digest"], int(row["value"])),
)


def squares(items: Sequence[int], asked: list[int]) -> list[int]:
    """Square numbers, and note which were asked for."""
    asked += items
    return [item * item for item in items]


def planned(asked: list[int], count: int = 5, **changes: Any) -> Plan[int, int]:
    items = {f"run {number}": number for number in range(count)}
    digests = dict.fromkeys(items, "new")
    return replace(Plan[int, int](items, squares, asked, digests), **changes)


class Deadly(ThisProcess):
    """Processes that die of some numbers."""

    def __init__(self, *deadly: int) -> None:
        self.deadly = set(deadly)

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Any], *arguments: Any
    ) -> Iterator[Ended[Any]]:
        for task in tasks:
            died = self.deadly & set(task.items)
            yield Ended(task, killed=4) if died else Ended(task, function(task, *arguments))


def test_results_come_in_the_order_of_the_plan_whatever_order_they_are_made_in() -> None:
    asked: list[int] = []
    plan = planned(asked, order=("run 3", "run 0", "run 4", "run 1", "run 2"), together=2)
    assert list(run_plan(plan, ThisProcess()).items()) == [(f"run {n}", n * n) for n in range(5)]
    assert asked == [3, 0, 4, 1, 2]


def test_an_interrupted_set_goes_on_where_it_was(tmp_path: Path) -> None:
    asked: list[int] = []
    store = Store(tmp_path / "runs.jsonl", LINES, {"what": "squares"})

    def stop(now: Progress[int]) -> None:
        if now.done == 3:
            raise KeyboardInterrupt

    plan = store.resume(planned(asked))
    with pytest.raises(KeyboardInterrupt), store.opened(plan):
        run_plan(plan, ThisProcess(), store, stop)
    with (tmp_path / "runs.jsonl").open("a") as file:
        file.write('{"key": "run 3", "dig')  # killed in the middle of a line
    again = store.resume(planned(asked))
    assert (again.kept, again.missing, again.outdated) == (
        {"run 0": 0, "run 1": 1, "run 2": 4}, ("run 3", "run 4"), 0,
    )  # fmt: skip
    told: list[Progress[int]] = []
    with store.opened(again):
        assert list(run_plan(again, ThisProcess(), store, told.append).values()) == [0, 1, 4, 9, 16]
    assert asked == [0, 1, 2, 3, 4]
    assert [(now.done, now.here, dict(now.latest)) for now in told] == [
        (3, 0, {}), (4, 1, {"run 3": 9}), (5, 2, {"run 4": 16}),
    ]  # fmt: skip
    assert store.described == {"what": "squares"}


def test_results_of_other_code_stay_until_they_are_done_again(tmp_path: Path) -> None:
    asked: list[int] = []
    store = Store(tmp_path / "runs.jsonl", LINES)
    first = store.resume(planned(asked))
    with store.opened(first):
        run_plan(first, ThisProcess(), store)
    old = (tmp_path / "runs.jsonl").read_bytes()
    edited = planned(asked, count=3, digests=dict.fromkeys(("run 0", "run 1", "run 2"), "edited"))
    plan = store.resume(edited)
    assert (plan.outdated, plan.kept) == (3, {})
    with store.opened(plan):
        run_plan(plan, ThisProcess(), store)
        assert (tmp_path / "runs.jsonl").read_bytes().startswith(old)
        store.tidy(plan)
    assert [(each.key, each.digest) for each in store.entries()] == [
        *((f"run {n}", "edited") for n in range(3)), ("run 3", "new"), ("run 4", "new"),
    ]  # fmt: skip
    store.forget(["run 3", "run 1"])
    assert [each.key for each in store.entries()] == ["run 0", "run 2", "run 4"]


def test_a_run_that_kills_its_processes_costs_none_of_its_task() -> None:
    plan = planned([], together=3, lost=lambda item, killed: -killed, has_failed=lambda value: value < 0)
    told: list[Progress[int]] = []
    assert list(run_plan(plan, Deadly(1), report=told.append).values()) == [0, -4, 4, 9, 16]
    assert told[-1].failed == 1
    with pytest.raises(EngineError, match="4 processes died"):
        run_plan(planned([]), Deadly(1))


def test_a_loss_that_is_not_kept_is_tried_again(tmp_path: Path) -> None:
    store = Store(tmp_path / "runs.jsonl", LINES)
    for keeps, missing in ((False, ("run 1",)), (True, ())):
        plan = store.resume(planned([], lost=lambda *_: 0, keeps_lost=keeps))
        with store.opened(plan):
            assert len(run_plan(plan, Deadly(1), store)) == 5
        assert store.resume(planned([])).missing == missing


def test_no_task_begins_after_its_time() -> None:
    asked: list[int] = []
    assert run_plan(planned(asked), ThisProcess(), until=time.monotonic() - 1.0) == {}
    assert asked == []


def test_a_task_has_the_same_runs_in_every_go() -> None:
    plan = planned([], count=6, together=2)
    assert [task.keys for task in plan.tasks({"run 2"})] == [
        ("run 0", "run 1"), ("run 3",), ("run 4", "run 5"),
    ]  # fmt: skip
    assert next(plan.tasks()) == Task(("run 0", "run 1"), (0, 1))


def test_a_store_is_written_by_one_process_at_a_time(tmp_path: Path) -> None:
    one, other = (Store(tmp_path / "runs.jsonl", LINES) for _ in range(2))
    plan = planned([])
    assert not one.is_busy
    with one.opened(plan):
        assert other.is_busy
        with pytest.raises(InputError, match="another process is writing"), other.opened(plan):
            pass
    with other.opened(plan):
        pass


def test_results_are_not_forgotten_while_another_process_writes(tmp_path: Path) -> None:
    one, other = (Store(tmp_path / "runs.jsonl", LINES) for _ in range(2))
    plan = planned([], count=2)
    with one.opened(plan):
        run_plan(plan, ThisProcess(), one)
        with pytest.raises(InputError, match="another process"):
            other.forget(["run 0"])
    other.forget(["run 0"])
    assert [each.key for each in one.entries()] == ["run 1"]


def test_results_that_cannot_be_read_any_more_stay(tmp_path: Path) -> None:
    store = Store(tmp_path / "runs.jsonl", LINES)
    theirs = [{"key": f"run {n}", "digest": "theirs", "more": None} for n in (0, 7)]
    old = {"key": "run 0", "digest": "old", "value": 0}
    (tmp_path / "runs.jsonl").write_text("".join(json.dumps(row) + "\n" for row in (*theirs, old)))
    plan = store.resume(planned([], count=1))
    assert plan.outdated == 1
    with store.opened(plan):
        run_plan(plan, ThisProcess(), store)
        store.tidy(plan)
    rows = [json.loads(line) for line in (tmp_path / "runs.jsonl").read_text().splitlines()]
    assert [(row["key"], row["digest"]) for row in rows] == [("run 0", "new"), ("run 7", "theirs")]


def test_a_line_may_hold_the_results_of_a_task(tmp_path: Path) -> None:
    store = Store(tmp_path / "runs.jsonl", replace(LINES, group="made"))
    plan = planned([], together=2)
    with store.opened(plan):
        run_plan(plan, ThisProcess(), store)
    rows = [json.loads(line) for line in (tmp_path / "runs.jsonl").read_text().splitlines()]
    assert [len(row["made"]) for row in rows] == [2, 2, 1]
    assert store.resume(plan).missing == ()


def test_a_store_without_a_file_keeps_nothing() -> None:
    store = Store(None, LINES)
    plan = store.resume(planned([]))
    with store.opened(plan):
        assert len(run_plan(plan, ThisProcess(), store)) == 5
    assert store.entries() == []


def test_what_differs_is_named() -> None:
    assert differing({"a": 1, "b": 2}, {"b": 3, "c": None, "d": 4}) == ["a", "b", "d"]
