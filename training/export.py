"""The net as one ONNX file that takes raw ink: cleaning, spacing, features, both senses, page, softmax inside."""

from __future__ import annotations

import warnings
from pathlib import Path

import onnx
import torch

from training.reader import RawReader

INPUTS = ("points", "times", "stroke", "page", "timed")
OUTPUTS = ("kinds", "strange", "together")


def export(reader: RawReader, target: Path, metadata: dict[str, str]) -> None:
    """Writes the ONNX file: inputs and outputs as `training.reader` describes them, any number of points and
    strokes."""
    example = (
        torch.tensor([[0, 0], [3, 1], [5, 5], [9, 9], [8, 2], [4, 4], [7, 1]], dtype=torch.float64),
        torch.arange(7, dtype=torch.float64),
        torch.tensor([0, 0, 0, 1, 1, 2, 2]),
        torch.tensor([0, 0, 0]),
        torch.ones(3),
    )
    points, strokes = torch.export.Dim("points", min=2), torch.export.Dim("strokes", min=2)
    shapes = {
        "points": {0: points}, "times": {0: points}, "stroke": {0: points}, "page": {0: strokes}, "timed": {0: strokes}
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the exporter's own deprecation chatter
        program = torch.onnx.export(
            reader.eval(),
            example,
            input_names=list(INPUTS),
            output_names=list(OUTPUTS),
            dynamic_shapes=shapes,
            external_data=False,
            dynamo=True,
            verbose=False,
        )
    assert program is not None
    model = onnx.load_from_string(program.model_proto.SerializeToString())
    # The exporter notes where each operator came from, machine paths included: not for shipping.
    for node in model.graph.node:
        del node.metadata_props[:]
        node.doc_string = ""
    for value in [*model.graph.input, *model.graph.output, *model.graph.value_info]:
        del value.metadata_props[:]
    for key, text in metadata.items():
        entry = model.metadata_props.add()
        entry.key, entry.value = key, text
    onnx.checker.check_model(model)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(model.SerializeToString())
