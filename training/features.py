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
    different raw points (B,) -> sequence (B, 15, 64) and whole (B, 19)."""

    differences: Tensor
    apart: Tensor
    support: Tensor

    def __init__(self) -> None:
        super().__init__()
        self.register_buffer("differences", torch.from_numpy(_differences()), persistent=False)
        between = np.abs(np.subtract.outer(np.arange(POINTS - 1), np.arange(POINTS - 1)))
        self.register_buffer("apart", torch.from_numpy((between >= 2).astype(np.float32)), persistent=False)
        angle = np.arange(RULE.directions) * (np.pi / RULE.directions)
        directions = np.stack([np.cos(angle), np.sin(angle)]).astype(np.float32)
        self.register_buffer("support", torch.from_numpy(directions), persistent=False)

    def forward(self, paths: Tensor, distinct: Tensor) -> tuple[Tensor, Tensor]:
        spans = len(RULE.spans)
        xy = paths.transpose(1, 2)
        vectors = (xy @ self.differences).reshape(-1, 2, 2 * spans + 4, POINTS)
        x, y = vectors[:, 0], vectors[:, 1]
        lengths = torch.sqrt(x * x + y * y)
        # Turns over each span: the chord that comes in and the chord that leaves.
        ax, bx, ay, by = x[:, :spans], x[:, spans : 2 * spans], y[:, :spans], y[:, spans : 2 * spans]
        both = lengths[:, :spans] * lengths[:, spans : 2 * spans]
        sure = 1.0 / (both + RULE.still**2)
        cosine, sine = (ax * bx + ay * by) * sure, (ax * by - ay * bx) * sure
        sharp = 0.5 * (both * sure - cosine)
        turn = 2.0 * torch.atan(sine[:, 0] / (1.0 + RULE.reversal + cosine[:, 0]))
        before = torch.cumsum(turn, dim=1)
        signed = before[:, -1:]
        # Sides: how far each point lies to the left of each step, as certainty between -1 and 1.
        step_x, step_y, step = x[:, spans, :-1], y[:, spans, :-1], lengths[:, spans, :-1]
        normal = torch.stack([-step_y, step_x], dim=1) / (step[:, None] + RULE.still)
        offset = (normal * xy[:, :, :-1]).sum(dim=1)
        side = torch.clamp((normal.transpose(1, 2) @ xy - offset[..., None]) * (1 / RULE.aside), -1.0, 1.0)
        parted = torch.relu(-side[:, :, 1:] * side[:, :, :-1])
        crossed = (parted * parted.transpose(1, 2) * self.apart).sum(dim=2)
        crossings = 0.5 * (nn.functional.pad(crossed, (0, 1)) + nn.functional.pad(crossed, (1, 0)))
        heading = vectors[:, :, 2 * spans] / (lengths[:, None, 2 * spans] + RULE.still)
        away = lengths[:, 2 * spans + 1 :]
        sequence = torch.cat(
            [
                2.0 * xy,
                heading,
                sine,
                sharp,
                2.0 * away[:, :1],
                away[:, 1:],
                (before - 0.5 * (turn + signed))[:, None] * (1 / (4 * np.pi)),
                torch.clamp(crossings, max=3.0)[:, None] * (1 / 3),
            ],
            dim=1,
        )
        whole = self._whole(vectors, lengths, turn, sharp, crossed, distinct)
        return sequence, whole

    def _whole(
        self, vectors: Tensor, lengths: Tensor, turn: Tensor, sharp: Tensor, crossed: Tensor, distinct: Tensor
    ) -> Tensor:
        spans = len(RULE.spans)
        steps, radius = lengths[:, spans, :-1], lengths[:, 2 * spans + 1]
        still = (steps.sum(dim=1) == 0).float()
        moving = 1.0 - still
        length = steps.sum(dim=1) + still
        chord = lengths[:, 2 * spans + 2, -1]
        middle = vectors[:, :, 2 * spans + 1]
        x, y = middle[:, 0], middle[:, 1]
        means = torch.stack([x * x, y * y, x * y, radius], dim=1).mean(dim=2)
        xx, yy, xy, mean_radius = means[:, 0], means[:, 1], means[:, 2], means[:, 3]
        half = torch.sqrt(0.25 * (xx - yy) ** 2 + xy * xy)
        greater = 0.5 * (xx + yy) + half + 1e-9
        lesser = torch.clamp(0.5 * (xx + yy) - half, min=0.0) + 1e-5
        # Squared radius once both spreads are made 1: by the inverse of the covariance, a straight line's too.
        least = RULE.thinnest * (xx + yy) + 1e-6
        thick_x, thick_y = xx + least, yy + least
        white = thick_y[:, None] * x * x + thick_x[:, None] * y * y - 2 * xy[:, None] * x * y
        white = white / (thick_x * thick_y - xy * xy + 1e-12)[:, None]
        whitened = torch.sqrt(torch.clamp(white, min=0.0) + 1e-6)
        white_mean = whitened.mean(dim=1)
        white_spread = torch.sqrt(((whitened - white_mean[:, None]) ** 2).mean(dim=1) + 1e-9)
        spread = torch.sqrt(((radius - mean_radius[:, None]) ** 2).mean(dim=1) + 1e-9)
        # Shoelace about the centroid; the closing side counts too.
        area = 0.5 * ((x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:]).sum(dim=1) + x[:, -1] * y[:, 0] - y[:, -1] * x[:, 0])
        shadow = middle.transpose(1, 2) @ self.support
        hull = np.pi * (shadow.amax(dim=1) - shadow.amin(dim=1)).mean(dim=1)
        from_start = vectors[:, :, 2 * spans + 2]
        end = from_start[:, :, -1:]
        beside = (end[:, 0] * from_start[:, 1] - end[:, 1] * from_start[:, 0]).abs().amax(dim=1)
        quarter = POINTS // 4
        gap = middle[:, :, :quarter, None] - middle[:, :, None, -quarter:]
        closing = torch.sqrt((gap * gap).sum(dim=1).flatten(1).amin(dim=1))
        signed, absolute = turn.sum(dim=1).abs(), turn.abs().sum(dim=1)
        drawn = torch.stack(
            [
                chord / length,
                chord,
                torch.log(length),
                torch.sqrt(lesser / greater),
                signed * (1 / (2 * np.pi)),
                absolute * (1 / (2 * np.pi)),
                signed / (absolute + 0.1),
                sharp[:, 0].sum(dim=1) * (1 / 8),
                torch.relu(sharp[:, 1] - RULE.corner).sum(dim=1) * (1 / 8),
                sharp[:, 1].amax(dim=1),
                torch.log1p(0.5 * crossed.sum(dim=1)),
                4 * np.pi * area.abs() / length**2,
                length / (hull + still),
                spread / (mean_radius + still),
                white_spread / white_mean,
                beside / (chord + 0.05) / length,
                closing / length,
            ],
            dim=1,
        )
        few = torch.clamp(distinct, max=RULE.few_points) * (1 / RULE.few_points)
        drawn = torch.clamp(drawn, -6.0, 6.0) * moving[:, None]
        return torch.cat([drawn, few[:, None], still[:, None]], dim=1)


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
