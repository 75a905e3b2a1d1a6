"""Mathematics as it is being written: the same as when it is read at once, and nothing but mathematics."""

from __future__ import annotations

import numpy as np
import pytest

from sketch.ink import Ink, Stroke
from studio.actions import Associate, Draw, Erase, Write, done
from studio.board import Board
from studio.limits import Refused
from studio.live import Live, begun, live_json, read_on, reader_from
from studio.reading import Reading, analyzed, reader
from studio_workshop import RAMP, dense, line_of, ring

DIAGRAM = {
    "ramp": dense(RAMP),
    "ball": ring(330, 180, 34, 3.0),
    "wire": dense([(330, 70), (330, 146)], start=6.0),
    "bob": ring(330, 48, 22, 7.0),
}
MASS = {f"m{k}": stroke for k, stroke in enumerate(line_of("m = 2", 520, 60, seed=4))}
ANGLE = {f"a{k}": stroke for k, stroke in enumerate(line_of(r"\theta = 0 . 5", 520, 200, seed=4, start=20.0))}
STROKES: dict[str, Stroke] = {**DIAGRAM, **MASS, **ANGLE}


def drawn(names: list[str], board: Board = Board()) -> Board:
    for name in names:
        board = done(board, Draw(name), STROKES.__getitem__)
    return board


def told(live: Live) -> list[tuple[str, tuple[str, ...]]]:
    return sorted((line.reading.text, line.strokes) for line in live.lines)


@pytest.fixture(scope="module")
def written() -> tuple[Board, Live]:
    """A diagram and two lines, read after each stroke."""
    live, board = begun(), Board()
    for name in STROKES:
        board = drawn([name], board)
        live = read_on(live, board, reader())
    return board, live


def test_read_stroke_by_stroke_it_says_what_it_says_read_at_once(written: tuple[Board, Live]) -> None:
    board, live = written
    assert told(live) == told(read_on(begun(), board, reader()))
    assert told(live) == [("m = 2", tuple(MASS)), ("theta = 0.5", tuple(ANGLE))]


def test_what_is_drawn_is_not_read_as_mathematics() -> None:
    live, board = begun(), Board()
    for name in DIAGRAM:
        board = drawn([name], board)
        live = read_on(live, board, reader())
        assert live.lines == ()


def test_analyze_takes_what_was_shown_without_reading_it_again(written: tuple[Board, Live]) -> None:
    board, live = written
    read = done(board, analyzed(board, hand=reader_from(live)), STROKES.__getitem__)
    assert [line.text for line in read.sketch.expressions] == ["m = 2", "theta = 0.5"]
    assert read == done(board, analyzed(board), STROKES.__getitem__)
    assert read_on(live, read, reader()).lines == ()
    asked: list[Ink] = []

    def stranger(line: Ink) -> Reading | None:
        asked.append(line)
        return None

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("studio.live.HAND_READER", stranger)
        analyzed(board, hand=reader_from(live))
        assert not asked
        copy = Ink(tuple(stroke.moved_to(stroke.points + 1.0) for stroke in MASS.values()))
        reader_from(live)(copy)
        assert len(asked) == 1


def test_a_formula_of_which_a_sign_is_erased_and_written_anew_is_read_anew_and_governs_what_it_governed(
    written: tuple[Board, Live],
) -> None:
    """Rows P5 and R4."""
    board, live = written
    read = done(board, analyzed(board, hand=reader_from(live)), STROKES.__getitem__)
    ball = next(part.label for part in read.sketch.components if part.kind == "circle")
    read = done(read, Associate((0,), ball, (330.0, 180.0)), STROKES.__getitem__)
    *_, two = MASS
    erased = done(read, Erase((two,)), STROKES.__getitem__)
    assert erased.sketch.expressions[0].text is None
    assert erased.sketch.associations == read.sketch.associations
    old = STROKES[two].points
    new = line_of("7", *old.min(axis=0).tolist(), seed=4, height=float(np.ptp(old[:, 1])), start=40.0)
    for k, stroke in enumerate(new):
        STROKES[f"new{k}"] = stroke
    rewritten = drawn([f"new{k}" for k in range(len(new))], erased)
    live = read_on(live, rewritten, reader())
    (line,) = live.lines
    assert (line.line, line.reading.text) == (0, "m = 7")
    again = done(rewritten, analyzed(rewritten, hand=reader_from(live)), STROKES.__getitem__)
    assert [line.text for line in again.sketch.expressions] == ["m = 7", "theta = 0.5"]
    assert again.sketch.associations == read.sketch.associations


def test_ink_can_be_said_to_be_a_formula_before_the_page_is_read_and_stays_one(
    written: tuple[Board, Live],
) -> None:
    board, live = written
    said = done(board, Write("m = 12", strokes=tuple(MASS)), STROKES.__getitem__)
    (line,) = said.sketch.expressions
    assert {said.names[stroke] for stroke in line.strokes} == set(MASS)
    assert told(read_on(live, said, reader())) == [("theta = 0.5", tuple(ANGLE))]
    read = done(said, analyzed(said), STROKES.__getitem__)
    assert [one.text for one in read.sketch.expressions] == ["m = 12", "theta = 0.5"]
    with pytest.raises(Refused, match="gone or has been read"):
        done(said, Write("m = 3", strokes=tuple(MASS)), STROKES.__getitem__)
    with pytest.raises(Refused, match="gone or has been read"):
        done(board, Write("m = 3", strokes=("nowhere",)), STROKES.__getitem__)


def test_what_browsers_are_told_is_mathml_and_how_sure_it_is(written: tuple[Board, Live]) -> None:
    lines = {line["text"]: line for line in live_json(written[1])["lines"]}
    angle = lines["theta = 0.5"]
    assert "<mi>θ</mi>" in angle["mathml"] and "<mn>0.5</mn>" in angle["mathml"]
    assert 0 <= angle["confidence"] <= 1 and angle["sure"] == (angle["confidence"] >= 0.5)
    assert angle["line"] is None and angle["strokes"] == tuple(ANGLE)
