"""Tables in memory for lane values: two points in one look, and what will be looked up soon."""

from __future__ import annotations

from typing import Any

import llvmlite.ir as ir
import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import overload

from beardyn_core.physics.lanes.lanes import (
    broadcast,
    integer_type,
    lane_address,
    require_lane_array,
    splat,
    typed_intrinsic,
)

_DOUBLE = ir.DoubleType()
_PAIR = ir.VectorType(_DOUBLE, 2)
_INT32 = ir.IntType(32)
_INT64 = ir.IntType(64)


def _load_pair(builder: Any, pointer: Any) -> Any:
    pointer = builder.bitcast(pointer, _PAIR.as_pointer())
    try:
        return builder.load(pointer, align=8, typ=_PAIR)
    except TypeError:  # llvmlite before opaque pointers
        return builder.load(pointer, align=8)


@typed_intrinsic
def _gather_pair(_typing: Any, lanes: Any, table: Any, index: Any) -> Any:
    if not isinstance(table, types.Array) or table.ndim != 1 or table.layout != "C":
        raise TypeError(f"a table is contiguous float64 [point], not {table}")
    pair = types.UniTuple(lanes.value, 2)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        view = context.make_array(signature.args[1])(context, builder, args[1])
        last = builder.sitofp(builder.sub(view.nitems, _INT64(2)), _DOUBLE)
        index, shape = args[2], args[2].type
        first, last = splat(shape, 0.0), broadcast(builder, last, types.float64, lanes.value)
        index = builder.select(builder.fcmp_ordered(">", index, first), index, first)
        index = builder.select(builder.fcmp_ordered("<", index, last), index, last)
        places = builder.fptosi(index, integer_type(shape))
        if lanes.width == 1:
            both = _load_pair(builder, builder.gep(view.data, [places]))
            return context.make_tuple(
                builder, pair, [builder.extract_element(both, _INT32(i)) for i in (0, 1)]
            )
        low = high = ir.Constant(shape, ir.Undefined)
        for lane in range(lanes.width):
            place = builder.extract_element(places, _INT32(lane))
            both = _load_pair(builder, builder.gep(view.data, [place]))
            low = builder.insert_element(low, builder.extract_element(both, _INT32(0)), _INT32(lane))
            high = builder.insert_element(high, builder.extract_element(both, _INT32(1)), _INT32(lane))
        return context.make_tuple(builder, pair, [low, high])

    return pair(lanes, table, lanes.value), generate


def gather_pair(lanes: Any, table: Any, index: Any) -> Any:
    """Look up ``table[index]`` and the point behind it, the index of each lane kept within the table."""
    inside = np.minimum(np.where(np.greater(index, 0.0), index, 0.0), len(table) - 2.0)
    place = np.asarray(inside, dtype=np.int64)
    return table[place], table[place + 1]


@overload(gather_pair, inline="always")
def _overload_gather_pair(lanes, table, index):
    return lambda lanes, table, index: _gather_pair(lanes, table, index)


@typed_intrinsic
def _prefetch(_typing: Any, lanes: Any, array: Any, block: Any, field: Any) -> Any:
    require_lane_array(array)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        pointer = lane_address(context, builder, signature.args[1], args[1], args[2], args[3], lanes.width)
        byte = ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [byte, _INT32, _INT32, _INT32])
        function = cgutils.get_or_insert_function(builder.module, kind, "llvm.prefetch.p0i8")
        reading, keep, data = _INT32(0), _INT32(3), _INT32(1)
        builder.call(function, [builder.bitcast(pointer, byte), reading, keep, data])
        return context.get_dummy_value()

    return types.void(lanes, array, types.intp, types.intp), generate


def prefetch(lanes: Any, array: Any, block: Any, field: Any) -> None:
    """Have the lane value at ``array[block, field]`` in the near cache for a later load."""


@overload(prefetch, inline="always")
def _overload_prefetch(lanes, array, block, field):
    return lambda lanes, array, block, field: _prefetch(lanes, array, block, field)
