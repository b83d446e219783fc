"""A function that is waited for, but not for ever."""

from __future__ import annotations

import ctypes
import sys
import threading
import traceback
from collections.abc import Callable
from typing import TypeVar

Answer = TypeVar("Answer")
WAITED_FOR = "beardyn waits for it"  # name of the thread


class NoAnswerError(Exception):
    """A function has not come back in time; `frames` are those it was in, the innermost last."""

    def __init__(self, frames: traceback.StackSummary) -> None:
        super().__init__()
        self.frames = frames


class _GivenUp(BaseException):
    """Raised in a thread that nobody waits for any more."""


def within(limit_s: float, function: Callable[[], Answer]) -> Answer:
    """Call a function and give back what it does, or raise what it raises.

    Parameters
    ----------
    limit_s : float
        How long it is waited for, wall time [s].
    function : callable
        It runs on a thread of its own. One that takes longer is ended at its next line of Python; one that
        waits outside of Python keeps its thread until the process ends, which does not wait for it.

    Raises
    ------
    NoAnswerError
        It has taken longer.
    """
    answers: list[Answer] = []
    errors: list[BaseException] = []

    def call() -> None:
        try:
            answers.append(function())
        except _GivenUp:
            pass
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=call, name=WAITED_FOR, daemon=True)
    thread.start()
    thread.join(limit_s)
    if errors:
        raise errors[0]
    if answers:
        return answers[0]
    frame = sys._current_frames().get(thread.ident or 0)
    frames = traceback.extract_stack(frame) if frame else traceback.StackSummary()
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident or 0), ctypes.py_object(_GivenUp))
    raise NoAnswerError(frames)
