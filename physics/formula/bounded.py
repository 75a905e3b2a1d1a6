"""Work that is stopped when it takes too long.

SymPy's solvers have no limit of their own, and an equation of one line can keep them busy for hours.
A signal would need the main thread, a process of its own takes half a second to start, and a thread
cannot be stopped. So calls are counted, by the hook that profilers use (`sys.setprofile`, which is of
this thread alone): SymPy is Python, and does nothing for long without calling a function. Counting
has the further merit that the same page is solved, or not, on a slow machine as on a fast one.
A single call into C cannot be stopped; the sizes of what is given to the solver are bounded for that.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from time import perf_counter
from types import FrameType
from typing import TypeVar

T = TypeVar("T")


class _Enough(BaseException):
    """Not an Exception: a library's own handlers must not take it for theirs."""


def bounded(work: Callable[[], T], calls: int, seconds: float) -> T | None:
    """What the work gives, None when it makes more than so many calls or takes longer than `seconds`."""
    spent = 0
    until = perf_counter() + seconds

    def count(frame: FrameType, event: str, argument: object) -> None:
        nonlocal spent
        del frame, event, argument
        spent += 1
        if spent > calls or (spent % 1024 == 0 and perf_counter() > until):
            raise _Enough

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        return work()
    except _Enough:
        return None
    finally:
        sys.setprofile(before)
