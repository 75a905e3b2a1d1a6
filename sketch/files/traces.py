"""The text of an InkML trace (W3C 2011, section 3.2): points, one value a channel, differences and all.

    1125 18432, '23 '43, "7 "-8, 3 -5, * *

A mark holds for its channel until the next: `!` the value itself, `'` the change since the last point,
`"` the change of that change; `*` repeats what was last given; `?` is unknown.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Context, Decimal

from sketch.ink import LIMITS

_VALUE = re.compile(r"\s*([!'\"]?)\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[*?TF])")
_ORDERS = {"!": 0, "'": 1, '"': 2}
_WIDE = Context(prec=700)
"""Digits enough to add any two float64 in decimal without rounding."""


class TraceError(ValueError):
    """What is wrong with a trace's text."""


@dataclass(slots=True)
class _Channel:
    """What a channel was last given: its value, velocity and acceleration, and which of them is meant."""

    order: int = 0
    value: Decimal = Decimal(0)
    velocity: Decimal = Decimal(0)
    acceleration: Decimal = Decimal(0)

    def take(self, mark: str, text: str) -> Decimal:
        if mark:
            self.order = _ORDERS[mark]
        last = (self.value, self.velocity, self.acceleration)[self.order]
        given = last if text == "*" else Decimal(text)
        match self.order:
            case 0:
                change = _WIDE.subtract(given, self.value)
                self.value, self.velocity, self.acceleration = given, change, Decimal(0)
            case 1:
                self.velocity, self.acceleration = given, Decimal(0)
                self.value = _WIDE.add(self.value, given)
            case _:
                self.acceleration = given
                self.velocity = _WIDE.add(self.velocity, given)
                self.value = _WIDE.add(self.value, self.velocity)
        return self.value


def points(text: str, regular: int, intermittent: int = 0) -> list[list[Decimal | None]]:
    """The values of the regular channels at every point; None where the trace says `?` or a truth value.

    Values beyond the regular channels, up to `intermittent` of them, are passed over. Raises TraceError.
    """
    if not text.strip():
        return []
    count = text.count(",") + 1
    if count > LIMITS.points:
        raise TraceError(f"a trace of {count} points; at most {LIMITS.points} are accepted")
    channels = [_Channel() for _ in range(regular)]
    found: list[list[Decimal | None]] = []
    for index, written in enumerate(text.split(",")):
        values = _values(written, index)
        if not regular <= len(values) <= regular + intermittent:
            raise TraceError(
                f"point {index} ({written.strip()[:40]!r}) has {len(values)} values; the format has {regular} channels"
            )
        try:
            found.append(
                [
                    None if value in ("?", "T", "F") else channel.take(mark, value)
                    for channel, (mark, value) in zip(channels, values[:regular], strict=True)
                ]
            )
        except ArithmeticError:
            raise TraceError(f"point {index} holds a number too large to reckon with") from None
    return found


def _values(written: str, index: int) -> list[tuple[str, str]]:
    values: list[tuple[str, str]] = []
    at, end = 0, len(written.rstrip())
    while at < end:
        match = _VALUE.match(written, at)
        if match is None:
            raise TraceError(f"point {index} ({written.strip()[:40]!r}) holds what is no number")
        values.append((match.group(1), match.group(2)))
        at = match.end()
    return values
