"""Raw ink into the ONNX file with onnxruntime and numpy alone, no preprocessing.

python examples/raw_onnx.py recognizer/learned/weights/strokes.onnx < ink.json
ink.json: the strokes of one page, [[[x, y, t_seconds or null], …], …]; y grows downward, any unit.
"""

import json
import sys

import numpy as np
import onnxruntime

KINDS = ("circle", "polygon", "spring", "wire", "arrow", "tap", "scribble", "lasso", "math")
page = json.load(sys.stdin)
points = [point for stroke in page for point in stroke]
session = onnxruntime.InferenceSession(sys.argv[1], providers=["CPUExecutionProvider"])
kinds, strange, together = session.run(
    None,
    {
        "points": np.array([point[:2] for point in points], dtype=np.float64),
        "times": np.array([point[2] or 0.0 for point in points], dtype=np.float64),
        "stroke": np.repeat(np.arange(len(page)), [len(stroke) for stroke in page]),
        "page": np.zeros(len(page), dtype=np.int64),
        "timed": np.array([stroke[0][2] is not None for stroke in page], dtype=np.float32),
    },
)
names = [KINDS[row.argmax()] for row in kinds]
found = {
    "names": names,
    "scores": kinds.tolist(),
    "strange": strange.tolist(),
    "together": together.ravel().tolist(),
}
sys.stdout.write(json.dumps(found) + "\n")
