"""What the net of signs is shown, from raw strokes, as operators that ONNX knows: no Python, no numba.

The same numbers as `recognizer.handwriting.line` and its kernels give, which stay what the reader itself uses: on one
thread they are faster. Spacing, boxes, the line's scale, the pen's run, images and numbers; which strokes may be one sign
is handed in. Frame: any unit, y down. Coordinates are doubles until a share of ink falls into a pixel, so that a dot lies on
the same side of an image's edge here and there.
"""

from __future__ import annotations

import json
import tempfile
import warnings
from pathlib import Path
from typing import cast

import onnx
import torch
from onnx import ModelProto
from torch import Tensor, nn

from recognizer.handwriting.kernels import IMAGES, POINTS, SIDE, STEP, SURE, WINDOW
from recognizer.handwriting.line import RULE, GroupRule
from sketch.writing.signs import SIGNS
from training.export import settled
from training.reader import Spaced

INPUTS = ("points", "ends", "groups", "alone")
OUTPUTS = ("sequence", "images", "numbers")
AXES = {
    "points": {0: "points"},
    "ends": {0: "strokes"},
    "groups": {0: "batch", 1: "most"},
    "alone": {0: "batch"},
}
OPSET = 20
"""That of the net of signs: two graphs of one opset can be joined."""
MOST = 400
"""Dots that a step is drawn with at most."""
PIXELS = SIDE * SIDE


class Looks(nn.Module):
    """points (N, 2) float64, ends (S,) int64 where each stroke ends, groups (B, G) int64 positions of the strokes of each
    group in drawing order, −1 after the last, alone (B,) bool -> sequence (B, 5, 64), images (B, 3, 28, 28) and numbers
    (B, 6), float32. Every stroke has a point and every group a stroke."""

    least: Tensor
    sure: Tensor
    step: Tensor
    tall: Tensor
    ink: Tensor
    shares: Tensor

    def __init__(self, rule: GroupRule = RULE) -> None:
        super().__init__()
        self.rule = rule
        self.spaced = Spaced(rule.points)
        # The exporter makes floats of some plain numbers; those that are stored it keeps as they are.
        stored = {
            "least": [[1e-300], [1e-12], [1e-9]],
            "sure": [SURE],
            "step": [rule.step],
            "tall": [0.15],
            "ink": [[1.0], [0.7]],
            "shares": [[rule.quantile], [0.5], [0.8]],
        }
        for name, numbers in stored.items():
            self.register_buffer(name, torch.tensor(numbers, dtype=torch.float64), persistent=False)

    def forward(
        self, points: Tensor, ends: Tensor, groups: Tensor, alone: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        paths, distinct, _, _ = self.spaced(points, owner_of(ends, points.shape[0]), ends)
        boxes = torch.cat([paths.amin(dim=1), paths.amax(dim=1)], dim=1)
        held, picked = groups >= 0, torch.clamp(groups, min=0)
        # Beyond the last stroke of a group stands its first: it widens no box.
        picked = torch.where(held, picked, picked[:, :1])
        corners = boxes[picked]
        low, high = corners[:, :, :2].amin(dim=1), corners[:, :, 2:].amax(dim=1)
        middle, extent = 0.5 * (low + high), high - low
        largest = extent.amax(dim=1)
        scale = torch.where(alone, torch.maximum(largest, self.least[2]), self._scale(boxes))
        size = torch.maximum(torch.maximum(largest, 1e-3 * scale), self.least[1])
        ways = paths[picked]
        count = held.sum(dim=1, keepdim=True)
        last = picked.gather(1, count - 1)[:, 0]
        first, final = paths[picked[:, 0], 0], paths[last, -1]
        sequence, length = self._sequence(ways, held, middle, size, final)
        numbers = torch.cat(
            [
                torch.log(torch.maximum(extent, 0.01 * scale[:, None]) / scale[:, None]),
                torch.where(alone, 0.0, 1.0)[:, None].double(),
                0.5 * count.double(),
                0.3 * length / size[:, None],
                torch.linalg.vector_norm(final - first, dim=1, keepdim=True) / size[:, None],
            ],
            dim=1,
        )
        images = self._images(paths, boxes, distinct <= 1.0, groups, alone, middle, size, scale)
        return sequence.float(), images, numbers.float()

    def _scale(self, boxes: Tensor) -> Tensor:
        """The height of a letter: `line.scale_of`."""
        rule = self.rule
        extent = boxes[:, 2:] - boxes[:, :2]
        width, height = extent[:, 0], extent[:, 1]
        size = extent.amax(dim=1)
        # One number is kept as an array of one: the exporter takes lone numbers for floats.
        largest = size.amax(dim=0, keepdim=True)
        share = self.tall / torch.sqrt(torch.ones_like(size).sum(dim=0, keepdim=True))
        told = (height > rule.upright * width) & (height > largest * share)
        upright = _quantile(height, told, self.shares[0])
        usual = self.shares[2] * _quantile(size, size > 0, self.shares[1])
        found = torch.where(told.any(dim=0, keepdim=True), upright, usual)
        exponent = torch.log(torch.maximum(found, self.least[0])) / torch.log(self.step)
        rounded = torch.pow(self.step, torch.round(exponent))
        return torch.where(largest > 0, rounded, torch.ones_like(rounded))

    def _sequence(
        self, ways: Tensor, held: Tensor, middle: Tensor, size: Tensor, final: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Points of equal spacing along the ink of ways (B, G, points, 2), and the ink's length, (B, 1)."""
        per = self.rule.points - 1
        steps = (ways[:, :, 1:] - ways[:, :, :-1]).flatten(1, 2)
        part = (torch.linalg.vector_norm(ways[:, :, 1:] - ways[:, :, :-1], dim=3) * held[:, :, None]).flatten(
            1
        )
        done = torch.cumsum(part, dim=1)
        total = done[:, -1:]
        step = total / (POINTS - 1)
        # How many of the places lie before each step's end; from it, on which step each place lies. (A factor that is
        # nearly 1 is left out by onnxruntime, whence a sum.)
        reached = torch.floor((done + self.sure * done) / torch.maximum(step, self.least[0])) + 1.0
        reached = torch.where(done > 0, torch.clamp(reached, max=POINTS), 0.0).long()
        at = (
            torch.zeros_like(reached[:, :1])
            .expand(-1, POINTS + 1)
            .scatter_add(1, reached, torch.ones_like(reached))
        )
        here = torch.minimum(
            torch.cumsum(at, dim=1)[:, :POINTS], torch.ones_like(total).long() * part.shape[1] - 1
        )
        length = part.gather(1, here)
        share = (torch.arange(POINTS) * step - (done - part).gather(1, here)) / torch.maximum(
            length, self.least[0]
        )
        start = ways[:, :, :-1].flatten(1, 2)
        pair = here[:, :, None].expand(-1, -1, 2)
        along = steps.gather(1, pair)
        spot = start.gather(1, pair) + share[:, :, None] * along
        drawn = total[:, :, None] > 0
        spot = torch.where(drawn, spot, final[:, None])
        heading = torch.where(drawn, along / torch.maximum(length, self.least[0])[:, :, None], 0.0)
        stroke = torch.div(here, per, rounding_mode="floor")
        begun = torch.cat([torch.ones_like(stroke[:, :1]), stroke[:, 1:] - stroke[:, :-1]], dim=1) > 0
        begins = torch.where(drawn, begun[:, :, None].double(), 0.0)
        own = 2.0 * (spot - middle[:, None]) / size[:, None, None]
        return torch.cat([own, heading, begins], dim=2).transpose(1, 2), total

    def _images(
        self,
        paths: Tensor,
        boxes: Tensor,
        dots: Tensor,
        groups: Tensor,
        alone: Tensor,
        middle: Tensor,
        size: Tensor,
        scale: Tensor,
    ) -> Tensor:
        """The group filling the image, the group at the line's scale, what is around it at the line's scale."""
        batch = groups.shape[0]
        own = (groups[:, :, None] == torch.arange(paths.shape[0])).any(dim=1)
        reach = (WINDOW * scale)[:, None]
        x, y = middle[:, :1], middle[:, 1:]
        left, top, right, bottom = boxes.transpose(0, 1).split(1)
        near = (left <= x + reach) & (right >= x - reach) & (top <= y + reach) & (bottom >= y - reach)
        others = near & ~own & ~alone[:, None]
        window = SIDE / (2 * WINDOW * scale)
        enlarged = torch.stack([(SIDE - 5.0) / size, window, window], dim=1).flatten()
        # One row for each stroke that is drawn in an image; coordinates go first, since long rows are quick.
        of, which, stroke = torch.nonzero(torch.stack([own, own, others], dim=1)).transpose(0, 1).split(1)
        of, image, stroke = of[0], (of * IMAGES + which)[0], stroke[0]
        placed = paths.permute(2, 0, 1)[:, stroke] - middle.transpose(0, 1)[:, of][:, :, None]
        placed = placed * enlarged[image][:, None] + 0.5 * (SIDE - 1)
        begin, end = placed[:, :, :-1], placed[:, :, 1:]
        way = end - begin
        count = torch.floor(torch.clamp(torch.linalg.vector_norm(way, dim=0) / STEP, max=MOST - 1.0)) + 1.0
        stride = way / count
        # A stroke that is a dot is its first step with one dot on it; a step that stays outside has none.
        dot = dots[stroke][:, None]
        most, least = torch.minimum(begin, end).amax(dim=0), torch.maximum(begin, end).amin(dim=0)
        seen = (most < SIDE - 1.0) & (least >= 0.0) & (~dot | (torch.arange(self.rule.points - 1) == 0))
        count = torch.where(seen, count, 0.0).flatten()
        ends = torch.cumsum(count, dim=0)
        # What lies on a line with the dots of a step, had they been counted from the very first dot of all.
        stride = stride.flatten(1)
        origin = begin.flatten(1) - (ends - count) * stride
        ink = torch.where(dot, self.ink[0], self.ink[1])
        drawn = torch.cat([ink, (image * PIXELS).double()[:, None]], dim=1).transpose(0, 1)
        drawn = drawn[:, :, None].expand(-1, -1, self.rule.points - 1).flatten(1)
        whole = ends.long()
        row = torch.cat([origin, stride, drawn])[:, owner_of(whole, cast(int, whole[-1]))]
        spot = row[:2] + torch.arange(row.shape[1]) * row[2:4]
        corner = torch.floor(spot)
        inside = (spot.amin(dim=0) >= 0.0) & (spot.amax(dim=0) < SIDE - 1.0)
        far = (spot - corner).float()
        both = torch.stack([1.0 - far, far])
        down = both[:, 1] * torch.where(inside, row[4], 0.0).float()
        pixel = torch.where(inside, row[5] + corner[1] * SIDE + corner[0], 0.0).long()
        beside = torch.tensor([[0], [1], [SIDE], [SIDE + 1]])
        empty = torch.zeros_like(enlarged).float()[:, None].expand(-1, PIXELS).flatten()
        shares = (down[:, None] * both[None, :, 0]).flatten()
        filled = empty.scatter_add(0, (beside + pixel).flatten(), shares)
        return torch.clamp(filled, max=1.0).reshape(batch, IMAGES, SIDE, SIDE)


def owner_of(ends: Tensor, total: int) -> Tensor:
    """For each of `total` places which of the runs that end at `ends` (s,) it lies in; runs may be empty."""
    marks = torch.zeros_like(torch.arange(total + 1))
    return torch.cumsum(marks.scatter_add(0, ends, torch.ones_like(ends)), dim=0)[:-1]


def _quantile(values: Tensor, counted: Tensor, share: Tensor) -> Tensor:
    """The quantile of those values that are counted, between neighbours in proportion; of none, anything."""
    ordered = torch.sort(torch.where(counted, values, torch.full_like(values, float("inf"))))[0]
    most = torch.clamp(counted.sum(dim=0, keepdim=True) - 1, min=0)
    place = most.double() * share
    below = torch.floor(place).long()
    low, high = ordered[below], ordered[torch.minimum(below + 1, most)]
    return low + (high - low) * (place - below)


def looks() -> ModelProto:
    """The step as a model: any number of points, strokes and groups; it holds no weights. The names of the signs,
    in the order of the net's answers, are with it."""
    example = (
        torch.rand(9, 2, dtype=torch.float64),
        torch.tensor([4, 5, 9]),
        torch.tensor([[0, 1], [2, -1]]),
        torch.tensor([False, True]),
    )
    with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
        # As in `training.export`: no branches by Python values, and the newer exporter thinks far longer.
        warnings.simplefilter("ignore")
        file = Path(folder) / "looks.onnx"
        torch.onnx.export(
            Looks().eval(),
            example,
            file,
            input_names=list(INPUTS),
            output_names=list(OUTPUTS),
            dynamic_axes={**AXES, **{name: {0: "batch"} for name in OUTPUTS}},
            opset_version=OPSET,
            dynamo=False,
        )
        model = onnx.load(file)
    settled(model.graph)
    model.producer_name = "inklined"
    model.producer_version = ""
    entry = model.metadata_props.add()
    entry.key, entry.value = "signs", json.dumps(SIGNS, ensure_ascii=False)
    return model
