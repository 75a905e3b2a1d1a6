"""The whole way from raw ink to answers as one graph, which is what the ONNX file holds.

Inputs (see recognizer/learned/README.md for the contract): points (n, 2) float64, page units, all strokes
one after another; times (n,) float64, seconds; stroke (n,) int64, each point's stroke, −1 for padding,
which comes last; page (s,) int64, each stroke's page; timed (s,) float32, 1 where its times are known.
Coordinates are doubles up to the point where each stroke stands in its own frame: a page far from the
origin loses nothing.
"""

from __future__ import annotations

from typing import cast

import torch
from torch import Tensor, nn

from training.features import POINTS, Features
from training.nets import PageNet, Round
from training.relations import Relations, own_frame, page_frame

LEAST = 1e-100
"""Instead of a length of nothing where it is divided by."""


class Spaced(nn.Module):
    """Cleaning and resampling to `count` points: repeats have no length, so equal spacing along the path leaves them out.

    Of `page` only how many strokes there are matters. -> paths (s, count, 2) float64 page units, distinct (s,) float32
    different points, first and last (s + 1,) the places of each stroke's ends among the points; of strokes without
    points, and in the row of the padding, anything."""

    def __init__(self, count: int = POINTS) -> None:
        super().__init__()
        self.count = count

    def forward(self, points: Tensor, stroke: Tensor, page: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        strokes = page.shape[0]
        owner = torch.remainder(stroke, strokes + 1)
        ones = torch.ones_like(owner)
        counts = torch.zeros(strokes + 1, dtype=torch.int64).scatter_add(0, owner, ones)
        end = torch.cumsum(counts, dim=0)
        first, last = torch.clamp(end - counts, max=points.shape[0] - 1), end - 1
        # The way from the very first point on, leaps between strokes included: differences within a stroke matter.
        length = nn.functional.pad(torch.linalg.vector_norm(points[1:] - points[:-1], dim=1), (1, 0))
        line = torch.cumsum(length, dim=0)
        begin = line[first]
        scale = (self.count - 1) / torch.clamp(line[last] - begin, min=LEAST)
        # A point's place along its stroke, 0 to count − 1; how many points of all come before each whole place.
        place = (line - begin[owner]) * scale[owner]
        moves = torch.cumsum((length > 0).float(), dim=0)
        slot = owner * self.count + torch.clamp(torch.ceil(place), 0, self.count - 1).long()
        at = torch.zeros((strokes + 1) * self.count, dtype=torch.int64).scatter_add(0, slot, ones)
        passed = torch.cumsum(at, dim=0).reshape(-1, self.count)
        # The step that each wanted place lies on; the end lies on one that leads nowhere.
        known = torch.cat([points, place[:, None]], dim=1)
        here = known[passed - 1]
        ahead = known[torch.minimum(passed, last[:, None])] - here
        (spot, place_here), (way, width) = here.split([2, 1], dim=2), ahead.split([2, 1], dim=2)
        wanted = torch.arange(self.count, dtype=torch.float64)[:, None]
        share = torch.clamp((wanted - place_here) / torch.clamp(width, min=LEAST), 0.0, 1.0)
        distinct = moves[last] - moves[first] + 1.0
        return (spot + share * way)[:strokes], distinct[:strokes], first, last


class Encoded(nn.Module):
    """Raw ink -> what each stroke looks like by itself, what is needed to compare strokes, and whether any two of
    them share a page."""

    def __init__(self, net: PageNet) -> None:
        super().__init__()
        self.spaced = Spaced()
        self.features = Features()
        self.encoder = net.encoder

    def forward(
        self, points: Tensor, stroke: Tensor, page: Tensor
    ) -> tuple[Tensor, Tensor, Tensor, Tensor, Tensor, Tensor]:
        """-> encoded, paths, first and last, same (s, s): 1 where strokes share a page, company: whether any do."""
        paths, distinct, first, last = self.spaced(points, stroke, page)
        same = shared(page)
        company = same.sum() > page.shape[0]
        return self.encoder(*self.features(own_frame(paths), distinct)), paths, first, last, same, company


class InCompany(nn.Module):
    """Answers for strokes some of which share a page."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.relations = Relations()
        self.net = net
        self.temperature = temperature

    def forward(
        self,
        encoded: Tensor,
        paths: Tensor,
        first: Tensor,
        last: Tensor,
        same: Tensor,
        times: Tensor,
        timed: Tensor,
    ) -> tuple[Tensor, Tensor, Tensor]:
        span = torch.stack([times[first], times[last]], dim=1)[: timed.shape[0]]
        return self.read(encoded, paths, span, same, timed)

    def read(
        self, encoded: Tensor, paths: Tensor, span: Tensor, same: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """span (s, 2): the first and last moment of each stroke; same (s, s): 1 where they share a page."""
        itself = torch.eye(timed.shape[0])
        company = same - itself
        on_page, standing = page_frame(paths[None], same[None] > 0)
        relations = self.relations(on_page, span[None], timed[None])
        kinds, strange, together = self.net(encoded[None], standing, relations, company[None])
        return (*_told(kinds[0], strange[0], self.temperature), torch.sigmoid(together[0]) * company + itself)


class Alone(nn.Module):
    """The same answers where no two strokes share a page: half the work. Of the net as it is now."""

    def __init__(self, net: PageNet, temperature: float) -> None:
        super().__init__()
        self.net = net
        self.rounds = nn.ModuleList(cast(Round, look).unheard() for look in net.rounds)
        self.temperature = temperature

    def forward(self, encoded: Tensor, same: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Each stroke shares a page with itself only: `same` is what they are one thing with."""
        strokes = encoded + self.net.standing.bias
        for taken in self.rounds:
            strokes = strokes + taken(strokes)
        answer = self.net.judge(strokes)
        return (*_told(answer[:, :-1], answer[:, -1], self.temperature), 1.0 * same)


def shared(page: Tensor) -> Tensor:
    """1 where two strokes share a page, (s, s)."""
    return (page[:, None] == page[None, :]).float()


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
        encoded, paths, first, last, same, company = self.encoded(points, stroke, page)
        if company:
            return self.in_company(encoded, paths, first, last, same, times, timed)
        return self.alone(encoded, same)

    def read(
        self, paths: Tensor, distinct: Tensor, moments: Tensor, page: Tensor, timed: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """The same from strokes at equal spacing, always by way of the whole net."""
        encoded = self.encoded.encoder(*self.encoded.features(own_frame(paths), distinct))
        return self.in_company.read(encoded, paths, moments, shared(page), timed)
