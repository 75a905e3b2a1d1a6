"""What the net looks at, as operators that ONNX knows: training, export and parity run this one text.

A stroke is `POINTS` points of equal spacing in its own frame (the middle of its bounding box at the
origin, its diagonal 1); two strokes of a page are compared in the page's frame (the same for the
page's box). All numbers are ratios of lengths or functions of angles, and all of them change little
where the ink changes little: a count that could jump at a rounding error would make the same ink
read differently by two runtimes. Frame: y down. Float32 throughout.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

Numbers = NDArray[np.float64]

POINTS = 64
"""Points of equal spacing that stand for a stroke: five for each leg of a twelve-legged zig-zag."""


@dataclass(frozen=True, slots=True)
class FeatureRule:
    """Numbers of the features. Lengths are of a stroke of size one."""

    spans: tuple[int, ...] = (1, 2, 5)
    """Points before and after over which a turn is taken: a corner drawn sharp, rounded, and a bend."""
    reversal: float = 0.02
    """A turn fades to nothing where the path runs straight back: its sense means nothing there."""
    still: float = 1e-3
    """Chords shorter than this have no direction."""
    aside: float = 0.004
    """Distance from a step's line over which being on one side of it becomes certain."""
    corner: float = 0.15
    """Sharpness (0 straight on, 1 back) of the wider turn above which it counts as a corner: 45 degrees."""
    thinnest: float = 1e-3
    """A stroke's spread across its main axis is never less than this of its spread along it, squared."""
    floor: float = 1e-6
    """Added to what is divided by and may be nothing. Not less: the exporter takes smaller numbers for zero."""
    directions: int = 18
    """Directions of the support function: 10 degrees apart over a half turn and back."""
    few_points: float = 12.0
    """A stroke with this many different points or more is not a dot; beyond it the count is not looked at."""


RULE = FeatureRule()

CHANNELS = (
    "x",
    "y",
    "heading x",
    "heading y",
    "sine of the turn",
    "sine of the wider turn",
    "sine of the bend",
    "sharpness of the turn",
    "sharpness of the wider turn",
    "sharpness of the bend",
    "distance from the centroid",
    "distance from the start",
    "distance from the end",
    "turned before less turned after",
    "crossings here",
)
BACKWARDS_SIGN = (1, 1, -1, -1, -1, -1, -1, 1, 1, 1, 1, 1, 1, 1, 1)
BACKWARDS_FROM = (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 11, 13, 14)
"""How the channels of a stroke drawn backwards follow: channel k is channel BACKWARDS_FROM[k], read from
its end, times BACKWARDS_SIGN[k]."""

WHOLE = (
    "gap of the ends over length",
    "gap of the ends over size",
    "log length over size",
    "width of the lesser axis over the greater",
    "turning, signed, turns",
    "turning, absolute, turns",
    "share of the turning in one sense",
    "sharpness, summed",
    "corners",
    "sharpest turn",
    "log of the crossings",
    "compactness of the enclosed area",
    "length over the hull's perimeter",
    "spread of the radius about the centroid",
    "spread of the radius in the whitened frame",
    "farthest from the chord",
    "gap that closing at the best crossing would leave",
    "different points (few)",
    "is a dot",
)


class Features(nn.Module):
    """paths (B, 64, 2) in the strokes' own frames (a stroke that never moved: zeros) and the number of
    different raw points (B,) -> sequence (B, 15, 64) and whole (B, 19).

    To a single stroke each operator costs more than its arithmetic, whence few of them: what is linear is one product
    with stored numbers, what is summed is summed together.
    """

    differences: Tensor
    turned: Tensor
    neighbours: Tensor
    support: Tensor
    girth: Tensor
    across: Tensor
    units: Tensor
    linear: Tensor
    constant: Tensor

    def __init__(self) -> None:
        super().__init__()
        linear, constant = _linear()
        angle = np.arange(2 * RULE.directions) * (np.pi / RULE.directions)
        stored = {
            "differences": _differences(),
            # Half turns so far less half of all, in turns of 2 pi.
            "turned": (np.triu(np.ones((POINTS, POINTS)), 1) + 0.5 * np.eye(POINTS) - 0.5) / (2 * np.pi),
            # What crosses a step counts half for each of its ends, in thirds.
            "neighbours": (np.eye(POINTS - 1, POINTS) + np.eye(POINTS - 1, POINTS, 1)) / 6,
            "support": np.stack([np.cos(angle), np.sin(angle)]),
            # The perimeter of the hull by Cauchy's formula: pi times the mean width.
            "girth": np.full((2 * RULE.directions, 1), np.pi / RULE.directions),
            # A vector, and it turned by a quarter.
            "across": np.array([[1, 0], [0, 1], [0, 1], [-1, 0]]),
            "units": np.array([2.0, 1.0, 1.0])[:, None],
            "linear": linear,
            "constant": constant,
        }
        for name, numbers in stored.items():
            self.register_buffer(name, torch.from_numpy(numbers.astype(np.float32)), persistent=False)

    def forward(self, paths: Tensor, distinct: Tensor) -> tuple[Tensor, Tensor]:
        xy = paths.transpose(1, 2)
        # Vectors and normals of all blocks: (B, 2, 2, 11, 64). What follows keeps four axes: (B, 1, rows, 64).
        both = (self.across @ (xy @ self.differences)).reshape(-1, 2, 2, BLOCKS, POINTS)
        vectors, normals = both.split(1, dim=1)
        lengths = _length(vectors, dim=2)
        come_length, away, leave_length, _, towards_length = lengths.split([3, 3, 3, 1, 1], dim=2)
        # Turns over each span, between the chord that comes in and the chord that leaves.
        reach = come_length * leave_length
        sure = 1.0 / (reach + RULE.still**2)
        products = (vectors[:, :, :, :4] * both[:, :, :, 6:10]).sum(dim=2)
        cosine, sine = (products[:, :, :3] * sure).split(1, dim=1)
        sharp = 0.5 * (reach * sure - cosine)
        sharpness, corner, _ = sharp.split(1, dim=2)
        turn = torch.atan(sine[:, :, :1] / (cosine[:, :, :1] + (1.0 + RULE.reversal)))
        steps = leave_length[:, :, :1]
        crossings = self._crossings(xy, normals[:, 0, :, 6], steps[:, 0])[:, None]
        sequence = torch.cat(
            [
                2.0 * xy[:, None],
                vectors[:, :, :, 10] / (towards_length + RULE.still),
                sine,
                sharp,
                away * self.units,
                turn @ self.turned,
                torch.clamp(crossings, max=1.0),
            ],
            dim=2,
        ).reshape(-1, len(CHANNELS), POINTS)
        middle = vectors[:, 0, :, 3]
        summands = torch.cat(
            [
                (middle[:, [0, 1, 0]] * middle[:, [0, 1, 1]])[:, None],
                steps,
                turn,
                turn.abs(),
                sharpness,
                torch.relu(corner - RULE.corner),
                crossings,
                products[:, 1:, 3:],
            ],
            dim=2,
        ).reshape(-1, len(SUMS), POINTS)
        beside = (vectors[:, 0, :, 4, POINTS - 1 :] * normals[:, 0, :, 4]).sum(dim=1).abs()
        ends = torch.cat([lengths[:, 0, 4:5, POINTS - 1], beside.amax(dim=1, keepdim=True)], dim=1)
        sharpest = corner.amax(dim=3)[:, 0]
        return sequence, self._whole(middle, away[:, 0, :1], summands, ends, sharpest, distinct)

    def _crossings(self, xy: Tensor, normal: Tensor, length: Tensor) -> Tensor:
        """How many other steps cross the steps beside each point, in thirds, (B, 1, 64).

        How far each point lies to the left of each step is a certainty between −1 and 1; neighbouring steps
        share a point, which lies on neither side, so that they never cross.
        """
        normal = normal / ((length + RULE.still) * RULE.aside)
        offset = (normal * xy).sum(dim=1, keepdim=True)
        side = torch.clamp(normal.transpose(1, 2) @ xy - offset.transpose(1, 2), -1.0, 1.0)[:, :-1]
        parted = torch.clamp(side[:, :, 1:] * side[:, :, :-1], max=0.0)
        return (parted * parted.transpose(1, 2)).sum(dim=1, keepdim=True) @ self.neighbours

    def _whole(
        self,
        middle: Tensor,
        radius: Tensor,
        summands: Tensor,
        ends: Tensor,
        sharpest: Tensor,
        distinct: Tensor,
    ) -> Tensor:
        """middle (B, 2, 64): where each point lies from the centroid, `radius` how far; summands (B, 10, 64) as `SUMS`;
        ends (B, 2): from the start to the end, and twice the greatest triangle over that."""
        chord, beside = ends.split(1, dim=1)
        figures = torch.addmm(self.constant, summands.sum(dim=2), self.linear)
        (
            quadratic,
            xy,
            uneven,
            mean,
            length,
            signed,
            absolute,
            sharpness,
            logged,
            area,
        ) = figures.split([3, 1, 2, 1, 1, 1, 1, 2, 1, 1], dim=1)
        still = (length == 0).float()
        length = length + still
        half = _length(uneven, keepdim=True)
        narrow = torch.sqrt((torch.relu(mean - half) + 10 * RULE.floor) / (mean + half + RULE.floor))
        # Radius once both spreads are made 1: by the inverse of the covariance, a straight line's too.
        white = quadratic[:, None] @ summands[:, :3]
        spreads = quadratic[:, :1] * quadratic[:, 1:2] - xy * xy
        whitened = torch.sqrt(torch.relu(white / spreads[:, None]) + RULE.floor)
        radii = torch.cat([radius, whitened], dim=1)
        mean_radii = radii.mean(dim=2, keepdim=True)
        strays = _length(radii - mean_radii, dim=2, keepdim=True)
        spread = (strays / ((mean_radii + RULE.floor) * POINTS**0.5))[:, :, 0]
        hull = (middle.transpose(1, 2) @ self.support).amax(dim=1) @ self.girth
        quarter = POINTS // 4
        gap = middle[:, :, :quarter, None] - middle[:, :, None, -quarter:]
        closing = _length(gap).amin(dim=(1, 2))[:, None]
        turning = signed.abs()
        drawn = torch.cat(
            [
                chord / length,
                chord,
                torch.log(length),
                narrow,
                turning,
                absolute,
                turning / (absolute + 0.1 / (2 * np.pi)),
                sharpness,
                sharpest,
                torch.log(logged),
                area.abs() / (length * length),
                length / (hull + still),
                spread,
                beside / ((chord + 0.05) * length),
                closing / length,
            ],
            dim=1,
        )
        few = torch.clamp(distinct[:, None], max=RULE.few_points) * (1 / RULE.few_points)
        return torch.cat([torch.clamp(drawn, -6.0, 6.0) * (1.0 - still), few, still], dim=1)


def _length(vectors: Tensor, dim: int = 1, keepdim: bool = False) -> Tensor:
    return torch.linalg.vector_norm(vectors, dim=dim, keepdim=keepdim)


def backwards(sequence: Tensor) -> Tensor:
    """The channels of the same strokes drawn from end to start, (B, 15, 64)."""
    sign = torch.tensor(BACKWARDS_SIGN, dtype=sequence.dtype)[:, None]
    return sequence[:, list(BACKWARDS_FROM)].flip(2) * sign


BLOCKS = 11
"""Vectors at each point: the chords before it over each span, where it lies from the centroid, the start and the end, the
chords after it, where the next point (of the last the first) lies from the centroid, and its heading."""


def _differences() -> Numbers:
    """(64, 64 · 11): a path's coordinates times this are all vectors that the features are made of. Chords that would
    leave the stroke are nothing, but for the steps themselves."""
    unit = np.eye(POINTS)
    place = np.arange(POINTS)
    chords: dict[bool, list[Numbers]] = {True: [], False: []}
    for before in (True, False):
        for span in RULE.spans:
            inside = (place >= span) & (place < POINTS - span)
            if span == 1 and not before:
                inside = place < POINTS - 1
            other = np.clip(place - span if before else place + span, 0, POINTS - 1)
            chord = unit[:, place] - unit[:, other] if before else unit[:, other] - unit[:, place]
            chords[before].append(chord * inside)
    towards = unit[:, np.minimum(place + 1, POINTS - 1)] - unit[:, np.maximum(place - 1, 0)]
    middle = unit - 1 / POINTS
    ends = [unit - unit[:, :1], unit - unit[:, -1:]]
    blocks = [*chords[True], middle, *ends, *chords[False], np.roll(middle, -1, axis=1), towards]
    return np.concatenate(blocks, axis=1)


SUMS = ("xx", "yy", "xy", "step", "turn", "absolute turn", "sharpness", "corner", "crossing", "swept")
"""What is summed over the points of a stroke, in the order of `Features._whole`."""


def _linear() -> tuple[Numbers, Numbers]:
    """What the sums are used for, as sums (B, 10) times (10, 14) plus (14,)."""
    xx, yy, xy, step, turn, absolute, sharpness, corner, crossing, swept = np.eye(len(SUMS))
    xx, yy, xy = xx / POINTS, yy / POINTS, xy / POINTS
    least = RULE.thinnest * (xx + yy)
    columns = [
        (yy + least, RULE.floor),
        (xx + least, RULE.floor),
        (-2 * xy, 0.0),
        (xy, 0.0),
        (0.5 * (xx - yy), 0.0),
        (xy, 0.0),
        (0.5 * (xx + yy), 0.0),
        (step, 0.0),
        # Turns are summed by halves, crossings in thirds.
        (turn / np.pi, 0.0),
        (absolute / np.pi, 0.0),
        (sharpness / 8, 0.0),
        (corner / 8, 0.0),
        (1.5 * crossing, 1.0),
        (2 * np.pi * swept, 0.0),
    ]
    return np.stack([column for column, _ in columns], axis=1), np.array([plus for _, plus in columns])
