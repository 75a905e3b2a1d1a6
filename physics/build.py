"""From a corrected page to a scene: page units to metres, mathematics to numbers and programs.

100 page units are a metre; the page's y points down, the scene's up. What the page leaves open
gets a default; what it says and cannot be is left out. Either way a notice tells the student.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

from physics.formula.meaning import GRAVITY, Meanings, read
from physics.formula.names import gravity_of
from physics.infer import act
from physics.parts.courses import courses_of
from physics.parts.given import Page, spoken, to_metres
from physics.parts.links import links_of
from physics.parts.solids import Figure, body_of, solids_of
from physics.rectify.unmet import unmet
from physics.scene import Scene
from sketch.page import Sketch
from sketch.shapes import Polygon

__all__ = ["Built", "build", "to_metres"]


@dataclass(frozen=True, slots=True)
class Built:
    """A scene, and what has to be said about it."""

    scene: Scene
    notices: tuple[str, ...]


def build(sketch: Sketch, meanings: Meanings | None = None) -> Built:
    """The scene of a page. Never raises for what a page may hold: what cannot be is left out, and
    a notice says so. meanings: what the page says, if it has been read already."""
    meanings = read(sketch) if meanings is None else meanings
    notices = list(meanings.notices)
    g = _gravity(sketch, meanings, notices)
    solids = solids_of(sketch, notices)
    page = _page(sketch, meanings, solids, g, notices)
    courses = [
        course
        for figure in solids
        if figure.part.label in page.spoken.own
        for course in courses_of(page, figure.part)
    ]
    bodies = tuple(body_of(page, figure, courses) for figure in solids)
    springs, wires = links_of(page, {body.label: body for body in bodies})
    acting = act(page, bodies)
    notices += unmet(sketch, page.spoken)
    scene = Scene(
        acting.bodies, springs, wires, acting.forces, acting.supports, (0.0, -g), courses=tuple(courses)
    )
    return Built(scene, tuple(dict.fromkeys(notices)))


def _gravity(sketch: Sketch, meanings: Meanings, notices: list[str]) -> float:
    said, value = meanings.of(None, "gravity", None), gravity_of(sketch, meanings)
    if said is not None and value is None:
        notices.append(
            f"{said.text}: the acceleration of free fall must be a number; {GRAVITY} m/s² is used."
        )
    return GRAVITY if value is None else value


def _page(sketch: Sketch, meanings: Meanings, solids: Sequence[Figure], g: float, notices: list[str]) -> Page:
    by_component = spoken(meanings)
    masses: dict[str, float] = {}
    starts: dict[str, tuple[float, float]] = {}
    for figure in solids:
        part = figure.part
        if figure.filled == inf:
            part = replace(part, shape=Polygon(figure.corners))
        masses[part.label], notice = by_component.mass(sketch, part)
        notices += [] if notice is None else [notice]
        starts[part.label] = to_metres(figure.centre)
    return Page(sketch, meanings, masses, starts, g, notices, by_component)
