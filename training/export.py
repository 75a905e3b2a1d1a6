"""The net as one ONNX file: dynamic batch, temperature and softmax inside, no sidecar."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import torch
from torch import Tensor, nn

from recognizer.learned.features import GLOBAL_FEATURES, PAGE_FEATURES, POINTS, SEQUENCE_CHANNELS
from training.dataset import Corpus
from training.nets import StrokeNet


class Calibrated(nn.Module):
    """The net with its temperature: logits / T. The recognizer averages both directions, then applies softmax."""

    def __init__(self, net: StrokeNet, temperature: float) -> None:
        super().__init__()
        self.net = net
        self.temperature = temperature

    def forward(self, sequence: Tensor, whole: Tensor) -> Tensor:
        return self.net(sequence, whole) / self.temperature


def export(net: StrokeNet, temperature: float, target: Path, metadata: dict[str, str]) -> None:
    """Writes the ONNX file. Inputs "sequence" (B, 12, 64) and "whole" (B, 26) float32, output "logits" (B, 9)."""
    example = (
        torch.zeros(2, len(SEQUENCE_CHANNELS), POINTS),
        torch.zeros(2, len(GLOBAL_FEATURES) + len(PAGE_FEATURES)),
    )
    batch = torch.export.Dim("batch")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the exporter's own deprecation chatter
        program = torch.onnx.export(
            Calibrated(net, temperature).eval(),
            example,
            input_names=["sequence", "whole"],
            output_names=["logits"],
            dynamic_shapes={"sequence": {0: batch}, "whole": {0: batch}},
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


def parity(net: StrokeNet, temperature: float, file: Path, corpus: Corpus) -> float:
    """Largest difference between torch's and onnxruntime's logits over a corpus."""
    session = onnxruntime.InferenceSession(str(file), providers=["CPUExecutionProvider"])
    (there,) = session.run(None, {"sequence": corpus.sequence, "whole": corpus.whole})
    with torch.no_grad():
        here = Calibrated(net, temperature).eval()(
            torch.from_numpy(corpus.sequence), torch.from_numpy(corpus.whole)
        )
    return float(np.abs(here.numpy() - np.asarray(there)).max())
