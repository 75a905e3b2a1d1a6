"""The whole way from raw ink to answers as one graph, which is what the ONNX file holds.

Inputs (see recognizer/learned/README.md for the contract): points (n, 2) float64, page units, all strokes
one after another; times (n,) float64, seconds; stroke (n,) int64, each point's stroke, −1 for padding,
which comes last; page (s,) int64, each stroke's page; timed (s,) float32, 1 where its times are known.
Coordinates are doubles up to the point where each stroke stands in its own frame: a page far from the
origin loses nothing.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from training.features import POINTS, Features
from training.nets import PageNet
from training.relations import Relations, frames


class Spaced(nn.Module):
    """Cleaning and resampling: repeats have no length, so equal spacing along the path leaves them out.

    -> paths (s, 64, 2) float64 page units, distinct (s,) float32 different points, span (s, 2) float64 the first
    and last moment of each stroke."""

    def forward(self, points: Tensor, times: Tensor, stroke: Tensor, page: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        strokes = page.shape[0]
        last_point = points.shape[0] - 1
        owner = torch.where(stroke >= 0, stroke, strokes)
        step = points[1:] - points[:-1]
        same = (owner[1:] == owner[:-1]).double()
        length = nn.functional.pad(torch.sqrt((step * step).sum(dim=1)) * same, (1, 0))
        travelled = torch.cumsum(length, dim=0)
        counts = torch.zeros(strokes + 1, dtype=torch.int64).scatter_add(0, owner, torch.ones_like(owner))
        moved = torch.zeros(strokes + 1, dtype=torch.int64).scatter_add(0, owner, (length > 0).long())
        first = torch.clamp(torch.cumsum(counts, dim=0) - counts, max=last_point)
        last = torch.clamp(first + counts - 1, min=0, max=last_point)
        begun, total = travelled[first], travelled[last] - travelled[first]
        per_length = (POINTS - 1) / torch.where(total > 0, total, 1.0)
        # A point's place along its stroke, 0 to 63; how many points come before each whole place.
        place = (travelled - begun[owner]) * per_length[owner]
        slot = torch.clamp(torch.ceil(place), 0, POINTS - 1).long()
        at = torch.zeros((strokes + 1) * POINTS, dtype=torch.int64)
        at = at.scatter_add(0, owner * POINTS + slot, torch.ones_like(owner))
        passed = torch.cumsum(at.reshape(-1, POINTS)[:strokes], dim=1) - 1
        low = first[:strokes, None] + torch.clamp(torch.minimum(passed, counts[:strokes, None] - 2), min=0)
        low = torch.minimum(low, last[:strokes, None])
        high = torch.minimum(low + 1, last[:strokes, None])
        begin, end = place[low], place[high]
        wanted = torch.arange(POINTS, dtype=torch.float64)
        width = end - begin
        share = torch.clamp((wanted - begin) / torch.where(width > 0, width, 1.0), 0.0, 1.0)
        here = points[low]
        paths = here + share[..., None] * (points[high] - here)
        span = torch.stack([times[first[:strokes]], times[last[:strokes]]], dim=1)
        return paths, (moved[:strokes] + 1).float(), span


class RawReader(nn.Module):
    """Raw ink -> kinds (s, 9) probabilities that sum to 1, strange (s,) the probability of being none of them,
    together (s, s) the probability that two strokes are one thing (0 across pages, 1 on the diagonal)."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.spaced = Spaced()
        self.features = Features()
        self.relations = Relations()
        self.net = net
        self.temperature = temperature

    def forward(
        self, points: Tensor, times: Tensor, stroke: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        paths, distinct, moments = self.spaced(points, times, stroke, page)
        return self.read(paths, distinct, moments, page, timed)

    def read(
        self, paths: Tensor, distinct: Tensor, moments: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """The same from strokes at equal spacing."""
        same = page[:, None] == page[None, :]
        own, on_page, standing = frames(paths[None], same[None])
        encoded = self.net.encoder(*self.features(own[0], distinct))
        company = same.float() * (1.0 - torch.eye(page.shape[0]))
        relations = self.relations(on_page, moments[None], timed[None])
        kinds, strange, together = self.net(encoded[None], standing, relations, company[None])
        kinds = torch.softmax(kinds[0] / self.temperature, dim=1)
        pairs = torch.sigmoid(together[0]) * company + torch.eye(page.shape[0])
        return kinds, torch.sigmoid(strange[0]), pairs
