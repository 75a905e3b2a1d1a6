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

from collections.abc import Iterable, Mapping
from functools import cache

from physics.formula.meaning import read
from physics.parts.given import spoken
from physics.rectify.angles import aim
from physics.rectify.attachments import attach
from physics.rectify.contacts import Pair, outlines_of, pairs_of, resting, touch
from physics.rectify.correction import RULES, Correction, Key, Rectified, Rule, with_anchors
from physics.rectify.flush import lay
from physics.rectify.incline import tilt
from physics.rectify.straighten import straighten
from sketch.page import Sketch


def rectify(sketch: Sketch, without: Iterable[Key] = ()) -> Rectified:
    """The corrected page with all corrections, in the order in which they were made.

    without: corrections that are not to be made, by their keys; one that would not be made anyway is
    passed over. Raises ValueError for a rule that is not one of C1 to C5.
    """
    left_out = frozenset(without)
    for rule, label in left_out:
        if rule not in RULES:
            raise ValueError(f"({rule!r}, {label!r}) is no correction's key; rules are {', '.join(RULES)}")

    def skipped(rule: Rule) -> frozenset[str]:
        return frozenset(label for name, label in left_out if name == rule)

    meanings = read(sketch)
    said = spoken(meanings)

    def mass(label: str) -> float:
        return said.mass(sketch, sketch.component(label))[0]

    straight = straighten(sketch, skipped("C1"))

    @cache
    def pairs() -> list[Pair]:
        return pairs_of(straight.sketch, outlines_of(straight.sketch))

    @cache
    def touching() -> Mapping[str, frozenset[str]]:
        return resting(pairs())

    tilted = tilt(straight.sketch, said, touching, skipped("C3"))
    laid = lay(tilted.sketch, touching, skipped("C2"))
    moved = touch(laid.sketch, pairs(), mass, skipped("C2"))
    attached = attach(moved.sketch, skipped("C4"))
    aimed = aim(attached.sketch, sketch, said, touching, skipped("C5"))
    steps = (straight, tilted, laid, moved, attached, aimed)
    corrections: tuple[Correction, ...] = tuple(one for step in steps for one in step.corrections)
    return Rectified(with_anchors(sketch, aimed.sketch), corrections, sketch, left_out, meanings)


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
