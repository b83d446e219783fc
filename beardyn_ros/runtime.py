"""One process, one node: arguments, signals, executor, exit code, and an end that stops nobody else.

rclpy is imported inside the functions: a process without ROS 2 says so in a sentence.
"""

from __future__ import annotations

import ctypes
import gc
import logging
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from threading import Event
from types import FrameType
from typing import Any, Protocol

from beardyn_core.base.errors import InputError
from beardyn_ros.environment import MISSING_ROS, prepare_environment, ros_available

EXIT_DONE = 0
EXIT_BAD_INPUT = 2
EXIT_INVALID_MODEL = 3
EXIT_LOAD_LOST = 4
EXIT_INCOMPLETE = 5
EXIT_CODES = {
    EXIT_DONE: "done, or stopped by SIGINT or SIGTERM",
    1: "demo only: a node has ended early or has fallen silent",
    EXIT_BAD_INPUT: "bad input: an argument, a parameter, a scene or another file; two twins of one name",
    EXIT_INVALID_MODEL: "the model has left its validity, or the twin has failed",
    EXIT_LOAD_LOST: "the load never came, stopped coming or overflowed; load and recorder: there is no twin",
    EXIT_INCOMPLETE: "recorder: messages that the twin has published are not in the file",
    130: "demo only: interrupted by Ctrl+C",
}

SPIN_SLICE_S = 0.1
RETURN_PERIOD_S = 30.0
LEAVING_TIMEOUT_S = 3.0
# Fast DDS answers a message 5 ms after it has come, from the thread that also announces its own process; that
# thread may have to wait for a processor.
QUIET_S = 0.05
LAST_WORDS_TIMEOUT_S = 0.5
_ON_A_THREAD = 2  # SIGEV_THREAD


class RunnableNode(Protocol):
    """What a node shows to its process."""

    @property
    def finished(self) -> bool:
        """Whether there is nothing left to do."""

    @property
    def exit_code(self) -> int:
        """Exit code of the process."""

    def close(self) -> object:
        """End threads, publish last words, close files; called once, ROS still alive."""


def run_node(make_node: Callable[[], RunnableNode], argv: Sequence[str]) -> int:
    """Run one node until it is finished or the process is asked to stop.

    Parameters
    ----------
    make_node : callable
        Builds the node after ROS is initialised; gives a `RunnableNode`.
    argv : sequence of str
        Arguments after the node's name (``--ros-args ...``).

    Returns
    -------
    int
        One of `EXIT_CODES`.
    """
    prepare_environment()
    if not ros_available():
        print(MISSING_ROS, file=sys.stderr)
        return EXIT_BAD_INPUT
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.impl.implementation_singleton import rclpy_implementation
    from rclpy.signals import SignalHandlerOptions

    logging.basicConfig(format="%(message)s", level=logging.INFO, stream=sys.stderr)
    stop = Event()
    previous = {number: signal.signal(number, _stopper(stop)) for number in (signal.SIGINT, signal.SIGTERM)}
    node: Any = None
    code = 1  # until something is known: that of an exception which nobody expects
    problems: list[str] = []
    try:
        stray = stray_arguments(argv)
        if stray:
            raise InputError(
                f"unknown argument(s) {' '.join(stray)}: parameters go behind --ros-args, "
                "for example `--ros-args -p speed_factor:=1.0`"
            )
        try:
            rclpy.init(args=["beardyn", *argv], signal_handler_options=SignalHandlerOptions.NO)
        except Exception as error:  # rclpy has several, all about unreadable arguments
            raise InputError(f"the ROS arguments cannot be read: {error}") from error
        try:
            node = make_node()
        except rclpy_implementation.RCLError as error:  # such as an enclave without keys
            raise InputError(f"the node cannot be made: {' '.join(str(error).split())}") from error
        gc.collect()
        gc.freeze()  # what is imported stays: the collector need not look through it again and again
        executor = SingleThreadedExecutor()
        for each in (node, *getattr(node, "members", ())):
            executor.add_node(each)
        returned_at = time.monotonic()
        while not (stop.is_set() or node.finished):
            executor.spin_once(timeout_sec=SPIN_SLICE_S)
            if time.monotonic() > returned_at + RETURN_PERIOD_S:
                returned_at = time.monotonic()
                return_free_memory()
        code = EXIT_DONE if stop.is_set() and not node.finished else node.exit_code
    except InputError as error:
        problems = error.problems
    finally:
        alive = False
        if node is not None:
            try:
                alive = bool(node.close())
            except InputError as error:  # such as a disk that refuses the rest, too
                problems += [each for each in error.problems if each not in problems]
        for sentence in problems:
            print(f"beardyn: {sentence}", file=sys.stderr)
            code = EXIT_BAD_INPUT
        with ended_after(LEAVING_TIMEOUT_S, code):
            if node is not None:
                leave_quietly(node)
            rclpy.try_shutdown()
        for number, handler in previous.items():
            signal.signal(number, handler)
    if alive:
        # A thread is inside the compiler, which cannot be interrupted; nothing is left to save.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    return code


def return_free_memory() -> None:
    """Give the system back what the process has freed (glibc; elsewhere nothing is done).

    Arrays that follow the speed of the shaft have another length each time. The holes that they leave between
    others are hardly used again, and the heap of a monitor would grow by 50 MB and more an hour.
    """
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).malloc_trim(0)


def wall_timer(node: Any, period: float, callback: Callable[[], None]) -> Any:
    """Create a timer of the wall clock, which also ticks while simulated time stands still.

    Parameters
    ----------
    node : rclpy.node.Node
        With `use_sim_time` its own timers would wait for ``/clock``.
    period : float
        [s].
    callback : callable
    """
    from rclpy.clock import Clock
    from rclpy.clock_type import ClockType

    return node.create_timer(period, callback, clock=Clock(clock_type=ClockType.STEADY_TIME))


def leave(code: int) -> None:
    """End the process with a code; a signal that comes while the interpreter ends no longer changes it."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    sys.exit(code)


def stray_arguments(argv: Sequence[str]) -> list[str]:
    """List the arguments outside of ``--ros-args ... --``, which no node understands."""
    stray, inside = [], False
    for word in argv:
        if word == "--ros-args":
            inside = True
        elif word == "--":
            inside = False
        elif not inside:
            stray.append(word)
    return stray


def _stopper(stop: Event) -> Callable[[int, FrameType | None], None]:
    def handle(_number: int, _frame: FrameType | None) -> None:
        stop.set()

    return handle


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


@contextmanager
def ended_after(timeout_s: float, code: int) -> Iterator[None]:
    """End the process with a code when what is inside takes longer (Linux; elsewhere nothing is done).

    For a node that has reported everything: what is left is courtesy to the others, and when many leave
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
    of Fast DDS, open). So nothing is said any more when publishers go. Every step informs the graph what is
    left, through a writer that goes with the last node: so that is one with nothing else to say.
    ``python -m evidence.ros.leaving`` shows both.
    """
    from rclpy.duration import Duration

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
    """Make a hidden node next to one, which has nothing to say."""
    from rclpy.node import Node
    from rclpy.parameter import Parameter

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
