"""`python -m training.handwriting.raw`: the step from raw strokes to what the net of signs is shown, as looks.onnx.

It holds no weights and does not change with training. With `--out FILE` it is joined with signs.onnx into one file that takes
raw strokes: inputs as of looks.onnx, output `scores` as of signs.onnx.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import onnx
from onnx import ModelProto, compose, helper

from training.handwriting.export import save
from training.handwriting.looks import looks

HERE = Path(__file__).parents[2] / "recognizer" / "handwriting" / "weights"
PREFIX = "net."
"""Of what the net's own values are called in a joined file."""


def joined(front: ModelProto, net: ModelProto) -> ModelProto:
    """One model of two: what the first gives is what the second takes, by name. Raises ValueError where it is not."""
    given = [value.name for value in front.graph.output]
    taken = [value.name for value in net.graph.input]
    if sorted(given) != sorted(taken):
        raise ValueError(f"the net takes {', '.join(taken)}; it should take {', '.join(given)}")
    renamed = compose.add_prefix(net, PREFIX, rename_inputs=False, rename_outputs=False)
    graph = helper.make_graph(
        [*front.graph.node, *renamed.graph.node],
        "inklined",
        list(front.graph.input),
        list(renamed.graph.output),
        [*front.graph.initializer, *renamed.graph.initializer],
    )
    model = helper.make_model(graph, opset_imports=list(net.opset_import), ir_version=net.ir_version)
    model.producer_name = "inklined"
    model.metadata_props.extend(front.metadata_props)
    onnx.checker.check_model(model, full_check=True)
    return model


def main(arguments: Sequence[str] | None = None) -> int:
    """Writes looks.onnx beside the weights or, asked for one file, the joined one."""
    parser = argparse.ArgumentParser(prog="python -m training.handwriting.raw", description=__doc__)
    parser.add_argument("--weights", type=Path, default=HERE, help="folder of signs.onnx and looks.onnx")
    parser.add_argument("--out", type=Path, help="write one file from raw strokes to scores instead")
    options = parser.parse_args(arguments)
    front = looks()
    if options.out is None:
        save(front, options.weights / "looks.onnx")
        return 0
    net = options.weights / "signs.onnx"
    if not net.is_file():
        parser.error(
            f"--weights {options.weights}: there is no signs.onnx; python -m training.handwriting makes it"
        )
    save(joined(front, onnx.load(net)), options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
