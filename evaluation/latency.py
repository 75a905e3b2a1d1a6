"""How long a recognizer takes for a stroke, on one thread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from recognizer.claims import Recognizer
from sketch.ink import Ink


@dataclass(frozen=True, slots=True)
class Latency:
    """Milliseconds per stroke over n timed pages; None when there was nothing to time."""

    n: int
    p50: float | None
    p95: float | None


@dataclass(frozen=True, slots=True)
class LatencyRule:
    """How latency is taken."""

    pages: int = 300
    """At most so many pages are timed, evenly spread over the suite: p95 then rests on 15 of them."""
    warm_up: int = 20
    """Calls before the clock starts: caches, lazy imports and the first inference are no stroke's."""


RULE = LatencyRule()


def latency(recognizer: Recognizer, pages: Sequence[Ink], rule: LatencyRule = RULE) -> Latency:
    """Wall time of `recognize` on each page, features and all, divided by the page's strokes."""
    inked = [page for page in pages if len(page)]
    if not inked:
        return Latency(0, None, None)
    spread = np.unique(np.linspace(0, len(inked) - 1, min(rule.pages, len(inked))).astype(int))
    timed = [inked[k] for k in spread.tolist()]
    with threadpool_limits(limits=1):
        for k in range(rule.warm_up):
            recognizer.recognize(timed[k % len(timed)])
        milliseconds = [_timed(recognizer, page) for page in timed]
    return Latency(len(timed), float(np.percentile(milliseconds, 50)), float(np.percentile(milliseconds, 95)))


def _timed(recognizer: Recognizer, page: Ink) -> float:
    begun = perf_counter()
    recognizer.recognize(page)
    return 1000 * (perf_counter() - begun) / len(page)
