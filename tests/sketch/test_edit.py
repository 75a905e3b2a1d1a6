"""Edits keep whatever they are not about: lines, components, associations."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from data_gen.pages import page
from sketch.edit import associated, rewritten, without_association, without_component, without_line
from sketch.page import Sketch, SketchError

PAGES = [page(name, 3, 1).truth for name in ("incline-and-ball", "box-on-two-wires", "pendulum")]
pages = st.sampled_from(PAGES)


def told(sketch: Sketch) -> list[tuple[str | None, str]]:
    """(a line's text, the component that it is associated with)."""
    return [(sketch.expressions[one.expression].text, one.component) for one in sketch.associations]


@given(pages, st.data())
def test_associations_outlive_the_rewriting_of_their_line(sketch: Sketch, data: st.DataObject) -> None:
    line = data.draw(st.integers(0, len(sketch.expressions) - 1))
    new = rewritten(sketch, line, "m = 7")
    assert new.associations == sketch.associations
    assert new.components == sketch.components
    assert new.expressions[line].text == "m = 7"
    assert str(new.expressions[line].tree) == "Eq(m, 7)"
    assert new.expressions[line].strokes == sketch.expressions[line].strokes
    assert rewritten(new, line, sketch.expressions[line].text or "") == sketch


def test_a_line_that_is_rewritten_badly_says_why_and_keeps_its_associations() -> None:
    new = rewritten(PAGES[0], 0, "m = = 7")
    assert new.expressions[0].tree is None
    assert new.expressions[0].problem
    assert new.associations == PAGES[0].associations


@given(pages, st.data())
def test_erasing_a_line_leaves_what_the_others_are_associated_with(
    sketch: Sketch, data: st.DataObject
) -> None:
    line = data.draw(st.integers(0, len(sketch.expressions) - 1))
    gone = sketch.expressions[line].text
    assert told(without_line(sketch, line)) == [one for one in told(sketch) if one[0] != gone]


@given(pages, st.data())
def test_erasing_a_component_leaves_all_others_and_all_lines(sketch: Sketch, data: st.DataObject) -> None:
    label = data.draw(st.sampled_from([part.label for part in sketch.components]))
    new = without_component(sketch, label)
    assert new.expressions == sketch.expressions
    assert told(new) == [one for one in told(sketch) if one[1] != label]
    assert [part.shape for part in new.components] == [
        part.shape for part in sketch.components if part.label != label
    ]
    assert not any(label in part.ends for part in new.components)


@given(pages, st.data())
def test_an_association_is_made_once_and_the_last_made_is_the_newest(
    sketch: Sketch, data: st.DataObject
) -> None:
    line = data.draw(st.integers(0, len(sketch.expressions) - 1))
    label = data.draw(st.sampled_from([part.label for part in sketch.components]))
    new = associated(associated(sketch, line, label, (1.0, 2.0)), line, label, (3.0, 4.0))
    pairs = [(one.expression, one.component) for one in new.associations]
    assert pairs.count((line, label)) == 1
    assert pairs[-1] == (line, label)
    assert new.associations[-1].anchor == (3.0, 4.0)
    assert (
        without_association(new, line, label).associations
        == without_association(sketch, line, label).associations
    )


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (lambda sketch: rewritten(sketch, 99, "m = 1"), "no line 99"),
        (lambda sketch: without_line(sketch, -1), "no line -1"),
        (lambda sketch: associated(sketch, 0, "Z", (0.0, 0.0)), "no component 'Z'; the page has A, B"),
        (lambda sketch: without_component(sketch, "Z"), "no component 'Z'"),
    ],
)
def test_what_is_not_there_is_named(edit: Callable[[Sketch], Sketch], said: str) -> None:
    with pytest.raises(SketchError, match=said):
        edit(PAGES[0])
