"""C2: shapes that are meant to touch are moved until they do.

Circles are moved along their line of centres, others along the minimum-distance vector. The
lighter moves to the heavier, and what is fixed never moves: the solids are settled one after
another, from the fixed and the heaviest outwards, each against all its settled neighbours at
once, so that in a stack or a chain no pair undoes another.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, sqrt

from physics.rectify.correction import Rectified, changes, moved, shift
from physics.rectify.separation import apart
from sketch.geometry import solid_area
from sketch.page import Sketch
from sketch.shapes import Circle, Polygon, Solid


@dataclass(frozen=True, slots=True)
class ContactRule:
    """When two shapes are meant to touch. Sizes are roots of areas; the smaller of two counts."""

    gap: float = 0.4
    """Share of the size: a ball of 40 units across may hover 14 units above its floor. A long floor
    drawn at 2 degrees is off by that much at its ends once it is level."""
    overlap: float = 0.4
    """Share of the size."""
    most: float = 25.0
    """Page units, for either: two large blocks this far apart were drawn apart."""
    exact: float = 1e-9
    """Page units: already in contact (rounding is a ten-thousandth of it)."""
    sweeps: int = 200
    """Over a solid's settled neighbours: two that meet at 20 degrees need 150 for 1e-9 units."""


RULE = ContactRule()


def meant_to_touch(one: Solid, other: Solid) -> bool:
    """Whether a gap or an overlap is small enough to be a slip of the pen."""
    gap, _ = apart(one, other)
    size = sqrt(min(solid_area(one), solid_area(other)))
    return -min(RULE.overlap * size, RULE.most) <= gap <= min(RULE.gap * size, RULE.most)


def touch(sketch: Sketch, mass: Callable[[str], float]) -> Rectified:
    """C2 on the whole page. mass: of a solid by its label, kg."""
    weight = {
        part.label: inf if part.fixed else mass(part.label)
        for part in sketch.components
        if isinstance(part.shape, Circle | Polygon)
    }
    neighbours = _neighbours(sketch, weight)
    after = sketch
    settled = {label for label, heavy in weight.items() if heavy == inf}
    waiting = [label for label in weight if label not in settled and neighbours[label]]
    while waiting:
        # Next is the heaviest of those that touch something settled, or of all if none does.
        ready = [label for label in waiting if neighbours[label] & settled] or waiting
        label = max(ready, key=lambda one: (weight[one], one))
        after = _settle(after, label, sorted(neighbours[label] & settled))
        settled.add(label)
        waiting.remove(label)
    why = "it is moved into contact with what it was drawn to touch"
    return Rectified(after, changes("C2", lambda part: f"{part.label}: {why}.", sketch, after))


def _neighbours(sketch: Sketch, weight: dict[str, float]) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {label: set() for label in weight}
    labels = list(weight)
    for k, one in enumerate(labels):
        for other in labels[k + 1 :]:
            if weight[one] == weight[other] == inf:
                continue
            if meant_to_touch(_solid(sketch, one), _solid(sketch, other)):
                found[one].add(other)
                found[other].add(one)
    return found


def _settle(sketch: Sketch, label: str, against: list[str]) -> Sketch:
    """The page with one solid moved so that it touches each of its settled neighbours."""
    for _ in range(RULE.sweeps):
        worst = 0.0
        for other in against:
            gap, (x, y) = apart(_solid(sketch, other), _solid(sketch, label))
            if abs(gap) > RULE.exact:
                worst = max(worst, abs(gap))
                sketch = moved(sketch, label, shift(-gap * x, -gap * y))
        if worst <= RULE.exact:
            break
    return sketch


def _solid(sketch: Sketch, label: str) -> Solid:
    shape = sketch.component(label).shape
    assert isinstance(shape, Circle | Polygon)
    return shape
