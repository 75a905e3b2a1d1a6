"""Fitting how sure a reading is: a logistic curve over what the search says, on generated lines by harder hands than taught it.

People's ink is harder to read than the generator's, and may not be fitted to. So the hands here depart farther from the
copybook than those that the nets were taught by, and half of the writers are of the groups whose hands are least steady.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from sklearn.linear_model import LogisticRegression

from data_gen.writers import sample_writer
from data_gen.writing.grammars import mixed
from data_gen.writing.habits import TypeRule, habits
from data_gen.writing.typeset import written
from recognizer.handwriting.confidence import Curve, measures
from recognizer.handwriting.reader import Reader
from sketch.writing.rows import latex

UNSTEADY = ("child", "tremor", "low_vision")
HARDER = TypeRule(
    freedom=(0.8, 2.6),
    uneven=(0.05, 0.24),
    jump=(0.03, 0.16),
    gap=(0.0, 0.38),
    script=(0.5, 1.0),
    turn=0.08,
    lean=0.16,
)
"""The hands: signs bent nearly twice as far, sizes and baselines half as steady again, scripts larger, gaps smaller."""


def calibrate(reader: Reader, lines: int, seed: int) -> tuple[Curve, float]:
    """The curve, and the share of the lines that were read right."""
    shown: list[tuple[float, float, float]] = []
    right: list[bool] = []
    for index in range(lines):
        rng = np.random.default_rng([seed, 10**9, index])
        row = mixed(rng)
        profile = UNSTEADY[index % len(UNSTEADY)] if index % 2 else None
        found = written(row, habits(sample_writer(rng, profile), rng, HARDER))
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
