"""Raw strokes to signs of mathematics with onnxruntime and numpy alone: looks.onnx, then signs.onnx.

python examples/raw_signs.py recognizer/handwriting/weights < ink.json
ink.json: {"strokes": [[[x, y], …], …], "groups": [[0], [1, 2], …], "alone": false}; y grows downward, any unit. A group
holds the strokes of what may be one sign; alone: each group by itself, not on the line that all strokes make.
"""

import json
import sys
from pathlib import Path

import numpy as np
import onnxruntime

weights = Path(sys.argv[1])
page = json.load(sys.stdin)
looks, signs = (
    onnxruntime.InferenceSession(str(weights / name), providers=["CPUExecutionProvider"])
    for name in ("looks.onnx", "signs.onnx")
)
most = max(len(group) for group in page["groups"])
shown = ["sequence", "images", "numbers"]
seen = looks.run(
    shown,
    {
        "points": np.array([point[:2] for stroke in page["strokes"] for point in stroke], dtype=np.float64),
        "ends": np.cumsum([len(stroke) for stroke in page["strokes"]]),
        "groups": np.array([group + [-1] * (most - len(group)) for group in page["groups"]]),
        "alone": np.full(len(page["groups"]), page.get("alone", False)),
    },
)
(scores,) = signs.run(None, dict(zip(shown, seen, strict=True)))
# The last answer is that the group is no sign.
names = [*json.loads(looks.get_modelmeta().custom_metadata_map["signs"]), ""]
shares = np.exp(scores - scores.max(axis=1, keepdims=True))
shares /= shares.sum(axis=1, keepdims=True)
found = {"signs": [names[row.argmax()] for row in shares], "chances": shares.max(axis=1).tolist()}
sys.stdout.write(json.dumps(found, ensure_ascii=False) + "\n")
