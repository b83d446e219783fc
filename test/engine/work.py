"""Tasks for the engine: functions that a worker can import."""

from __future__ import annotations

import os
import time
from pathlib import Path


def squared(number: int) -> tuple[int, int]:
    """Square a number; give the process that did it too."""
    return number * number, os.getpid()


def slow(number: int, seconds: float) -> tuple[int, int]:
    """Wait as long as a run does, without using a core."""
    time.sleep(seconds)
    return number, os.getpid()


def fatal(number: int, once: str) -> int:
    """Kill the process at number 0: the first time only where ``once`` names a file."""
    if number == 0:
        if once:
            try:
                Path(once).touch(exist_ok=False)
            except FileExistsError:
                return number
        os._exit(9)
    return number


def wrong(number: int) -> int:
    """Raise a mistake."""
    raise ValueError(f"{number} is wrong")
