"""Laws of handwritten lines: what a formula looks like whatever hand wrote it."""

import numpy as np
import pytest

from data_gen.typeset import Hand, hand, line
from data_gen.writers import sample_writer
from sketch.formula.lexer import FormulaError


def somebody(seed: int, stacked: bool = True) -> Hand:
    rng = np.random.default_rng([9, seed])
    writer = sample_writer(rng)
    made = hand(writer, rng)
    return Hand(made.writer, made.usual, stacked, rng)


def box(path):
    return path.min(axis=0), path.max(axis=0)


TEXTS = [
    "theta = pi/6",
    "f_1 = 0.9 |W| cos(theta)",
    "T_1 = 5 sqrt(2)",
    "v_x = -1.5",
    "g = 10",
    "1/2 m v^2 = m g h",
]


@pytest.mark.parametrize("text", TEXTS)
def test_a_line_is_centred_and_made_of_finite_strokes(text):
    for seed in range(8):
        strokes = line(text, somebody(seed))
        low, high = box(np.concatenate(strokes))
        assert np.isfinite(low).all() and np.isfinite(high).all()
        np.testing.assert_allclose(low + high, 0, atol=1e-9)


@pytest.mark.parametrize("text", TEXTS)
def test_a_line_is_as_tall_as_its_writer_writes(text):
    for seed in range(8):
        by = somebody(seed)
        low, high = box(np.concatenate(line(text, by)))
        assert 0.6 < (high - low)[1] / by.writer.height < 3.2


def test_a_stacked_fraction_has_its_numerator_above_and_its_denominator_below_the_bar():
    for seed in range(8):
        strokes = line("1/2", somebody(seed))
        bar = max(range(len(strokes)), key=lambda k: np.ptp(strokes[k][:, 0]))
        height = strokes[bar][:, 1].mean()
        assert max(path[:, 1].max() for path in strokes[:bar]) < height
        assert min(path[:, 1].min() for path in strokes[bar + 1 :]) > height


def test_a_slashed_fraction_keeps_to_one_line():
    for seed in range(8):
        stacked = np.concatenate(line("pi/6", somebody(seed)))
        slashed = np.concatenate(line("pi/6", somebody(seed, stacked=False)))
        assert np.ptp(slashed[:, 1]) < np.ptp(stacked[:, 1])


def test_a_root_covers_what_stands_under_it():
    for seed in range(8):
        root, *inner = line("sqrt(25)", somebody(seed))
        low, high = box(np.concatenate(inner))
        assert root[:, 1].min() < low[1]
        assert root[:, 0].min() < low[0]
        assert root[-1, 0] > high[0] - 0.1 * np.ptp(root[:, 0])


def test_subscripts_hang_below_their_letter_and_exponents_rise_above_it_both_smaller_than_a_capital():
    for seed in range(8):
        by = somebody(seed)
        letter = len(line("x", somebody(seed)))
        for text, higher in (("x_2", False), ("x^2", True)):
            strokes = line(text, somebody(seed))
            base, script = box(np.concatenate(strokes[:letter])), box(np.concatenate(strokes[letter:]))
            beyond = base[0][1] - script[0][1] if higher else script[1][1] - base[1][1]
            assert beyond > 0.1 * by.writer.height
            assert (script[1] - script[0])[1] < 0.85 * by.writer.height


def test_text_that_is_no_formula_is_refused_with_its_place():
    with pytest.raises(FormulaError) as caught:
        line("(1 + 2", somebody(0))
    assert caught.value.position == 6
    with pytest.raises(FormulaError):
        line("a = /2", somebody(0))
