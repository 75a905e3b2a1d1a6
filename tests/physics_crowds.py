"""Hypothesis strategies for scenes, and the world turned, moved and set going. SI units, y up."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, sin
from typing import Literal, TypeVar

from hypothesis import strategies as st
from physics_scenes import box, disc, floor

from physics.scene import Anchor, Body, Material, Pin, Scene, SpringLink, Vector, WireLink

Ground = Literal["none", "floor"]
Kind = TypeVar("Kind", SpringLink, WireLink, Pin)
number = st.floats(-1, 1)
materials = st.builds(Material, st.floats(0, 1), st.sampled_from([None, 0.0, 0.2, 0.5, 1.5]))


@st.composite
def crowds(draw: st.DrawFn, most: int = 4) -> tuple[Body, ...]:
    """Solids on a loose grid, so that none overlap, moving at random; two or more."""
    bodies: list[Body] = []
    for k in range(draw(st.integers(2, most))):
        x, y = 1.1 * (k % 2) + 0.1 * draw(number), 0.6 + 1.1 * (k // 2) + 0.1 * draw(number)
        velocity = (3 * draw(number), 3 * draw(number), 4 * draw(number))
        mass, material = draw(st.floats(0.2, 5)), draw(materials)
        if draw(st.booleans()):
            bodies.append(disc(f"B{k}", x, y, 0.35, mass, velocity, material))
        else:
            bodies.append(box(f"B{k}", x, y, 0.6, 0.5, mass, velocity, material))
    return tuple(bodies)


@st.composite
def scenes(draw: st.DrawFn, ground: Ground = "floor", most: int = 4) -> Scene:
    """A crowd, some of it joined; with a floor, gravity and links to the page, or free of all three."""
    bodies = draw(crowds(most))
    springs: list[SpringLink] = []
    wires: list[WireLink] = []
    pins: list[Pin] = []
    for a, b in pairwise(bodies):
        link = draw(st.sampled_from(["none", "spring", "wire", "pin"]))
        label, ends = f"{a.label}-{b.label}", (Anchor(a.label, (0.0, 0.0)), Anchor(b.label, (0.0, 0.0)))
        apart = (b.position[0] - a.position[0], b.position[1] - a.position[1])
        far = hypot(*apart)
        if link == "spring":
            stiffness, damping = draw(st.floats(5, 200)), draw(st.sampled_from([0.0, 0.5, 3.0]))
            springs.append(SpringLink(label, *ends, far * draw(st.floats(0.8, 1.2)), stiffness, damping))
        elif link == "wire":
            wires.append(WireLink(label, *ends, far * draw(st.floats(1.0, 1.2))))
        elif link == "pin":
            half = (apart[0] / 2, apart[1] / 2)
            pins.append(Pin(label, Anchor(a.label, half), Anchor(b.label, (-half[0], -half[1]))))
    if ground == "none":
        return Scene(bodies, tuple(springs), tuple(wires), gravity=(0.0, 0.0), pins=tuple(pins))
    if draw(st.booleans()):
        last = bodies[-1]
        hook = (last.position[0] + draw(number), last.position[1] + 1.5)
        away = hypot(hook[0] - last.position[0], 1.5)
        ends = Anchor(last.label, (0.1, 0.1)), Anchor(None, hook)
        wires.append(WireLink("hook", *ends, away * draw(st.floats(1.0, 1.1))))
    return Scene((*bodies, floor(draw(materials))), tuple(springs), tuple(wires), pins=tuple(pins))


def carried(scene: Scene, angle: float, shift: Vector) -> Scene:
    """The whole world turned about the origin and then moved: bodies, gravity, points of the page."""

    def turn(x: float, y: float) -> Vector:
        return cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y

    def place(point: Vector) -> Vector:
        x, y = turn(*point)
        return x + shift[0], y + shift[1]

    def moved(anchor: Anchor) -> Anchor:
        return anchor if anchor.body is not None else Anchor(None, place(anchor.point))

    return replace(
        scene,
        bodies=tuple(
            replace(
                body,
                position=place(body.position),
                angle=body.angle + angle,
                velocity=(*turn(*body.velocity[:2]), body.velocity[2]),
            )
            for body in scene.bodies
        ),
        springs=tuple(replace(one, start=moved(one.start), end=moved(one.end)) for one in scene.springs),
        wires=tuple(replace(one, start=moved(one.start), end=moved(one.end)) for one in scene.wires),
        pins=tuple(replace(one, start=moved(one.start), end=moved(one.end)) for one in scene.pins),
        gravity=turn(*scene.gravity),
    )


def renamed(scene: Scene, mark: str, shift: Vector) -> Scene:
    """The same scene elsewhere on the page under other labels."""
    there = carried(scene, 0.0, shift)

    def marked(anchor: Anchor) -> Anchor:
        return anchor if anchor.body is None else Anchor(anchor.body + mark, anchor.point)

    def link(one: Kind) -> Kind:
        return replace(one, label=one.label + mark, start=marked(one.start), end=marked(one.end))

    return replace(
        there,
        bodies=tuple(replace(body, label=body.label + mark) for body in there.bodies),
        springs=tuple(link(one) for one in there.springs),
        wires=tuple(link(one) for one in there.wires),
        pins=tuple(link(one) for one in there.pins),
    )


def together(first: Scene, second: Scene) -> Scene:
    """Both on one page, under the gravity of the first."""
    return replace(
        first,
        bodies=(*first.bodies, *second.bodies),
        springs=(*first.springs, *second.springs),
        wires=(*first.wires, *second.wires),
        pins=(*first.pins, *second.pins),
    )
