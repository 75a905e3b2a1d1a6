"""Random scenes, and the world turned, moved and set going. SI units, y up."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, sin
from typing import Literal, TypeVar

import numpy as np
from hypothesis import strategies as st
from physics_scenes import box, disc, floor

from physics.scene import Anchor, Body, Material, Pin, Scene, SpringLink, Vector, WireLink

Ground = Literal["none", "floor"]
Kind = TypeVar("Kind", SpringLink, WireLink, Pin)
number = st.floats(-1, 1)
CROWDS = 200
"""Scenes of each sort. A finite number, each made from its seed alone: every one of them has been tried, and which
ones hypothesis draws on a machine makes no difference."""


def scenes(ground: Ground = "floor") -> st.SearchStrategy[Scene]:
    """Crowds, some of them joined; with a floor, gravity and links to the page, or free of all three."""
    return st.sampled_from(range(CROWDS)).map(lambda seed: crowd_at(seed, ground))


def crowd_at(seed: int, ground: Ground) -> Scene:
    """The crowd of this seed."""
    rng = np.random.default_rng([seed, int(ground == "floor")])
    bodies = _solids(rng)
    springs: list[SpringLink] = []
    wires: list[WireLink] = []
    pins: list[Pin] = []
    for a, b in pairwise(bodies):
        label, ends = f"{a.label}-{b.label}", (Anchor(a.label, (0.0, 0.0)), Anchor(b.label, (0.0, 0.0)))
        apart = (b.position[0] - a.position[0], b.position[1] - a.position[1])
        far = hypot(*apart)
        match int(rng.integers(4)):
            case 1:
                stiffness, damping = rng.uniform(5, 200), float(rng.choice([0.0, 0.5, 3.0]))
                springs.append(SpringLink(label, *ends, far * rng.uniform(0.8, 1.2), stiffness, damping))
            case 2:
                wires.append(WireLink(label, *ends, far * _often(rng, 1.0, rng.uniform(1.0, 1.2))))
            case 3:
                half = (apart[0] / 2, apart[1] / 2)
                pins.append(Pin(label, Anchor(a.label, half), Anchor(b.label, (-half[0], -half[1]))))
            case _:
                pass
    if ground == "none":
        return Scene(bodies, tuple(springs), tuple(wires), gravity=(0.0, 0.0), pins=tuple(pins))
    if rng.random() < 0.5:
        last = bodies[-1]
        hook = (last.position[0] + rng.uniform(-1, 1), last.position[1] + 1.5)
        away = hypot(hook[0] - last.position[0], 1.5)
        ends = Anchor(last.label, (0.1, 0.1)), Anchor(None, hook)
        wires.append(WireLink("hook", *ends, away * _often(rng, 1.0, rng.uniform(1.0, 1.1))))
    return Scene((*bodies, floor(_material(rng))), tuple(springs), tuple(wires), pins=tuple(pins))


def _solids(rng: np.random.Generator) -> tuple[Body, ...]:
    """Two to four on a loose grid, so that none overlap, at rest or moving at random."""
    bodies: list[Body] = []
    for k in range(int(rng.integers(2, 5))):
        x = 1.1 * (k % 2) + 0.1 * _often(rng, 0.0, rng.uniform(-1, 1))
        y = 0.6 + 1.1 * (k // 2) + 0.1 * _often(rng, 0.0, rng.uniform(-1, 1))
        speeds = [_often(rng, 0.0, rng.uniform(-1, 1)) for _ in range(3)]
        velocity = (3 * speeds[0], 3 * speeds[1], 4 * speeds[2])
        mass, material = _often(rng, 1.0, rng.uniform(0.2, 5)), _material(rng)
        if rng.random() < 0.5:
            bodies.append(disc(f"B{k}", x, y, 0.35, mass, velocity, material))
        else:
            bodies.append(box(f"B{k}", x, y, 0.6, 0.5, mass, velocity, material))
    return tuple(bodies)


def _often(rng: np.random.Generator, special: float, other: float) -> float:
    """The special value in one case of five: symmetry and rest are where engines err."""
    return special if rng.random() < 0.2 else float(other)


def _material(rng: np.random.Generator) -> Material:
    friction = [None, 0.0, 0.2, 0.5, 1.5][int(rng.integers(5))]
    return Material(_often(rng, float(rng.integers(2)), rng.random()), friction)


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
