"""Six diagrams of a mechanics course, each drawn anew from a random generator, with the whole truth.

Frame: page units, y down, a page of about 600 x 450; 100 page units are a metre. Velocities and
angles in the mathematics are SI with y up. The first two diagrams are the worked examples of
the sketch-based physics tutor of Cheema and LaViola (a ball on an incline, a box on two
wires); they come with right and with wrong answers. What each diagram must do when it is set in
motion follows in closed form from how it was made, and stands beside it as `Expected`.

Shapes that are meant to touch touch exactly, links end exactly on boundaries, angles are exactly
those in the mathematics. What a pen makes of that is another file's business.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import cos, pi, sin, sqrt, tan

import numpy as np

from sketch.geometry import bounding_box, centroid, polygon_of
from sketch.ink import FloatArray
from sketch.page import Component, labels
from sketch.shapes import Circle, Point, Polygon, Spring, Wire

PER_METRE = 100.0
"""Page units in a metre."""
GRAVITY = 9.81
"""m/s², where the page says nothing else."""
RESTITUTION = 0.5
"""Share of the closing speed kept by a collision, where the page says nothing else."""

Span = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Remark:
    """A line of mathematics in the formula language, with what it governs: pairs of a component's
    label and the spot on it (page units) where it was associated. None at all: the whole page."""

    text: str
    about: tuple[tuple[str, Point], ...] = ()


@dataclass(frozen=True, slots=True)
class Expected:
    """What must be seen. fates: for each movable label the fates that are right; breaks: links of
    which at least one must break (empty: none may)."""

    fates: Mapping[str, frozenset[str]]
    breaks: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Problem:
    """A diagram as it was meant: shapes without ink, mathematics without a place on the page.

    seconds: how long to watch so that the answer shows and nothing has left the scene yet.
    """

    name: str
    answer: str
    components: tuple[Component, ...]
    remarks: tuple[Remark, ...]
    seconds: float
    expected: Expected


def problem(name: str, answer: str, rng: np.random.Generator) -> Problem:
    """The diagram `name` of `PROBLEMS` with one of its `ANSWERS`, sized and placed by `rng`.

    Raises ValueError on a name or an answer that is not known.
    """
    if name not in PROBLEMS:
        raise ValueError(f"no problem is called {name!r}; there are {', '.join(PROBLEMS)}")
    if answer not in ANSWERS[name]:
        raise ValueError(f"{name} has no answer {answer!r}; it has {', '.join(ANSWERS[name])}")
    drawn = _in_reading_order(_DIAGRAMS[name](answer, rng))
    return replace(drawn, name=name, answer=answer)


@dataclass(frozen=True, slots=True)
class InclineRanges:
    """A right-angled triangle with a ball on its long side."""

    angles: tuple[tuple[str, float], ...] = (
        ("pi/5", pi / 5),
        ("pi/6", pi / 6),
        ("pi/7", pi / 7),
        ("pi/8", pi / 8),
        ("0.5", 0.5),
        ("0.6", 0.6),
    )
    """As written and in radians: steep enough to see it roll, flat enough to fit on the page."""
    base: Span = (270.0, 380.0)
    height: float = 240.0
    """At most: the triangle leaves room for its mathematics."""
    radius: Span = (18.0, 36.0)
    along: Span = (0.72, 0.9)
    """Where the ball touches, from the foot (0) to the top (1)."""
    stop: float = 0.12
    """Watched until the ball is this share of the long side away from the foot."""


def _incline_and_ball(answer: str, rng: np.random.Generator) -> Problem:
    ranges = InclineRanges()
    written, angle = ranges.angles[rng.integers(len(ranges.angles))]
    base = min(rng.uniform(*ranges.base), ranges.height / tan(angle))
    side = float(rng.choice([-1, 1]))  # which way it rises
    foot = np.array([300 - side * base / 2 + rng.uniform(-60, 60), rng.uniform(330, 400)])
    corner = foot + [side * base, 0]
    top = corner - [0, base * tan(angle)]
    radius = float(rng.uniform(*ranges.radius))
    along = float(rng.uniform(*ranges.along))
    outward = np.array([-side * sin(angle), -cos(angle)])
    centre = foot + along * (top - foot) + radius * outward
    vertices = np.array([foot, corner, top])

    gravity, remarks = _maybe_gravity(rng)
    scale = {"right": "", "low": "0.9 ", "high": "1.1 "}[answer]
    remarks += (
        Remark(f"theta = {written}", (("incline", _point(0.75 * foot + 0.25 * centroid(vertices))),)),
        Remark(f"f_1 = {scale}|W| cos(theta)", (("ball", _point(centre)),)),
    )
    if rng.random() < 0.3:
        remarks += (Remark(f"m = {rng.integers(1, 6)}", (("ball", _point(centre)),)),)
    slide = (along - ranges.stop) * float(np.linalg.norm(top - foot)) / PER_METRE
    fate = {"right": "rolls", "low": "bounces", "high": "flies off"}[answer]
    return _drawn(
        [_block("incline", vertices, fixed=True), Component(Circle(_point(centre), radius), label="ball")],
        remarks,
        seconds=sqrt(2 * slide / (gravity * sin(angle))),
        expected=Expected({"ball": frozenset({fate})}),
    )


@dataclass(frozen=True, slots=True)
class HangingBoxRanges:
    """A box of 1 kg on two wires at 45° to two blocks; only 5√2 N on each keeps it where it is."""

    width: Span = (80.0, 150.0)
    height: Span = (60.0, 110.0)
    reach: Span = (75.0, 130.0)
    """Each wire's horizontal (and vertical) extent; the two need not be equal."""
    block_width: Span = (55.0, 110.0)
    block_height: Span = (30.0, 60.0)
    seconds: float = 2.0


_TENSIONS: dict[str, tuple[str, str]] = {
    "right": ("5 sqrt(2)", "5 sqrt(2)"),
    "low": ("6", "6"),
    "high": ("8", "8"),
    "low-left": ("6", "5 sqrt(2)"),
    "high-right": ("5 sqrt(2)", "8"),
}


def _box_on_two_wires(answer: str, rng: np.random.Generator) -> Problem:
    ranges = HangingBoxRanges()
    half = rng.uniform(*ranges.width) / 2
    height = rng.uniform(*ranges.height)
    top = np.array([300 + rng.uniform(-30, 30), rng.uniform(225, 265)])  # middle of the box's top side
    parts = [_block("box", _rectangle(top - [half, 0], top + [half, height]))]
    remarks = [Remark("g = 10"), Remark("m = 1", (("box", _point(top + [0, height / 2])),))]
    about: list[tuple[str, Point]] = []
    for name, side, tension in zip(("left", "right"), (-1.0, 1.0), _TENSIONS[answer], strict=True):
        reach = rng.uniform(*ranges.reach)
        low = top + [side * half, 0]
        high = low + [side * reach, -reach]
        size = np.array([rng.uniform(*ranges.block_width), rng.uniform(*ranges.block_height)])
        if rng.random() < 0.7:  # ends under the block
            inner = high - [side * rng.uniform(0.25, 0.75) * size[0], size[1]]
        else:  # ends on the side that faces the box
            inner = high - [0, rng.uniform(0.3, 0.7) * size[1]]
        parts.append(
            _block(f"{name} block", _rectangle(inner, inner + [side * size[0], size[1]]), fixed=True)
        )
        wire = f"{name} wire"
        parts.append(Component(Wire(_point(high), _point(low)), label=wire, ends=(f"{name} block", "box")))
        index = 1 if name == "left" else 2
        remarks.append(Remark(f"T_{index} = {tension}", ((wire, _point(0.5 * (low + high))),)))
        about.append((wire, _point(0.8 * high + 0.2 * low)))
    remarks.append(Remark("theta = pi/4", tuple(about)))
    right = answer == "right"
    return _drawn(
        parts,
        remarks,
        ranges.seconds,
        Expected(
            {"box": frozenset({"stays"} if right else {"falls", "swings", "drifts", "flies off"})},
            frozenset() if right else frozenset({"left wire", "right wire"}),
        ),
    )


@dataclass(frozen=True, slots=True)
class SpringRanges:
    """A mass hanging on a spring, or beside a wall on a smooth floor with a push."""

    length: Span = (85.0, 150.0)
    width: Span = (18.0, 34.0)
    coils: tuple[int, int] = (4, 9)
    side: Span = (50.0, 85.0)
    radius: Span = (22.0, 40.0)
    stiffness: tuple[int, ...] = (20, 30, 40, 50)
    """N/m: with 1 kg, weight stretches such springs by 0.2 to 0.5 m, which is to be seen."""
    push: tuple[str, ...] = ("1", "-1", "1.5", "0.5")
    """m/s."""
    seconds: float = 2.0


def _mass_on_spring(_answer: str, rng: np.random.Generator) -> Problem:
    return (_hanging_mass if rng.random() < 0.6 else _mass_beside_wall)(rng)


def _hanging_mass(rng: np.random.Generator) -> Problem:
    ranges = SpringRanges()
    block, high = _ceiling(rng)
    low = high + [0, rng.uniform(*ranges.length)]
    if rng.random() < 0.5:
        half, height = rng.uniform(*ranges.side) / 2, rng.uniform(*ranges.side)
        mass = _block("mass", _rectangle(low - [half, 0], low + [half, height]))
        middle = low + [0, height / 2]
    else:
        radius = float(rng.uniform(*ranges.radius))
        middle = low + [0, radius]
        mass = Component(Circle(_point(middle), radius), label="mass")
    spring = _spring(rng, high, low, ("ceiling", "mass"))
    gravity = _maybe_gravity(rng)[1]
    remarks = gravity + _spring_remarks(rng, 0.5 * (high + low), middle)
    return _drawn([block, spring, mass], remarks, ranges.seconds, Expected({"mass": frozenset({"swings"})}))


def _mass_beside_wall(rng: np.random.Generator) -> Problem:
    ranges = SpringRanges()
    side = float(rng.choice([-1, 1]))  # which way the spring points, seen from the wall
    ground = rng.uniform(330, 390)
    wall = np.array([300 - side * rng.uniform(150, 200), ground])
    thickness, tall = rng.uniform(30, 55), rng.uniform(110, 170)
    width, height = rng.uniform(*ranges.side, size=2)
    near = wall + [0, -height / 2]
    far = near + [side * rng.uniform(*ranges.length), 0]
    box = _rectangle(far - [0, height / 2], far + [side * width, height / 2])
    floor = wall - [side * thickness, 0]
    parts = [
        _block("wall", _rectangle(wall - [side * thickness, tall], wall), fixed=True),
        _block(
            "floor",
            _rectangle(floor, floor + [side * rng.uniform(440, 500), rng.uniform(25, 45)]),
            fixed=True,
        ),
        _block("mass", box),
        _spring(rng, near, far, ("wall", "mass")),
    ]
    middle = box.mean(axis=0)
    push = Remark(f"v_x = {rng.choice(ranges.push)}", (("mass", _point(middle)),))
    remarks = (push, *_spring_remarks(rng, 0.5 * (near + far), middle))
    return _drawn(parts, remarks, ranges.seconds, Expected({"mass": frozenset({"swings", "rolls"})}))


def _spring(rng: np.random.Generator, start: FloatArray, end: FloatArray, ends: tuple[str, str]) -> Component:
    ranges = SpringRanges()
    coils = float(rng.integers(ranges.coils[0], ranges.coils[1] + 1))
    shape = Spring(_point(start), _point(end), coils, float(rng.uniform(*ranges.width)))
    return Component(shape, label="spring", ends=ends)


def _spring_remarks(rng: np.random.Generator, spring: FloatArray, mass: FloatArray) -> tuple[Remark, ...]:
    ranges = SpringRanges()
    remarks: tuple[Remark, ...] = ()
    if rng.random() < 0.7:
        remarks += (Remark(f"k = {rng.choice(ranges.stiffness)}", (("spring", _point(spring)),)),)
    if rng.random() < 0.5:
        remarks += (Remark("m = 1", (("mass", _point(mass)),)),)
    return remarks


@dataclass(frozen=True, slots=True)
class PendulumRanges:
    """A ball on a wire under a block, drawn at an angle."""

    angle: Span = (0.25, 0.9)
    """From the vertical, radians, to either side."""
    length: Span = (110.0, 210.0)
    radius: Span = (18.0, 38.0)
    seconds: float = 2.0


def _pendulum(_answer: str, rng: np.random.Generator) -> Problem:
    ranges = PendulumRanges()
    block, high = _ceiling(rng)
    angle = rng.uniform(*ranges.angle) * rng.choice([-1, 1])
    along = np.array([sin(angle), cos(angle)])
    length, radius = rng.uniform(*ranges.length), float(rng.uniform(*ranges.radius))
    low, centre = high + length * along, high + (length + radius) * along
    parts = [
        block,
        Component(Wire(_point(high), _point(low)), label="wire", ends=("ceiling", "ball")),
        Component(Circle(_point(centre), radius), label="ball"),
    ]
    remarks = _maybe_gravity(rng)[1]
    if rng.random() < 0.4:
        remarks += (Remark(f"m = {rng.integers(1, 4)}", (("ball", _point(centre)),)),)
    return _drawn(parts, remarks, ranges.seconds, Expected({"ball": frozenset({"swings"})}))


@dataclass(frozen=True, slots=True)
class TwoBallsRanges:
    """Two equal balls on a smooth floor; one is given a velocity towards the other."""

    radius: Span = (20.0, 36.0)
    gap: Span = (70.0, 150.0)
    """Free way between them."""
    speeds: tuple[str, ...] = ("1", "1.5", "2", "3")
    """m/s."""
    margin: float = 30.0
    """Watched until a ball is this close to the floor's end, page units."""
    seconds: float = 2.0


def _two_balls(_answer: str, rng: np.random.Generator) -> Problem:
    ranges = TwoBallsRanges()
    side = int(rng.choice([-1, 1]))  # the way the first ball moves
    radius = float(rng.uniform(*ranges.radius))
    ground = rng.uniform(300, 380)
    first = np.array([300 - side * rng.uniform(130, 180), ground - radius])
    second = first + [side * (2 * radius + rng.uniform(*ranges.gap)), 0]
    low, high = np.array([30 + rng.uniform(0, 30), ground]), np.array([570 - rng.uniform(0, 30), ground])
    floor = _rectangle(low, high + [0, rng.uniform(25, 45)])
    speed = str(rng.choice(ranges.speeds))
    velocity = speed if side > 0 else f"-{speed}"
    remarks = [Remark(f"v_x = {velocity}", (("first", _point(first)),))]
    masses = [1.0, 1.0]
    if rng.random() < 0.5:
        # The second is never the lighter one: the first would hunt it over the edge at once.
        masses = [1.0, float(rng.integers(1, 4))]
        remarks += [
            Remark(f"m = {mass:g}", ((name, _point(middle)),))
            for name, middle, mass in zip(("first", "second"), (first, second), masses, strict=True)
        ]
    ends = side * np.array([low[0], high[0]])
    way = (side * (second - first)[0] - 2 * radius) / PER_METRE
    room = (ends.max() - ranges.margin - side * second[0]) / PER_METRE
    # Along the line of centres: momentum is kept, and RESTITUTION of the closing speed.
    struck = (1 + RESTITUTION) * float(speed) * masses[0] / (masses[0] + masses[1])
    moving = frozenset({"rolls"})
    return _drawn(
        [
            Component(Circle(_point(first), radius), label="first"),
            Component(Circle(_point(second), radius), label="second"),
            _block("floor", floor, fixed=True),
        ],
        remarks,
        seconds=min(ranges.seconds, way / float(speed) + room / struck),
        expected=Expected({"first": moving, "second": moving}),
    )


@dataclass(frozen=True, slots=True)
class StackRanges:
    """Two to four boxes on one another on a fixed floor."""

    boxes: tuple[int, int] = (2, 4)
    width: Span = (110.0, 170.0)
    height: Span = (45.0, 80.0)
    narrower: Span = (0.7, 0.95)
    """Each box's width as a share of that of the one below."""
    shift: float = 0.08
    """Largest offset of a box's middle from the middle of the one below, as a share of its own
    width: four such boxes keep every common centre of mass well inside what carries it."""
    seconds: float = 2.0


def _stack_of_boxes(_answer: str, rng: np.random.Generator) -> Problem:
    ranges = StackRanges()
    middle = np.array([rng.uniform(260, 340), rng.uniform(350, 400)])
    reach = rng.uniform(170, 240)
    floor = _rectangle(middle - [reach, 0], middle + [reach, rng.uniform(25, 45)])
    parts = [_block("floor", floor, fixed=True)]
    width = rng.uniform(*ranges.width)
    count = int(rng.integers(ranges.boxes[0], ranges.boxes[1] + 1))
    for index in range(count):
        height = rng.uniform(*ranges.height)
        parts.append(
            _block(f"box {index}", _rectangle(middle - [width / 2, height], middle + [width / 2, 0]))
        )
        width *= rng.uniform(*ranges.narrower)
        middle = middle + [rng.uniform(-ranges.shift, ranges.shift) * width, -height]
    stays = {part.label: frozenset({"stays"}) for part in parts[1:]}
    return _drawn(parts, _maybe_gravity(rng)[1], ranges.seconds, Expected(stays))


def _ceiling(rng: np.random.Generator) -> tuple[Component, FloatArray]:
    """A fixed block near the page's top, and where a link leaves its lower side."""
    left = np.array([rng.uniform(200, 280), rng.uniform(30, 80)])
    width, height = rng.uniform(90, 190), rng.uniform(28, 55)
    block = _block("ceiling", _rectangle(left, left + [width, height]), fixed=True)
    return block, left + [rng.uniform(0.3, 0.7) * width, height]


def _maybe_gravity(rng: np.random.Generator) -> tuple[float, tuple[Remark, ...]]:
    """Every third page states its own g, for the whole page."""
    return (10.0, (Remark("g = 10"),)) if rng.random() < 1 / 3 else (GRAVITY, ())


def _rectangle(one: FloatArray, other: FloatArray) -> FloatArray:
    """The upright rectangle between two opposite corners, (4, 2), from the top left to the right."""
    (left, top), (right, bottom) = np.minimum(one, other), np.maximum(one, other)
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])


def _block(label: str, vertices: FloatArray, fixed: bool = False) -> Component:
    return Component(Polygon(vertices), label=label, fixed=fixed)


def _point(values: FloatArray) -> Point:
    return (float(values[0]), float(values[1]))


def _drawn(
    parts: Sequence[Component], remarks: Sequence[Remark], seconds: float, expected: Expected
) -> Problem:
    return Problem("", "", tuple(parts), tuple(remarks), float(seconds), expected)


def _in_reading_order(drawn: Problem) -> Problem:
    """The same diagram with labels A, B … given out from top to bottom, then left to right."""

    def place(component: Component) -> tuple[float, float]:
        shape = component.shape
        points = np.array([shape.start, shape.end]) if isinstance(shape, Spring | Wire) else polygon_of(shape)
        low, high = bounding_box(points)
        return (round(float(low[1] + high[1]) / 2, 6), float(low[0] + high[0]) / 2)

    ordered = sorted(drawn.components, key=place)
    letter = {part.label: label for part, label in zip(ordered, labels(), strict=False)}
    return replace(
        drawn,
        components=tuple(
            replace(
                part,
                label=letter[part.label],
                ends=tuple(None if end is None else letter[end] for end in part.ends),
            )
            for part in ordered
        ),
        remarks=tuple(
            replace(remark, about=tuple((letter[name], spot) for name, spot in remark.about))
            for remark in drawn.remarks
        ),
        expected=Expected(
            {letter[name]: fates for name, fates in drawn.expected.fates.items()},
            frozenset(letter[name] for name in drawn.expected.breaks),
        ),
    )


_DIAGRAMS: dict[str, Callable[[str, np.random.Generator], Problem]] = {
    "incline-and-ball": _incline_and_ball,
    "box-on-two-wires": _box_on_two_wires,
    "mass-on-spring": _mass_on_spring,
    "pendulum": _pendulum,
    "two-balls": _two_balls,
    "stack-of-boxes": _stack_of_boxes,
}
PROBLEMS: tuple[str, ...] = tuple(_DIAGRAMS)
"""The names of the six diagrams."""
ANSWERS: dict[str, tuple[str, ...]] = {
    "incline-and-ball": ("right", "low", "high"),
    "box-on-two-wires": tuple(_TENSIONS),
    "mass-on-spring": ("right",),
    "pendulum": ("right",),
    "two-balls": ("right",),
    "stack-of-boxes": ("right",),
}
"""For each diagram the answers that a page can bear, the right one first."""
