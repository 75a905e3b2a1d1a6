"""Tables of many kinds in one piece of memory, which kernels are handed as one pointer.

To hand a compiled function a dozen arrays costs more than most of them compute: each is copied word by
word, and counted. So a cluster's tables lie behind one another in one array of 8-byte cells, headed by
a record that says how many there are of each and where they begin (in bytes). Inside kernels `head`
gives that record, which is a bare pointer; the accessors that a `Layout` makes, `line` and `integers`
give what lies behind it. They own nothing: the array must outlive the call. Python sees the same
memory through ordinary numpy views (`Plan.view`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import prod
from typing import Any, cast

import numpy as np
from numba import from_dtype
from numba.core import cgutils, types
from numba.extending import intrinsic
from numba.np import arrayobj
from numpy.typing import NDArray

from sketch.ink import FloatArray

CELL = 8
"""Bytes."""
REAL, WHOLE = np.dtype(np.float64), np.dtype(np.int64)
"""Types of the entries of a block."""
PLANS = 4096
"""Plans of a layout that are remembered: scenes of one kind have the same few again and again."""


@dataclass(frozen=True, slots=True)
class Plan:
    """Where the blocks of a layout lie for certain counts. head: its cells; size: of all, in cells; places: of
    each block its first byte, type and shape; nothing: blocks without entries, the same for everyone."""

    head: FloatArray
    size: int
    places: dict[str, tuple[int, np.dtype[Any], tuple[int, ...]]]
    nothing: dict[str, NDArray[Any]]

    def fresh(self) -> FloatArray:
        """Cells in which everything but the head is zero."""
        cells = np.zeros(self.size)
        cells[: len(self.head)] = self.head
        return cells

    def filled(self, arrays: Iterable[NDArray[Any]]) -> list[NDArray[Any]]:
        """Copies of all blocks, in order, within cells of their own, which come last."""
        cells = self.fresh()
        views = self.views(cells)
        for view, array in zip(views, arrays, strict=True):
            if array.size:
                view[...] = array
        return [*views, cells]

    def view(self, cells: FloatArray, name: str) -> NDArray[Any]:
        """The block of that name within the cells."""
        at, dtype, shape = self.places[name]
        return np.ndarray(shape, dtype, cells, at)

    def views(self, cells: FloatArray) -> list[NDArray[Any]]:
        """All blocks, in order."""
        nothing = self.nothing
        return [
            nothing[name] if name in nothing else np.ndarray(shape, dtype, cells, at)
            for name, (at, dtype, shape) in self.places.items()
        ]


class Layout:
    """The plan of one piece of memory: fields are named blocks, in order, behind a head of their offsets.

    blocks: of each the type of its entries and its shape, in numbers and names of counts. `dtype` of the head:
    for each block its first byte, `NAME_at`; then the counts named in `counts`.
    """

    def __init__(
        self, blocks: Mapping[str, tuple[np.dtype[Any], tuple[int | str, ...]]], counts: tuple[str, ...]
    ) -> None:
        self.blocks, self.counts = blocks, counts
        self.head = np.dtype(
            [(f"{name}_at", np.int64) for name in blocks] + [(name, np.int64) for name in counts]
        )
        self.plan = lru_cache(PLANS)(self._plan)

    def _plan(self, *counts: int) -> Plan:
        """The plan for so many of each, in the order of `self.counts`."""
        known = dict(zip(self.counts, counts, strict=True))
        at = self.head.itemsize
        places: dict[str, tuple[int, np.dtype[Any], tuple[int, ...]]] = {}
        for name, (dtype, lengths) in self.blocks.items():
            shape = tuple(known[length] if isinstance(length, str) else length for length in lengths)
            places[name] = (at, dtype, shape)
            at += dtype.itemsize * prod(shape)
        nothing = {
            name: np.zeros(shape, dtype) for name, (_, dtype, shape) in places.items() if not prod(shape)
        }
        numbers = [place[0] for place in places.values()] + list(counts)
        return Plan(np.array(numbers, np.int64).view(np.float64), at // CELL, places, nothing)

    def plan_of(self, cells: FloatArray) -> Plan:
        """The plan that such cells were made by."""
        numbers = cells[len(self.blocks) : len(self.blocks) + len(self.counts)].view(np.int64)
        return self.plan(*numbers.tolist())

    def numbers(self, name: str) -> Callable[[Any], FloatArray]:
        """For kernels: from the head, the block of float64 of that name, which has one or two sizes."""
        return self._block(name, types.float64)

    def integers(self, name: str) -> Callable[[Any], Any]:
        """The same for a block of int64."""
        return self._block(name, types.int64)

    def lines(self, name: str) -> Callable[[Any, int], FloatArray]:
        """For kernels: from the head and k, part k of the block of float64 of that name, flat."""
        shape = self.blocks[name][1][1:]
        begin, sizes = self._at(f"{name}_at"), self._sizes(shape)
        kind = types.Array(types.float64, 1, "C")

        def part(_typing: Any, start: Any, _k: Any) -> Any:
            def code(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
                length = _number(context, CELL)
                lengths = _lengths(context, builder, args[0], sizes)
                for size in lengths:
                    length = builder.mul(length, size)
                offset = builder.add(_said(context, builder, args[0], begin), builder.mul(args[1], length))
                flat = builder.udiv(length, _number(context, CELL))
                return _array(context, builder, kind, _place(builder, args[0], offset), [flat])

            return kind(start, types.int64), code

        return _compiled(part)

    def records(self, name: str) -> Callable[[Any, int], Any]:
        """For kernels: from the head and k, record k of the block of that name."""
        dtype = self.blocks[name][0]
        begin, kind = self._at(f"{name}_at"), from_dtype(dtype)

        def record(_typing: Any, start: Any, _k: Any) -> Any:
            def code(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
                skipped = builder.mul(args[1], _number(context, dtype.itemsize))
                offset = builder.add(_said(context, builder, args[0], begin), skipped)
                return builder.bitcast(_place(builder, args[0], offset), context.get_value_type(kind))

            return kind(start, types.int64), code

        return _compiled(record)

    def _block(self, name: str, dtype: Any) -> Callable[[Any], Any]:
        shape = self.blocks[name][1]
        begin, sizes = self._at(f"{name}_at"), self._sizes(shape)
        kind = types.Array(dtype, len(shape), "C")

        def block(_typing: Any, start: Any) -> Any:
            def code(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
                place = _place(builder, args[0], _said(context, builder, args[0], begin))
                return _array(context, builder, kind, place, _lengths(context, builder, args[0], sizes))

            return kind(start), code

        return _compiled(block)

    def _at(self, name: str) -> int:
        """At which byte of the head a number stands."""
        return next(at for field, (_, at, *_) in (self.head.fields or {}).items() if field == name)

    def _sizes(self, shape: tuple[int | str, ...]) -> list[tuple[bool, int]]:
        """Of each size, whether it is known, and it or where the head says it."""
        return [(True, n) if isinstance(n, int) else (False, self._at(n)) for n in shape]


def _number(context: Any, value: int) -> Any:
    return context.get_constant(types.intp, value)


def _place(builder: Any, start: Any, offset: Any) -> Any:
    """The address of a byte at an offset from a head."""
    base = builder.bitcast(start, cgutils.voidptr_t)
    return cgutils.pointer_add(builder, base, offset, return_type=cgutils.voidptr_t)


def _said(context: Any, builder: Any, start: Any, at: int) -> Any:
    """The number at that byte of a head."""
    place = _place(builder, start, _number(context, at))
    return builder.load(builder.bitcast(place, cgutils.intp_t.as_pointer()))


def _lengths(context: Any, builder: Any, start: Any, sizes: list[tuple[bool, int]]) -> list[Any]:
    return [_number(context, n) if known else _said(context, builder, start, n) for known, n in sizes]


def _array(context: Any, builder: Any, kind: Any, place: Any, shape: list[Any]) -> Any:
    """An array that owns nothing."""
    made = arrayobj.make_array(kind)(context, builder)
    size = _number(context, CELL)
    arrayobj.populate_array(
        made,
        data=builder.bitcast(place, context.get_data_type(kind.dtype).as_pointer()),
        shape=shape,
        strides=[size] if len(shape) == 1 else [builder.mul(size, shape[1]), size],
        itemsize=size,
        meminfo=None,
    )
    return made._getvalue()


def _compiled(function: Callable[..., Any]) -> Any:
    """What numba puts into kernels where they call it, as machine code straight away."""
    return cast(Any, intrinsic)(function)


def _head(_typing: Any, cells: Any, dtype: Any) -> Any:
    kind = dtype.dtype

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, value=args[0])
        return builder.bitcast(array.data, context.get_value_type(kind))

    return kind(cells, dtype), code


def _stretch(dtype: Any) -> Callable[..., Any]:
    kind = types.Array(dtype, 1, "C")

    def stretch(_typing: Any, start: Any, _offset: Any, _n: Any) -> Any:
        def code(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
            return _array(context, builder, kind, _place(builder, args[0], args[1]), [args[2]])

        return kind(start, types.int64, types.int64), code

    return stretch


head: Callable[[FloatArray, np.dtype[Any]], Any] = _compiled(_head)
"""head(cells, DTYPE): the record at the start of an array of cells."""
line: Callable[[Any, int, int], FloatArray] = _compiled(_stretch(types.float64))
"""line(head, bytes, n): n float64 at an offset."""
integers: Callable[[Any, int, int], Any] = _compiled(_stretch(types.int64))
"""integers(head, bytes, n): n int64 at an offset."""
