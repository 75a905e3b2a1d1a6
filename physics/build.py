"""From a corrected page to a scene: page units to metres, mathematics to numbers and programs.

100 page units are a metre; the page's y points down, the scene's up. What the page leaves open
gets a default; what it says and cannot be is left out. Either way a notice tells the student.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from physics.formula.meaning import GRAVITY, Meanings, read
from physics.formula.names import gravity_of, mass_of
from physics.parts.courses import courses_of
from physics.parts.forces import forces_of
from physics.parts.given import Page, to_metres
from physics.parts.links import links_of
from physics.parts.solids import body_of, centre_of, solids_of
from physics.scene import Scene
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon

__all__ = ["Built", "build", "to_metres"]


@dataclass(frozen=True, slots=True)
class Built:
    """A scene, and what has to be said about it."""

    scene: Scene
    notices: tuple[str, ...]


def build(sketch: Sketch) -> Built:
    """The scene of a page. Never raises for what a page may hold: what cannot be is left out, and
    a notice says so."""
    meanings = read(sketch)
    notices = list(meanings.notices)
    g = _gravity(sketch, meanings, notices)
    solids = solids_of(sketch, notices)
    page = _page(sketch, meanings, solids, g, notices)
    courses = [course for part in solids for course in courses_of(page, part)]
    bodies = tuple(body_of(page, part, courses) for part in solids)
    springs, wires = links_of(page, {body.label: body for body in bodies})
    forces, supports = forces_of(page, bodies)
    scene = Scene(bodies, springs, wires, forces, supports, (0.0, -g), courses=tuple(courses))
    return Built(scene, tuple(dict.fromkeys(notices)))


def _gravity(sketch: Sketch, meanings: Meanings, notices: list[str]) -> float:
    said = meanings.of(None, "gravity", None)
    value = gravity_of(sketch, meanings)
    if said is not None and value is None:
        notices.append(
            f"{said.text}: the acceleration of free fall must be a number; {GRAVITY} m/s² is used."
        )
    return GRAVITY if value is None else value


def _page(
    sketch: Sketch, meanings: Meanings, solids: Sequence[Component], g: float, notices: list[str]
) -> Page:
    masses: dict[str, float] = {}
    starts: dict[str, tuple[float, float]] = {}
    for part in solids:
        assert isinstance(part.shape, Circle | Polygon)
        masses[part.label], notice = mass_of(sketch, meanings, part)
        notices += [] if notice is None else [notice]
        starts[part.label] = centre_of(part.shape)
    return Page(sketch, meanings, masses, starts, g, notices)
