"""Tables of many kinds in one piece of memory, which kernels are handed as one pointer.

To hand a compiled function a dozen arrays costs more than most of them compute: each is copied word by
word, and counted. So a cluster's tables lie behind one another in one array of 8-byte cells, headed by
a record that says how many there are of each and where they begin (in bytes). Inside kernels `head`
gives that record, which is a bare pointer; `record`, `line`, `grid`, `integers` and `integer_grid` give what lies
at an offset from it. They own nothing: the array must outlive the call. Python sees the same memory through
ordinary numpy views (`Layout.view`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.core import cgutils, types
from numba.extending import intrinsic
from numba.np import arrayobj
from numpy.typing import NDArray

from sketch.ink import FloatArray


class Layout:
    """The plan of one piece of memory: fields are named blocks, in order, behind a head of their offsets.

    `dtype` of the head: for each block its first byte, `NAME_at`; then the counts named in `counts`.
    """

    def __init__(self, blocks: tuple[str, ...], counts: tuple[str, ...]) -> None:
        self.blocks, self.counts = blocks, counts
        self.head = np.dtype(
            [(f"{name}_at", np.int64) for name in blocks] + [(name, np.int64) for name in counts]
        )

    def laid(self, counts: dict[str, int], arrays: dict[str, NDArray[Any]]) -> FloatArray:
        """One array of cells that holds copies of all blocks."""
        at = self.head.itemsize
        head = np.zeros(1, self.head)
        for name, count in counts.items():
            head[name] = count
        for name in self.blocks:
            head[f"{name}_at"] = at
            at += arrays[name].nbytes
        cells = np.zeros(at // 8)
        cells[: self.head.itemsize // 8] = head.view(np.float64)
        for name in self.blocks:
            start = int(head[f"{name}_at"][0]) // 8
            block = np.ascontiguousarray(arrays[name])
            cells[start : start + block.nbytes // 8] = block.view(np.float64).ravel() if block.size else 0.0
        return cells

    def head_of(self, cells: FloatArray) -> NDArray[Any]:
        """The head of such cells, as one record."""
        return cells[: self.head.itemsize // 8].view(self.head)[0]

    def view(self, cells: FloatArray, name: str, like: NDArray[Any]) -> NDArray[Any]:
        """The block of that name within the cells, shaped and typed as `like`."""
        start = int(self.head_of(cells)[f"{name}_at"]) // 8
        return cells[start : start + like.nbytes // 8].view(like.dtype).reshape(like.shape)


def _pointer(context: Any, builder: Any, kind: Any, value: Any, offset: Any) -> Any:
    """Address of a byte offset from a record."""
    base = builder.bitcast(value, cgutils.voidptr_t)
    return cgutils.pointer_add(builder, base, offset, return_type=cgutils.voidptr_t)


@intrinsic
def head(_typing: Any, cells: Any, dtype: Any) -> Any:
    """head(cells, DTYPE): the record at the start of an array of cells."""
    made = dtype.dtype

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, value=args[0])
        return builder.bitcast(array.data, context.get_value_type(made))

    return made(cells, dtype), code


@intrinsic
def record(_typing: Any, start: Any, offset: Any, dtype: Any) -> Any:
    """record(head, bytes, DTYPE): the record at an offset."""
    made = dtype.dtype

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = _pointer(context, builder, signature.args[0], args[0], args[1])
        return builder.bitcast(place, context.get_value_type(made))

    return made(start, types.int64, dtype), code


def _array(context: Any, builder: Any, kind: Any, place: Any, shape: Any) -> Any:
    """An array that owns nothing."""
    made = arrayobj.make_array(kind)(context, builder)
    size = context.get_constant(types.intp, 8)
    strides = [size] if len(shape) == 1 else [builder.mul(size, shape[1]), size]
    arrayobj.populate_array(
        made,
        data=builder.bitcast(place, context.get_data_type(kind.dtype).as_pointer()),
        shape=shape,
        strides=strides,
        itemsize=size,
        meminfo=None,
    )
    return made._getvalue()


def _lines(dtype: Any) -> Any:
    kind = types.Array(dtype, 1, "C")

    def typed(_typing: Any, start: Any, offset: Any, n: Any) -> Any:
        def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            place = _pointer(context, builder, signature.args[0], args[0], args[1])
            return _array(context, builder, kind, place, [args[2]])

        return kind(start, types.int64, types.int64), code

    return typed


@intrinsic
def line(_typing: Any, start: Any, offset: Any, n: Any) -> Any:
    """line(head, bytes, n): n float64 at an offset."""
    return _lines(types.float64)(_typing, start, offset, n)


@intrinsic
def integers(_typing: Any, start: Any, offset: Any, n: Any) -> Any:
    """integers(head, bytes, n): n int64 at an offset."""
    return _lines(types.int64)(_typing, start, offset, n)


def _grids(dtype: Any) -> Any:
    kind = types.Array(dtype, 2, "C")

    def typed(_typing: Any, start: Any, offset: Any, n: Any, m: Any) -> Any:
        def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            place = _pointer(context, builder, signature.args[0], args[0], args[1])
            return _array(context, builder, kind, place, [args[2], args[3]])

        return kind(start, types.int64, types.int64, types.int64), code

    return typed


@intrinsic
def grid(_typing: Any, start: Any, offset: Any, n: Any, m: Any) -> Any:
    """grid(head, bytes, n, m): n lines of m float64 at an offset."""
    return _grids(types.float64)(_typing, start, offset, n, m)


@intrinsic
def integer_grid(_typing: Any, start: Any, offset: Any, n: Any, m: Any) -> Any:
    """integer_grid(head, bytes, n, m): n lines of m int64 at an offset."""
    return _grids(types.int64)(_typing, start, offset, n, m)
