"""Parts of an array of numbers as arrays of their own in compiled code, over the same memory.

Slices, `reshape` and `view` say the same, but numba takes long over each, as it asks what else they could be; and a
function that returns them has to count who uses the memory.
"""

from __future__ import annotations

from typing import Any

from numba.core import cgutils, types
from numba.core.types.containers import BaseTuple, UniTuple
from numba.core.typing.templates import Signature
from numba.extending import intrinsic
from numba.np.arrayobj import make_array, populate_array

from workbench.files.regular import sha256_of

DIGEST = sha256_of(__file__)  # now, for the file may be another one later


@intrinsic
def floats_at(context: Any, numbers: Any, at: Any, shape: Any) -> tuple[Signature, Any] | None:
    """floats_at(numbers, at, shape): float64 in C order from a place of float64 numbers on; no bounds are checked.

    The memory lives as long as its owner: nothing here counts who uses it.
    """
    return _view(types.float64, numbers, at, shape)


@intrinsic
def integers_at(context: Any, numbers: Any, at: Any, shape: Any) -> tuple[Signature, Any] | None:
    """The same as int64, which take as much room."""
    return _view(types.int64, numbers, at, shape)


def _view(kind: Any, numbers: Any, at: Any, shape: Any) -> tuple[Signature, Any] | None:
    if not (isinstance(numbers, types.Array) and numbers.dtype == types.float64 and numbers.layout == "C"
            and isinstance(at, types.Integer) and isinstance(shape, BaseTuple)
            and all(isinstance(length, types.Integer) for length in shape)):
        return None
    lengths = UniTuple(types.intp, len(shape))
    return Signature(types.Array(kind, len(shape), "C"), (numbers, types.intp, lengths), None), _made


def _made(context: Any, builder: Any, signature: Signature, arguments: Any) -> Any:
    numbers, at, shape = arguments
    given = make_array(signature.args[0])(context, builder, numbers)
    made = make_array(signature.return_type)(context, builder)
    size = context.get_constant(types.intp, 8)
    lengths = cgutils.unpack_tuple(builder, shape)
    strides = [size]
    for length in reversed(lengths[1:]):
        strides.insert(0, builder.mul(strides[0], length))
    populate_array(made, data=builder.bitcast(builder.gep(given.data, [at]), made.data.type), shape=lengths,
                   strides=strides, itemsize=size, meminfo=None)
    return made._getvalue()
