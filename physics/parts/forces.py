"""The forces that the page gives its solids, and those that stand in for what a solid rests on."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, nan

from physics.formula.meaning import Said
from physics.formula.program import Program, ProgramError
from physics.formula.vectors import split
from physics.parts.given import Page
from physics.rectify.separation import apart
from physics.scene import Body, Disc, Edge, Force, Support, Vector
from sketch.page import Component
from sketch.shapes import Circle, Polygon


@dataclass(frozen=True, slots=True)
class ForceRule:
    """What counts as touching."""

    touching: float = 0.5
    """Page units: a gap below this is a contact that a given normal force may stand in for."""


RULE = ForceRule()


def forces_of(page: Page, bodies: tuple[Body, ...]) -> tuple[tuple[Force, ...], tuple[Support, ...]]:
    """A vector is a force like any other; a scalar is the normal force that the student gives in
    place of what the body rests on."""
    forces: list[Force] = []
    supports: list[Support] = []
    zero = Program("0", (("push", 0.0),))
    newest = {(said.component, said.name): said for said in page.meanings.said}
    for (label, name), said in newest.items():
        part = None if label is None else page.sketch.component(label)
        if part is None or label is None or not isinstance(part.shape, Circle | Polygon):
            continue
        if said.quantity is None or said.quantity.role != "force" or label not in page.masses or part.fixed:
            continue
        try:
            pair = split(said.tree)
        except ProgramError as error:
            page.notices.append(f"{said.text} of {label} cannot be worked out: {error}. It is not used.")
            continue
        axis = name[-1] if "_" in name and name[-1] in "xy" else None
        if pair is None and axis is None:
            support = _support(page, part, said, bodies, taken={held.body for held in supports})
            supports += [] if support is None else [support]
            continue
        trees = pair if pair is not None else (said.tree, None) if axis == "x" else (None, said.tree)
        x, y = (zero if tree is None else page.program(said, label, tree) for tree in trees)
        if x is not None and y is not None:
            forces.append(Force(name, label, x, y))
    return tuple(forces), tuple(supports)


def _support(
    page: Page, part: Component, said: Said, bodies: tuple[Body, ...], taken: set[str]
) -> Support | None:
    """The given normal force in place of whatever carries the body: of all that it touches, what
    faces gravity most."""
    program = page.program(said, part.label, said.tree)
    if program is None:
        return None
    assert isinstance(part.shape, Circle | Polygon)
    if part.label in taken:
        page.notices.append(
            f"{said.text}: {part.label} has been given a normal force already; this one is not used."
        )
        return None
    best: tuple[float, str, Vector] | None = None
    for other in page.sketch.components:
        if other.label == part.label or other.label not in page.masses:
            continue
        assert isinstance(other.shape, Circle | Polygon)
        gap, (nx, ny) = apart(other.shape, part.shape)
        if gap <= RULE.touching and (best is None or -ny > best[0]):
            best = (-ny, other.label, (nx, -ny))
    if best is None:
        page.notices.append(
            f"{said.text} of {part.label} has no direction, since {part.label} rests on nothing; "
            "write it as a pair, such as (0, 5). It is not used."
        )
        return None
    on = next(body for body in bodies if body.label == best[1])
    edge = _edge(on, best[2])
    return Support(said.name, part.label, on.label, program, edge)


def _edge(body: Body, normal: Vector) -> Edge | None:
    """The edge of a block whose outward normal is nearest to `normal`; None for a disc."""
    if isinstance(body.shape, Disc):
        return None
    vertices = body.shape.vertices
    best, found = -nan, None
    for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        facing = ((y2 - y1) * normal[0] + (x1 - x2) * normal[1]) / (hypot(x2 - x1, y2 - y1) or 1.0)
        if found is None or facing > best:
            best, found = facing, Edge((x1, y1), (x2, y2))
    return found
