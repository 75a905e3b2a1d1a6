"""Fitting how sure a reading is: a logistic curve over what the search says, on generated lines by hard hands.

Half of the writers are of the groups whose hands are least steady: people's ink is harder than the
generator's adults, and may not be fitted to.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from sklearn.linear_model import LogisticRegression

from data_gen.writers import sample_writer
from data_gen.writing.grammars import mixed
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from recognizer.handwriting.confidence import Curve, measures
from recognizer.handwriting.reader import Reader
from sketch.writing.rows import latex

HARD = ("child", "tremor", "low_vision")


def calibrate(reader: Reader, lines: int, seed: int) -> tuple[Curve, float]:
    """The curve, and the share of the lines that were read right."""
    shown: list[tuple[float, float, float]] = []
    right: list[bool] = []
    for index in range(lines):
        rng = np.random.default_rng([seed, 10**9, index])
        row = mixed(rng)
        profile = HARD[index % len(HARD)] if index % 2 else None
        found = written(row, habits(sample_writer(rng, profile), rng))
        reading = reader.read(found.ink.strokes)
        shares = 1.0 / (
            1.0 + sum(chance for _, chance in reading.alternatives) / max(reading.confidence, 1e-9)
        )
        shown.append(measures(shares, [symbol.confidence for symbol in reading.symbols]))
        right.append(reading.latex == latex(row))
    return curve_of(shown, right), float(np.mean(right))


def curve_of(shown: Sequence[tuple[float, float, float]], right: Sequence[bool]) -> Curve:
    """The logistic curve that makes these outcomes likeliest, gently held to small weights."""
    fitted = LogisticRegression(C=1.0).fit(np.asarray(shown), np.asarray(right))
    share, signs, worst = fitted.coef_[0].tolist()
    return Curve(float(fitted.intercept_[0]), share, signs, worst)
