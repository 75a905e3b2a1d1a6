"""The simpler rival: signs told by $P's clouds of points and by their size on the line; all else is the reader's.

Vatavu, Anthony and Wobbrock, "Gestures as point clouds", ICMI 2012 (`recognizer.templates.dollar_p`). Templates are
generated ink, some of each sign. What the paper has no word for, and is fitted on generated ink: a
temperature, the spread of each sign's size, and how far a cloud may lie from all templates and still be a sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from io import BytesIO

import numpy as np

from recognizer.handwriting.line import Group, Line, box_of
from recognizer.handwriting.signs import COUNT
from recognizer.templates.dollar_p import DollarP, normalised
from recognizer.templates.points import IntArray
from sketch.ink import FloatArray, Ink, Stroke


@dataclass(frozen=True, slots=True)
class CloudRule:
    temperature: float = 0.12
    """Of distances, which are sums over 32 points of half the paper's weights: a right sign that is not the nearest lies
    0.1 to 0.4 behind it."""
    far: float = 1.25
    """Distance from which a group is rather no sign: nine tenths of signs lie nearer to a template."""
    slope: float = 3.0
    """Log-odds of being no sign for each unit of distance beyond it."""
    unlike: float = 20.0
    """The distance of a sign that there is no template of."""


RULE = CloudRule()


class CloudSigns:
    """templates (T, 32, 2) with labels (T,); sizes (signs, 4): mean and spread of the logarithms of width and height
    in the line's scale."""

    name = "dollar-p"

    def __init__(
        self, templates: FloatArray, labels: IntArray, sizes: FloatArray, rule: CloudRule = RULE
    ) -> None:
        self._matcher = DollarP(templates, labels)
        self._labels = labels
        self._sizes = sizes
        self._rule = rule

    def scores(self, line: Line, groups: Sequence[Group], alone: bool = False) -> FloatArray:
        drawings = [drawing(line, group) for group in groups]
        distances = np.full((len(groups), COUNT), self._rule.unlike)
        known = np.unique(self._labels)
        distances[:, known] = self._matcher.nearest(drawings)
        odds = -distances / self._rule.temperature
        if not alone:
            odds += self._size(line, groups)
        nothing = self._rule.slope * (distances.min(axis=1) - self._rule.far)
        real = -np.logaddexp(0.0, nothing)
        odds = odds - np.logaddexp.reduce(odds, axis=1, keepdims=True) + real[:, None]
        return np.column_stack([odds, -np.logaddexp(0.0, -nothing)])

    def _size(self, line: Line, groups: Sequence[Group]) -> FloatArray:
        seen = np.array([size(line, group) for group in groups])
        mean, spread = self._sizes[:, :2], self._sizes[:, 2:]
        apart = (seen[:, None] - mean[None]) / spread[None]
        return -0.5 * (apart**2).sum(axis=2) - np.log(spread).sum(axis=1)[None]


def drawing(line: Line, group: Group) -> Ink:
    """A group's strokes as ink."""
    starts = np.concatenate([[0], line.ends[:-1]])
    return Ink(tuple(Stroke(line.points[starts[k] : line.ends[k]]) for k in group))


def size(line: Line, group: Group) -> FloatArray:
    """Logarithms of a group's width and height in the line's scale, (2,); what is thinner than 0.03 is 0.03."""
    box = box_of(line, group)
    return np.log(np.maximum((box[2:] - box[:2]) / line.scale, 0.03))


def packed(drawings: Sequence[Ink], labels: IntArray, sizes: FloatArray) -> bytes:
    """Templates as a file."""
    file = BytesIO()
    clouds = np.round(normalised(drawings) * 127 / 1.2).clip(-127, 127).astype(np.int8)
    np.savez_compressed(file, clouds=clouds, labels=labels.astype(np.int16), sizes=sizes.astype(np.float32))
    return file.getvalue()


@cache
def taught() -> CloudSigns:
    """The rival as shipped."""
    file = resources.files("recognizer.handwriting").joinpath("weights/clouds.npz").read_bytes()
    with np.load(BytesIO(file)) as found:
        clouds = found["clouds"].astype(np.float64) * (1.2 / 127)
        return CloudSigns(clouds, found["labels"].astype(np.int64), found["sizes"].astype(np.float64))
