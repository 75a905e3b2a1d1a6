"""The order in which a page is corrected, and how a correction is undone (C6).

Shapes first (C1), then the incline and what rests on it (C3), contacts (C2), the ends of links on
the boundaries that result (C4), and their angles last (C5), since nothing afterwards may turn
them again. Each step is a pure function of the page; a page that is exact already comes out as
it went in, and correcting twice is correcting once.

A correction is known by its `Key`: the rule, and the component that the rule was applied to. To undo
one is to correct the drawn page again without it: the component is then left by that rule as it
was drawn, and all others are corrected around it, so that what remains is as valid as a page can be that
is wrong there on purpose. What only followed is undone along with what it followed.

    page = rectify(sketch)
    page.corrections[2].before, page.corrections[2].after   # shapes, to be shown side by side
    other = undo(page, 2)                                   # without the third
    again = redo(other, page.corrections[2].key)            # and with it
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache

from physics.formula.meaning import read
from physics.parts.given import Spoken, spoken
from physics.rectify.angles import SaidAngle, aim
from physics.rectify.angles import angles_of as links_said
from physics.rectify.attachments import attach
from physics.rectify.contacts import Pair, outlines_of, pairs_of, resting, touch
from physics.rectify.correction import (
    RULES,
    Correction,
    Key,
    Rectified,
    Rule,
    Step,
    displacements,
    with_anchors,
)
from physics.rectify.flush import lay
from physics.rectify.incline import angles_of as inclines_said
from physics.rectify.incline import tilt
from physics.rectify.straighten import straighten
from sketch.page import Sketch

ROUNDS = 12
"""Of all rules: nearly every page has settled after one, and the next shows it. What a link's angle brings near to
something else may touch it then."""
SETTLED = 1e-9
"""Page units by which a round may still move something: rounding."""


def rectify(sketch: Sketch, without: Iterable[Key] = ()) -> Rectified:
    """The corrected page with all corrections, in the order in which they were made.

    without: corrections that are not to be made, by their keys; one that would not be made anyway is
    passed over. Raises ValueError for a rule that is not one of C1 to C5.
    """
    left_out = frozenset(without)
    for rule, label in left_out:
        if rule not in RULES:
            raise ValueError(f"({rule!r}, {label!r}) is no correction's key; rules are {', '.join(RULES)}")

    meanings = read(sketch)
    said = spoken(meanings)

    inclines, links = inclines_said(sketch, said), links_said(sketch, said)

    def once(page: Sketch, leaving: frozenset[Key]) -> tuple[Step, ...]:
        return _steps(page, said, inclines, links, leaving)

    after, corrections = sketch, tuple[Correction, ...]()
    for _ in range(ROUNDS):
        after, more, whole = _settled(after, left_out, once)
        corrections += more
        if whole or not more:
            break
        # Some were given up; from here on they may be had.
    return Rectified(with_anchors(sketch, after), corrections, sketch, left_out, meanings)


Once = Callable[[Sketch, frozenset[Key]], tuple[Step, ...]]
"""All rules in their order, without corrections of these keys."""


def _settled(
    sketch: Sketch, without: frozenset[Key], once: Once
) -> tuple[Sketch, tuple[Correction, ...], bool]:
    """(the page on which the rules change nothing more, what was corrected, whether nothing had to be given up).

    Where corrections undo one another round after round, the contacts among them are given up, since contacts are
    guessed and angles are said."""
    left_out = without
    while True:
        after, corrections = sketch, list[Correction]()
        made: tuple[Correction, ...] = ()
        for _ in range(ROUNDS):
            steps = once(after, left_out)
            moves = displacements(after, steps[-1].sketch).values()
            if max((max(ways) for ways in moves), default=0.0) <= SETTLED:
                return after, tuple(corrections), left_out == without
            after = steps[-1].sketch
            made = tuple(one for step in steps for one in step.corrections)
            corrections += made
        fighting = {one.key for one in made}
        left_out |= {key for key in fighting if key[0] == "C2"} or fighting


def _steps(
    sketch: Sketch,
    said: Spoken,
    inclines: Mapping[str, float],
    links: Mapping[str, SaidAngle],
    without: frozenset[Key],
) -> tuple[Step, ...]:
    """All rules in their order, each on the page that the one before it left."""

    def skipped(rule: Rule) -> frozenset[str]:
        return frozenset(label for name, label in without if name == rule)

    def mass(label: str) -> float:
        return said.mass(sketch, sketch.component(label))[0]

    straight = straighten(sketch, inclines, skipped("C1"))

    @cache
    def pairs() -> list[Pair]:
        return pairs_of(straight.sketch, outlines_of(straight.sketch))

    @cache
    def touching() -> Mapping[str, frozenset[str]]:
        return resting(pairs())

    tilted = tilt(straight.sketch, inclines, touching, skipped("C3"))
    laid = lay(tilted.sketch, touching, skipped("C2"))
    moved = touch(laid.sketch, pairs(), mass, skipped("C2"))
    attached = attach(moved.sketch, links, touching, skipped("C4"))
    aimed = aim(attached.sketch, links, touching, skipped("C5"))
    return straight, tilted, laid, moved, attached, aimed


def undo(rectified: Rectified, index: int) -> Rectified:
    """The page without one of its corrections, and without what followed from it.

    Raises IndexError where the page has no such correction.
    """
    if not 0 <= index < len(rectified.corrections):
        raise IndexError(f"correction {index}: the page has {len(rectified.corrections)}, counted from 0")
    return rectify(rectified.drawn, rectified.without | {rectified.corrections[index].key})


def redo(rectified: Rectified, key: Key) -> Rectified:
    """The page with a correction that was undone. Raises KeyError where it was not."""
    if key not in rectified.without:
        raise KeyError(f"{key} was not undone; undone are {sorted(rectified.without)}")
    return rectify(rectified.drawn, rectified.without - {key})
