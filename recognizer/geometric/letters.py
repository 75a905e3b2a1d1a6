"""What the size of a page's letters tells of the strokes beside them.

Letters of one page are of one size: a mark as small as they are that stands among them is one of them, and a closed
outline several times as large is none. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.group import boxes_of
from sketch.ink import FloatArray, Ink


@dataclass(frozen=True, slots=True)
class LetterRule:
    """When letters have a size, and what is large and near beside it."""

    fewest: int = 2
    """Strokes of mathematics, at least, before their median size says anything."""
    small: float = 1.3
    """Size of a mark over the median letter's, at most: an arrow stands for a vector and is drawn larger than the
    letters that name it."""
    near: float = 0.5
    """Gap between a mark and the next letter over the letter's size, at most: half a letter, as within a word."""
    word: float = 1.0
    """The same between letters of one line: a letter's size, as between words."""
    large: float = 2.5
    """Size of an outline over the median letter's from which it is no letter: a capital beside an exponent is as much."""


LETTERS = LetterRule()


def marks(ink: Ink, pointing: Sequence[int], letters: Sequence[int], rule: LetterRule = LETTERS) -> list[int]:
    """Those of the strokes that look like arrows but are marks among the letters' strokes: an x below a v."""
    return _among(ink, pointing, letters, rule.small, rule.near, rule)


def written(
    ink: Ink, strange: Sequence[int], letters: Sequence[int], rule: LetterRule = LETTERS
) -> list[int]:
    """Those of the strange strokes that stand among letters and are no larger: letters of somebody's own."""
    return _among(ink, strange, letters, rule.large, rule.word, rule)


def _among(
    ink: Ink, strokes: Sequence[int], letters: Sequence[int], small: float, near: float, rule: LetterRule
) -> list[int]:
    """Those of the strokes that are at most `small` times as large as the median letter and within `near` of its size of
    another."""
    if not strokes or len(letters) < rule.fewest:
        return []
    own, boxes = boxes_of(ink, strokes), boxes_of(ink, letters)
    height = float(np.median(_sizes(boxes)))
    gaps = np.maximum(own[:, None, :2] - boxes[None, :, 2:], boxes[None, :, :2] - own[:, None, 2:])
    away = np.hypot(*np.maximum(gaps, 0.0).transpose(2, 0, 1))
    away[np.equal.outer(np.asarray(strokes), np.asarray(letters))] = np.inf  # itself
    found = (_sizes(own) <= small * height) & (away.min(axis=1) <= near * height)
    return [strokes[position] for position in np.flatnonzero(found).tolist()]


def too_large(
    ink: Ink, closed: Sequence[int], letters: Sequence[int], rule: LetterRule = LETTERS
) -> list[int]:
    """Those of the closed strokes that are too large to be letters beside these."""
    small = [index for index in letters if index not in set(closed)]
    if not closed or len(small) < rule.fewest:
        return []
    limit = rule.large * float(np.median(_sizes(boxes_of(ink, small))))
    found = _sizes(boxes_of(ink, closed)) > limit
    return [closed[position] for position in np.flatnonzero(found).tolist()]


def _sizes(boxes: FloatArray) -> FloatArray:
    return np.hypot(boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1])
