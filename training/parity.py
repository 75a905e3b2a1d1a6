"""The Python path beside the ONNX file: strokes cleaned and spaced by `sketch.geometry`, the rest by torch."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import onnxruntime
import torch

from data_gen.strokes import items
from recognizer.learned.raw import feeds
from sketch.geometry import distinct, resample
from sketch.ink import Stroke
from training.features import POINTS
from training.reader import RawReader

CHUNK = 64
"""Strokes read together, one or a few on each page."""


def parity(reader: RawReader, file: Path, seed: int, strokes: int) -> float:
    """Largest difference of any probability between the ONNX file on raw ink and the Python path, over at least
    so many generated strokes, alone and in company of up to three drawings a page."""
    session = onnxruntime.InferenceSession(str(file), providers=["CPUExecutionProvider"])
    worst, done, start = 0.0, 0, 0
    while done < strokes:
        drawn = items(CHUNK, seed, start)
        rng = np.random.default_rng([seed, start])
        page_of = np.cumsum((rng.random(len(drawn)) < 0.6).astype(np.int64))
        every = [stroke for item in drawn for stroke in item.strokes]
        page = np.repeat(page_of, [len(item.strokes) for item in drawn])
        there = session.run(None, feeds(every, page))
        worst = max(worst, _apart(python_path(reader, every, page), there))
        done, start = done + len(every), start + CHUNK
    return worst


def python_path(
    reader: RawReader, strokes: list[Stroke], page: np.ndarray[tuple[int], np.dtype[np.int64]]
) -> list[np.ndarray[tuple[int, ...], np.dtype[np.float32]]]:
    """kinds (s, 9), strange (s,), together (s, s), as the ONNX file gives them."""
    cleaned = [distinct(stroke.points) for stroke in strokes]
    moments = [(0.0, 0.0) if s.times is None else (float(s.times[0]), float(s.times[-1])) for s in strokes]
    with torch.no_grad():
        said = reader.read(
            torch.from_numpy(np.array([resample(points, POINTS) for points in cleaned])),
            torch.tensor([float(len(points)) for points in cleaned]),
            torch.tensor(moments, dtype=torch.float64),
            torch.from_numpy(page),
            torch.tensor([float(stroke.times is not None) for stroke in strokes]),
        )
    return [answer.numpy() for answer in said]


def _apart(one: list[np.ndarray[tuple[int, ...], np.dtype[np.float32]]], other: Sequence[object]) -> float:
    """Largest difference; infinity where there is no number on either side."""
    differences = np.array([np.abs(a - np.asarray(b)).max() for a, b in zip(one, other, strict=True)])
    return float(differences.max()) if np.isfinite(differences).all() else float("inf")
