"""The timers in the step: who gets the cycles, which steps are timed, and what a disturbance does."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest

from beardyn_core.base.jit import OPTIONS, entry, inline
from beardyn_core.physics.bodies.stage_timer import PERIOD, mark, time_step
from beardyn_core.physics.bodies.step_stages import (
    CAGE,
    CONTACT,
    CYCLES,
    EMPTY,
    FILM,
    KERNEL_STAGES,
    MARKS,
    RIB,
    TIMED_STEPS,
    new_timers,
    stage_cycles,
)
from beardyn_core.physics.tiers.build import HELD_SAMPLES

X86 = platform.machine().lower() in ("x86_64", "amd64")
pytestmark = pytest.mark.skipif(not X86, reason="only x86 lets a program read its cycle counter")


@inline
def _grind(values: Any, times: Any) -> None:
    """Each pass waits for the one before: a hundred cycles and more."""
    for _ in range(times):
        for i in range(1, len(values)):
            values[i] = 1.0 / (1.0 + values[i - 1] * values[i])


@entry
def grinding(values, timers, steps):
    """Three stages: one unit of work, none, and four units in two pieces."""
    for step in range(steps):
        time_step(timers, step)
        _grind(values, 20)
        mark(timers, CONTACT)
        mark(timers, FILM)
        for _ in range(2):
            _grind(values, 40)
            mark(timers, RIB)


def ground(steps: int) -> Any:
    timers = new_timers()
    grinding(np.full(16, 0.5), timers, steps)
    return timers


def test_the_stage_that_works_gets_the_cycles() -> None:
    cycles = stage_cycles(ground(TIMED_STEPS * PERIOD))
    assert cycles[RIB] / cycles[CONTACT] == pytest.approx(4.0, rel=0.25)
    assert cycles[FILM] < 0.1 * cycles[CONTACT]
    assert cycles[CAGE] == 0.0


def test_one_step_in_many_is_timed() -> None:
    timers = ground(3 * PERIOD)
    assert timers[MARKS, CONTACT] == 2 * 3  # and the step before
    assert timers[MARKS, RIB] == 2 * 6
    assert np.count_nonzero(timers[CYCLES:, CONTACT]) == 3


def test_rows_hold_the_steps_timed_last() -> None:
    timers = ground((TIMED_STEPS + 1) * PERIOD)
    once = np.delete(timers[CYCLES:, CONTACT], 0)
    assert timers[CYCLES, CONTACT] < 1.9 * np.median(once)


def test_no_step_timed_is_no_cycles() -> None:
    np.testing.assert_array_equal(stage_cycles(ground(3)), np.zeros(len(KERNEL_STAGES)))
    np.testing.assert_array_equal(stage_cycles(None), np.zeros(len(KERNEL_STAGES)))


def test_a_step_that_was_interrupted_is_left_out_and_marks_are_free() -> None:
    timers = new_timers()
    timers[CYCLES:, CONTACT] = 1300.0
    timers[CYCLES:, EMPTY] = 50.0
    timers[MARKS, CONTACT], timers[MARKS, EMPTY] = 6.0 * TIMED_STEPS, 2.0 * TIMED_STEPS
    timers[CYCLES + 2, CONTACT] = 1e7  # the processor did something else for 4 ms
    assert stage_cycles(timers)[CONTACT] == 1300.0 - 6.0 * 50.0


@pytest.mark.parametrize("steps_per_sample", [1, 2, 3, 4, 5, 6, 9, 10, 16])
@pytest.mark.parametrize("interrupted", [None, 0, 1])
def test_what_is_worked_out_in_a_step_of_two_samples_counts_by_their_steps(
    steps_per_sample: int, interrupted: int | None
) -> None:
    timers = new_timers()
    timers[MARKS, EMPTY] = 2.0
    held = int(HELD_SAMPLES * steps_per_sample)
    timed = [step for step in range(512 * steps_per_sample) if step % PERIOD == 4]
    for k, step in enumerate(timed):
        row = CYCLES + (step // PERIOD) % TIMED_STEPS
        timers[row, CONTACT], timers[row, EMPTY] = 1000.0, 1.0
        timers[row, FILM] = 100.0 * held if step % held == 0 else 0.0
        if k == interrupted:
            timers[row, CONTACT] += 1e5
    assert stage_cycles(timers)[FILM] == pytest.approx(100.0)
    assert stage_cycles(timers)[CONTACT] == pytest.approx(1000.0)


@entry
def without_timers(values):
    """The same work, its hooks without timers."""
    time_step(None, 100)
    _grind(values, 20)
    mark(None, CONTACT)


@entry
def without_hooks(values):
    """The same work, never any hooks."""
    _grind(values, 20)


def test_absent_timers_leave_no_code() -> None:
    first, second = np.full(16, 0.5), np.full(16, 0.5)
    without_timers(first)
    without_hooks(second)
    np.testing.assert_array_equal(first, second)
    if hasattr(without_timers, "py_func"):  # not in plain Python
        assert body(without_timers, first) == body(without_hooks, first)
        assert any("rdtsc" in line for line in body(grinding, first, new_timers(), 1))


def body(dispatcher: Any, *arguments: Any) -> list[str]:
    """Instructions of an entry without their operands, compiled here: numba shows none of its cached code."""
    compiled = numba.njit(**OPTIONS)(dispatcher.py_func)
    compiled(*arguments)
    listing = "\n".join(compiled.inspect_asm().values())
    return [line.split()[0] for line in listing.splitlines() if line.startswith("\t") and line[1] != "."]


_MARKED = """
import numpy as np
from beardyn_core.base.jit import entry
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.bodies.stage_timer import mark_result
from beardyn_core.physics.bodies.step_stages import FILM, new_timers

@entry
def marked(lanes, values, timers):
    mark_result(timers, FILM, lanes.load(values, 0, 0))

marked(Lanes(8), np.ones((1, 1, 8)), new_timers())
print("marked")
"""


@pytest.mark.parametrize("processor", ["x86-64", "x86-64-v3"])
def test_results_wider_than_a_register_can_be_marked(processor: str, tmp_path: Path) -> None:
    """A processor without AVX-512 holds eight lanes in two registers or four."""
    environment = {
        **os.environ,
        "NUMBA_CPU_NAME": processor,
        "NUMBA_CPU_FEATURES": "",
        "BEARDYN_CACHE_DIR": str(tmp_path),
    }
    source = tmp_path / "marked.py"
    source.write_text(_MARKED)
    done = subprocess.run(
        [sys.executable, source], env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "marked\n", "")
