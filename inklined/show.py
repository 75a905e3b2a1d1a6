"""A page that was read, as tables and as JSON."""

from __future__ import annotations

from collections import Counter
from typing import Any, assert_never

from evaluation.table import Cell, Table
from sketch.page import Sketch
from sketch.shapes import Arrow, Circle, Point, Polygon, Shape, Spring, Wire


def page_tables(page: Sketch, title: str) -> list[Table]:
    """What is on the page: components, mathematics, and a count of the strokes."""
    tables = [
        Table(
            f"{title}: {_count(page)}",
            ("", "kind", "shape", "ends", "strokes"),
            tuple(
                (
                    part.label,
                    Cell(part.kind + (", fixed" if part.fixed else "")),
                    Cell(describe(part.shape)),
                    Cell(_ends(part.ends)),
                    Cell(" ".join(map(str, part.strokes))),
                )
                for part in page.components
            ),
        )
    ]
    if page.expressions:
        tables.append(
            Table(
                "Mathematics",
                ("", "formula", "about", "remark"),
                tuple(
                    (
                        str(index),
                        Cell(line.text or f"not read ({len(line.strokes)} strokes)"),
                        Cell(" ".join(_about(page, index)) or "the whole page"),
                        Cell(line.problem or ""),
                    )
                    for index, line in enumerate(page.expressions)
                ),
            )
        )
    return tables


def page_json(page: Sketch, recognizer: str) -> dict[str, Any]:
    """The same as plain values; lengths in page units, y down."""
    return {
        "recognizer": recognizer,
        "strokes": list(page.kinds()),
        "components": [
            {
                "label": part.label,
                "kind": part.kind,
                "fixed": part.fixed,
                "strokes": list(part.strokes),
                "ends": list(part.ends),
                "shape": measures(part.shape),
            }
            for part in page.components
        ],
        "expressions": [
            {
                "text": line.text,
                "problem": line.problem,
                "strokes": list(line.strokes),
                "about": _about(page, k),
            }
            for k, line in enumerate(page.expressions)
        ],
        "gestures": [{"kind": gesture.kind, "stroke": gesture.stroke} for gesture in page.gestures],
    }


def measures(shape: Shape) -> dict[str, Any]:
    """A shape's numbers by name, page units."""
    match shape:
        case Circle(centre, radius):
            return {"centre": list(centre), "radius": radius}
        case Polygon(vertices=vertices):
            return {"vertices": vertices.tolist()}
        case Spring(start, end, coils, width):
            return {"start": list(start), "end": list(end), "coils": coils, "width": width}
        case Wire(start, end) | Arrow(start, end):
            return {"start": list(start), "end": list(end)}
        case _:
            assert_never(shape)


def describe(shape: Shape) -> str:
    """A shape in a few words, page units."""
    match shape:
        case Circle(centre, radius):
            return f"radius {radius:.0f} about {_place(centre)}"
        case Polygon(vertices=vertices):
            return " ".join(_place((x, y)) for x, y in vertices.tolist())
        case Spring(start, end, coils, _):
            return f"{_place(start)} to {_place(end)}, {coils:.0f} coils"
        case Wire(start, end) | Arrow(start, end):
            return f"{_place(start)} to {_place(end)}"
        case _:
            assert_never(shape)


def _place(point: Point) -> str:
    return f"({point[0]:.0f}, {point[1]:.0f})"


def _ends(ends: tuple[str | None, str | None]) -> str:
    return "" if ends == (None, None) else " – ".join(end or "free" for end in ends)


def _about(page: Sketch, expression: int) -> list[str]:
    return [link.component for link in page.associations if link.expression == expression]


def _count(page: Sketch) -> str:
    kinds = Counter(kind or "unclaimed" for kind in page.kinds())
    if not kinds:
        return "no ink"
    listed = ", ".join(f"{n} {kind}" for kind, n in kinds.most_common())
    return f"{len(page.ink)} strokes ({listed})"
