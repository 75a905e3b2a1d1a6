"""Seconds to milliseconds and back as text, to the bit.

A float64 multiplied by 1000 and divided by 1000 is not always itself. Its shortest decimal with the
point moved is: so files hold the moved decimal, and reading moves the point back before rounding.
"""

from __future__ import annotations

from decimal import Decimal

_WHOLE = 1e15
_PLAIN_DIGITS = 20
"""Decimals whose first digit lies further from the point are written with an exponent."""


def shifted(value: float, places: int) -> str:
    """The shortest decimal that is this finite float64, times 10^places, as JSON and XML write numbers:
    shifted(0.25, 3) is '250'."""
    if value == 0:
        return repr(value)  # '-0.0' keeps its sign, which '-0' would lose
    moved = _moved(Decimal(repr(value)), places)
    return f"{moved:f}" if abs(moved.adjusted()) < _PLAIN_DIGITS else str(moved)


def unshifted(number: Decimal | int, places: int) -> float:
    """The float64 nearest to number / 10^places; ±inf when there is none."""
    return float(_moved(Decimal(number), -places))


def plainly(value: float) -> str:
    """A finite float64 as files by others have it: whole numbers without a point; zero keeps its sign."""
    return (
        str(int(value))
        if (value.is_integer() and 0 < abs(value) < _WHOLE) or str(value) == "0.0"
        else repr(value)
    )


def _moved(number: Decimal, places: int) -> Decimal:
    """number · 10^places, not rounded to any context's precision."""
    sign, digits, exponent = number.as_tuple()
    if not isinstance(exponent, int):
        return number  # infinite or NaN
    return Decimal((sign, digits, exponent + places))
