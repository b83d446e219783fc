"""Tasks for the engine: functions that a worker can import."""

from __future__ import annotations

import os
import time
from pathlib import Path

import psutil


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


def hungry(number: int, megabytes: int) -> int:
    """Take memory step by step at number 0, and keep it for a while; the others take none."""
    held = []
    if number == 0:
        for _ in range(megabytes // 20):
            held.append(b"x" * 20_000_000)
            time.sleep(0.05)
    return number


_HELD: list[bytes] = []


def held_for(number: int, whole: float) -> int:
    """Fill this process up to so many bytes, for ever; let Dask look at its memory a few times."""
    _HELD.append(b"x" * max(int(whole - psutil.Process().memory_info().rss), 0))
    time.sleep(0.6)
    return number


def wrong(number: int) -> int:
    """Raise a mistake."""
    raise ValueError(f"{number} is wrong")
