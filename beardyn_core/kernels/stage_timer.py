"""Where the time of a step goes: a cycle counter read between the stages of a few steps.

One step in `PERIOD` is timed; in the others a mark is a branch that is never taken, and without timers it is
nothing at all. In a timed step every mark waits until all that came before it is done, so that each cycle
belongs to one stage. Stages therefore do not overlap in a timed step as they do in the others: the numbers
are *shares*, the part of the step that each stage takes when it has the processor for itself, and the
seconds of a summary are those shares of the kernel's wall time. An interval without work is counted in each
timed step too and deducted for every mark. Film and traction are marked lamina by lamina.

Only x86 lets a program read its cycle counter; elsewhere nothing is counted and the kernel is one stage.
"""

from __future__ import annotations

import platform
import time
from typing import Any

import llvmlite.ir as ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload

from beardyn_core.jit import inline
from beardyn_core.kernels.lanes import VectorType
from beardyn_core.model.stages import CYCLES, EMPTY, LAST, MARKS, OWN, ROW, TIMED_STEPS

PERIOD = 256
_FIRST = 100  # not the first step of a block, which takes the energy audit
_HAS_COUNTER = platform.machine().lower() in ("x86_64", "amd64", "i386", "i686")


def _need(builder: Any, kind: types.Type, value: Any) -> None:
    """Make the compiler have the numbers of a value ready at this place."""
    if isinstance(kind, types.BaseTuple):
        for place, part in enumerate(kind.types):
            _need(builder, part, builder.extract_value(value, place))
    elif isinstance(kind, types.Float | VectorType):
        takes = ir.FunctionType(ir.VoidType(), [value.type])
        builder.asm(takes, "", "x", [value], True)


@intrinsic
def _cycle_count(_typing: Any, results: Any) -> Any:
    def generate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        if not _HAS_COUNTER:
            return ir.Constant(ir.DoubleType(), 0.0)
        nothing = ir.FunctionType(ir.VoidType(), [])
        wait = cgutils.get_or_insert_function(builder.module, nothing, "llvm.x86.sse2.lfence")
        number = ir.FunctionType(ir.IntType(64), [])
        read = cgutils.get_or_insert_function(builder.module, number, "llvm.readcyclecounter")
        _need(builder, results, args[0])
        builder.call(wait, [])
        count = builder.call(read, [])
        return builder.uitofp(count, ir.DoubleType())

    return types.float64(results), generate


def cycle_count(_results: Any) -> float:
    """Cycles since the machine started, results at hand; nanoseconds in plain Python."""
    return float(time.perf_counter_ns())


@overload(cycle_count)
def _overload_cycle_count(_results):
    return lambda _results: _cycle_count(_results)


@inline
def time_step(timers: Any, step: Any) -> None:
    """Begin a step: decide whether it is timed.

    Parameters
    ----------
    timers : float64 array, shape [CYCLES + TIMED_STEPS, TIMER_SLOTS], or None
        Counters of `model.stages`; ``None``: no timers, and compiles to nothing.
    step : int
        Of the block.
    """
    if timers is None:
        return
    timers[OWN, ROW] = 0.0
    if step % PERIOD == _FIRST:
        row = CYCLES + (step // PERIOD) % TIMED_STEPS
        timers[row] = 0.0
        timers[OWN, ROW] = row
        timers[OWN, LAST] = cycle_count(0.0)
        mark(timers, EMPTY, 0.0)


@inline
def mark(timers: Any, stage: Any, results: Any) -> None:
    """End a stage: what passed since the last mark is its.

    Parameters
    ----------
    timers : float64 array, shape [CYCLES + TIMED_STEPS, TIMER_SLOTS], or None
        Counters of `model.stages`; ``None``: no timers, and compiles to nothing.
    stage : int
        Slot of the stage.
    results : lane value or tuple
        What the stage works out: the compiler may not leave it for later. Arrays need not be named.
    """
    if timers is None:
        return
    if timers[OWN, ROW] > 0.0:
        now = cycle_count(results)
        timers[int(timers[OWN, ROW]), stage] += now - timers[OWN, LAST]
        timers[MARKS, stage] += 1.0
        timers[OWN, LAST] = now
