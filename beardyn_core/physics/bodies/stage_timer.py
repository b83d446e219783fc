"""Where the time of a step goes: a cycle counter read between the stages of a few steps.

One step in `PERIOD` is timed, and the one before it, only to have the code of the marks in the cache. In the
others a mark is a branch that is never taken, and without timers it is nothing at all.

In a timed step every mark waits until all that came before it is done, so that each cycle belongs to one
stage. Stages then do not overlap as they do in other steps: the numbers are *shares*, the part of the step
that a stage takes when it has the processor for itself, and the seconds of a summary are those shares of the
kernel's wall time. An interval without work is counted too and deducted for every mark; film and traction are
marked lamina by lamina. The cycles so found add up to those of an untimed step within some per cent.

Only x86 lets a program read its cycle counter; elsewhere nothing is counted and the kernel is one stage.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Callable
from typing import Any

import llvmlite.ir as ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.step_stages import (
    CYCLES,
    EMPTY,
    LAST,
    MARKS,
    OWN,
    ROW,
    TIMED_STEPS,
    TIMER_SLOTS,
)
from beardyn_core.physics.lanes.lanes import VectorType

# A prime, so that steps timed one after the other take turns however many hold friction: all of their places
# twice in a block, which has 512 steps and friction worked out in every second one for each step a sample.
PERIOD = 127
_TIMED = 4  # not the first step of a block, which takes the energy audit
_HAS_COUNTER = platform.machine().lower() in ("x86_64", "amd64", "i386", "i686")
_DOUBLE, _INT = ir.DoubleType(), ir.IntType(64)
_OWN_ROW, _OWN_LAST = OWN * TIMER_SLOTS + ROW, OWN * TIMER_SLOTS + LAST

_typed_intrinsic: Callable[[Callable[..., Any]], Callable[..., Any]] = intrinsic  # called without the context


def _add(builder: Any, address: Any, number: Any) -> None:
    builder.store(builder.fadd(builder.load(address), number), address)


def _read_counter(builder: Any) -> Any:
    """Read the cycle counter once all earlier work is done, as a float64: exact for a month of cycles."""
    nothing = ir.FunctionType(ir.VoidType(), [])
    wait = cgutils.get_or_insert_function(builder.module, nothing, "llvm.x86.sse2.lfence")
    number = ir.FunctionType(ir.IntType(64), [])
    read = cgutils.get_or_insert_function(builder.module, number, "llvm.readcyclecounter")
    builder.call(wait, [])
    count = builder.call(read, [])
    builder.call(wait, [])
    return builder.uitofp(count, ir.DoubleType())


def _await(builder: Any, value: Any) -> None:
    """Do nothing, but not before the value is ready: in pairs, for which every x86-64 has registers."""
    pairs = [value]
    if isinstance(value.type, ir.VectorType):
        pair = ir.VectorType(ir.IntType(32), 2)
        pairs = [
            builder.shuffle_vector(value, value, ir.Constant(pair, [lane, lane + 1]))
            for lane in range(0, value.type.count, 2)
        ]
    for part in pairs:
        builder.asm(ir.FunctionType(ir.VoidType(), [part.type]), "", "x", [part], True)


@_typed_intrinsic
def _mark(_typing: Any, timers: Any, stage: Any, result: Any) -> Any:
    """Emit `mark_result` with an unlikely branch, which keeps the registers for the other side."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        if not _HAS_COUNTER:
            return context.get_dummy_value()
        data = context.make_array(signature.args[0])(context, builder, args[0]).data
        row = builder.load(builder.gep(data, [_INT(_OWN_ROW)]))
        with cgutils.if_unlikely(builder, builder.fcmp_ordered(">", row, ir.Constant(_DOUBLE, 0.0))):
            if isinstance(result, VectorType | types.Float):
                _await(builder, args[2])
            now = _read_counter(builder)
            last = builder.gep(data, [_INT(_OWN_LAST)])
            stage_slot = builder.add(builder.fptosi(row, _INT), args[1])
            _add(builder, builder.gep(data, [stage_slot]), builder.fsub(now, builder.load(last)))
            marks = builder.gep(data, [builder.add(_INT(MARKS * TIMER_SLOTS), args[1])])
            _add(builder, marks, ir.Constant(_DOUBLE, 1.0))
            builder.store(now, last)
        return context.get_dummy_value()

    return types.void(timers, types.intp, result), generate


def _mark_plainly(timers: Any, stage: int, _result: Any) -> None:
    """Mark a result in plain Python, in nanoseconds."""
    if timers[OWN, ROW] > 0.0:
        now = float(time.perf_counter_ns())
        timers.flat[int(timers[OWN, ROW]) + stage] += now - timers[OWN, LAST]
        timers[MARKS, stage] += 1.0
        timers[OWN, LAST] = now


@overload(_mark_plainly, inline="always")
def _overload_mark(timers, stage, _result):
    return lambda timers, stage, _result: _mark(timers, stage, _result)


@inline
def time_step(timers, step):
    """Begin a step of the block: decide whether it is timed.

    ``timers`` [CYCLES + TIMED_STEPS, TIMER_SLOTS] are the counters of `bodies.step_stages`; without
    this and the marks compile to nothing.
    """
    if timers is None:
        return
    timers[OWN, ROW] = 0.0
    if step % PERIOD == _TIMED or step % PERIOD == _TIMED - 1:
        row = CYCLES + (step // PERIOD) % TIMED_STEPS
        timers[row] = 0.0
        timers[OWN, ROW] = row * TIMER_SLOTS
        mark(timers, EMPTY)
        timers[row, EMPTY] = 0.0
        mark(timers, EMPTY)


@inline
def mark(timers, stage):
    """End a stage: what passed since the last mark counts for its slot."""
    if timers is None:
        return
    _mark_plainly(timers, stage, None)


@inline
def mark_result(timers, stage, result):
    """End a stage so short that the compiler would mix it with the next one: its result is ready then."""
    if timers is None:
        return
    _mark_plainly(timers, stage, result)
