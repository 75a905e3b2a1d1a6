"""From claims to a page: the oracle's page is the truth, and each rule of R3 by its consequence."""

from __future__ import annotations

import time

import numpy as np
import pytest

from data_gen import ideals
from data_gen.pages import page as generated
from data_gen.problems import PROBLEMS
from recognizer.claims import Bonds, Claim, claim_for
from recognizer.group import apart, bound
from recognizer.interpret import Note, interpret, notes_of, reading_order
from recognizer.oracle import Oracle
from recognizer.roster import recognizer
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import STROKE_KINDS, Gesture, Sketch, StrokeKind, label

BOX = ideals.polygon([[0, 0], [140, 0], [140, 90], [0, 90]])
HIGH_BOX = ideals.polygon([[20, -200], [120, -200], [120, -150], [20, -150]])
WIRE = ideals.line((70, -148), (70, 2))
SPRING = ideals.zigzag((70, -148), (70, 2), 8, 40)
DOT = np.array([[60.0, 40.0], [60.6, 40.4]])


class Told:
    """Says of each stroke what it is told to say."""

    name = "told"
    claims = frozenset(STROKE_KINDS)

    def __init__(self, *claims: StrokeKind | Claim) -> None:
        self._claims = tuple(c if isinstance(c, Claim) else claim_for(c, 0.9) for c in claims)

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        assert len(ink) == len(self._claims)
        return self._claims


def torn(first: StrokeKind, second: StrokeKind) -> Claim:
    """Rather the first kind, perhaps the second."""
    scores = np.full(len(STROKE_KINDS), 0.02)
    scores[STROKE_KINDS.index(first)], scores[STROKE_KINDS.index(second)] = 0.5, 0.36
    return Claim(scores)


def page(*paths: FloatArray) -> Ink:
    return Ink(tuple(Stroke(path if len(path) < 3 else resample(path, 120)) for path in paths))


def structure(sketch: Sketch) -> dict[str, object]:
    """What a page says, free of labels: strokes stand for the components that they draw."""
    drawn = {component.label: frozenset(component.strokes) for component in sketch.components}
    return {
        "components": {
            (c.kind, drawn[c.label], c.fixed, frozenset(drawn[end] for end in c.ends if end))
            for c in sketch.components
        },
        "writing": {frozenset(written.strokes) for written in sketch.expressions},
        "texts": {(written.text, written.strokes) for written in sketch.expressions},
        "associations": {
            (sketch.expressions[a.expression].text, drawn[a.component], a.anchor) for a in sketch.associations
        },
        "gestures": set(sketch.gestures),
    }


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("index", range(4))
def test_told_the_truth_the_page_is_the_truth(name: str, index: int) -> None:
    truth = generated(name, 20, index).truth
    assert structure(interpret(truth.ink, Oracle(truth), notes_of(truth))) == structure(truth)


@pytest.mark.parametrize("name", PROBLEMS)
def test_told_the_truth_shapes_lie_where_they_were_meant(name: str) -> None:
    truth = generated(name, 21, 1).truth
    found = interpret(truth.ink, Oracle(truth), notes_of(truth))
    where = {frozenset(c.strokes): c for c in found.components}
    low, _, high, _ = truth.ink.bounds()
    for meant in truth.components:
        ends = [np.asarray(x) for x in _places(meant)]
        seen = [np.asarray(x) for x in _places(where[frozenset(meant.strokes)])]
        for place in ends:
            # A twelfth: children are among the writers, and their corners stray that far.
            assert min(float(np.hypot(*(place - other))) for other in seen) < 0.08 * (high - low)


def _places(component) -> list:
    shape = component.shape
    if component.kind == "circle":
        return [shape.centre]
    return list(shape.vertices) if component.kind == "polygon" else [shape.start, shape.end]


@pytest.mark.parametrize("link", ["wire", "spring"])
def test_a_link_is_one_only_between_two_shapes(link: StrokeKind) -> None:
    path = WIRE if link == "wire" else SPRING
    held = interpret(page(HIGH_BOX, BOX, path), Told("polygon", "polygon", link))
    (found,) = [c for c in held.components if c.kind == link]
    assert set(found.ends) == {held.components[0].label, held.components[2].label} == {"A", "C"}
    free = interpret(page(BOX, path), Told("polygon", link))
    assert [c.kind for c in free.components] == ["polygon"]
    assert [written.strokes for written in free.expressions] == [(1,)]


def test_both_ends_at_one_shape_make_no_link() -> None:
    across = ideals.line((2, 30), (138, 30))
    found = interpret(page(BOX, across), Told("polygon", "wire"))
    assert [c.kind for c in found.components] == ["polygon"]


def test_a_demoted_link_becomes_its_next_best_claim() -> None:
    away = WIRE + np.array([300.0, 0.0])
    found = interpret(page(BOX, away), Told("polygon", torn("wire", "arrow")))
    assert [c.kind for c in found.components] == ["arrow", "polygon"]


def test_a_shape_must_enclose_an_area_worth_the_name() -> None:
    speck = ideals.circle((300, 0), 1.5)
    found = interpret(page(BOX, speck), Told("polygon", "circle"))
    assert [c.kind for c in found.components] == ["polygon"]
    assert [written.strokes for written in found.expressions] == [(1,)]


def test_a_zero_among_letters_is_a_letter_and_the_same_ring_on_a_wire_is_a_ball() -> None:
    one, ring = ideals.line((300, 40), (300, 60)), ideals.superellipse((312, 50), (7, 10))
    equals = [ideals.line((280, y), (292, y)) for y in (47.0, 53.0)]
    kinds: tuple[StrokeKind, ...] = ("polygon", "math", "circle", "math", "math")
    written = interpret(page(BOX, one, ring, *equals), Told(*kinds))
    assert [c.kind for c in written.components] == ["polygon"]
    assert [e.strokes for e in written.expressions] == [(1, 2, 3, 4)]
    hung = interpret(page(BOX, one, ring, *equals, ideals.line((137, 88), (305, 52))), Told(*kinds, "wire"))
    assert sorted(c.kind for c in hung.components) == ["circle", "polygon", "wire"]


@pytest.mark.parametrize("taps", [0, 1, 2, 3])
def test_each_tap_toggles_what_it_hits(taps: int) -> None:
    dots = [DOT + np.array([3.0 * k, 0.0]) for k in range(taps)]
    found = interpret(page(BOX, *dots), Told("polygon", *["tap"] * taps))
    assert found.components[0].fixed == (taps % 2 == 1)
    assert found.gestures == tuple(Gesture("tap", k + 1) for k in range(taps))


def test_a_dot_in_the_writing_is_a_point() -> None:
    digits = [ideals.superellipse((300 + x, 50), (6, 10)) for x in (0, 26)]
    point = np.array([[313.0, 59.0], [313.4, 59.2]])
    found = interpret(page(BOX, *digits, point), Told("polygon", "math", "math", "tap"))
    assert [e.strokes for e in found.expressions] == [(1, 2, 3)]
    assert found.gestures == ()


def test_a_scribble_erases_what_it_goes_over_and_nothing_else() -> None:
    wrong = ideals.line((300, 0), (380, 30))
    scribble = ideals.zigzag((310, 15), (370, 15), 12, 60)
    found = interpret(page(BOX, wrong, scribble), Told("polygon", "math", "scribble"))
    assert found.kinds() == ("polygon", None, "scribble")


def test_ink_drawn_after_a_scribble_is_not_erased() -> None:
    scribble = ideals.zigzag((310, 15), (370, 15), 12, 60)
    first, later = ideals.line((300, 0), (380, 30)), ideals.line((300, 30), (380, 0))
    found = interpret(page(BOX, first, scribble, later), Told("polygon", "math", "scribble", "math"))
    assert found.kinds() == ("polygon", None, "scribble", "math")


def test_a_gesture_over_nothing_is_its_next_best_claim() -> None:
    ring = page(ideals.circle((0, 0), 50))
    assert interpret(ring, Told(torn("lasso", "circle"))).kinds() == ("circle",)


@pytest.mark.parametrize("pieces", [(1, 1, 1), (2, 1)])
def test_three_lines_that_close_are_a_triangle_however_they_were_claimed(pieces: tuple[int, ...]) -> None:
    corners = np.array([[0.0, 100.0], [180, 100], [180, 0], [0, 100]])
    starts = np.cumsum((0, *pieces))
    paths = [corners[a : a + n + 1] + 2.0 * k for k, (a, n) in enumerate(zip(starts, pieces, strict=False))]
    found = interpret(page(*paths), Told(*["wire" if n == 1 else "math" for n in pieces]))
    assert [(c.kind, c.strokes) for c in found.components] == [("polygon", tuple(range(len(pieces))))]


def test_rejected_strokes_belong_to_nobody() -> None:
    found = interpret(page(BOX), Told(claim_for("polygon", 0.4, rejected=True)))
    assert (found.components, found.kinds()) == ((), (None,))


def test_lines_of_writing_are_parted_and_words_are_not() -> None:
    letters = [ideals.superellipse((x, y), (5, 8)) for y in (0.0, 45.0) for x in (0.0, 14.0, 30.0)]
    found = interpret(page(*letters), Told(*["math"] * 6))
    assert [e.strokes for e in found.expressions] == [(0, 1, 2), (3, 4, 5)]


def test_a_note_takes_its_line_and_its_component() -> None:
    letters = [ideals.superellipse((x, 150.0), (5, 8)) for x in (0.0, 14.0, 30.0)]
    note = Note("m = 2", at=(15.0, 150.0), anchor=(70.0, 45.0))
    found = interpret(page(BOX, *letters), Told("polygon", "math", "math", "math"), [note])
    assert [(e.text, e.strokes) for e in found.expressions] == [("m = 2", (1, 2, 3))]
    assert [(a.expression, a.component) for a in found.associations] == [(0, "A")]


def test_an_unreadable_note_says_why() -> None:
    (written,) = interpret(Ink(), Told(), [Note("m = = 2")]).expressions
    assert written.tree is None
    assert written.problem


@pytest.mark.parametrize("index", range(6))
def test_notes_of_a_page_are_the_notes_of_its_reading(index: int) -> None:
    truth = generated(PROBLEMS[index], 22, index).truth
    notes = notes_of(truth)
    again = notes_of(interpret(truth.ink, Oracle(truth), notes))
    assert sorted(again, key=repr) == sorted(notes, key=repr)


def test_labels_run_in_reading_order() -> None:
    centres = np.array([[200.0, 300.0], [10.0, 8.0], [300.0, 0.0], [20.0, 310.0]])
    assert reading_order(centres) == [1, 2, 3, 0]
    assert [label(rank) for rank in (0, 25, 26, 27, 51, 52, 701, 702)] == [
        "A", "Z", "AA", "AB", "AZ", "BA", "ZZ", "AAA",
    ]  # fmt: skip


def test_moving_and_scaling_a_page_changes_no_reading() -> None:
    truth = generated("box-on-two-wires", 23, 1).truth
    rival = recognizer("geometric")
    meant = structure(interpret(truth.ink, rival))
    for scale, x, y in ((0.25, 0.0, 0.0), (4.0, -900.0, 300.0)):
        moved = Ink(tuple(stroke.moved_to(scale * stroke.points + [x, y]) for stroke in truth.ink))
        assert structure(interpret(moved, rival)) == meant


@pytest.mark.parametrize("name", ["paper", "geometric", "learned"])
@pytest.mark.parametrize(
    "ink",
    [Ink(), page(DOT), Ink((Stroke([[1.0, 1.0]]),)), Ink((Stroke([[1.0, 1.0]] * 9),) * 3), page(1e6 * BOX)],
    ids=["empty page", "tap", "dot", "identical points", "huge"],
)
def test_any_page_is_read(name: str, ink: Ink) -> None:
    found = interpret(ink, recognizer(name))
    assert found.ink == ink


@pytest.mark.parametrize("heap", [False, True], ids=["all over the page", "in one place"])
def test_ten_thousand_strokes_take_seconds(heap: bool) -> None:
    rng = np.random.default_rng(9)
    paths = [ideals.circle((0, 0), 8), BOX / 9, WIRE / 9, SPRING / 9, *[WIRE / 30] * 16]
    kinds: tuple[StrokeKind, ...] = ("circle", "polygon", "wire", "spring", *["math"] * 16)
    places = np.zeros((10_000, 2)) if heap else rng.uniform(0, 4000, (10_000, 2))
    shapes = [resample(path, 30) for path in paths]
    ink = Ink(tuple(Stroke(shapes[k % 20] + place) for k, place in enumerate(places)))
    began = time.perf_counter()
    found = interpret(ink, Told(*(kinds[k % 20] for k in range(10_000))))
    assert time.perf_counter() - began < 30
    assert found.ink == ink


def test_geometric_claims_ten_thousand_strokes_in_seconds() -> None:
    rng = np.random.default_rng(10)
    shapes = [resample(path, 30) for path in (ideals.circle((0, 0), 8), BOX / 9, WIRE / 9, SPRING / 9)]
    places = rng.uniform(0, 4000, (10_000, 2))
    ink = Ink(tuple(Stroke(shapes[k % 4] + place) for k, place in enumerate(places)))
    began = time.perf_counter()
    claims = recognizer("geometric").recognize(ink)
    assert time.perf_counter() - began < 90
    assert len(claims) == 10_000


def _bonds(*told: tuple[int, int, float]) -> Bonds:
    return Bonds(np.array([pair[:2] for pair in told]), np.array([pair[2] for pair in told]))


def test_the_surest_pairs_are_joined_first_and_one_doubtful_bridge_joins_no_two_things() -> None:
    bridged = _bonds((0, 1, 0.9), (1, 2, 0.6), (2, 3, 0.95), (4, 5, 0.4))
    assert sorted(bound([0, 1, 2, 3, 4, 5], bridged)) == [(0, 1), (2, 3), (4,), (5,)]


def test_strokes_that_are_not_asked_about_take_no_part() -> None:
    assert bound([7, 3], _bonds((3, 5, 0.9), (5, 7, 0.9))) == [(3,), (7,)]


def test_things_are_apart_where_the_mean_over_their_pairs_says_so() -> None:
    bonds = _bonds((0, 1, 0.9), (1, 2, 0.9))
    assert apart([0, 1, 2, 3], bonds) and not apart([0, 1, 2], bonds)


class Bound(Told):
    """Says besides which strokes are one thing."""

    def __init__(self, bonds: Bonds, *claims: StrokeKind) -> None:
        super().__init__(*claims)
        self._bonds = bonds

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        return self.recognize(ink), self._bonds


def test_who_says_what_belongs_together_is_heard() -> None:
    """Two boxes that share a corner: geometry alone may walk from one to the other."""
    sides = [
        np.array(side, dtype=float) for side in ([(0, 0), (90, 0), (90, 60)], [(90, 60), (0, 60), (0, 0)])
    ]
    ink = page(*(side + shift for shift in ((0.0, 0.0), (90.0, 60.0)) for side in sides))
    told = interpret(ink, Bound(_bonds((0, 1, 0.9), (2, 3, 0.9)), *["polygon"] * 4))
    assert {component.strokes for component in told.components} == {(0, 1), (2, 3)}
    assert {component.kind for component in told.components} == {"polygon"}
