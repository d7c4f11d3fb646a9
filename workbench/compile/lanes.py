"""Numbers that are several numbers: a kernel of them makes several runs side by side.

An operation on them is one instruction of the processor for all its lanes, without reassociation or fused operations,
so that each lane has the bits of the same kernel run alone. numba knows arrays and scalars only; this is the vector
between them. Generated functions take them as they take floats.
"""

from __future__ import annotations

import hashlib
import inspect
import math
import operator
import sys
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models
from numba.core.imputils import impl_ret_borrowed
from numba.core.typeconv import Conversion
from numba.extending import intrinsic, lower_cast, overload, register_model
from numba.np.arrayobj import make_array, populate_array

from workbench.compile.typed_once import SIMPLE

_DOUBLE, _INDEX = ir.DoubleType(), ir.IntType(32)
Emitted = Callable[[Any, Any, Any], Any]


class Lanes(types.Type):
    """The type of `count` floats in one vector; a float beside them is one for all lanes."""

    def __init__(self, count: int) -> None:
        self.count = count
        super().__init__(name=f"Lanes({count})")

    def unify(self, _: Any, other: types.Type) -> types.Type | None:
        """With a number: these lanes."""
        return self if isinstance(other, types.Number) else None

    def can_convert_from(self, _: Any, other: types.Type) -> Conversion | None:
        """A number can be had in all lanes."""
        return Conversion.safe if isinstance(other, types.Number) else None


SIMPLE.add(Lanes)


@register_model(Lanes)
class _Vector(models.PrimitiveModel):
    def __init__(self, manager: Any, of: Lanes) -> None:
        super().__init__(manager, of, ir.VectorType(_DOUBLE, of.count))


def kernel_head(count: int) -> str:
    """The line by which a kernel's source says how many lanes it has, and by which version of this file."""
    return f"LANES = {count}  # {hashlib.sha256(inspect.getsource(sys.modules[__name__]).encode()).hexdigest()[:12]}\n"


def _at(number: int) -> ir.Constant:
    return ir.Constant(_INDEX, number)


def _spread(context: Any, builder: Any, value: Any, of: types.Type, lanes: Lanes) -> Any:
    """A value in all lanes."""
    if isinstance(of, Lanes):
        return value
    empty = ir.Constant(ir.VectorType(_DOUBLE, lanes.count), ir.Undefined)
    one = builder.insert_element(empty, context.cast(builder, value, of, types.float64), _at(0))
    return builder.shuffle_vector(one, empty, ir.Constant(ir.VectorType(_INDEX, lanes.count), [0] * lanes.count))


@lower_cast(types.Float, Lanes)
@lower_cast(types.Integer, Lanes)
def _cast(context: Any, builder: Any, of: types.Type, to: Lanes, value: Any) -> Any:
    return _spread(context, builder, value, of, to)


def _lanes_among(*of: types.Type) -> Lanes | None:
    """The lanes among numbers; None without any, and beside anything else."""
    found = [x for x in of if isinstance(x, Lanes)]
    return found[0] if found and all(isinstance(x, Lanes | types.Number) for x in of) else None


def _two(of: Callable[..., Any], emit: Emitted) -> None:
    """Teach numba an operation on two of which at least one has lanes."""

    @intrinsic
    def both(_: Any, a: types.Type, b: types.Type) -> Any:
        lanes = _lanes_among(a, b)
        if lanes is None:
            return None

        def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return emit(builder, *(_spread(context, builder, value, kind, lanes)
                                   for value, kind in zip(args, signature.args, strict=True)))

        return lanes(a, b), code

    @overload(of, strict=False)
    def of_lanes(a: types.Type, b: types.Type) -> Any:
        return (lambda a, b: both(a, b)) if _lanes_among(a, b) else None  # noqa: PLW0108 - as numba wants it


def _one(of: Callable[..., Any], emit: Callable[[Any, Any, Lanes, Any], Any]) -> None:
    """Teach numba an operation on lanes alone."""

    @intrinsic
    def alone(_: Any, a: Lanes) -> Any:
        return a(a), lambda context, builder, signature, args: emit(context, builder, a, args[0])

    @overload(of, strict=False)
    def of_lanes(a: types.Type) -> Any:
        return (lambda a: alone(a)) if isinstance(a, Lanes) else None  # noqa: PLW0108 - as above


for _operation in (operator.add, operator.iadd):
    _two(_operation, lambda builder, a, b: builder.fadd(a, b))
for _operation in (operator.sub, operator.isub):
    _two(_operation, lambda builder, a, b: builder.fsub(a, b))
_two(operator.mul, lambda builder, a, b: builder.fmul(a, b))
_two(operator.truediv, lambda builder, a, b: builder.fdiv(a, b))
# Which of two equal or unordered ones is taken is as numba does with floats.
_two(min, lambda builder, a, b: builder.select(builder.fcmp_ordered("<", b, a), b, a))
_two(max, lambda builder, a, b: builder.select(builder.fcmp_ordered(">", b, a), b, a))
_one(operator.neg, lambda context, builder, lanes, a: builder.fneg(a))


def _size(context: Any, builder: Any, lanes: Lanes, a: Any) -> Any:
    name, kind = f"llvm.fabs.v{lanes.count}f64", ir.FunctionType(a.type, [a.type])
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), [a])


def _each(of: Callable[[float], float]) -> Callable[[Any, Any, Lanes, Any], Any]:
    """Lane by lane, by the function that floats have."""

    def emit(context: Any, builder: Any, lanes: Lanes, a: Any) -> Any:
        function = context.get_function(of, types.float64(types.float64))
        for number in range(lanes.count):
            value = function(builder, (builder.extract_element(a, _at(number)),))
            a = builder.insert_element(a, value, _at(number))
        return a

    return emit


_one(abs, _size)
for _function in (math.sin, math.exp):
    _one(_function, _each(_function))


@intrinsic
def _square(_: Any, a: Lanes) -> Any:
    return a(a), lambda context, builder, signature, args: builder.fmul(args[0], args[0])


@overload(operator.pow, strict=False)
def _power(a: types.Type, b: types.Type) -> Any:
    """Squares are what floats have as a product too."""
    if isinstance(a, Lanes) and isinstance(b, types.IntegerLiteral) and b.literal_value == 2:
        return lambda a, b: _square(a)
    return None


@intrinsic
def where_less(_: Any, a: types.Type, b: types.Type, less: types.Type, other: types.Type) -> Any:
    """In every lane `less` where a < b, else `other`, as where one of both is no number."""
    lanes = _lanes_among(a, b, less, other)
    if lanes is None:
        return None

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        x, y, yes, no = (_spread(context, builder, value, kind, lanes)
                         for value, kind in zip(args, signature.args, strict=True))
        return builder.select(builder.fcmp_ordered("<", x, y), yes, no)

    return lanes(a, b, less, other), code


@intrinsic
def sum_of_lanes(_: Any, a: Lanes) -> Any:
    """The sum of all lanes."""

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        total = builder.extract_element(args[0], _at(0))
        for number in range(1, a.count):
            total = builder.fadd(total, builder.extract_element(args[0], _at(number)))
        return total

    return types.float64(a), code


@intrinsic
def lanes_of(_: Any, array: types.Array, count: types.Type) -> Any:
    """A C-contiguous array of floats, the last axis `count` long, as an array of lanes; both are the same memory."""
    if not isinstance(count, types.IntegerLiteral):
        return None
    lanes = Lanes(count.literal_value)
    # What numpy allocates need not lie where a vector is loaded fastest.
    found = types.Array(lanes, array.ndim - 1, "C", aligned=False)

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        given, made = make_array(array)(context, builder, args[0]), make_array(found)(context, builder)
        shape, strides = (cgutils.unpack_tuple(builder, part)[:-1] for part in (given.shape, given.strides))
        vector = ir.VectorType(_DOUBLE, lanes.count)
        populate_array(made, data=builder.bitcast(given.data, vector.as_pointer()), shape=shape, strides=strides,
                       itemsize=context.get_constant(types.intp, 8 * lanes.count), meminfo=given.meminfo,
                       parent=given.parent)
        return impl_ret_borrowed(context, builder, found, made._getvalue())  # where uses are counted, one more

    return found(array, count), code
