"""Strokes as they left the pen.

Frame: page units, x to the right, y *down* (as screens and InkML have it); times in
seconds from any origin; pressure in the device's own range, usually 0 to 1.

`Stroke` and `Ink` are the border of the house: what they hold has been checked, so that
everything further in may trust it. What is refused is refused with an `InkError` that says
what, where and what would be right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


class InkError(ValueError):
    """Ink that cannot be a pen's: the message says what, where and what would be right."""


@dataclass(frozen=True, slots=True)
class InkLimits:
    """What one page may hold. Generous: a day of writing at 250 Hz stays below each."""

    strokes: int = 20_000
    """Strokes on a page. A dense page of mathematics has some 500."""
    points: int = 200_000
    """Points in one stroke: 13 minutes at 250 Hz without lifting the pen."""
    total_points: int = 5_000_000
    """Points on a page: 120 MB as float64 triples."""
    coordinate: float = 1e9
    """Largest |x| or |y|: beyond it, squares of distances lose the digits a page needs."""


LIMITS = InkLimits()


@dataclass(frozen=True, slots=True, eq=False)
class Stroke:
    """One pen-down to pen-up.

    points: (n, 2) page units, n >= 1 (one point is a dot); times: (n,) seconds, never
    decreasing, or None when the source had none; pressure: (n,) or None.
    Equal when every number is the same to the bit. Arrays are read-only copies.

    Raises InkError on an empty stroke, wrong shapes, NaN or infinite values, coordinates beyond
    `LIMITS.coordinate`, times that run backwards, too many points.
    """

    points: FloatArray
    times: FloatArray | None = None
    pressure: FloatArray | None = None

    def __init__(
        self, points: ArrayLike, times: ArrayLike | None = None, pressure: ArrayLike | None = None
    ) -> None:
        checked = _numbers(points, "points")
        if checked.ndim != 2 or checked.shape[1] != 2:
            raise InkError(f"points have shape {checked.shape}; a stroke needs (n, 2): x and y of each point")
        if len(checked) == 0:
            raise InkError("a stroke without points; it needs at least one")
        if len(checked) > LIMITS.points:
            raise InkError(f"a stroke of {len(checked)} points; at most {LIMITS.points} are accepted")
        far = np.abs(checked) > LIMITS.coordinate
        if far.any():
            at = int(np.argwhere(far)[0][0])
            raise InkError(
                f"point {at} lies at ({checked[at, 0]:g}, {checked[at, 1]:g}); "
                f"coordinates beyond ±{LIMITS.coordinate:g} are not accepted"
            )
        object.__setattr__(self, "points", checked)
        object.__setattr__(self, "times", _channel(times, "times", len(checked)))
        object.__setattr__(self, "pressure", _channel(pressure, "pressure", len(checked)))
        if self.times is not None and len(self.times) > 1:
            backwards = self.times[1:] < self.times[:-1]
            if backwards.any():
                at = int(np.argmax(backwards)) + 1
                raise InkError(
                    f"time runs backwards at point {at}: {self.times[at]:g} s after {self.times[at - 1]:g} s; "
                    "times must not decrease (leave them out if they are not known)"
                )

    @classmethod
    def trusted(cls, points: FloatArray, times: FloatArray | None, pressure: FloatArray | None) -> Stroke:
        """A stroke of arrays that are known to be right, taken as they are and made read-only: nothing is
        checked or copied. For ink made inside the house by the hundred thousand."""
        stroke = object.__new__(cls)
        for name, channel in (("points", points), ("times", times), ("pressure", pressure)):
            if channel is not None:
                channel.setflags(write=False)
            object.__setattr__(stroke, name, channel)
        return stroke

    def __len__(self) -> int:
        return len(self.points)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Stroke) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> tuple[Any, ...]:
        return Stroke, (self.points, self.times, self.pressure)

    def _key(self) -> tuple[bytes | None, ...]:
        return tuple(
            None if channel is None else channel.tobytes()
            for channel in (self.points, self.times, self.pressure)
        )

    def moved_to(self, points: ArrayLike) -> Stroke:
        """The same pen motion (times, pressure) along other points, (n, 2)."""
        return Stroke(points, self.times, self.pressure)


@dataclass(frozen=True, slots=True)
class Ink:
    """The strokes of a page, in the order in which they were drawn.

    Raises InkError when there are more strokes or points than `LIMITS` allows. No strokes at
    all is an empty page, which is fine.
    """

    strokes: tuple[Stroke, ...] = ()

    def __post_init__(self) -> None:
        if len(self.strokes) > LIMITS.strokes:
            raise InkError(f"a page of {len(self.strokes)} strokes; at most {LIMITS.strokes} are accepted")
        total = sum(len(stroke) for stroke in self.strokes)
        if total > LIMITS.total_points:
            raise InkError(f"a page of {total} points; at most {LIMITS.total_points} are accepted")

    def __len__(self) -> int:
        return len(self.strokes)

    def __iter__(self) -> Iterator[Stroke]:
        return iter(self.strokes)

    def __getitem__(self, index: int) -> Stroke:
        return self.strokes[index]

    def points_of(self, indices: Sequence[int]) -> FloatArray:
        """All points of the strokes named, one below the other: (n, 2)."""
        if not indices:
            return np.empty((0, 2))
        return np.concatenate([self.strokes[index].points for index in indices])

    def bounds(self) -> tuple[float, float, float, float]:
        """(left, top, right, bottom) of all ink; (0, 0, 0, 0) for an empty page."""
        if not self.strokes:
            return (0.0, 0.0, 0.0, 0.0)
        low = np.min([stroke.points.min(axis=0) for stroke in self.strokes], axis=0)
        high = np.max([stroke.points.max(axis=0) for stroke in self.strokes], axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def readonly(values: ArrayLike) -> FloatArray:
    """A float64 copy that nobody can write to."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def _channel(values: ArrayLike | None, name: str, length: int) -> FloatArray | None:
    if values is None:
        return None
    array = _numbers(values, name)
    if array.shape != (length,):
        raise InkError(f"{name} have shape {array.shape}; one value per point is needed: ({length},)")
    return array


def _numbers(values: ArrayLike, name: str) -> FloatArray:
    try:
        array = readonly(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise InkError(f"{name} must be numbers in a regular array: {error}") from None
    finite = np.isfinite(array)
    if not finite.all():
        at = int(np.argwhere(~finite)[0][0])
        raise InkError(f"{name} {at} is not a finite number; NaN and infinity are not accepted")
    return array
