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
from torch import Tensor, nn

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

    Columns stay columns, (B, 1), and what is summed is summed together: to a single stroke each operator
    costs more than its arithmetic.
    """

    differences: Tensor
    support: Tensor
    units: Tensor

    def __init__(self) -> None:
        super().__init__()
        self.register_buffer("differences", torch.from_numpy(_differences()), persistent=False)
        angle = np.arange(RULE.directions) * (np.pi / RULE.directions)
        directions = np.stack([np.cos(angle), np.sin(angle)]).astype(np.float32)
        self.register_buffer("support", torch.from_numpy(directions), persistent=False)
        units = [2.0, 1.0, 1.0, 1 / (4 * np.pi)]
        self.register_buffer("units", torch.tensor(units, dtype=torch.float32)[:, None], persistent=False)

    def forward(self, paths: Tensor, distinct: Tensor) -> tuple[Tensor, Tensor]:
        spans = len(RULE.spans)
        xy = paths.transpose(1, 2)
        vectors = (xy @ self.differences).reshape(-1, 2, 2 * spans + 4, POINTS)
        lengths = torch.sqrt((vectors * vectors).sum(dim=1))
        come, leave, towards, others = vectors.split([spans, spans, 1, 3], dim=2)
        come_length, leave_length, towards_length, away = lengths.split([spans, spans, 1, 3], dim=1)
        # Turns over each span, between the chord that comes in and the chord that leaves.
        both = come_length * leave_length
        sure = 1.0 / (both + RULE.still**2)
        cosine = (come * leave).sum(dim=1) * sure
        sine = _cross(come, leave) * sure
        sharp = 0.5 * (both * sure - cosine)
        turn = 2.0 * torch.atan(sine[:, :1] / (cosine[:, :1] + (1.0 + RULE.reversal)))
        turned = torch.cumsum(turn, dim=2)
        crossed = self._crossed(xy, leave[:, :, 0], leave_length[:, :1])
        crossings = 0.5 * (crossed + nn.functional.pad(crossed[:, :, :-1], (1, 0)))
        sequence = torch.cat(
            [
                2.0 * xy,
                (towards / (towards_length[:, None] + RULE.still))[:, :, 0],
                sine,
                sharp,
                torch.cat([away, turned - 0.5 * (turn + turned[:, :, -1:])], dim=1) * self.units,
                torch.clamp(crossings, max=3.0) * (1 / 3),
            ],
            dim=1,
        )
        return sequence, self._whole(others, leave_length[:, :1], away, turn, sharp, crossed, distinct)

    def _crossed(self, xy: Tensor, step: Tensor, length: Tensor) -> Tensor:
        """How many other steps cross the step that leaves each point, (B, 1, 64); none at the last.

        How far each point lies to the left of each step is a certainty between −1 and 1; neighbouring steps
        share a point, which lies on neither side, so that they never cross.
        """
        steps = step / ((length + RULE.still) * RULE.aside)
        normal = torch.cat([-steps[:, 1:], steps[:, :1]], dim=1)
        offset = (normal * xy).sum(dim=1, keepdim=True)
        side = torch.clamp(normal.transpose(1, 2) @ xy - offset.transpose(1, 2), -1.0, 1.0)
        parted = torch.clamp(side[:, :-1, 1:] * side[:, :-1, :-1], max=0.0)
        crossed = (parted * parted.transpose(1, 2)).sum(dim=1, keepdim=True)
        return nn.functional.pad(crossed, (0, 1))

    def _whole(
        self,
        others: Tensor,
        steps: Tensor,
        away: Tensor,
        turn: Tensor,
        sharp: Tensor,
        crossed: Tensor,
        distinct: Tensor,
    ) -> Tensor:
        """others (B, 2, 3, 64): where each point lies from the centroid, the start and the end, `away` how far."""
        middle, from_start, _ = others.unbind(dim=2)
        radius = away[:, :1]
        squares = middle * middle
        product = middle[:, :1] * middle[:, 1:]
        around = torch.cat([middle, middle[:, :, :1]], dim=2)
        swept = _cross(around[:, :, :-1], around[:, :, 1:])
        corners = torch.relu(sharp[:, 1:2] - RULE.corner)
        summed = torch.cat(
            [steps, turn, turn.abs(), sharp[:, :1], corners, crossed, swept[:, None], squares, product], dim=1
        ).sum(dim=2)
        length, signed, absolute, sharpness, cornered, crossings, area, sum_xx, sum_yy, sum_xy = summed.split(
            1, dim=1
        )
        still = (length == 0).float()
        length = length + still
        xx, yy, xy = (total * (1 / POINTS) for total in (sum_xx, sum_yy, sum_xy))
        half = torch.sqrt(0.25 * (xx - yy) ** 2 + xy * xy)
        mean = 0.5 * (xx + yy)
        narrow = torch.sqrt((torch.relu(mean - half) + 10 * RULE.floor) / (mean + half + RULE.floor))
        # Radius once both spreads are made 1: by the inverse of the covariance, a straight line's too.
        least = RULE.thinnest * (xx + yy) + RULE.floor
        thick = torch.cat([yy + least, xx + least], dim=1)
        white = (squares * thick[:, :, None]).sum(dim=1) - 2 * xy * product[:, 0]
        white = white / (thick[:, :1] * thick[:, 1:] - xy * xy)
        whitened = torch.sqrt(torch.relu(white) + RULE.floor)
        radii = torch.stack([radius[:, 0], whitened], dim=1)
        mean_radii = radii.mean(dim=2, keepdim=True)
        spread = torch.sqrt(((radii - mean_radii) ** 2).mean(dim=2)) / (mean_radii[:, :, 0] + RULE.floor)
        shadow = middle.transpose(1, 2) @ self.support
        hull = np.pi * (shadow.amax(dim=1) - shadow.amin(dim=1)).mean(dim=1, keepdim=True)
        end = from_start[:, :, -1:]
        beside = _cross(end, from_start).abs().amax(dim=1, keepdim=True)
        chord = away[:, 1, -1:]
        quarter = POINTS // 4
        gap = middle[:, :, :quarter, None] - middle[:, :, None, -quarter:]
        closing = torch.sqrt((gap * gap).sum(dim=1).amin(dim=(1, 2)))[:, None]
        turning = signed.abs()
        drawn = torch.cat(
            [
                chord / length,
                chord,
                torch.log(length),
                narrow,
                turning * (1 / (2 * np.pi)),
                absolute * (1 / (2 * np.pi)),
                turning / (absolute + 0.1),
                sharpness * (1 / 8),
                cornered * (1 / 8),
                sharp[:, 1].amax(dim=1, keepdim=True),
                torch.log1p(0.5 * crossings),
                2 * np.pi * area.abs() / (length * length),
                length / (hull + still),
                spread,
                beside / ((chord + 0.05) * length),
                closing / length,
            ],
            dim=1,
        )
        few = torch.clamp(distinct[:, None], max=RULE.few_points) * (1 / RULE.few_points)
        return torch.cat([torch.clamp(drawn, -6.0, 6.0) * (1.0 - still), few, still], dim=1)


def _cross(one: Tensor, other: Tensor) -> Tensor:
    """Cross products of vectors (B, 2, …) -> (B, …)."""
    return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]


def backwards(sequence: Tensor) -> Tensor:
    """The channels of the same strokes drawn from end to start, (B, 15, 64)."""
    sign = torch.tensor(BACKWARDS_SIGN, dtype=sequence.dtype)[:, None]
    return sequence[:, list(BACKWARDS_FROM)].flip(2) * sign


def _differences() -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
    """(64, 64 k): a path's coordinates times this are all vectors that the features are made of. Blocks of
    64 columns: the chords before a point over each span, those after it, its heading, and where it lies
    from the centroid, the start and the end. Chords that would leave the stroke are nothing."""
    unit = np.eye(POINTS)
    place = np.arange(POINTS)
    blocks: list[np.ndarray[tuple[int, int], np.dtype[np.float64]]] = []
    for before in (True, False):
        for span in RULE.spans:
            inside = (place >= span) & (place < POINTS - span)
            if span == 1 and not before:
                inside = place < POINTS - 1  # also the steps themselves
            other = np.clip(place - span if before else place + span, 0, POINTS - 1)
            chord = unit[:, place] - unit[:, other] if before else unit[:, other] - unit[:, place]
            blocks.append(chord * inside)
    blocks.append(unit[:, np.minimum(place + 1, POINTS - 1)] - unit[:, np.maximum(place - 1, 0)])
    blocks.append(unit - 1 / POINTS)
    blocks.append(unit - unit[:, :1])
    blocks.append(unit - unit[:, -1:])
    return np.concatenate(blocks, axis=1).astype(np.float32)
