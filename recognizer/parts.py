"""Which strokes become components, in the order of row R3: shapes, then links, then arrows.

Frame: page units, y down. Everything is judged against the page and its neighbours, so that the
page's scale is no matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from recognizer.attach import Solids
from recognizer.claims import Bonds
from recognizer.fit import fit, fit_sides, joined
from recognizer.geometric.ring import ring
from recognizer.geometric.rules import RULES, outline_evidence
from recognizer.group import apart, bound, boxes_of, chains, letter_height
from recognizer.preprocess import unit_path
from sketch.geometry import diagonal, resample, solid_area
from sketch.ink import Ink, Stroke
from sketch.page import StrokeKind
from sketch.shapes import Circle, Polygon, Shape, Solid, Spring, Wire


@dataclass(frozen=True, slots=True)
class PartRule:
    """What is worth being a component."""

    area: float = 0.015
    """Side of the smallest square a shape must enclose, as a share of the page's diagonal: 11 units of
    a page of 600 by 450, the size of a letter."""
    pieced: float = -4.5
    """Logarithm of the belief, at least, in an outline whose strokes were found to close: the corners of
    one drawn in pieces stand over, and that it closes is evidence enough."""
    letter: float = 1.5
    """A shape up to this many letter heights high that stands in a line of letters is one: capitals
    and brackets are that much higher than ordinary letters."""
    beside: float = 1.0
    """Letter heights to the next letter, at most."""
    level: float = 0.4
    """Share of the lesser height in which two letters of a line overlap, at least."""
    shaft: float = 1.8
    """An arrow's shaft over a stroke of its head: barbs are at most half as long."""
    long_link: float = 3.0
    """Letter heights. A longer link that ends at a small shape says that it is one: no letter does."""


PARTS = PartRule()


@dataclass(frozen=True, slots=True)
class Part:
    """A shape with the strokes that draw it; ends: for links, the positions of the solids at its start
    and its end in the list of solids."""

    shape: Shape
    strokes: tuple[int, ...]
    ends: tuple[int, int] | None = None


def shapes(
    ink: Ink, kinds: Sequence[StrokeKind | None], bonds: Bonds | None = None, rule: PartRule = PARTS
) -> list[Part]:
    """Circles and polygons that enclose enough: outlines of several strokes first, then those of one. bonds:
    which strokes the recognizer takes for one thing, if it says so; else the ends alone decide."""
    sides = [index for index, kind in enumerate(kinds) if kind in ("circle", "polygon")]
    pieces = [index for index, kind in enumerate(kinds) if kind in ("circle", "polygon", "wire", "math")]
    left, top, right, bottom = ink.bounds()
    least = (rule.area * float(np.hypot(right - left, bottom - top))) ** 2
    found: list[Part] = []
    used: set[int] = set()
    chained = [*chains(ink, sides), *chains(ink, pieces)]
    if bonds is not None:
        told = [strokes for strokes in bound(sides, bonds) if len(strokes) > 1]
        chained = [*told, *(chain for chain in chained if not apart(chain, bonds))]
    for chain in chained:
        if used.intersection(chain):
            continue
        shape = _outline_of([ink[index] for index in chain], [kinds[index] for index in chain])
        if shape is not None and solid_area(shape) >= least:
            found.append(Part(shape, chain))
            used.update(chain)
    for index, kind in enumerate(kinds):
        if index not in used and (kind == "circle" or kind == "polygon"):
            shape = fit(kind, [ink[index]])
            if isinstance(shape, Circle | Polygon) and solid_area(shape) >= least:
                found.append(Part(shape, (index,)))
    return found


def links(
    ink: Ink, kinds: Sequence[StrokeKind | None], solids: Sequence[Part], rule: PartRule = PARTS
) -> tuple[list[Part], list[Part]]:
    """The solids that are no letters, and the springs and wires both of whose ends are attached to two
    of them: springs first, then wires. A shape is taken for a letter only where no long link says
    otherwise."""
    used = {stroke for solid in solids for stroke in solid.strokes}
    candidates = [
        Part(shape, (index,))
        for wanted in ("spring", "wire")
        for index, kind in enumerate(kinds)
        if kind == wanted and index not in used and (shape := fit(wanted, [ink[index]])) is not None
    ]
    first = attached(ink, candidates, solids)
    linked = {stroke for link in first for stroke in link.strokes}
    drawn = used | linked
    inside = Solids([_solid(part.shape) for part in solids])
    letters = [
        index
        for index, kind in enumerate(kinds)
        if (index not in drawn and kind in ("math", "wire", "spring"))
        or (kind == "tap" and not inside.holds(ink[index].points.mean(axis=0)))
    ]
    kept = _without_letters(ink, solids, first, letters, rule)
    return kept, attached(ink, candidates, kept)


def attached(ink: Ink, candidates: Sequence[Part], solids: Sequence[Part]) -> list[Part]:
    """The links whose two ends are attached, with the positions of the solids they end at."""
    drawn = [[ink[stroke] for stroke in part.strokes] for part in solids]
    index = Solids([_solid(part.shape) for part in solids], drawn)
    return [
        Part(part.shape, part.strokes, ends)
        for part in candidates
        if isinstance(part.shape, Spring | Wire) and (ends := index.ends(part.shape)) is not None
    ]


def arrows(
    ink: Ink, strokes: Sequence[int], bonds: Bonds | None = None, rule: PartRule = PARTS
) -> list[Part]:
    """Arrows from the strokes claimed for them: those that the recognizer takes for one thing, if it says so;
    else a stroke that meets a much larger one is of its head."""
    if not strokes:
        return []
    parts = _headed(ink, strokes, rule) if bonds is None else bound(strokes, bonds)
    fitted = [(fit("arrow", [ink[index] for index in members]), members) for members in parts]
    return [Part(shape, members) for shape, members in fitted if shape is not None]


def _headed(ink: Ink, strokes: Sequence[int], rule: PartRule) -> list[tuple[int, ...]]:
    """The strokes as arrows by their sizes and where they meet."""
    sizes = np.array([diagonal(ink[index].points) for index in strokes])
    boxes = shapely.box(*boxes_of(ink, strokes).T)
    tree = shapely.STRtree(boxes)
    shaft_of = list(range(len(strokes)))
    for position in range(len(strokes)):
        meeting = tree.query(boxes[position])
        largest = int(meeting[np.argmax(sizes[meeting])])
        if sizes[largest] > rule.shaft * sizes[position]:
            shaft_of[position] = largest
    drawn: dict[int, list[int]] = {}
    for position, shaft in enumerate(shaft_of):
        drawn.setdefault(shaft_of[shaft] if shaft_of[shaft] == shaft else position, []).append(position)
    return [tuple(strokes[position] for position in members) for members in drawn.values()]


def _outline_of(strokes: list[Stroke], kinds: list[StrokeKind | None]) -> Solid | None:
    """What several strokes outline together: what one of them was claimed for, the polygon of straight
    sides, else what fits better; None where they outline nothing well."""
    if all(kind == "wire" for kind in kinds) and (sides := fit_sides(strokes)) is not None:
        return sides
    path = joined(strokes)
    named = next((kind for kind in kinds if kind in ("circle", "polygon")), None)
    if named is None:
        outline = ring(resample(unit_path(Stroke(path)), RULES.points)) if diagonal(path) > 0 else None
        if outline is None:
            return None
        beliefs = outline_evidence(outline)
        named = max(beliefs, key=lambda kind: beliefs[kind])
        if beliefs[named] < PARTS.pieced:
            return None
    shape = fit("circle" if named == "circle" else "polygon", [Stroke(path)])
    return shape if isinstance(shape, Circle | Polygon) else None


def among_letters(
    ink: Ink, parts: Sequence[tuple[int, ...]], letters: Sequence[int], rule: PartRule = PARTS
) -> list[bool]:
    """For each set of strokes, none of them among the letters, whether it is no larger than the letters and
    stands in a line with one of them: then it is a letter itself, by its context."""
    if not letters:
        return [False] * len(parts)
    boxes = boxes_of(ink, letters)
    height = letter_height(boxes)
    tree = shapely.STRtree(shapely.box(*boxes.T))
    found: list[bool] = []
    for strokes in parts:
        own = boxes_of(ink, strokes)
        left, top, right, bottom = *own[:, :2].min(axis=0), *own[:, 2:].max(axis=0)
        tall = bottom - top
        if max(tall, right - left) > rule.letter * height:
            found.append(False)
            continue
        reach = rule.beside * height
        meeting = tree.query(shapely.box(left - reach, top, right + reach, bottom))
        near = boxes[meeting]
        middle = 0.5 * (near[:, 0] + near[:, 2])
        near = near[(middle < left) | (middle > right)]  # what stands within a shape is not beside it
        level = np.minimum(near[:, 3], bottom) - np.maximum(near[:, 1], top)
        found.append(bool((level >= rule.level * np.minimum(near[:, 3] - near[:, 1], tall)).any()))
    return found


def _without_letters(
    ink: Ink, solids: Sequence[Part], found: Sequence[Part], letters: Sequence[int], rule: PartRule
) -> list[Part]:
    """The solids without those that are letters by their context, unless a long link ends there."""
    height = letter_height(boxes_of(ink, letters)) if letters else 0.0
    held = {
        end for link in found if _length(link.shape) >= rule.long_link * height for end in link.ends or ()
    }
    small = among_letters(ink, [part.strokes for part in solids], letters, rule)
    return [part for position, part in enumerate(solids) if position in held or not small[position]]


def _length(shape: Shape) -> float:
    if isinstance(shape, Spring | Wire):
        return float(np.hypot(shape.end[0] - shape.start[0], shape.end[1] - shape.start[1]))
    return 0.0


def _solid(shape: Shape) -> Solid:
    if not isinstance(shape, Circle | Polygon):
        raise TypeError(f"a {type(shape).__name__.lower()} is no solid")
    return shape
