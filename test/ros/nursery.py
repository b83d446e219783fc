"""Node processes that begin ready: forked off a process that has imported what they need and begun nothing.

A node that starts by itself imports Python modules and loads libraries for most of a second of a core, and
the tests start some two hundred. What ROS does at a start, from `rclpy.init` on, each process still does by
itself, and tests of starting and ending (and `evidence`) start new ones. Run as a module it is that process::

    python -m test.ros.nursery FILE_DESCRIPTOR

Over the socket come objects with module, words, environment and log; one process is forked for each, and its
id and in the end its exit code are sent back.
"""

from __future__ import annotations

import atexit
import ctypes
import gc
import inspect
import json
import os
import selectors
import signal
import socket
import subprocess
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from beardyn_ros.processes import CHILD

MODULES = {"test.ros.fake_twin": "test.ros.fake_twin", "beardyn_ros": "beardyn_ros.__main__"}
"""Modules that can be run with ``-m``, and where each has its ``main``."""

# What a process reads when it begins, before any code of ours: such an environment needs a start of its own.
AT_START = ("PYTHON", "LD_", "PATH", "VIRTUAL_ENV", "OPENBLAS", "OMP_", "NUMBA", "BEARDYN")
_LARGEST = 1 << 18
_PR_SET_PDEATHSIG = 1


class Nursery:
    """The process with everything imported, seen from the test.

    Parameters
    ----------
    folder : Path
        Its own output goes to ``nursery.log`` in it.
    """

    def __init__(self, folder: Path) -> None:
        self._socket, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _LARGEST)
        self._born_in = _at_start(os.environ)
        self._codes: dict[int, int] = {}
        words = [str(CHILD), str(os.getpid()), "-m", "test.ros.nursery", str(other.fileno())]
        self._log = folder / "nursery.log"
        with self._log.open("wb") as log, other:
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", *words],
                pass_fds=(other.fileno(),),
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
                start_new_session=True,
            )

    def can_start(self, module: str, environment: Mapping[str, str]) -> bool:
        """Whether a process of this module and environment would be the same when it is forked."""
        return module in MODULES and _at_start(environment) == self._born_in

    def start(self, module: str, words: tuple[str, ...], environment: Mapping[str, str], log: Path) -> Forked:
        """Begin ``python -m module words``."""
        log.write_bytes(b"")
        asked = {"module": module, "words": words, "environment": dict(environment), "log": str(log)}
        self._socket.send(json.dumps(asked).encode())
        while "began" not in (told := self._take()):
            pass
        return Forked(self, told["began"])

    def _take(self) -> dict[str, int]:
        received = self._socket.recv(_LARGEST)
        assert received, f"the process that begins nodes has ended: {self._log.read_text()}"
        told: dict[str, int] = json.loads(received)
        if "ended" in told:
            self._codes[told["ended"]] = told["code"]
        return told

    def exit_code(self, pid: int, timeout: float | None) -> int | None:
        """Exit code of a process that was begun here; ``None`` when it has not ended within a time."""
        while pid not in self._codes:
            with selectors.DefaultSelector() as selector:
                selector.register(self._socket, selectors.EVENT_READ)
                if not selector.select(timeout):
                    return None
            self._take()
        return self._codes[pid]

    def end(self) -> None:
        """End the process."""
        self._socket.close()
        self._process.wait()


@dataclass
class Forked:
    """A process that was forked, with the part of `subprocess.Popen` that `Processes` uses."""

    nursery: Nursery
    pid: int

    def poll(self) -> int | None:
        return self.nursery.exit_code(self.pid, 0.0)

    def wait(self, timeout: float | None = None) -> int:
        code = self.nursery.exit_code(self.pid, timeout)
        if code is None:
            raise subprocess.TimeoutExpired(str(self.pid), timeout or 0.0)
        return code


def _at_start(environment: Mapping[str, str]) -> dict[str, str]:
    return {
        name: value
        for name, value in environment.items()
        if name.startswith(AT_START) and name != "PYTHONUNBUFFERED"
    }


# --- inside of the process -----------------------------------------------------------------------------


def _prepare() -> None:
    """Import and load what nodes need, up to where they differ; no context, no thread of the middleware."""
    from rclpy.type_support import check_for_type_support

    from beardyn_core.record.messages import Diagnostic, decode_diagnostics, encode_diagnostics
    from beardyn_core.record.topics import TOPICS
    from beardyn_ros.wire import message_class

    for name in ("twin_node", "load_node", "recorder_node", "monitor_node"):
        import_module(f"beardyn_ros.{name}")
    for module in MODULES.values():
        import_module(module)
    for kind in {message_class(topic.type) for topic in TOPICS}:
        check_for_type_support(kind)
    decode_diagnostics(encode_diagnostics(0, "", [Diagnostic("", 0, "", (("", ""),))]))
    frame = inspect.currentframe()
    assert frame is not None
    inspect.getframeinfo(frame)  # the logger of rclpy asks it who speaks; it lists all modules the first time
    gc.freeze()


def serve(control: socket.socket) -> Callable[[], int] | None:
    """For each request fork a process: gives its program in the new one, ``None`` in the old one."""
    running: dict[int, int] = {}  # process ids by the descriptors that tell their ends
    with selectors.DefaultSelector() as selector:
        selector.register(control, selectors.EVENT_READ)
        while True:
            for key, _ in selector.select():
                if key.fileobj is not control:
                    pid = running.pop(key.fd)
                    selector.unregister(key.fd)
                    os.close(key.fd)
                    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
                    control.send(json.dumps({"ended": pid, "code": code}).encode())
                    continue
                request = control.recv(_LARGEST)
                if not request:
                    return None
                asked = json.loads(request)
                parent = os.getpid()
                if (pid := os.fork()) == 0:
                    control.close()
                    for descriptor in running:
                        os.close(descriptor)
                    return _become(asked, parent)
                descriptor = os.pidfd_open(pid)
                running[descriptor] = pid
                selector.register(descriptor, selectors.EVENT_READ)
                control.send(json.dumps({"began": pid}).encode())


def _become(asked: dict[str, Any], parent: int) -> Callable[[], int]:
    """Be a process as `Processes.start` begins it, in a session of its own that ends with the parent."""
    os.setsid()
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, int(signal.SIGTERM))
    if os.getppid() != parent:
        os._exit(0)
    log = os.open(asked["log"], os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(log, stream)
    os.close(log)
    os.environ.clear()
    os.environ.update(asked["environment"])
    module = import_module(MODULES[asked["module"]])
    sys.argv = [str(module.__file__), *asked["words"]]
    return lambda: int(module.main(asked["words"]))


def main(words: list[str]) -> None:
    """Serve until the test has closed the socket; in a new process, run its program."""
    _prepare()
    program = serve(socket.socket(fileno=int(words[0])))
    if program is None:
        return
    code = 1
    try:
        code = program()
    except BaseException:
        traceback.print_exc()
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # the tracing library of ROS would stop threads at exit that were not forked with it


if __name__ == "__main__":
    main(sys.argv[1:])
