"""Child processes in groups of their own that never outlive their parent."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType

from beardyn_ros.environment import this_machine_only

CHILD = Path(__file__).with_name("child.py")
FIRST_DOMAIN, LAST_DOMAIN = 20, 99
LAST_PARTICIPANT = 119
_claims: dict[int, socket.socket] = {}


def free_domain_id(taken: Sequence[int] = ()) -> int:
    """Find a ROS domain that no process of this machine uses, and claim it.

    Its first discovery ports are free, and no other process has claimed it: two that begin at once never get
    the same one. The claim lasts until `release_domain_id` or the end of this process.
    """
    span = LAST_DOMAIN - FIRST_DOMAIN + 1
    begin = os.getpid() % span
    for offset in range(span):
        domain = FIRST_DOMAIN + (begin + offset) % span
        if domain not in taken and all(_port_is_free(_port(domain, k)) for k in range(4)) and _claim(domain):
            return domain
    return FIRST_DOMAIN + begin


def release_domain_id(domain: int) -> None:
    """Give a claimed domain back."""
    if claim := _claims.pop(domain, None):
        claim.close()


def _claim(domain: int) -> bool:
    """Hold the discovery port of the last participant of a domain, which no other process can hold then."""
    claim = _held_port(_port(domain, LAST_PARTICIPANT))
    if claim is None:
        return False
    _claims[domain] = claim
    return True


def _port(domain: int, participant: int) -> int:
    return 7400 + 250 * domain + 10 + 2 * participant


def _port_is_free(port: int) -> bool:
    if held := _held_port(port):
        held.close()
    return held is not None


def _held_port(port: int) -> socket.socket | None:
    held = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        held.bind(("0.0.0.0", port))
    except OSError:
        held.close()
        return None
    return held


def local_environment(domain_id: int) -> dict[str, str]:
    """Make the environment of a child that talks to this machine only, in one domain."""
    return {
        **os.environ,
        "ROS_DOMAIN_ID": str(domain_id),
        **this_machine_only(),
        "PYTHONUNBUFFERED": "1",
    }


class Processes:
    """Named child processes; leaving the ``with`` block ends every one of them.

    Parameters
    ----------
    environment : mapping
    log_folder : Path
        Each child's output goes to ``<name>.log`` in it.
    """

    def __init__(self, environment: Mapping[str, str], log_folder: Path) -> None:
        self._environment = dict(environment)
        self._log_folder = log_folder
        self._children: dict[str, subprocess.Popen[bytes]] = {}

    def start(self, name: str, *words: str) -> subprocess.Popen[bytes]:
        """Start ``python <words>`` under a name.

        The child itself asks to end with its parent: code of ours between fork and exec (`preexec_fn`) can
        wait for ever for a lock that one of the middleware's threads held at the fork.
        """
        with self.log_path(name).open("wb") as log, _no_interrupt_while_forking():
            child = subprocess.Popen(
                [sys.executable, "-I", "-S", str(CHILD), str(os.getpid()), *words],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=self._environment,
                start_new_session=True,
            )
        self._children[name] = child
        return child

    def log_path(self, name: str) -> Path:
        """Name the file that a child's output goes to."""
        return self._log_folder / f"{name}.log"

    def log(self, name: str) -> str:
        """Read the output of a child so far."""
        return self.log_path(name).read_text(errors="replace")

    def exit_code(self, name: str) -> int | None:
        """Return the exit code of a child, ``None`` while it runs."""
        return self._children[name].poll()

    def pid(self, name: str) -> int:
        """Return the process id of a child."""
        return self._children[name].pid

    def failed(self) -> list[str]:
        """List the children that have ended with another exit code than 0."""
        return [name for name, child in self._children.items() if child.poll() not in (None, 0)]

    def wait(self, name: str, timeout: float) -> int:
        """Wait until a child has ended and return its exit code."""
        return self._children[name].wait(timeout)

    def signal(self, name: str, number: signal.Signals) -> None:
        """Send a signal to a child's whole group."""
        _signal_group(self._children[name], number)

    def end(self, patience: float = 5.0) -> None:
        """Send SIGINT, then SIGTERM, then SIGKILL to the children that are still there."""
        for number, wait in ((signal.SIGINT, patience), (signal.SIGTERM, 2.0), (signal.SIGKILL, 2.0)):
            running = [child for child in self._children.values() if child.poll() is None]
            for child in running:
                _signal_group(child, number)
            deadline = time.monotonic() + wait
            while any(child.poll() is None for child in running) and time.monotonic() < deadline:
                time.sleep(0.02)

    def __enter__(self) -> Processes:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()


def _signal_group(child: subprocess.Popen[bytes], number: signal.Signals) -> None:
    if child.poll() is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, number)


@contextlib.contextmanager
def _no_interrupt_while_forking() -> Iterator[None]:
    """Hold SIGINT back until a child is kept in the list; the child lets it in again."""
    if not sys.platform.startswith("linux"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
