"""Ctrl-C: a command ends within a second or two, also while machine code is compiled.

Python answers a signal between two of its own instructions, and an exception that is raised in a callback
of the compiler is swallowed there. So a thread watches too: when Ctrl-C has not been answered after
`GRACE_S`, and the main thread is in a section that may be left at any moment, the process ends there.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

GRACE_S = 0.7
EXIT_INTERRUPTED = 130
_LOOK_S = 0.05

_depth = 0
_last_words: list[Callable[[], str]] = []


def enter() -> None:
    """Begin a section that the process may be ended in, such as compiling: nothing is open or half done."""
    global _depth
    _depth += 1


def leave() -> None:
    """End a section begun by `enter`."""
    global _depth
    _depth -= 1


@contextmanager
def may_be_left() -> Iterator[None]:
    """Mark a section that the process may be ended in: nothing is open, nothing is half written."""
    enter()
    try:
        yield
    finally:
        leave()


@contextmanager
def last_words(say: Callable[[], str]) -> Iterator[None]:
    """Choose what the command says when Ctrl-C ends it, while the context lasts.

    Parameters
    ----------
    say : callable
        Gives a sentence that tells what has been kept, without "interrupted".
    """
    _last_words.append(say)
    try:
        yield
    except KeyboardInterrupt as interrupt:
        if not interrupt.args:
            interrupt.args = (say(),)
        raise
    finally:
        _last_words.remove(say)


def sentence(interrupt: KeyboardInterrupt | None = None) -> str:
    """Say that the command was interrupted, and what has been kept."""
    if interrupt is not None:
        kept = str(interrupt)
    else:
        kept = _last_words[-1]() if _last_words else ""
    return f"interrupted; {kept}" if kept else "interrupted"


@contextmanager
def watching() -> Iterator[None]:
    """End the process when the main thread does not answer Ctrl-C, while the context lasts.

    Only the command line does so: in a library or a notebook the process belongs to somebody else.
    """
    if (
        threading.current_thread() is not threading.main_thread()
        or signal.getsignal(signal.SIGINT) is not signal.default_int_handler
    ):
        yield
        return
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    answered = threading.Event()
    before = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    complain = sys.unraisablehook
    sys.unraisablehook = lambda lost: None if lost.exc_type is KeyboardInterrupt else complain(lost)
    threading.Thread(target=_watch, args=(reader, answered), name="interrupts", daemon=True).start()
    try:
        yield
    finally:
        answered.set()
        sys.unraisablehook = complain
        signal.set_wakeup_fd(before)
        os.close(writer)  # what the thread reads ends with it


def _watch(reader: int, answered: threading.Event) -> None:
    while (signals := os.read(reader, 16)) and signal.SIGINT not in signals:
        pass
    answered.wait(GRACE_S)
    while not answered.wait(_LOOK_S):
        if _depth > 0:
            _end()
    os.close(reader)


def _end() -> None:
    with suppress(Exception):
        sys.stdout.flush()
        print(f"\nbeardyn: {sentence()}", file=sys.stderr, flush=True)
    os._exit(EXIT_INTERRUPTED)
