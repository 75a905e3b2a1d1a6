"""How two strokes of a page lie to one another, for the net's attention: near, beside, around, after.

A page's strokes stand in the page's frame: the middle of its box at the origin, its diagonal 1. Relations
are as seen from the first stroke of a pair. Float32.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor, nn

from training.features import POINTS


def _spread(count: int) -> list[int]:
    return np.round(np.linspace(0, POINTS - 1, count)).astype(int).tolist()


SKETCHED, ROUGH = _spread(32), _spread(16)
"""Points of a stroke that the ends of others are compared with, and those that whole strokes are."""


@dataclass(frozen=True, slots=True)
class RelationRule:
    """Numbers of the relations."""

    smallest: float = 5e-4
    """A stroke's size over its page's is not told apart below this."""
    least: float = 1e-3
    """A stroke's size over the page's counts as this at least: a dot has a neighbourhood, too."""
    stillest: float = 1e-30
    """A stroke's size is never less, in any unit, where it is divided by."""
    near: tuple[float, float] = (0.06, 0.4)
    """Distances over the greater size that a closeness falls to one half at: touching, and beside."""
    directions: int = 12
    """Directions in which one stroke's reach is compared with another's, 30 degrees apart."""
    pause: float = 1.0
    """Seconds: a pause that is neither short nor long."""


RULE = RelationRule()

RELATIONS = 29
"""Numbers that describe a pair."""


class Relations(nn.Module):
    """paths (P, N, 64, 2) in the page's frame, span (P, N, 2) float64: first and last moment of each stroke (s),
    timed (P, N): 1 where that is known; strokes in the order of drawing -> (P, N, N, 29)."""

    support: Tensor

    def __init__(self) -> None:
        super().__init__()
        angle = np.arange(RULE.directions) * (2 * np.pi / RULE.directions)
        directions = np.stack([np.cos(angle), np.sin(angle)]).astype(np.float32)
        self.register_buffer("support", torch.from_numpy(directions), persistent=False)

    def forward(self, paths: Tensor, span: Tensor, timed: Tensor) -> Tensor:
        pages, count = paths.shape[0], paths.shape[1]
        low, high = paths.amin(dim=2), paths.amax(dim=2)
        size = torch.clamp(torch.sqrt(((high - low) ** 2).sum(dim=2)), min=RULE.least)
        own, other = size[:, :, None], size[:, None, :]
        scale = torch.maximum(own, other)
        ends, sketched, rough = paths[:, :, [0, POINTS - 1]], paths[:, :, SKETCHED], paths[:, :, ROUGH]
        # From each end of the one to the whole of the other; to its two ends; from the whole to the whole.
        at_path = _between(ends, sketched).amin(dim=4)
        at_ends = _between(ends, ends)
        straight = torch.maximum(at_ends[:, :, 0, :, 0], at_ends[:, :, 1, :, 1])
        crosswise = torch.maximum(at_ends[:, :, 0, :, 1], at_ends[:, :, 1, :, 0])
        nearer, farther = at_path.amin(dim=2), at_path.amax(dim=2)
        distances = torch.stack(
            [
                nearer,
                farther,
                nearer.transpose(1, 2),
                farther.transpose(1, 2),
                at_ends.amin(dim=(2, 4)),
                torch.minimum(straight, crosswise),
                _between(rough, rough).amin(dim=(2, 4)),
            ],
            dim=3,
        )
        relative = torch.sqrt(torch.relu(distances)).to(paths.dtype) / scale[..., None]
        closeness = [reach / (reach + relative) for reach in RULE.near]
        # Reach in twelve directions: one stroke encloses another where it reaches further in all of them.
        reach = (sketched @ self.support).amax(dim=2)
        beyond = (reach[:, :, None] - reach[:, None]).amin(dim=3) / scale
        centre = 0.5 * (low + high)
        offset = (centre[:, None] - centre[:, :, None]) / scale[..., None]
        away = torch.sqrt((offset * offset).sum(dim=3))
        overlap = torch.minimum(high[:, :, None], high[:, None]) - torch.maximum(
            low[:, :, None], low[:, None]
        )
        shared = overlap / (
            torch.minimum((high - low)[:, :, None], (high - low)[:, None]) + 0.1 * scale[..., None]
        )
        rank = torch.arange(count, dtype=paths.dtype)
        later = (rank[None, :] - rank[:, None]).expand(pages, count, count)
        known = timed[:, :, None] * timed[:, None, :]
        pause = torch.maximum(
            span[:, None, :, 0] - span[:, :, None, 1], span[:, :, None, 0] - span[:, None, :, 1]
        )
        waited = torch.relu(pause).to(paths.dtype) * known
        plain = torch.stack(
            [
                0.5 * torch.log(other / own),
                0.2 * torch.log(scale) + 0.5,
                torch.clamp(beyond, -1.0, 1.0),
                torch.clamp(beyond.transpose(1, 2), -1.0, 1.0),
                1.0 / (1.0 + away),
                _next(later, 1.0),
                _next(later, -1.0),
                1.0 / (1.0 + later.abs()),
                torch.tanh(0.3 * later),
                known,
                known * RULE.pause / (RULE.pause + waited),
            ],
            dim=3,
        )
        return torch.cat(
            [*closeness, torch.clamp(offset, -3.0, 3.0) * 0.5, torch.clamp(shared, -2.0, 1.0), plain], dim=3
        )


def own_frame(paths: Tensor) -> Tensor:
    """paths (B, 64, 2) in any frame -> float32 in each stroke's own; a path that never moved is all zeros."""
    low, high = paths.amin(dim=1, keepdim=True), paths.amax(dim=1, keepdim=True)
    size = torch.linalg.vector_norm(high - low, dim=2, keepdim=True)
    return ((paths - 0.5 * (low + high)) / torch.clamp(size, min=RULE.stillest)).float()


def page_frame(paths: Tensor, same: Tensor) -> tuple[Tensor, Tensor]:
    """paths (P, N, 64, 2) in any frame and which strokes share a page (P, N, N), each with itself too -> float32
    paths in their pages' frames, and how each stroke stands on its page (P, N, 2): whether it has company, and
    the logarithm of its size over the page's."""
    low, high = paths.amin(dim=2), paths.amax(dim=2)
    far = torch.finfo(paths.dtype).max / 4
    there = same[..., None]
    page_low = torch.where(there, low[:, None], far).amin(dim=2)
    page_high = torch.where(there, high[:, None], -far).amax(dim=2)
    size = torch.sqrt(((high - low) ** 2).sum(dim=2))
    whole = torch.sqrt(((page_high - page_low) ** 2).sum(dim=2))
    whole = torch.where(whole > 0, whole, 1.0)
    middle = (0.5 * (page_low + page_high))[:, :, None]
    on_page = (paths - middle) / whole[:, :, None, None]
    company = (same.sum(dim=2) > 1).float()
    relative = torch.log(torch.clamp(size / whole, min=RULE.smallest)).float()
    return on_page.float(), torch.stack([company, relative * company / 3.0], dim=2)


def _next(later: Tensor, by: float) -> Tensor:
    return torch.relu(1.0 - (later - by).abs())


def _between(one: Tensor, other: Tensor) -> Tensor:
    """Squared distances between all points of all pairs: (P, N, a, 2), (P, N, b, 2) -> (P, N, a, N, b), as one
    product of matrices, in doubles: |p|² − 2 p·q + |q|² cancels where the points meet, and may be a little less than
    nothing."""
    pages, count, here = one.shape[0], one.shape[1], one.shape[2]
    (px, py), (qx, qy) = (points.double().flatten(1, 2).unbind(dim=2) for points in (one, other))
    left = torch.stack([-2.0 * px, -2.0 * py, px * px + py * py, torch.ones_like(px)], dim=2)
    # Laid out as it is needed: onnxruntime-web cannot multiply a transposed matrix of doubles.
    right = torch.stack([qx, qy, torch.ones_like(qx), qx * qx + qy * qy], dim=1)
    return (left @ right).reshape(pages, count, here, count, other.shape[2])
