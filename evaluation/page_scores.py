"""Pages' scores drawn together, one number for each question."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from evaluation.metrics.strokes import accuracy, balanced_accuracy, confusion
from evaluation.page_contest import PageScore


@dataclass(frozen=True, slots=True)
class PageSummary:
    """Over n pages, None where there is nothing to tell.

    exact, components, grouping, ends, fixed, same_outcome: shares of pages; strokes,
    strokes_balanced: accuracy over all strokes of all pages after disambiguation; centre, radius,
    vertex: mean errors of corrected shapes, fractions of the diagram's size, angle: degrees;
    unread: share of true components without a counterpart of their kind; motion, motion_median: mean
    and median over pages of the motion error; same_verdict: share of pages with an answer on which it is judged alike;
    divergence: mean motion error at each of `metrics.motion.TIMES`.
    """

    n: int
    exact: float | None
    components: float | None
    grouping: float | None
    ends: float | None
    fixed: float | None
    strokes: float | None
    strokes_balanced: float | None
    centre: float | None
    radius: float | None
    vertex: float | None
    angle: float | None
    unread: float | None
    motion: float | None
    motion_median: float | None
    same_outcome: float | None
    same_verdict: float | None
    divergence: tuple[float, ...]


def summarize(pages: Sequence[PageScore]) -> PageSummary:
    """All pages count the same, whatever is on them."""
    strokes = [pair for page in pages for pair in page.strokes]
    table = confusion([true for true, _ in strokes], [claimed for _, claimed in strokes])
    compared = sum(page.geometry.compared for page in pages)
    missing = sum(page.geometry.missing for page in pages)
    return PageSummary(
        n=len(pages),
        exact=_mean(page.match.exact for page in pages),
        components=_mean(page.match.components for page in pages),
        grouping=_mean(page.match.grouping for page in pages),
        ends=_mean(page.match.ends for page in pages),
        fixed=_mean(page.match.fixed for page in pages),
        strokes=accuracy(table),
        strokes_balanced=balanced_accuracy(table),
        centre=_mean(page.geometry.centre for page in pages),
        radius=_mean(page.geometry.radius for page in pages),
        vertex=_mean(page.geometry.vertex for page in pages),
        angle=_mean(page.geometry.angle for page in pages),
        unread=missing / (compared + missing) if compared + missing else None,
        motion=_mean(page.motion.error for page in pages),
        motion_median=float(np.median([page.motion.error for page in pages])) if pages else None,
        same_outcome=_mean(page.same_outcome for page in pages),
        same_verdict=_mean(page.same_verdict for page in pages),
        divergence=_means([page.divergence for page in pages if page.divergence]),
    )


def by_problem(pages: Sequence[PageScore]) -> dict[str, PageSummary]:
    """A summary for each diagram, in the order in which they first come."""
    names = dict.fromkeys(page.problem for page in pages)
    return {name: summarize([page for page in pages if page.problem == name]) for name in names}


def _mean(values: Iterable[float | None]) -> float | None:
    known = [float(value) for value in values if value is not None]
    return float(np.mean(known)) if known else None


def _means(curves: Sequence[tuple[float, ...]]) -> tuple[float, ...]:
    return tuple(np.mean(curves, axis=0).tolist()) if curves else ()
