"""The stroke net: a small one-dimensional convolutional network over 64 points, joined by whole-stroke numbers."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from recognizer.learned.features import GLOBAL_FEATURES, PAGE_FEATURES, SEQUENCE_CHANNELS
from sketch.page import STROKE_KINDS


class StrokeNet(nn.Module):
    """sequence (B, 12, 64), whole (B, 26) -> logits (B, 9) over `STROKE_KINDS`."""

    def __init__(self, width: int = 48) -> None:
        super().__init__()
        wide = 2 * width
        self.convolutions = nn.Sequential(
            *_layer(len(SEQUENCE_CHANNELS), width, span=7, stride=2),
            *_layer(width, wide, span=5, stride=2),
            *_layer(wide, wide, span=3, stride=1),
        )
        self.overall = nn.Sequential(
            nn.BatchNorm1d(len(GLOBAL_FEATURES) + len(PAGE_FEATURES)),
            nn.Linear(len(GLOBAL_FEATURES) + len(PAGE_FEATURES), width),
            nn.ReLU(),
        )
        self.judge = nn.Sequential(
            nn.Linear(2 * wide + width, wide), nn.ReLU(), nn.Dropout(0.2), nn.Linear(wide, len(STROKE_KINDS))
        )

    def forward(self, sequence: Tensor, whole: Tensor) -> Tensor:
        points = self.convolutions(sequence)
        pooled = torch.cat([points.mean(dim=2), points.amax(dim=2), self.overall(whole)], dim=1)
        return self.judge(pooled)


def parameters_of(net: nn.Module) -> int:
    """Number of trained numbers in a net."""
    return sum(parameter.numel() for parameter in net.parameters())


def _layer(inputs: int, outputs: int, span: int, stride: int) -> list[nn.Module]:
    return [nn.Conv1d(inputs, outputs, span, stride, span // 2), nn.BatchNorm1d(outputs), nn.ReLU()]
