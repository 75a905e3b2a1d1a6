"""Laws of pages: what is undone was never done, what is in the log is what is seen, gestures mean what lies under them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketch.formula.parse import expression
from sketch.ink import Ink, Stroke
from sketch.page import Sketch
from studio.actions import (
    KINDS,
    Action,
    Associate,
    Dissociate,
    Draw,
    Erase,
    Fix,
    Move,
    Select,
    Title,
    Write,
    done,
    dumps,
    from_json,
    loads,
)
from studio.board import Board
from studio.examples import EXAMPLES, example
from studio.gestures import understood
from studio.history import KEPT, REDO, UNDO, History, remembered
from studio.limits import Refused
from studio.reading import Reading, analyzed, rival
from studio.store import Entry, Penned, Store
from studio.view import shown, state
from studio_workshop import RAMP, dense, dot, loop, ring, zigzag

STROKES = {
    "ramp": dense(RAMP),
    "ball": ring(330, 180, 34, 3.0),
    "other": ring(90, 90, 25, 6.0),
    "line": dense([(20, 400), (90, 404)], start=9.0),
}


def drawn(*names: str) -> Board:
    board = Board()
    for name in names:
        board = done(board, Draw(name), STROKES.__getitem__)
    return board


def read(board: Board) -> Board:
    return done(board, analyzed(board, "geometric"), STROKES.__getitem__)


@pytest.fixture(scope="module")
def page() -> Board:
    """A ramp and a ball that were read, with two formulas, one of them said of the ball."""
    board = read(drawn("ramp", "ball"))
    ball = next(part for part in board.sketch.components if part.kind == "circle")
    for action in (
        Write("m = 2", at=(500, 100)),
        Write("g = 10", at=(500, 160)),
        Associate((0,), ball.label, (330.0, 180.0)),
    ):
        board = done(board, action, STROKES.__getitem__)
    return board


LABELS = st.sampled_from(["A", "B"])
FAR = st.floats(-300, 300)
ACTIONS: st.SearchStrategy[Action] = st.one_of(
    st.builds(Draw, st.sampled_from(["other", "line"])),
    st.builds(Fix, LABELS, st.booleans()),
    st.builds(Title, st.text(max_size=20, alphabet=st.characters(exclude_categories=("Cs",)))),
    st.builds(Write, st.sampled_from(["k = 3", "v = 2 m/s", "((", "F = m a"]), st.sampled_from([None, 0, 1]), st.tuples(FAR, FAR)),
    st.builds(Select, st.just(()), st.lists(LABELS, unique=True).map(tuple), st.sampled_from([(), (0,), (0, 1)])),
    st.builds(Move, FAR, FAR),
    st.builds(Associate, st.sampled_from([(0,), (1,), (0, 1)]), LABELS, st.tuples(FAR, FAR)),
    st.builds(Dissociate, st.sampled_from([0, 1]), LABELS),
    st.builds(Erase, st.just(()), st.lists(LABELS, max_size=1).map(tuple), st.sampled_from([(), (0,)])),
)  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(st.lists(st.one_of(ACTIONS, st.sampled_from([UNDO, REDO])), max_size=14))
def test_a_log_that_is_read_again_gives_the_same_page_and_undoing_all_of_it_gives_the_first(
    page: Board, entries: list[Action | str]
) -> None:
    history = History(STROKES.__getitem__)
    history.take(Title("start"), page)
    log: list[str] = []
    for entry in entries:
        try:
            board = history.foreseen(entry)
        except Refused:
            continue  # an action for what is not there any more
        if isinstance(entry, Draw) and entry.stroke in history.board.names:
            continue
        history.take(entry, board)
        log.append(entry if isinstance(entry, str) else dumps(entry))
    again = History(STROKES.__getitem__)
    again.take(Title("start"), page)
    for entry in log:
        again.take(entry, again.foreseen(entry))
    assert again.board == history.board
    now = history.board
    steps = 0
    while history.undoable is not None and steps < 40:
        history.take(UNDO, history.foreseen(UNDO))
        steps += 1
    for _ in range(steps):
        history.take(REDO, history.foreseen(REDO))
    assert history.board == now


@settings(max_examples=60, deadline=None)
@given(ACTIONS)
def test_an_action_is_the_same_after_it_was_written_down(action: Action) -> None:
    assert loads(dumps(action)) == action
    assert dumps(action)[8:].split('"')[0] in KINDS


def test_undo_goes_back_beyond_the_boards_that_are_kept() -> None:
    history = History(STROKES.__getitem__)
    for number in range(KEPT + 130):
        action = Title(str(number))
        history.take(action, history.foreseen(action))
    for number in range(KEPT + 128, -1, -1):
        board = history.foreseen(UNDO)
        history.take(UNDO, board)
        assert board.title == str(number)


def test_dragging_there_and_back_is_nothing_but_rounding(page: Board) -> None:
    there = done(
        done(page, Select((), ("A", "B"), (0, 1)), STROKES.__getitem__),
        Move(31.5, -20.25),
        STROKES.__getitem__,
    )
    back = done(there, Move(-31.5, 20.25), STROKES.__getitem__)
    for one, other in zip(page.sketch.ink, back.sketch.ink, strict=True):
        np.testing.assert_allclose(one.points, other.points, atol=1e-9)
    assert back.sketch.associations == page.sketch.associations


def test_what_is_said_of_a_thing_outlives_that_it_is_dragged_and_that_the_formula_is_rewritten(
    page: Board,
) -> None:
    ball = page.sketch.associations[0].component
    moved = done(done(page, Select((), (ball,), ()), STROKES.__getitem__), Move(50, -40), STROKES.__getitem__)
    after = done(moved, Write("m = 7", 0), STROKES.__getitem__)
    (one,) = after.sketch.associations
    assert (one.component, one.expression, one.anchor) == (ball, 0, (380.0, 140.0))


def test_reading_twice_is_reading_once_and_new_ink_only_adds(page: Board) -> None:
    again = read(page)
    assert again.sketch == page.sketch
    more = read(done(page, Draw("other"), STROKES.__getitem__))
    assert more.sketch.components[: len(page.sketch.components)] == page.sketch.components
    assert len(more.sketch.components) == len(page.sketch.components) + 1
    assert more.sketch.associations == page.sketch.associations
    assert len({part.label for part in more.sketch.components}) == len(more.sketch.components)


def test_reading_anew_keeps_labels_what_is_fixed_and_what_is_said(page: Board) -> None:
    fixed = done(page, Fix("B", True), STROKES.__getitem__)
    anew = done(fixed, analyzed(fixed, "learned", anew=True), STROKES.__getitem__)
    assert {(part.label, part.kind, part.fixed) for part in anew.sketch.components} == {
        (part.label, part.kind, part.fixed) for part in fixed.sketch.components
    }
    assert anew.sketch.associations == fixed.sketch.associations


def test_a_reader_of_handwriting_is_given_each_unread_line_once() -> None:
    truth, _ = example("incline")
    board = Board(
        tuple(f"s{k}" for k in range(len(truth.ink))), Sketch(truth.ink), ((0.0, 0.0),) * len(truth.ink)
    )
    seen: list[Ink] = []

    def reader(line: Ink) -> Reading:
        seen.append(line)
        return Reading("m = 3", 0.7, ("m = 8",))

    once = done(board, analyzed(board, "learned", hand=reader), STROKES.__getitem__)
    assert [line.text for line in once.sketch.expressions] == ["m = 3"] * len(truth.expressions)
    assert [line.alternatives for line in once.sketch.expressions] == [("m = 8",)] * len(truth.expressions)
    assert len(seen) == len(truth.expressions)
    analyzed(once, "learned", hand=reader)
    assert len(seen) == len(truth.expressions)


def told(board: Board, stroke: Stroke) -> tuple[str, Action | None]:
    found = understood(board, shown(board).sketch, "g", stroke, rival("geometric"))
    return found.said, found.action


def test_a_ring_about_a_thing_takes_it_and_one_about_nothing_is_a_ring(page: Board) -> None:
    ball = next(part.label for part in page.sketch.components if part.kind == "circle")
    said, action = told(page, loop(Ink((STROKES["ball"],)), [0], margin=6))
    assert said == "lasso" and isinstance(action, Select) and action.components == (ball,)
    assert told(page, ring(700, 400, 40))[0] == "drawn"


def test_a_ring_about_a_typed_formula_takes_it_and_a_scribble_over_it_erases_it(page: Board) -> None:
    angle = np.linspace(0.2, 2 * np.pi + 0.3, 90)
    about = dense(np.array([500, 160]) + np.column_stack([90 * np.cos(angle), 30 * np.sin(angle)]))
    said, action = told(page, about)
    assert said == "lasso" and isinstance(action, Select) and action.lines == (1,)
    xs = np.linspace(465, 535, 14)
    said, action = told(page, dense(np.column_stack([xs, np.where(np.arange(14) % 2, 145, 175)])))
    assert said == "scribble" and isinstance(action, Erase) and action.lines == (1,)


def test_to_and_fro_over_a_thing_erases_it_with_its_ink(page: Board) -> None:
    said, action = told(page, zigzag(Ink((STROKES["ball"],)), [0]))
    assert said == "scribble" and isinstance(action, Erase)
    after = done(page, action, STROKES.__getitem__)
    assert [part.kind for part in after.sketch.components] == ["polygon"]
    assert after.names == ("ramp",)
    assert not after.sketch.associations and len(after.sketch.expressions) == 2


def test_a_tap_on_a_shape_fixes_it_and_with_a_formula_selected_says_the_formula_of_it(page: Board) -> None:
    ramp = next(part.label for part in page.sketch.components if part.kind == "polygon")
    assert told(page, dot(400, 300)) == ("tap", Fix(ramp, True))
    chosen = replace(page, selected=done(page, Select((), (), (1,)), STROKES.__getitem__).selected)
    said, action = told(chosen, dot(400, 300))
    assert (
        said == "tap" and isinstance(action, Associate) and (action.lines, action.component) == ((1,), ramp)
    )
    assert told(page, dot(700, 430))[0] == "drawn"


@pytest.mark.parametrize(
    "sent",
    [
        [], {}, {"do": "fly"}, {"do": "move"}, {"do": "move", "dx": "1", "dy": 2}, {"do": "move", "dx": float("nan"), "dy": 0},
        {"do": "fix", "component": 3, "fixed": True}, {"do": "write", "text": 5}, {"do": "write", "text": "x" * 2000},
        {"do": "select", "strokes": "abc"}, {"do": "associate", "lines": [True], "component": "A", "anchor": [0, 0]},
        {"do": "leave", "rule": "C9", "component": "A"}, {"do": "title", "title": "\ud800"}, {"do": "fix", "component": "A", "fixed": True, "more": 1},
    ],
)  # fmt: skip
def test_actions_that_are_none_are_refused_with_a_sentence(sent: object) -> None:
    with pytest.raises(Refused, match=r"\w+ \w+"):
        from_json(sent)


def test_what_was_appended_is_there_when_the_notebook_is_opened_again(tmp_path: Path) -> None:
    store = Store(tmp_path / "notebook.sqlite")
    page = store.create()
    stroke = Stroke([[0.1, 1 / 3], [2e5, -7.25]], [0.5, 0.75], None)
    store.append(page, 0, Entry("k1", dumps(Draw("k1"))), [Penned("k1", stroke, "pen")], "first", "m = 2", 1)
    store.append(page, 1, Entry("k2", UNDO), [], "first", "", 0)
    other = Store(tmp_path / "notebook.sqlite")  # as after a kill: the first was never closed
    assert other.strokes(page)["k1"] == Penned("k1", stroke, "pen")
    entries = [entry.text for entry in other.log(page)]
    assert remembered(entries, lambda name: other.strokes(page)[name].stroke).board == Board()
    assert [one.id for one in other.pages("FIRST")] == [page] and other.pages("absent") == []
    other.throw(page)
    assert other.pages() == []
    other.fetch_back(page)
    assert other.page(page).title == "first"


def test_an_entry_is_written_with_its_strokes_or_not_at_all(tmp_path: Path) -> None:
    store = Store(tmp_path / "notebook.sqlite")
    page = store.create()
    stroke = Penned("s", Stroke([[0, 0]]))
    store.append(page, 0, Entry("k", dumps(Draw("s"))), [stroke], "", "", 1)
    with pytest.raises(Exception, match="UNIQUE"):
        store.append(page, 1, Entry("k", dumps(Draw("t"))), [Penned("t", Stroke([[1, 1]]))], "", "", 2)
    assert set(store.strokes(page)) == {"s"} and len(store.log(page)) == 1


@pytest.mark.parametrize("one", EXAMPLES, ids=lambda one: one.name)
def test_examples_can_be_shown(one) -> None:
    sketch, title = example(one.name)
    assert title and sketch.components and len(sketch.ink)
    board = Board(tuple(f"s{k}" for k in range(len(sketch.ink))), sketch, ((0.0, 0.0),) * len(sketch.ink))
    history = History(STROKES.__getitem__)
    history.take(Title(""), board)
    told_of = state("page", history, shown(board))
    assert all(line["mathml"] for line in told_of["lines"])
    assert all(
        line == expression(line.text, line.strokes, line.at) for line in sketch.expressions if line.text
    )
