"""Tasks to the workers of a Dask cluster, and what they give back as it comes.

A worker that is killed loses what it was computing; the scheduler gives that to another one. A scheduler that
is killed takes all it knew with it: the engine waits for it to come back, at its address, and gives it what
is not done. What has come back is never asked for again.
"""

from __future__ import annotations

import logging
import queue
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Annotated as A
from typing import Any, Generic, TypeVar

from beardyn_core.base.optional import library
from beardyn_core.experiments.cluster import Cluster, LocalCluster, wait_until

Task = TypeVar("Task")
# tasks that wait at the scheduler for each worker: enough that none is idle, few enough to be forgotten soon
_AHEAD = 3
_LOOK_S = 0.5
_FETCHED_S = 30.0  # a result that has not come by then was with a worker that has died


class EngineError(Exception):
    """The workers cannot be reached; the sentence says what to do."""


@dataclass(frozen=True)
class Ended(Generic[Task]):
    """What became of a task."""

    task: Task
    value: A[Any, "what the function gave"] = None
    killed: A[int, "workers that died while they computed it, one after the other; it is given up then"] = 0


class Engine:
    """Runs functions on the workers of a cluster, from the ``with`` statement to its end.

    Parameters
    ----------
    cluster : Cluster
    say : callable, optional
        Gets sentences about workers and schedulers that come and go.
    """

    def __init__(self, cluster: Cluster, say: Callable[[str], None] | None = None) -> None:
        self.cluster = cluster
        self._say = say or (lambda _: None)
        self._local: LocalCluster | None = None
        self._client: Any = None
        self._done: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def __enter__(self) -> Engine:
        """Start the workers, or connect to the cluster."""
        self._quiet()
        try:
            self._connect()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let go of the cluster; workers of this machine end at once."""
        self.close()

    @property
    def dashboard(self) -> str:
        """Address of Dask's dashboard; empty where there is none."""
        if self._local is not None:
            return self._local.dashboard
        try:
            return str(self._client.dashboard_link or "")
        except Exception:  # an address that cannot be made is no reason to fail
            return ""

    @property
    def local(self) -> LocalCluster | None:
        """Processes of this machine; ``None`` on another cluster."""
        return self._local

    def worker_count(self) -> int:
        """Count the threads of all workers that are there."""
        try:
            return sum(self._client.nthreads().values())
        except Exception:
            return 0

    def close(self) -> None:
        """Let go of the cluster."""
        client, self._client = self._client, None
        local, self._local = self._local, None
        if local is not None:
            local.close()
        if client is not None:
            with suppress(Exception):
                client.close(timeout=0.1 if local is not None else 2.0)

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task], *arguments: Any
    ) -> Iterator[Ended[Task]]:
        """Call ``function(task, *arguments)`` for every task; give the results in the order they come.

        Parameters
        ----------
        function : callable
            Of a module that the workers can import. What it raises is raised here.
        tasks : iterable
            Taken as workers get free.

        Raises
        ------
        EngineError
            The scheduler has gone and did not come back.
        """
        waiting, todo = iter(tasks), list[Task]()
        running: dict[Any, Task] = {}
        over = False
        try:
            while True:
                while not over and len(todo) < self._wanted_workers(len(running)):
                    try:
                        todo.append(next(waiting))
                    except StopIteration:
                        over = True
                if not running and not todo and over:
                    return
                try:
                    while todo:
                        future = self._client.submit(function, todo[0], *arguments, pure=False, retries=0)
                        running[future] = todo.pop(0)
                        future.add_done_callback(self._done.put)
                    for future in self._wait_for_finished(running):
                        task = running[future]
                        ended = self._fetch_result(future, task)
                        del running[future]
                        if ended is None:
                            future.cancel()
                            todo.insert(0, task)
                            continue
                        future.release()
                        yield ended
                except _LostError:
                    todo, running = [*running.values(), *todo], {}
                    self._reconnect()
        finally:
            for future in running:
                with suppress(Exception):
                    future.cancel()

    def _wanted_workers(self, running: int) -> int:
        return max(_AHEAD * max(self.worker_count(), 1) - running, 0)

    def _wait_for_finished(self, running: dict[Any, Any]) -> list[Any]:
        """Wait until some are finished, a worker has come, or the scheduler has gone."""
        if not self._reachable():
            raise _LostError
        done = []
        with suppress(queue.Empty):
            done.append(self._done.get(timeout=_LOOK_S))
            while True:
                done.append(self._done.get_nowait())
        done = [future for future in done if future in running]
        if not self._reachable() or any(future.status in ("cancelled", "lost") for future in done):
            raise _LostError
        return done

    def _reachable(self) -> bool:
        return self._client.status == "running" and (self._local is None or self._local.alive)

    def _fetch_result(self, future: Any, task: Task) -> Ended[Task] | None:
        """Fetch what a task gave; ``None`` where its worker has died with it, and it must be done again."""
        from distributed import CancelledError, KilledWorker
        from distributed.comm import CommClosedError

        try:
            return Ended(task, future.result(timeout=_FETCHED_S))
        except KilledWorker as error:
            self._say(f"a task has been given up: {len(_workers_of(error))} workers died of it")
            return Ended(task, killed=len(_workers_of(error)))
        except (CancelledError, CommClosedError) as error:
            raise _LostError from error
        except (TimeoutError, OSError) as error:
            if not self._reachable():
                raise _LostError from error
            if not isinstance(error, TimeoutError) or future.status == "error":  # of the task itself
                raise
            return None

    def _reconnect(self) -> None:
        client, self._client = self._client, None
        with suppress(Exception):
            client.close(timeout=0.5)
        if self._local is not None:
            self._say("the scheduler has died; it is started anew, and what is not done is done again")
            self._local.close()
            self._local = None
        else:
            self._say(
                f"the scheduler at {self.cluster.scheduler} has gone; waiting for it to come back, "
                f"{self.cluster.patience:g} s at most"
            )
        self._connect()

    def _connect(self) -> None:
        library("distributed", "many runs at once", "sweep")
        from distributed import Client

        cluster = self.cluster
        if not cluster.scheduler:
            self._local = LocalCluster(cluster.worker_count, cluster.memory)
        address = cluster.scheduler if self._local is None else self._local.address
        end = time.monotonic() + cluster.patience
        while True:
            try:
                self._client = Client(
                    address, security=cluster.security(), timeout=5, set_as_default=False, name="beardyn"
                )
                break
            except (OSError, TimeoutError) as error:
                if time.monotonic() > end:
                    raise EngineError(
                        f"--scheduler {address}: cannot be reached ({error}); start one with "
                        "`dask scheduler`, and workers with `dask worker`"
                    ) from error
                time.sleep(1.0)
        if not wait_until(self.worker_count, cluster.patience):
            raise EngineError(
                f"--scheduler {address}: has no worker; start some with `dask worker {address} --nthreads 1`"
            )

    def _quiet(self) -> None:
        """Keep what Dask logs about comers and goers from the user, who gets a sentence."""
        library("distributed", "many runs at once", "sweep")  # it sets its levels when it is imported
        names = ("distributed", "distributed.client", "distributed.core", "distributed.comm")
        for name in (*names, "tornado", "tornado.application"):
            logging.getLogger(name).setLevel(logging.CRITICAL)


class ThisProcess:
    """Runs functions here, one after the other, as an `Engine` does on its workers."""

    dashboard = ""

    def worker_count(self) -> int:
        """Count this process."""
        return 1

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task], *arguments: Any
    ) -> Iterator[Ended[Task]]:
        """Call ``function(task, *arguments)`` for every task, in their order."""
        for task in tasks:
            yield Ended(task, function(task, *arguments))


class _LostError(Exception):
    """The scheduler has gone."""


def _workers_of(error: Any) -> tuple[Any, ...]:
    attempts = getattr(error, "allowed_failures", 3)
    return (None,) * (int(attempts) + 1)
