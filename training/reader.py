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
from training.relations import Relations, own_frame, page_frame


class Spaced(nn.Module):
    """Cleaning and resampling: repeats have no length, so equal spacing along the path leaves them out.

    -> paths (s, 64, 2) float64 page units, distinct (s,) float32 different points, span (s, 2) float64 the first
    and last moment of each stroke."""

    def forward(
        self, points: Tensor, times: Tensor, stroke: Tensor, page: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        strokes = page.shape[0]
        owner = torch.where(stroke >= 0, stroke, strokes)
        step = points[1:] - points[:-1]
        same = (owner[1:] == owner[:-1]).double()
        length = nn.functional.pad(torch.sqrt((step * step).sum(dim=1)) * same, (1, 0))
        line = torch.stack([torch.cumsum(length, dim=0), times], dim=1)
        none, ones = torch.zeros(strokes + 1, dtype=torch.int64), torch.ones_like(owner)
        counts = none.scatter_add(0, owner, ones)
        moved = none.scatter_add(0, owner, (length > 0).long())
        end = torch.cumsum(counts, dim=0)
        first, last = torch.clamp(torch.stack([end - counts, end - 1]), 0, points.shape[0] - 1)
        begin, finish = line[first], line[last]
        total = finish[:, 0] - begin[:, 0]
        # A point's place along its stroke, 0 to 63; how many points come before each whole place.
        scaling = torch.stack([begin[:, 0], (POINTS - 1) / torch.where(total > 0, total, 1.0)], dim=1)[owner]
        place = (line[:, :1] - scaling[:, :1]) * scaling[:, 1:]
        slot = torch.clamp(torch.ceil(place[:, 0]), 0, POINTS - 1).long()
        at = torch.zeros((strokes + 1) * POINTS, dtype=torch.int64).scatter_add(
            0, owner * POINTS + slot, ones
        )
        passed = torch.cumsum(at.reshape(-1, POINTS)[:strokes], dim=1) - 1
        # The step that each wanted place lies on: a last one that leads nowhere counts as its first point.
        begun, ended = first[:strokes, None], last[:strokes, None]
        low = torch.maximum(torch.minimum(begun + passed, ended - 1), begun)
        high = torch.minimum(low + 1, ended)
        known = torch.cat([points, place], dim=1)
        here, there = known[low], known[high]
        width = there[..., 2:] - here[..., 2:]
        wanted = torch.arange(POINTS, dtype=torch.float64)[:, None]
        share = torch.clamp((wanted - here[..., 2:]) / torch.where(width > 0, width, 1.0), 0.0, 1.0)
        paths = here[..., :2] + share * (there[..., :2] - here[..., :2])
        span = torch.stack([begin[:strokes, 1], finish[:strokes, 1]], dim=1)
        return paths, (moved[:strokes] + 1).float(), span


class Encoded(nn.Module):
    """Raw ink -> what each stroke looks like by itself, what is needed to compare strokes, and whether any two of
    them share a page."""

    def __init__(self, net: PageNet) -> None:
        super().__init__()
        self.spaced = Spaced()
        self.features = Features()
        self.encoder = net.encoder

    def forward(
        self, points: Tensor, times: Tensor, stroke: Tensor, page: Tensor
    ) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        paths, distinct, moments = self.spaced(points, times, stroke, page)
        company = (page[:, None] == page[None, :]).sum() > page.shape[0]
        return self.encoder(*self.features(own_frame(paths), distinct)), paths, moments, company


class InCompany(nn.Module):
    """Answers for strokes some of which share a page."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.relations = Relations()
        self.net = net
        self.temperature = temperature

    def forward(
        self, encoded: Tensor, paths: Tensor, moments: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        same = page[:, None] == page[None, :]
        itself = torch.eye(page.shape[0])
        company = same.float() - itself
        on_page, standing = page_frame(paths[None], same[None])
        relations = self.relations(on_page, moments[None], timed[None])
        kinds, strange, together = self.net(encoded[None], standing, relations, company[None])
        return (*_told(kinds[0], strange[0], self.temperature), torch.sigmoid(together[0]) * company + itself)


class Alone(nn.Module):
    """The same answers where no two strokes share a page: half the work."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.net = net
        self.temperature = temperature

    def forward(self, encoded: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        kinds, strange = self.net.alone(encoded)
        return (*_told(kinds, strange, self.temperature), torch.eye(encoded.shape[0]))


def _told(kinds: Tensor, strange: Tensor, temperature: float) -> tuple[Tensor, Tensor]:
    """Probabilities of the kinds, and of being none of them. A stroke that is none is each with equal right."""
    odd = torch.sigmoid(strange)
    shares = torch.softmax(kinds / temperature, dim=1)
    return shares + (1.0 / kinds.shape[1] - shares) * odd[:, None], odd


class RawReader(nn.Module):
    """Raw ink -> kinds (s, 9) probabilities that sum to 1, strange (s,) the probability of being none of them,
    together (s, s) the probability that two strokes are one thing (0 across pages, 1 on the diagonal)."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.encoded = Encoded(net)
        self.in_company = InCompany(net, temperature)
        self.alone = Alone(net, temperature)

    def forward(
        self, points: Tensor, times: Tensor, stroke: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        encoded, paths, moments, company = self.encoded(points, times, stroke, page)
        return self.in_company(encoded, paths, moments, page, timed) if company else self.alone(encoded)

    def read(
        self, paths: Tensor, distinct: Tensor, moments: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """The same from strokes at equal spacing, always by way of the whole net."""
        encoded = self.encoded.encoder(*self.encoded.features(own_frame(paths), distinct))
        return self.in_company(encoded, paths, moments, page, timed)
