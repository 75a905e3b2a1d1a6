"""The net as one ONNX file that takes raw ink: cleaning, spacing, features, both senses, page, softmax inside.

torch exports three graphs: what each stroke looks like by itself, and the answers for strokes in company
and for strokes alone. They are put together as one with an `If`, so that a single stroke does not pay for
what lies between strokes.
"""

from __future__ import annotations

import tempfile
import warnings
from pathlib import Path

import onnx
import torch
from onnx import GraphProto, ModelProto, NodeProto, helper
from torch import Tensor, nn

from training.reader import RawReader

INPUTS = ("points", "times", "stroke", "page", "timed")
OUTPUTS = ("kinds", "strange", "together")
AXES = {"points": "points", "times": "points", "stroke": "points", "first": "rows", "last": "rows"}
"""Of what there may be any number in each array; of the others: strokes."""
OPSET = 18
"""The newest that the exporter knows well; onnxruntime and onnxruntime-web know far newer ones."""
BETWEEN = ("encoded", "paths", "first", "last", "same", "company")


def export(reader: RawReader, target: Path, metadata: dict[str, str]) -> None:
    """Writes the ONNX file: inputs and outputs as `training.reader` describes them, any number of points and
    strokes."""
    model = assembled(reader)
    for key, text in metadata.items():
        entry = model.metadata_props.add()
        entry.key, entry.value = key, text
    onnx.checker.check_model(model, full_check=True)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(model.SerializeToString())


def assembled(reader: RawReader) -> ModelProto:
    """The whole reader as one model."""
    points, times = torch.rand(7, 2, dtype=torch.float64), torch.arange(7, dtype=torch.float64)
    stroke, page, timed = torch.tensor([0, 0, 0, 1, 1, 2, 2]), torch.tensor([0, 0, 0]), torch.ones(3)
    raw = {"points": points, "stroke": stroke, "page": page}
    with torch.no_grad():
        encoded, paths, first, last, same, _ = reader.encoded(*raw.values())
    front = _exported(reader.encoded, raw, BETWEEN)
    company = {"encoded": encoded, "paths": paths, "first": first, "last": last}
    company |= {"same": same, "times": times, "timed": timed}
    branches = {
        "then_branch": _exported(reader.in_company, company, OUTPUTS),
        "else_branch": _exported(reader.alone, {"encoded": encoded, "same": same}, OUTPUTS),
    }
    graph = front.graph
    _planar(graph)
    stored: dict[bytes, str] = {}
    graphs: dict[str, GraphProto] = {}
    for name, branch in branches.items():
        _prefixed(branch.graph, f"{name[:4]}.", (*BETWEEN, *INPUTS))
        graphs[name] = _bare(branch.graph, graph, stored)
    choice = helper.make_node("If", ["company"], list(OUTPUTS), name="company_or_not")
    choice.attribute.extend(helper.make_attribute(name, branch) for name, branch in graphs.items())
    graph.node.append(choice)
    known = {value.name: value for value in (*graph.input, *branches["then_branch"].graph.input)}
    outputs = list(branches["then_branch"].graph.output)
    for value, name in zip(outputs, OUTPUTS, strict=True):
        value.name = name
    whole = helper.make_graph(
        list(graph.node), "inklined", [known[name] for name in INPUTS], outputs, list(graph.initializer)
    )
    model = helper.make_model(whole, opset_imports=list(front.opset_import), ir_version=10)
    model.producer_name = "inklined"
    return model


def _exported(module: nn.Module, example: dict[str, Tensor], outputs: tuple[str, ...]) -> ModelProto:
    """A part as a model of its own: strokes and points may be any number."""
    axes = {name: {0: AXES.get(name, "strokes")} for name in example}
    axes |= {name: {0: "strokes"} for name in OUTPUTS}
    axes |= {name: {0: "strokes", 1: "strokes"} for name in ("same", "together")}
    with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
        # Branches by Python values would be frozen: a reader has none, and parity is tested. The newer exporter
        # writes the same operators, but thinks a hundred times as long about them.
        warnings.simplefilter("ignore")
        file = Path(folder) / "part.onnx"
        torch.onnx.export(
            module.eval(),
            tuple(example.values()),
            file,
            input_names=list(example),
            output_names=list(outputs),
            dynamic_axes={name: axes[name] for name in (*example, *outputs) if name in axes},
            opset_version=OPSET,
            dynamo=False,
        )
        model = onnx.load(file)
    settled(model.graph)
    return model


def settled(graph: GraphProto) -> None:
    """Stores numbers as numbers, not as operators that yield them, and leaves out what is for debugging: machine
    paths are not for shipping."""
    operators = list(graph.node)
    del graph.node[:], graph.value_info[:]
    for node in operators:
        node.doc_string = ""
        if node.op_type == "Constant":
            (value,) = node.attribute
            graph.initializer.append(value.t)
            graph.initializer[-1].name = node.output[0]
        else:
            graph.node.append(node)


def _planar(graph: GraphProto) -> None:
    """Makes the convolutions along strokes ones over pictures of one row: runtimes have better code for those."""
    weights = {tensor.name: tensor for tensor in graph.initializer}
    graph.initializer.append(helper.make_tensor("row", onnx.TensorProto.INT64, [1], [2]))
    convolutions = [node for node in graph.node if node.op_type == "Conv"]
    for node in convolutions:
        dims = weights[node.input[1]].dims
        dims[:] = [dims[0], dims[1], 1, dims[2]]
        for attribute in node.attribute:
            match attribute.name:
                case "pads":
                    before, after = attribute.ints
                    attribute.ints[:] = [0, before, 0, after]
                case "kernel_shape" | "strides" | "dilations":
                    attribute.ints[:] = [1, *attribute.ints]
                case _:
                    pass
    # What comes after them flattens the row by itself.
    first = convolutions[0]
    lying = helper.make_node("Unsqueeze", [first.input[0], "row"], ["lying"], name="lying")
    first.input[0] = "lying"
    graph.node.insert(list(graph.node).index(first), lying)


def _prefixed(graph: GraphProto, prefix: str, kept: tuple[str, ...]) -> None:
    """Gives every value of a branch a name that no other has, but for those that come from outside."""
    outside = {value.name for value in graph.input} & set(kept)

    def renamed(name: str) -> str:
        return name if name in outside or not name else prefix + name

    for tensor in graph.initializer:
        tensor.name = renamed(tensor.name)
    for node in graph.node:
        node.name = prefix + node.name
        _rename(node, {name: renamed(name) for name in (*node.input, *node.output)})
    for value in graph.output:
        value.name = renamed(value.name)


def _bare(branch: GraphProto, graph: GraphProto, stored: dict[bytes, str]) -> GraphProto:
    """The branch without inputs, its stored numbers moved to the outer graph, each only once."""
    known: dict[str, str] = {}
    for tensor in branch.initializer:
        name = tensor.name
        tensor.name = ""
        content = tensor.SerializeToString()
        if content not in stored:
            stored[content] = name
            tensor.name = name
            graph.initializer.append(tensor)
        known[name] = stored[content]
    for node in branch.node:
        _rename(node, known)
    return helper.make_graph(list(branch.node), branch.name, [], list(branch.output))


def _rename(node: NodeProto, names: dict[str, str]) -> None:
    inputs, outputs = ([names.get(name, name) for name in side] for side in (node.input, node.output))
    del node.input[:], node.output[:]
    node.input.extend(inputs)
    node.output.extend(outputs)
