"""What the engine promises: everything comes back, whoever dies."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import psutil
import pytest

from beardyn_core.experiments import Cluster, Engine, EngineError, Tls
from beardyn_core.experiments.loop import all_of
from test.experiments.work import fatal, held_for, hungry, slow, squared, wrong

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def engine() -> Iterator[Engine]:
    """Two processes that the tests of this file share."""
    with Engine(Cluster(workers=2)) as started:
        yield started


def test_every_task_comes_back_once_from_both_workers(engine: Engine) -> None:
    ended = list(engine.run(slow, range(8), 0.1))
    assert sorted(each.value[0] for each in ended) == list(range(8))
    assert all(each.task == each.value[0] for each in ended)
    assert len({each.value[1] for each in ended}) == 2
    assert engine.worker_count() == 2
    assert engine.dashboard.startswith("http://127.0.0.1:")


def test_tasks_are_taken_as_workers_get_free(engine: Engine) -> None:
    taken: list[int] = []

    def tasks() -> Iterator[int]:
        for number in range(1000):
            taken.append(number)
            yield number

    run = engine.run(squared, tasks())
    next(run)
    assert len(taken) <= 12
    run.close()  # type: ignore[attr-defined]


def test_what_a_task_raises_is_raised_here(engine: Engine) -> None:
    with pytest.raises(ValueError, match="3 is wrong"):
        list(engine.run(wrong, [3]))
    assert [each.value[0] for each in engine.run(squared, [4])] == [16]


def test_what_a_killed_worker_computed_is_computed_again(engine: Engine, tmp_path: Path) -> None:
    ended = list(engine.run(fatal, range(6), str(tmp_path / "once")))
    assert sorted(each.value for each in ended) == list(range(6))
    assert not any(each.killed for each in ended)


def test_a_task_that_kills_every_worker_is_given_up_and_the_others_come_back() -> None:
    with Engine(Cluster(workers=2)) as engine:
        ended = list(engine.run(fatal, range(4), ""))
    assert sorted(each.value for each in ended if not each.killed) == [1, 2, 3]
    (given_up,) = (each for each in ended if each.killed)
    assert given_up.task == 0
    assert given_up.killed == 4


@pytest.mark.slow
def test_a_task_that_takes_too_much_memory_is_stopped_at_the_limit_and_the_others_come_back() -> None:
    """It asks for ten times the limit: no process may get more than half as much again as is allowed."""
    limit, most = 4e8, 0
    stop = threading.Event()
    with Engine(Cluster(workers=1, memory=limit)) as engine:
        assert engine.local is not None
        host = psutil.Process(engine.local.process_id)

        def watch() -> None:
            nonlocal most
            while not stop.wait(0.02):
                for each in host.children(recursive=True):
                    with suppress(psutil.Error):
                        most = max(most, each.memory_info().rss)

        watching = threading.Thread(target=watch, daemon=True)
        watching.start()
        ended = list(engine.run(hungry, range(4), 4000))
        stop.set()
        watching.join()
    assert sorted(each.value for each in ended if not each.killed) == [1, 2, 3]
    (given_up,) = (each for each in ended if each.killed)
    assert given_up.task == 0
    assert 0.8 * limit < most < 1.5 * limit


@pytest.mark.slow
def test_a_worker_that_holds_nearly_all_it_may_goes_on_working() -> None:
    """Dask would let it pause for ever above four fifths of its limit."""
    with Engine(Cluster(workers=1)) as engine:
        assert engine.local is not None
        children = psutil.Process(engine.local.process_id).children(recursive=True)
        usual = max(each.memory_info().rss for each in children)
    limit, ended = max(usual / 0.7, 2.5e8), list[Any]()
    with Engine(Cluster(workers=1, memory=limit)) as engine:
        run = threading.Thread(
            target=lambda: ended.extend(engine.run(held_for, range(4), 0.87 * limit)), daemon=True
        )
        run.start()
        run.join(60.0)
    assert [each.killed for each in ended] == [0] * 4


def test_tasks_of_a_study_come_back_in_order() -> None:
    assert [value for value, _ in all_of(squared, [3, 1, 2])] == [9, 1, 4]


@pytest.mark.slow
def test_a_killed_scheduler_is_replaced_and_nothing_that_came_back_is_asked_for_again() -> None:
    said: list[str] = []
    with Engine(Cluster(workers=2), said.append) as engine:
        seen: list[int] = []
        for ended in engine.run(slow, range(8), 0.2):
            seen.append(ended.value[0])
            if len(seen) == 3:
                assert engine.local is not None
                os.kill(engine.local.process_id, signal.SIGKILL)
        assert sorted(seen) == list(range(8))
    assert "the scheduler has died" in said[0]


def test_nothing_is_left_behind(tmp_path: Path) -> None:
    with Engine(Cluster(workers=1)) as engine:
        assert engine.local is not None
        host = psutil.Process(engine.local.process_id)
        processes = [host, *host.children(recursive=True)]
        list(engine.run(squared, [2]))
    _, alive = psutil.wait_procs(processes, timeout=10.0)
    assert not alive


def test_a_script_without_a_main_guard_may_use_it(tmp_path: Path) -> None:
    """Processes of ``multiprocessing`` would run the script again in each of them."""
    (tmp_path / "script.py").write_text(
        "from beardyn_core.experiments import Cluster, Engine\n"
        "from test.experiments.work import squared\n"
        "with Engine(Cluster(workers=1)) as engine:\n"
        "    print([each.value[0] for each in engine.run(squared, [5])])\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "script.py"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == "[25]\n"


def test_nobody_at_the_address_is_a_sentence() -> None:
    began = time.monotonic()
    with (
        pytest.raises(EngineError, match="cannot be reached"),
        Engine(Cluster(scheduler="tcp://127.0.0.1:9", patience=1.0)),
    ):
        pass
    assert time.monotonic() - began < 60.0


def test_every_mistake_about_where_to_work_is_told(tmp_path: Path) -> None:
    tls = Tls(ca=tmp_path / "no.pem", cert=tmp_path / "none.pem")
    problems = Cluster(0, "localhost:8786", tls, 1e6).problems()
    told = "\n".join(problems)
    for mistake in (
        "--workers 0",
        "--memory 0.001",
        "it must be an address",
        "has its own",
        "no.pem",
        "go tog",
    ):
        assert mistake in told
    assert not Cluster(2).problems()
    assert not Cluster(scheduler="tcp://host:8786").problems()
