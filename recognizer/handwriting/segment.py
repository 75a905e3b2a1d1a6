"""Strokes shared out among signs: the likeliest ways to cover a line by groups, none of them twice.

Each stroke's probability is that of its group being a sign, so that two strokes taken as one sign and as
two are weighed alike. A beam takes the strokes in drawing order: the first one that is still free belongs
to a group whose first stroke it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.handwriting.line import Group
from recognizer.handwriting.search.cover import cover
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class SegmentRule:
    width: int = 30
    """States of the beam."""
    kept: int = 4
    """Ways that are read."""
    unlikely: float = 7.0
    """Ways this far below the best are not read: natural logarithm."""


RULE = SegmentRule()


@dataclass(frozen=True, slots=True)
class Covering:
    """A way to share out the strokes: positions of its groups, and the logarithm of its chance beyond that of each
    group's sign, which is counted once where signs are chosen."""

    groups: tuple[int, ...]
    score: float


def coverings(
    strokes: int, groups: Sequence[Group], scores: FloatArray, rule: SegmentRule = RULE
) -> list[Covering]:
    """The likeliest coverings of strokes 0 … n − 1, the best first; groups as `line.groups` sorts them, scores
    (groups, signs + 1) as of `SignReader`."""
    real = np.log(np.maximum(-np.expm1(np.minimum(scores[:, -1], -1e-9)), 1e-12))
    sizes = np.array([len(group) for group in groups])
    members = np.concatenate([np.array(group) for group in groups])
    # Each stroke vouches for its group being a sign and for which: a word is no cheaper than its letters.
    told = scores[:, :-1].max(axis=1) - real
    each = real + told
    best = np.full(strokes, -np.inf)
    np.maximum.at(best, members, np.repeat(each, sizes))
    ends = np.cumsum(sizes)
    costs = sizes * each - np.add.reduceat(best[members], ends - sizes)
    found, chosen, counts = cover(strokes, members, ends, costs, rule.width)
    value = real * sizes + told * (sizes - 1)
    return [
        Covering(tuple(chosen[k, : counts[k]].tolist()), float(value[chosen[k, : counts[k]]].sum()))
        for k in range(min(rule.kept, len(found)))
        if found[k] > found[0] - rule.unlikely
    ]
