"""What somebody sent, as the values that it must be: each function says what is wrong with what is not."""

from __future__ import annotations

import re
from typing import Any, cast

import numpy as np

from sketch.ink import FloatArray, InkError, Stroke
from sketch.shapes import Point
from studio.limits import LIMITS, Refused


def text_of(value: object, name: str, most: int | None) -> str:
    """Text of at most so many characters. Raises Refused."""
    if not isinstance(value, str) or (most is not None and len(value) > most):
        raise Refused(f"{name} must be text{'' if most is None else f' of at most {most} characters'}")
    if any("\ud800" <= letter <= "\udfff" for letter in value):
        raise Refused(f"{name} holds half of a surrogate pair, which is no character")
    return value


def number_of(value: object, name: str) -> float:
    """A finite number within `LIMITS.coordinate`. Raises Refused."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= LIMITS.coordinate:
        raise Refused(f"{name} must be a number of at most ±{LIMITS.coordinate:g}")
    return float(value)


def whole_of(value: object, name: str) -> int:
    """A whole number from 0. Raises Refused."""
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 1_000_000:
        raise Refused(f"{name} must be a whole number from 0")
    return value


def point_of(value: object, name: str) -> Point:
    """Two numbers. Raises Refused."""
    pair = list_of(value, name)
    if len(pair) != 2:
        raise Refused(f"{name} must be two numbers, x and y")
    return (number_of(pair[0], name), number_of(pair[1], name))


def list_of(value: object, name: str) -> list[Any]:
    """A list that is not too long. Raises Refused."""
    if not isinstance(value, list | tuple) or len(cast(list[Any], value)) > LIMITS.strokes:
        raise Refused(f"{name} must be a list of at most {LIMITS.strokes} items")
    return list(cast(list[Any], value))


def stroke_of(item: dict[str, Any]) -> Stroke:
    """A stroke from its points [[x, y], …] and, where they are known, times (s) and pressures, one for each point.
    Raises Refused."""
    points = item.get("points")
    if not isinstance(points, list) or not points:
        raise Refused("a stroke needs points: a list of [x, y], at least one")
    rows = cast(list[Any], points)
    if len(rows) > LIMITS.points:
        raise Refused(f"a stroke of {len(rows)} points; at most {LIMITS.points} are accepted")
    if not all(isinstance(row, list) and len(cast(list[Any], row)) == 2 for row in rows):
        raise Refused("each point of a stroke must be two numbers, x and y")
    channels: dict[str, FloatArray | None] = {}
    for name in ("times", "pressure"):
        given = item.get(name)
        if given is not None and (not isinstance(given, list) or len(cast(list[Any], given)) != len(rows)):
            raise Refused(f"{name} must be a list with one number for each of the {len(rows)} points")
        channels[name] = None if given is None else _floats(cast(list[Any], given), name)
    array = _floats(rows, "points")
    if float(np.abs(array).max()) > LIMITS.coordinate:
        raise Refused(f"a point lies beyond ±{LIMITS.coordinate:g}; pages are smaller than that")
    try:
        return Stroke(array, channels["times"], channels["pressure"])
    except InkError as error:
        raise Refused(str(error)) from None


def _floats(values: list[Any], name: str) -> FloatArray:
    """Numbers, and nothing that could be taken for one: no text, no true or false."""
    flat = [value for row in values for value in (cast(list[Any], row) if isinstance(row, list) else [row])]
    if any(isinstance(value, bool) or not isinstance(value, int | float) for value in flat):
        raise Refused(f"{name} must be numbers")
    try:
        array = np.array(values, dtype=np.float64)
    except (ValueError, OverflowError):
        raise Refused(f"{name} must be numbers in a regular list") from None
    if not np.isfinite(array).all():
        raise Refused(f"{name} must be finite numbers")
    return array


_KEY = re.compile(r"[A-Za-z0-9_-]{1,64}")


def key_of(item: dict[str, Any]) -> str:
    """The key by which a message that is sent twice is carried out once. Raises Refused."""
    key = item.get("key")
    if not isinstance(key, str) or not _KEY.fullmatch(key):
        raise Refused("key must be 1 to 64 letters, digits, - or _ that no other message of this page bears")
    return key
