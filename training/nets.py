"""The net: a convolutional encoder of single strokes, and attention over the strokes of their page.

A stroke is encoded in both drawing senses by the same convolutions, whose answers are pooled over
both: the sense never matters. Then each stroke looks twice at the others of its page through what
lies between the two (`training.relations`), in the manner of GATv2 (Brody, Alon and Yahav 2022): the
message decides by itself how much it is listened to, and silence can always be chosen instead.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

from sketch.page import STROKE_KINDS
from training.features import CHANNELS, POINTS, WHOLE, backwards
from training.relations import RELATIONS


@dataclass(frozen=True, slots=True)
class NetSize:
    """Widths of the net: some 200,000 numbers. Tests and the ablation make it smaller."""

    width: int = 48
    """Channels of the first convolution; the others have twice as many."""
    stroke: int = 96
    """Numbers that stand for a stroke."""
    message: int = 64
    """Numbers of a message between two strokes."""
    heads: int = 4
    """Messages are weighed in this many ways at once."""
    rounds: int = 2
    """How often strokes look at one another: an arrow's shaft, head and what it points at are two steps."""
    dropout: float = 0.1


SIZE = NetSize()

STANDING = 2
"""Numbers about a stroke on its page: has company, log of its size over the page's."""


class StrokeEncoder(nn.Module):
    """sequence (B, 15, 64), whole (B, 19) -> (B, stroke)."""

    def __init__(self, size: NetSize) -> None:
        super().__init__()
        self.wide = wide = 2 * size.width
        self.convolutions = nn.Sequential(
            *_layer(len(CHANNELS), size.width, span=7, stride=2),
            *_layer(size.width, wide, span=5, stride=2),
            *_layer(wide, wide, span=3, stride=1),
        )
        self.overall = nn.Sequential(nn.BatchNorm1d(len(WHOLE)), nn.Linear(len(WHOLE), size.width), nn.ReLU())
        self.joined = nn.Sequential(nn.Linear(2 * wide + size.width, size.stroke), nn.ReLU())

    def forward(self, sequence: Tensor, whole: Tensor) -> Tensor:
        senses = torch.cat([sequence, backwards(sequence)], dim=1).reshape(-1, len(CHANNELS), POINTS)
        found = self.convolutions(senses)
        found = found.reshape(-1, 2, self.wide, POINTS // 4)
        both = [found.mean(dim=(1, 3)), found.amax(dim=(1, 3)), self.overall(whole)]
        return self.joined(torch.cat(both, dim=1))

    def in_one_sense(self, sequence: Tensor, whole: Tensor) -> Tensor:
        """The same from one drawing sense alone, half the work: for the greater part of training."""
        found = self.convolutions(sequence)
        return self.joined(torch.cat([found.mean(dim=2), found.amax(dim=2), self.overall(whole)], dim=1))


class Round(nn.Module):
    """One look around: strokes (P, N, stroke), relations (P, N, N, 29), company (P, N, N) -> strokes, messages."""

    def __init__(self, size: NetSize) -> None:
        super().__init__()
        self.heads = size.heads
        self.own = nn.Linear(size.stroke, size.message)
        self.other = nn.Linear(size.stroke, size.message, bias=False)
        self.between = nn.Linear(RELATIONS, size.message, bias=False)
        self.weight = nn.Linear(size.message, size.heads)
        self.taken = nn.Sequential(
            nn.Linear(size.stroke + size.message, size.stroke), nn.ReLU(), nn.Linear(size.stroke, size.stroke)
        )

    def unheard(self) -> nn.Sequential:
        """The same for strokes (…, stroke) without company, less the strokes themselves: a part of its own, without the
        weights of what is heard."""
        first = self.taken[0]
        assert isinstance(first, nn.Linear)
        bare = nn.Linear(self.own.in_features, first.out_features)
        bare.load_state_dict({"weight": first.weight[:, : self.own.in_features], "bias": first.bias})
        return nn.Sequential(bare, *list(self.taken)[1:])

    def forward(self, strokes: Tensor, relations: Tensor, company: Tensor) -> tuple[Tensor, Tensor]:
        message = torch.relu(
            self.own(strokes)[:, :, None] + self.other(strokes)[:, None] + self.between(relations)
        )
        weight = torch.exp(torch.clamp(self.weight(message), max=20.0)) * company[..., None]
        share = weight / (1.0 + weight.sum(dim=2, keepdim=True))
        by_head = message.unflatten(3, (self.heads, message.shape[3] // self.heads))
        heard = (share[..., None] * by_head).sum(dim=2).flatten(2)
        return strokes + self.taken(torch.cat([strokes, heard], dim=2)), message


class PageNet(nn.Module):
    """What each stroke of a page is, whether it is anything known, and which strokes are one thing."""

    def __init__(self, size: NetSize = SIZE) -> None:
        super().__init__()
        self.size = size
        self.encoder = StrokeEncoder(size)
        self.standing = nn.Linear(STANDING, size.stroke)
        self.rounds = nn.ModuleList(Round(size) for _ in range(size.rounds))
        self.judge = nn.Sequential(
            nn.Linear(size.stroke, size.stroke),
            nn.ReLU(),
            nn.Dropout(size.dropout),
            nn.Linear(size.stroke, len(STROKE_KINDS) + 1),
        )
        self.pairing = nn.Linear(size.message, 1)

    def forward(
        self, encoded: Tensor, standing: Tensor, relations: Tensor, company: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """encoded (P, N, stroke) by `encoder`, standing (P, N, 2), relations (P, N, N, 29), company (P, N, N)
        1 where two different strokes share a page -> logits of the kinds (P, N, 9), logit of being none of
        them (P, N), logit of being one thing (P, N, N)."""
        strokes = encoded + self.standing(standing)
        message = torch.zeros(1)
        for look in self.rounds:
            strokes, message = look(strokes, relations, company)
        answer = self.judge(strokes)
        together = self.pairing(message + message.transpose(1, 2))[..., 0]
        return answer[..., :-1], answer[..., -1], together


def parameters_of(net: nn.Module) -> int:
    """Number of trained numbers in a net."""
    return sum(parameter.numel() for parameter in net.parameters())


def _layer(inputs: int, outputs: int, span: int, stride: int) -> list[nn.Module]:
    return [nn.Conv1d(inputs, outputs, span, stride, span // 2), nn.BatchNorm1d(outputs), nn.ReLU()]
