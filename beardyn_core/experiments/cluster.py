"""Where the work is done: processes of this machine, or a Dask cluster at an address."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.optional import missing

MOST_WORKERS = 1024
_SCHEMES = ("tcp", "tls", "ws", "wss", "ucx")


def core_count() -> int:
    """Count the cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True)
class Tls:
    """Files that a cluster with TLS is reached with, as Dask names them."""

    ca: A[Path | None, "certificate of the authority that has signed the others, PEM"] = None
    cert: A[Path | None, "certificate of this client, PEM"] = None
    key: A[Path | None, "its private key, PEM"] = None

    @property
    def given(self) -> dict[str, Path]:
        """Files that are given, by their names."""
        return {name: path for name, path in vars(self).items() if path is not None}


@dataclass(frozen=True)
class Cluster:
    """Processes of this machine, or a cluster at an address."""

    workers: A[int | None, "processes of this machine; ``None``: one for each core"] = None
    scheduler: A[str, "address of a scheduler, ``tcp://host:8786``; empty: processes of this machine"] = ""
    tls: A[Tls, "how that is reached safely"] = field(default_factory=Tls)
    memory: A[float | None, "of a worker, above which it is started anew; ``None``: its share, [byte]"] = None
    patience: A[float, "how long a scheduler that has gone is waited for, [s]"] = 120.0

    def problems(self) -> list[str]:
        """List what is wrong with it, in the words of the command line."""
        found = missing("distributed", "many runs at once", "sweep") + self.worker_problems()
        if self.memory is not None and not self.memory >= 2.5e8:
            found.append(f"--memory {self.memory / 1e9:g}: a worker needs at least 0.25 GB, and usually 1")
        scheme, colon, rest = self.scheduler.partition("://")
        if self.scheduler and (not colon or scheme not in _SCHEMES or not rest):
            found.append(
                f"--scheduler {self.scheduler}: it must be an address such as tcp://host:8786 (also "
                f"{', '.join(f'{each}://' for each in _SCHEMES[1:])})"
            )
        if self.scheduler and self.workers is not None:
            found.append("--workers: goes with processes of this machine; a scheduler has its own workers")
        if self.scheduler and self.memory is not None:
            found.append(
                "--memory: goes with processes of this machine; `dask worker --memory-limit` sets it"
            )
        given = self.tls.given
        for name, path in given.items():
            if not path.is_file():
                found.append(f"--tls-{name} {path}: the file does not exist")
        if given and not self.scheduler.startswith(("tls://", "wss://")):
            found.append("--tls-ca, --tls-cert, --tls-key: go with --scheduler tls://host:port")
        if bool(self.tls.cert) != bool(self.tls.key):
            found.append("--tls-cert and --tls-key: go together")
        return found

    def worker_problems(self) -> list[str]:
        """List what is wrong with the number of processes, which needs no Dask."""
        if self.workers is None or 1 <= self.workers <= MOST_WORKERS:
            return []
        return [f"--workers {self.workers}: allowed is 1 to {MOST_WORKERS}"]

    @property
    def worker_count(self) -> int:
        """Processes of this machine."""
        return core_count() if self.workers is None else self.workers

    def security(self) -> Any:
        """Make what Dask calls security; ``None`` without TLS."""
        if not self.tls.given:
            return None
        from distributed.security import Security

        return Security(
            require_encryption=True,
            tls_ca_file=None if self.tls.ca is None else str(self.tls.ca),
            tls_client_cert=None if self.tls.cert is None else str(self.tls.cert),
            tls_client_key=None if self.tls.key is None else str(self.tls.key),
        )


class LocalCluster:
    """A process of this machine with a scheduler, and its workers, each a process with one thread.

    It is none of this program's children by ``multiprocessing``, so that scripts and notebooks need no main
    guard. It ends with this process, however that ends, for its standard input does.

    Attributes
    ----------
    address, dashboard : str
        The second is empty where there is no dashboard.
    """

    def __init__(self, workers: int, memory: float | None) -> None:
        settings = {"workers": workers, "memory": memory}
        command = [sys.executable, "-m", "beardyn_core.experiments.local", json.dumps(settings)]
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 (its processes write there to their end)
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            env=_environment(),
            start_new_session=True,
        )
        assert self._process.stdout is not None
        try:
            line = self._process.stdout.readline()
        except BaseException:  # Ctrl-C
            self.close()
            raise
        if not line:
            self._log.seek(0)
            last = self._log.read().decode(errors="replace").strip().rpartition("\n")[2]
            raise OSError(f"the process of the workers ended before it was ready: {last}")
        told = json.loads(line)
        self.address, self.dashboard = str(told["address"]), str(told["dashboard"])

    @property
    def process_id(self) -> int:
        """Of the process that holds the scheduler."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process of the scheduler is there."""
        return self._process.poll() is None

    def close(self) -> None:
        """End all its processes at once: what they have given back is here, the rest is not wanted."""
        with suppress(ProcessLookupError, PermissionError):
            if hasattr(os, "killpg"):
                os.killpg(self._process.pid, signal.SIGKILL)
            else:  # Windows: workers end when their scheduler is gone
                self._process.kill()
        for pipe in (self._process.stdin, self._process.stdout, self._log):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(10.0)


def _environment() -> Mapping[str, str]:
    """Give the workers the modules that this process finds."""
    paths = [os.path.abspath(path) for path in sys.path]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(dict.fromkeys(paths))}


def wait_until(is_so: Any, seconds: float, step: float = 0.2) -> bool:
    """Wait until something is so, at most so long; tell whether it is."""
    end = time.monotonic() + seconds
    while not is_so():
        if time.monotonic() > end:
            return False
        time.sleep(step)
    return True
