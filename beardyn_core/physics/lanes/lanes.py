"""Lane values: one kernel source for scalars, LLVM vectors and NumPy arrays.

A *lane value* holds one number of each of ``width`` rollers. Compiled, it is a ``float64`` (width 1) or
an LLVM ``<width x double>`` that lives in a register; with ``NUMBA_DISABLE_JIT=1`` it is a NumPy array of
``width`` numbers, so that the same source can be debugged and covered. Kernels take a `Lanes` value that
carries the width and moves lane values from and to arrays of shape ``[block, field, lane]``.

Every primitive is a plain Python function with a NumPy body, which is its meaning, and an overload
that emits LLVM instructions.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import llvmlite.ir as ir
import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.typeconv import Conversion
from numba.core.typing import signature as typed
from numba.core.typing.templates import AbstractTemplate, infer_global
from numba.extending import (
    NativeValue,
    intrinsic,
    lower_builtin,
    lower_cast,
    models,
    overload,
    overload_attribute,
    overload_method,
    register_model,
    typeof_impl,
    unbox,
)

from beardyn_core.base.jit import FASTMATH

_DOUBLE = ir.DoubleType()
_INT32 = ir.IntType(32)
_INT64 = ir.IntType(64)


typed_intrinsic: Callable[[Callable[..., Any]], Any] = intrinsic  # called without the typing context


class VectorType(types.Type):
    """numba type of a lane value of width two or more."""

    def __init__(self, width: int) -> None:
        self.width = width
        super().__init__(name=f"LaneVector({width})")

    def unify(self, _context: Any, other: types.Type) -> types.Type | None:
        """Make a vector of a number and a vector, so that ``total = 0.0; total += vector`` types."""
        return self if isinstance(other, types.Number) else None

    def can_convert_from(self, _context: Any, other: types.Type) -> Any:
        """Allow numbers, which are broadcast to all lanes."""
        return Conversion.safe if isinstance(other, types.Number) else None


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, vector: VectorType) -> None:
        super().__init__(manager, vector, ir.VectorType(_DOUBLE, vector.width))


class LanesType(types.Type):
    """numba type of a `Lanes`: the width is part of the type."""

    def __init__(self, width: int) -> None:
        self.width = width
        super().__init__(name=f"Lanes({width})")

    @property
    def value(self) -> types.Type:
        """Name the type of one lane value."""
        return types.float64 if self.width == 1 else VectorType(self.width)


register_model(LanesType)(models.OpaqueModel)


class Lanes:
    """Carrier of the lane width; moves lane values from and to arrays ``[block, field, lane]``.

    Parameters
    ----------
    width : int
        Lanes of one value: 1 for scalars, else a power of two.
    """

    def __init__(self, width: int) -> None:
        self.width = width

    def load(self, array: Any, block: int, field: int) -> Any:
        """Load the lane value stored at ``array[block, field]``."""
        return array[block, field, 0] if self.width == 1 else array[block, field].copy()

    def store(self, array: Any, block: int, field: int, value: Any) -> None:
        """Store a lane value at ``array[block, field]``."""
        array[block, field] = value

    def constant(self, number: float) -> Any:
        """Make a lane value with the same number in every lane."""
        return float(number) if self.width == 1 else np.full(self.width, float(number))

    def gather(self, table: Any, index: Any) -> Any:
        """Look up the lane value of ``table[index]``, the index of each lane kept within the table."""
        inside = np.minimum(np.where(np.greater(index, 0.0), index, 0.0), len(table) - 1.0)
        return table[np.asarray(inside, dtype=np.int64)]


@typeof_impl.register(Lanes)
def _typeof_lanes(value: Lanes, _context: Any) -> LanesType:
    return LanesType(value.width)


@unbox(LanesType)
def _unbox_lanes(_type: LanesType, _object: Any, context: Any) -> NativeValue:
    return NativeValue(context.context.get_dummy_value())


@overload_attribute(LanesType, "width")
def _lanes_width(lanes):
    width = lanes.width
    return lambda lanes: width


def broadcast(builder: Any, value: Any, number: types.Type, target: types.Type) -> Any:
    """Turn the LLVM value of a number into `target`, the same in every lane."""
    if isinstance(number, types.Integer):
        value = builder.sitofp(value, _DOUBLE)
    if isinstance(target, VectorType) and not isinstance(number, VectorType):
        vector = ir.VectorType(_DOUBLE, target.width)
        undefined = ir.Constant(vector, ir.Undefined)
        first = builder.insert_element(undefined, value, _INT32(0))
        zeros = ir.Constant(ir.VectorType(_INT32, target.width), [0] * target.width)
        value = builder.shuffle_vector(first, undefined, zeros)
    return value


@lower_cast(types.Number, VectorType)
def _cast_number(_context: Any, builder: Any, number: Any, vector: Any, value: Any) -> Any:
    return broadcast(builder, value, number, vector)


def lane_address(
    context: Any, builder: Any, array_type: Any, array: Any, block: Any, field: Any, width: int
) -> Any:
    """Make the LLVM pointer to a lane value of an array."""
    view = context.make_array(array_type)(context, builder, array)
    fields = builder.extract_value(view.shape, 1)
    offset = builder.mul(builder.add(builder.mul(block, fields), field), _INT64(width))
    pointer = builder.gep(view.data, [offset])
    return pointer if width == 1 else builder.bitcast(pointer, ir.VectorType(_DOUBLE, width).as_pointer())


def require_lane_array(array: Any) -> None:
    """Refuse what is no array of lane values."""
    contiguous = isinstance(array, types.Array) and array.ndim == 3 and array.layout == "C"
    if not contiguous or array.dtype != types.float64:
        raise TypeError(f"a lane array is C-contiguous float64 [block, field, lane], not {array}")


@typed_intrinsic
def _load(_typing: Any, lanes: Any, array: Any, block: Any, field: Any) -> Any:
    require_lane_array(array)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        pointer = lane_address(context, builder, signature.args[1], args[1], args[2], args[3], lanes.width)
        element = _DOUBLE if lanes.width == 1 else ir.VectorType(_DOUBLE, lanes.width)
        try:
            return builder.load(pointer, align=8, typ=element)
        except TypeError:  # llvmlite before opaque pointers
            return builder.load(pointer, align=8)

    return lanes.value(lanes, array, types.intp, types.intp), generate


@typed_intrinsic
def _store(_typing: Any, lanes: Any, array: Any, block: Any, field: Any, value: Any) -> Any:
    require_lane_array(array)

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        pointer = lane_address(context, builder, signature.args[1], args[1], args[2], args[3], lanes.width)
        builder.store(args[4], pointer, align=8)
        return context.get_dummy_value()

    return types.void(lanes, array, types.intp, types.intp, lanes.value), generate


@typed_intrinsic
def _gather(_typing: Any, lanes: Any, table: Any, index: Any) -> Any:
    if not isinstance(table, types.Array) or table.ndim != 1 or table.layout != "C":
        raise TypeError(f"a table is contiguous float64 [point], not {table}")

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        view = context.make_array(signature.args[1])(context, builder, args[1])
        last = builder.sitofp(builder.sub(view.nitems, _INT64(1)), _DOUBLE)
        first = _DOUBLE(0.0)

        def element(place: Any) -> Any:
            place = builder.select(builder.fcmp_ordered(">", place, first), place, first)
            place = builder.select(builder.fcmp_ordered("<", place, last), place, last)
            pointer = builder.gep(view.data, [builder.fptosi(place, _INT64)])
            return builder.load(pointer)

        if lanes.width == 1:
            return element(args[2])
        found = ir.Constant(ir.VectorType(_DOUBLE, lanes.width), ir.Undefined)
        for lane in range(lanes.width):
            place = builder.extract_element(args[2], _INT32(lane))
            found = builder.insert_element(found, element(place), _INT32(lane))
        return found

    return lanes.value(lanes, table, lanes.value), generate


@typed_intrinsic
def _constant(_typing: Any, lanes: Any, number: Any) -> Any:
    def generate(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return broadcast(builder, args[1], signature.args[1], lanes.value)

    return lanes.value(lanes, types.float64), generate


@overload_method(LanesType, "load")
def _lanes_load(lanes, array, block, field):
    return lambda lanes, array, block, field: _load(lanes, array, block, field)


@overload_method(LanesType, "store")
def _lanes_store(lanes, array, block, field, value):
    return lambda lanes, array, block, field, value: _store(lanes, array, block, field, value)


@overload_method(LanesType, "gather")
def _lanes_gather(lanes, table, index):
    return lambda lanes, table, index: _gather(lanes, table, index)


@overload_method(LanesType, "constant")
def _lanes_constant(lanes, number):
    return lambda lanes, number: _constant(lanes, number)


@typed_intrinsic
def _align_stack(_typing: Any, lanes: Any) -> Any:
    def generate(context: Any, builder: Any, _signature: Any, _args: Any) -> Any:
        builder.function.attributes.alignstack = 8 * max(lanes.width, 2)
        builder.function.attributes.add("norecurse")  # llvmlite drops an alignment that stands alone
        return context.get_dummy_value()

    return types.void(lanes), generate


def align_stack(lanes: Lanes) -> None:
    """Keep the lane values that find no register where none lies across two cache lines.

    For entry points. LLVM learns of such values too late to align the stack by itself; on the 16 bytes that
    it is given three of four stores and loads of them take two cache lines, also in a step that spills
    hundreds of times.
    """


@overload(align_stack, inline="always")
def _overload_align_stack(lanes):
    return lambda lanes: _align_stack(lanes)


def _is_lane_value(candidate: types.Type) -> bool:
    return isinstance(candidate, VectorType | types.Float | types.Integer)


def _lower(emit: Callable[..., Any]) -> Callable[..., Any]:
    """Make the code of a call that applies ``emit(builder, *values)`` to vectors and broadcast numbers."""

    def generate(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
        shape = signature.return_type
        return emit(
            builder, *(broadcast(builder, v, t, shape) for v, t in zip(args, signature.args, strict=True))
        )

    return generate


def _type_calls(function: Any, arity: int, vectors_only: bool) -> None:
    """Give numba the type of calls with lane values; ``vectors_only``: of those that have a vector.

    An overload would do, too, but numba compiles one like a function, for each combination of types.
    """

    class _Calls(AbstractTemplate):
        key = function

        def generic(self, args: Any, kws: Any) -> Any:
            if kws or len(args) != arity or not all(map(_is_lane_value, args)):
                return None
            vector = next((each for each in args if isinstance(each, VectorType)), None)
            if vector is None and vectors_only:
                return None
            return typed(vector or types.float64, *map(types.unliteral, args))

    infer_global(function, types.Function(_Calls))


def _overload_arithmetic(function: Any, emit: Callable[..., Any], arity: int = 2) -> None:
    _type_calls(function, arity, vectors_only=True)
    vector: Any = VectorType
    combinations = [(vector,)] if arity == 1 else [(vector, vector), (vector, types.Any), (types.Any, vector)]
    for kinds in combinations:
        lower_builtin(function, *kinds)(_lower(emit))


for _functions, _emitted in (
    ((operator.add, operator.iadd), lambda builder, a, b: builder.fadd(a, b, flags=FASTMATH)),
    ((operator.sub, operator.isub), lambda builder, a, b: builder.fsub(a, b, flags=FASTMATH)),
    ((operator.mul, operator.imul), lambda builder, a, b: builder.fmul(a, b, flags=FASTMATH)),
    ((operator.truediv, operator.itruediv), lambda builder, a, b: builder.fdiv(a, b, flags=FASTMATH)),
):
    for _function in _functions:
        _overload_arithmetic(_function, _emitted)
_overload_arithmetic(operator.neg, lambda builder, a: builder.fneg(a, flags=FASTMATH), 1)


def primitive(emit: Callable[..., Any]) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Give a function with a NumPy body an LLVM twin for numbers and vectors."""

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        arity = function.__code__.co_argcount
        _type_calls(function, arity, vectors_only=False)
        lower_builtin(function, *[types.Any] * arity)(_lower(emit))
        return function

    return decorate


@typed_intrinsic
def _any_positive(_typing: Any, a: Any) -> Any:
    def generate(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
        vector = signature.args[0]
        positive = builder.fcmp_ordered(">", args[0], splat(args[0].type, 0.0))
        if not isinstance(vector, VectorType):
            return positive
        bits = ir.IntType(vector.width)
        return builder.icmp_unsigned("!=", builder.bitcast(positive, bits), bits(0))

    return types.boolean(a), generate


def any_positive(a: Any) -> Any:
    """Check whether any lane is above zero: the one way to branch on lane values."""
    return bool(np.any(np.greater(a, 0.0)))


@overload(any_positive)
def _overload_any_positive(a):
    return (lambda a: _any_positive(a)) if _is_lane_value(a) else None


def integer_type(value: ir.Type) -> ir.Type:
    """Name the LLVM integer type of the same shape as a lane value's type."""
    return ir.VectorType(_INT64, value.count) if isinstance(value, ir.VectorType) else _INT64


def splat(shape: ir.Type, number: float) -> ir.Constant:
    """Make an LLVM constant with the same number in every lane."""
    return ir.Constant(shape, [number] * shape.count if isinstance(shape, ir.VectorType) else number)


def library_call(builder: Any, name: str, *values: Any) -> Any:
    """Call an LLVM math intrinsic on lane values."""
    shape = values[0].type
    suffix = f"v{shape.count}f64" if isinstance(shape, ir.VectorType) else "f64"
    kind = ir.FunctionType(shape, [shape] * len(values))
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.{suffix}")
    return builder.call(function, values, fastmath=FASTMATH)
