"""Ctrl-C: a command ends within a second or two, also while machine code is compiled.

An exception that is raised inside of the compiler, in a callback from C, is swallowed there or worse. So
Ctrl-C waits until the compiler has returned; and because that may take half a minute, a thread of the
command line watches too and ends the process when nothing is open that would be lost. Raised inside of the
writer of a file it would leave half a record, so there it waits as well.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

GRACE_S = 0.7
EXIT_INTERRUPTED = 130
_LOOK_S = 0.05

_sealed = 0  # depth of sections of the main thread that an exception must not be raised in
_whole = 0  # depth of those that Ctrl-C waits for the end of, however long
_leavable = 0  # depth of those that the process may be ended in
_pending = False  # whether Ctrl-C waits for the end of a sealed section
_last_words: list[Callable[[], str]] = []


def seal() -> None:
    """Begin a section that Ctrl-C waits for the end of, such as the compiler; other threads have none."""
    global _sealed
    if threading.current_thread() is threading.main_thread():
        _sealed += 1


def unseal() -> None:
    """End a section begun by `seal`; raises `KeyboardInterrupt` when Ctrl-C came meanwhile."""
    global _sealed
    if threading.current_thread() is threading.main_thread():
        _sealed -= 1
        _raise_pending()


@contextmanager
def hold_interrupts() -> Iterator[None]:
    """Hold Ctrl-C back while compiled code is called: what it has begun is done, or the process ends.

    Between a call from C into Python and its return nobody expects an exception: numba's dispatcher crashes
    when one comes while it loads a kernel.
    """
    seal()
    try:
        yield
    finally:
        unseal()


@contextmanager
def whole() -> Iterator[None]:
    """Hold Ctrl-C back until what has been begun is done, such as a record of a file."""
    global _whole
    here = threading.current_thread() is threading.main_thread()
    _whole += here
    try:
        yield
    finally:
        _whole -= here
        if here:
            _raise_pending()


def _raise_pending() -> None:
    global _pending
    if _pending and not _sealed and not _whole:
        _pending = False
        raise KeyboardInterrupt


def _answer(number: int, frame: FrameType | None) -> None:
    global _pending
    _pending = True
    _raise_pending()


def _answers() -> bool:
    """Tell whether Ctrl-C comes to this thread and nobody else handles it."""
    here = threading.current_thread() is threading.main_thread()
    return here and signal.getsignal(signal.SIGINT) is signal.default_int_handler


@contextmanager
def may_be_left() -> Iterator[None]:
    """Mark a section that the process may be ended in: nothing is open, nothing is half written."""
    global _leavable
    _leavable += 1
    try:
        yield
    finally:
        _leavable -= 1


@contextmanager
def held_back() -> Iterator[None]:
    """Answer Ctrl-C only outside of sealed sections, while the context lasts."""
    global _pending
    if not _answers():
        yield
        return
    _pending = False
    signal.signal(signal.SIGINT, _answer)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    _raise_pending()


@contextmanager
def last_words(say: Callable[[], str]) -> Iterator[None]:
    """Choose what the command says when Ctrl-C ends it, while the context lasts.

    Parameters
    ----------
    say : callable
        Gives a sentence about what has been kept, without "interrupted".
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
    if not _answers():
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
        with held_back():
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
        if not _whole and (_sealed or _leavable):
            _end()
    os.close(reader)


def _end() -> None:
    with suppress(Exception):
        sys.stdout.flush()
        print(f"\nbeardyn: {sentence()}", file=sys.stderr, flush=True)
    os._exit(EXIT_INTERRUPTED)
