"""A page with one thing of every kind, for what formulas say of them."""

from __future__ import annotations

from physics_pages import page, rectangle

from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon, Spring, Wire

FLOOR = Component(rectangle(0, 380, 500, 420), label="A", fixed=True)
BALL = Component(Circle((200.0, 160.0), 20.0), label="B")
BOX = Component(rectangle(300, 340, 340, 380), label="C")
WIRE = Component(Wire((200.0, 40.0), (200.0, 140.0)), label="D", ends=(None, "B"))
SPRING = Component(Spring((320.0, 40.0), (320.0, 340.0), 5, 20), label="E", ends=(None, "C"))
INCLINE = Component(Polygon([(600, 400), (900, 400), (900, 300)]), label="F")
PARTS = (FLOOR, BALL, BOX, WIRE, SPRING, INCLINE)


def saying(*remarks: tuple[str, str | None]) -> Sketch:
    """The page with these lines; each of a label, or of the whole page (None)."""
    return page(PARTS, tuple((text, label, None) for text, label in remarks))
