"""The page's springs and wires, between bodies or pinned to the page."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import assert_never

from physics.formula.meaning import PER_METRE
from physics.infer import RULE as INFERENCE
from physics.parts.given import Page, to_metres
from physics.parts.pulleys import Run, runs_over
from physics.scene import Anchor, Body, SpringLink, WireLink
from sketch.page import Component
from sketch.shapes import Arrow, Circle, Point, Polygon, Spring, Wire


@dataclass(frozen=True, slots=True)
class LinkRule:
    """What a link is where the page says nothing (row M1)."""

    stiffness: float = 50.0
    """N/m: a kilogram stretches such a spring by 20 units."""


RULE = LinkRule()


def links_of(page: Page, bodies: dict[str, Body]) -> tuple[tuple[SpringLink, ...], tuple[WireLink, ...]]:
    """All links of the page; two wires that run over a pulley are one, under the first one's label."""
    springs: list[SpringLink] = []
    wires: list[WireLink] = []
    runs = runs_over(page.sketch)
    over = {part.label for run in runs for part in run.parts}
    for part in page.sketch.components:
        if part.label in over:
            continue
        match part.shape:
            case Spring() | Wire():
                link = _link(page, part, part.shape, bodies)
                if isinstance(link, SpringLink):
                    springs.append(link)
                elif link is not None:
                    wires.append(link)
            case Circle() | Polygon() | Arrow():
                pass
            case _:
                assert_never(part.shape)
    return tuple(springs), (*wires, *(_over(page, run, bodies) for run in runs))


def _over(page: Page, run: Run, bodies: dict[str, Body]) -> WireLink:
    """A wire over a pulley. A tension that is given of either piece is the whole wire's."""
    start, end = (
        Anchor(None, place)
        if label is None
        else Anchor(label, (place[0] - bodies[label].position[0], place[1] - bodies[label].position[1]))
        for label, place in zip(run.ends, run.places, strict=True)
    )
    tension = None
    for part in run.parts:
        said = page.meanings.of(part.label, "tension", "wire")
        if said is not None:
            tension = page.program(said, part.label, said.tree)
    label = run.parts[0].label
    return WireLink(label, start, end, run.rest, tension, INFERENCE.yields * run.rest, over=run.over)


def _link(
    page: Page, part: Component, shape: Spring | Wire, bodies: dict[str, Body]
) -> SpringLink | WireLink | None:
    """A link with both ends placed. An end that hangs free is pinned to the page where it was drawn:
    drawn links are meant to hold something, and the page is what they then hold on to."""
    ends = [end if end in bodies else None for end in part.ends]
    if ends[0] == ends[1]:
        page.notices.append(f"{part.label} does not join two things; it is not part of the motion.")
        return None
    if None in ends:
        page.notices.append(
            f"One end of {part.label} is attached to nothing; it is pinned to the page there."
        )
    start, end = (
        _anchor(place, bodies.get(label or ""))
        for place, label in zip((shape.start, shape.end), ends, strict=True)
    )
    drawn = hypot(shape.end[0] - shape.start[0], shape.end[1] - shape.start[1]) / PER_METRE
    rest = page.constant(part, "length", 1e-6, 1e6, "a length must be a number above zero") or drawn
    if isinstance(shape, Spring):
        stiffness = page.constant(
            part, "stiffness", 0.0, 1e9, "a stiffness must be a number, and not below zero"
        )
        return SpringLink(part.label, start, end, rest, RULE.stiffness if stiffness is None else stiffness)
    said = page.said(part, "tension")
    tension = None if said is None else page.program(said, part.label, said.tree)
    return WireLink(part.label, start, end, rest, tension, INFERENCE.yields * rest)


def _anchor(place: Point, body: Body | None) -> Anchor:
    x, y = to_metres(place)
    return (
        Anchor(None, (x, y))
        if body is None
        else Anchor(body.label, (x - body.position[0], y - body.position[1]))
    )
