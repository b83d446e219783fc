"""A node leaves so that those who stay are not stopped by it."""

from __future__ import annotations

import ctypes
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter

# Fast DDS answers a message 5 ms after it has come, from the thread that also announces its own process; that
# thread may have to wait for a processor.
QUIET_S = 0.05
LAST_WORDS_TIMEOUT_S = 0.5


class _Notice(ctypes.Structure):
    """``struct sigevent`` of Linux, 64 bit: call a function with a number, on a thread of its own."""

    _fields_ = (
        ("value", ctypes.c_int64),
        ("signal", ctypes.c_int),
        ("kind", ctypes.c_int),
        ("function", ctypes.c_void_p),
        ("attributes", ctypes.c_void_p),
        ("_rest", ctypes.c_byte * 32),
    )


_ON_A_THREAD = 2  # SIGEV_THREAD


@contextmanager
def ended_after(timeout_s: float, code: int) -> Iterator[None]:
    """End the process with a code when what is inside takes longer (Linux; elsewhere nothing is done).

    For a node that has saved and told everything: what is left is courtesy to the others, and when many leave
    at once it may stop for good, see `leave_quietly`. No thread of Python can help then, because rclpy
    destroys with the interpreter held.

    Parameters
    ----------
    timeout_s : float
        [s].
    code : int
        Exit code.
    """
    if sys.platform != "linux" or ctypes.sizeof(ctypes.c_void_p) != 8:
        yield
        return
    libc, timer = ctypes.CDLL(None), ctypes.c_void_p()
    notice = _Notice(value=code, kind=_ON_A_THREAD, function=ctypes.cast(libc._exit, ctypes.c_void_p))
    failed = libc.timer_create(time.CLOCK_MONOTONIC, ctypes.byref(notice), ctypes.byref(timer))
    if failed:  # no memory for one more timer
        yield
        return
    seconds, rest = divmod(round(timeout_s * 1e9), 10**9)
    once = (ctypes.c_int64 * 4)(0, 0, seconds, rest)  # struct itimerspec: period, first time
    libc.timer_settime(timer, 0, ctypes.byref(once), None)
    try:
        yield
    finally:
        libc.timer_delete(timer)


def leave_quietly(node: Any) -> None:
    """Destroy a node and its members, each step after everybody has answered the one before.

    Parameters
    ----------
    node : rclpy.node.Node
        With or without `members`, nodes of the same process.

    Notes
    -----
    A process that answers a writer while it learns that this writer is gone, and has to announce itself next,
    stops for good: it holds the list of participants and waits for the thread that wants the list (issue 6502
    of Fast DDS, open). So nothing is said any more when publishers go. Every step tells the graph what is
    left, through a writer that goes with the last node: so that is one with nothing else to say.
    ``python -m evidence.ros.leaving`` shows both.
    """
    try:
        last = _nobody(node)
    except Exception:  # the context has gone: there is nobody left to be quiet for
        node.destroy_node()
        return
    deadline = time.monotonic() + LAST_WORDS_TIMEOUT_S
    for each in (*getattr(node, "members", ()), node):
        for publisher in each.publishers:
            publisher.wait_for_all_acked(Duration(seconds=max(deadline - time.monotonic(), 0.0)))
    time.sleep(QUIET_S)
    node.destroy_node()
    time.sleep(QUIET_S)
    last.destroy_node()


def _nobody(node: Any) -> Any:
    """Make a hidden node beside one, which has nothing to say."""
    last = Node(
        f"_{node.get_name()}_leaving",  # hidden from `ros2 node list`
        namespace=node.get_namespace(),
        context=node.context,
        use_global_arguments=False,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter("start_type_description_service", value=False)],
    )
    for publisher in list(last.publishers):
        last.destroy_publisher(publisher)
    return last
