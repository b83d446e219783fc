"""What a node has freed goes back to the system."""

from __future__ import annotations

import os
import platform

import numpy as np
import pytest

from beardyn_ros import runtime
from evidence.ros.memory import resident


def test_holes_between_arrays_are_given_back() -> None:
    if platform.libc_ver()[0] != "glibc":
        pytest.skip("only glibc can")
    pid = os.getpid()
    # pieces small enough for the heap; every second one goes, so that its end stays where it is
    pieces = [np.ones(8_000) for _ in range(2_000)]
    full = resident(pid)
    kept = pieces[::2]
    del pieces
    freed = resident(pid)
    runtime.return_free_memory()
    assert resident(pid) < full - 40.0
    assert resident(pid) <= freed
    assert len(kept) == 1_000
