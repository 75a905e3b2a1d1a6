"""What a drawing implies that its mathematics does not say (row E3).

The rules:

1. An inclined plane. A solid bears on another where the two touch; of all that it touches it bears on
   what faces gravity most, and of a block on the edge whose outward normal n is nearest to the direction of
   their contact. With an angle said of that block (C3) this edge is an inclined plane of that angle; without one
   it has the angle that it was drawn with.
2. A scalar force on a solid that bears on something is the normal force of that contact: it acts on the centre of
   mass along n (from a ball: along the line of centres), and it *replaces* what the engine would supply there.
   One too small lets the solid sink in; at a depth of `sinks` of its size the edge strikes it back, without loss, so
   that it is seen to bounce. One too great lifts it off, for good. It is over when the centre leaves the edge.
3. A scalar force is friction instead where its name says so (f_k, f_s, f_r, f_f, f_fr, F_k …), where its formula holds a
   coefficient of friction (f = mu N), or where another scalar force is the normal force: one that is called so (N, R,
   f_1, f_n), else the first (f_1 = …, f_2 = …). It acts along the contact against the motion, and it replaces the engine's own
   friction, of the same pair. In its formula N is the normal force at the start, if the page does not say what
   N is: what the student gave, or what balances the weight and all constant forces there.
   - On a block it is the engine's own friction with that bound: the coefficient is the share of the normal force at
     the start. So it also holds a block that need not slide.
   - A ball would roll by that, and a rolling ball needs less friction than the student says. On a ball, friction acts on
     the centre, as all forces of the student do; below a speed of `creeps` it fades, where it could hold the ball.
4. A vector, or a component f_x, f_y, is a force on the centre of mass and replaces nothing.
5. A tension said of a wire acts along the wire at each end, from one end to the other, and replaces the wire's
   constraint: the engine does not hold the ends together any more. The wire breaks when its length has
   left that of the equilibrium by more than `yields` of it.
6. Where none of this is said the engine supplies the true force: what a contact bears, what a wire pulls.

A force that is said of a fixed thing, or that has no direction by these rules, is not used, and a notice tells.
Scene: SI units, y up.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import hypot, isfinite
from typing import Literal

from physics.formula.meaning import Said, names_used
from physics.formula.program import STATE, Code, Node, Program, ProgramError, Reading, compile_tree, constant
from physics.formula.quantities import axis_of
from physics.formula.said import names_in
from physics.formula.vectors import split
from physics.parts.given import Page, formula
from physics.rectify.contacts import outlines_of
from physics.rectify.separation import Outline, boxes_apart, separation
from physics.scene import Body, Disc, Edge, Force, Material, Support, Vector


@dataclass(frozen=True, slots=True)
class InferenceRule:
    """What counts as touching, and what is seen of a wrong force."""

    touching: float = 0.5
    """Page units: a gap below this is a contact that a given normal force may stand in for."""
    sinks: float = 0.3
    """Share of a solid's half size (a ball's radius) by which it sinks before it is struck back: deep enough to be
    seen across a room (7 page units of a ball 50 across), and shallow enough that under a force 10 % too small a
    ball is back at the surface before it has come down a drawn incline."""
    shallowest: float = 0.02
    """m: no less, or rounding and the pen would strike."""
    creeps: float = 1e-3
    """m/s: friction on a ball that it could hold fades below this speed: a page unit in ten seconds."""
    yields: float = 0.05
    """Share of its length by which a wire under a given tension may be off before it breaks: it
    forgives a tension rounded to two digits (5√2 as 7.1), not one that is 15 % wrong."""


RULE = InferenceRule()
FRICTION_NAMES = frozenset({"k", "s", "r", "f", "fr", "mu", "friction"})
"""Subscripts that make a force friction."""
NORMAL_NAMES = frozenset({"1", "n", "N", "normal"})
"""Subscripts that make a force the normal force, before all others; and it is what N and R are."""


@dataclass(frozen=True, slots=True)
class Bearing:
    """What a solid bears on: normal, a unit vector out of it towards the solid; edge: of a block, in its frame."""

    on: Body
    normal: Vector
    edge: Edge | None


@dataclass(frozen=True, slots=True)
class Acting:
    """All forces that the page gives its solids. bodies: as they are rubbed by them."""

    bodies: tuple[Body, ...]
    forces: tuple[Force, ...]
    supports: tuple[Support, ...]


Part = Literal["normal", "friction", "vector"]


def act(page: Page, bodies: tuple[Body, ...]) -> Acting:
    """The page's forces by the rules above."""
    forces: list[Force] = []
    supports: list[Support] = []
    materials: dict[str, Material] = {}
    outlines: dict[str, Outline] = {}
    for body in bodies:
        said = _parted(page, body)
        if not said:
            continue
        if not outlines:
            outlines = outlines_of(page.sketch)
        bearing = bearing_of(body, bodies, outlines)
        given: Support | None = None
        own: list[Force] = []
        rubbing: Said | None = None
        for one, part in said:
            match part:
                case "vector":
                    made = _vector(page, body, one)
                    own += [] if made is None else [made]
                case "normal":
                    given = _support(page, body, one, bearing) or given
                case "friction":
                    if rubbing is not None:
                        page.notices.append(
                            f"{body.label} is given {rubbing.text} and {one.text} as friction; the newest is used."
                        )
                    rubbing = one
        forces += own
        supports += [] if given is None else [given]
        if rubbing is not None:
            rubbed = _friction(page, body, rubbing, bearing, given, own)
            if isinstance(rubbed, Force):
                forces.append(rubbed)
                materials[body.label] = replace(body.material, friction=0.0)
            elif rubbed is not None:
                materials[body.label] = replace(body.material, friction=rubbed)
    bodies = tuple(
        replace(body, material=materials[body.label]) if body.label in materials else body for body in bodies
    )
    return Acting(bodies, tuple(forces), tuple(supports))


def bearing_of(body: Body, bodies: Iterable[Body], outlines: dict[str, Outline]) -> Bearing | None:
    """What a solid bears on, None where it touches nothing (rule 1)."""
    best: tuple[float, Body, Vector] | None = None
    for other in bodies:
        if other.label == body.label:
            continue
        if boxes_apart(outlines[other.label], outlines[body.label]) > RULE.touching:
            continue
        gap, (nx, ny) = separation(outlines[other.label], outlines[body.label])
        if gap <= RULE.touching and (best is None or -ny > best[0]):
            best = (-ny, other, (nx, -ny))
    if best is None:
        return None
    _, on, normal = best
    edge = _edge(on, normal)
    return Bearing(on, normal if edge is None else _normal(edge), edge)


def _parted(page: Page, body: Body) -> list[tuple[Said, Part]]:
    """The newest of each force that is said of a body, and what it is: vectors, normal forces, then friction."""
    own = page.spoken.own.get(body.label)
    if own is None:
        return []
    newest = {
        said.name: said for said in own.said if said.quantity is not None and said.quantity.role == "force"
    }
    # N in f_1 = N is the same force by another name.
    aliases = {said.tree.name for said in newest.values() if said.tree.is_Symbol and said.tree.name in newest}
    forces = [said for said in newest.values() if said.name not in aliases]
    if body.fixed and forces:
        used = names_used(page.meanings.said)
        page.notices.extend(
            f"{said.text}: {body.label} is fixed, so it is not used."
            for said in forces
            if said.name not in used
        )
        return []
    vectors: list[Said] = []
    friction: list[Said] = []
    scalars: list[Said] = []
    for said in forces:
        try:
            pair = split(said.tree)
        except ProgramError as error:
            page.notices.append(f"{said.text} of {body.label} cannot be worked out: {error}. It is not used.")
            continue
        index = said.name.partition("_")[2]
        if pair is not None or axis_of(said.name):
            vectors.append(said)
        elif index in FRICTION_NAMES or _holds_coefficient(said):
            friction.append(said)
        else:
            scalars.append(said)
    named = [said for said in scalars if _normal_by_name(said.name)]
    for said in named[:-1]:
        page.notices.append(
            f"{body.label} is given {said.text} and {named[-1].text} as its normal force; the newest is used."
        )
    normal = named[-1:] or scalars[:1]
    friction += [said for said in scalars if said not in normal and said not in named]
    parts: tuple[tuple[Part, list[Said]], ...] = (
        ("vector", vectors),
        ("normal", normal),
        ("friction", friction),
    )
    return [(said, part) for part, several in parts for said in several]


def _normal_by_name(name: str) -> bool:
    base, _, index = name.partition("_")
    return base in ("N", "R") or index in NORMAL_NAMES


def _holds_coefficient(said: Said) -> bool:
    return any(name == "mu" or name.startswith("mu_") for name in names_in(said.tree))


def _vector(page: Page, body: Body, said: Said) -> Force | None:
    pair = split(said.tree)
    trees = pair or ((said.tree, None) if said.name[-1] == "x" else (None, said.tree))
    zero = constant(0.0)
    x, y = (zero if tree is None else page.program(said, body.label, tree) for tree in trees)
    return None if x is None or y is None else Force(said.name, body.label, x, y)


def _support(page: Page, body: Body, said: Said, bearing: Bearing | None) -> Support | None:
    program = page.program(said, body.label, said.tree)
    if program is None:
        return None
    if bearing is None:
        page.notices.append(
            f"{said.text} of {body.label} has no direction, since {body.label} rests on nothing; "
            "write it as a pair, such as (0, 5). It is not used."
        )
        return None
    return Support(said.name, body.label, bearing.on.label, program, bearing.edge, skin_of(body))


def skin_of(body: Body) -> float:
    """How deep a solid sinks into what bears it under too small a force before it is struck back, m (rule 2)."""
    if isinstance(body.shape, Disc):
        half = body.shape.radius
    else:
        half = min(hypot(x, y) for x, y in body.shape.vertices) / 2
    return max(RULE.shallowest, RULE.sinks * half)


def _friction(
    page: Page,
    body: Body,
    said: Said,
    bearing: Bearing | None,
    given: Support | None,
    forces: list[Force],
) -> Force | float | None:
    """Friction as a force on the centre, or as a coefficient of the engine's own (rule 3)."""
    if bearing is None:
        page.notices.append(
            f"{said.text} of {body.label} is taken for friction, and {body.label} rests on nothing; "
            "write a force as a pair, such as (0, 5). It is not used."
        )
        return None
    pushed = [page.at_start(program, body.label) for force in forces for program in (force.x, force.y)]
    net = (sum(pushed[::2]), sum(pushed[1::2]) - body.mass * page.g)
    nx, ny = bearing.normal
    borne = -(net[0] * nx + net[1] * ny)
    normal = borne if given is None else page.at_start(given.force, body.label)
    program = _with_normal(page, said, body.label, normal)
    if program is None:
        return None
    size = page.at_start(program, body.label)
    if not isfinite(size) or size < 0 or normal <= 0:
        page.notices.append(
            f"{said.text} of {body.label}: friction must be a number of newtons, not below zero, "
            "of a contact that presses; it is not used."
        )
        return None
    if isinstance(body.shape, Disc):
        drive = abs(net[1] * nx - net[0] * ny)
        return _rubbing(body, said, bearing, program, skin_of(body), held=size >= drive)
    share = size / normal
    other = bearing.on.material.friction
    if other == 0 and share > 0:
        page.notices.append(
            f"{said.text} of {body.label}: {bearing.on.label} is said to be without friction; it is not used."
        )
        return None
    # Where both say something the geometric mean holds; it is to be this share.
    return share if other is None else share * share / other if other > 0 else 0.0


def _with_normal(page: Page, said: Said, label: str, normal: float) -> Program | None:
    """The program of friction, with the true normal force for an N that nobody explains."""
    names = page.names(label)

    def find(name: str) -> Node | float | Reading | None:
        found = names(name)
        return normal if name == "N" and found is None else found

    try:
        made = compile_tree(said.tree, find, formula(said))
    except ProgramError as error:
        page.refuse(said, label, error)
        return None
    page.tell_zeros(said, label, made)
    return page.from_start(made, label)


def _rubbing(body: Body, said: Said, bearing: Bearing, size: Program, skin: float, held: bool) -> Force:
    """Friction against a ball's motion along the contact, for as long as it is over the edge and near it."""
    nx, ny = bearing.normal
    tx, ty = ny, -nx
    speed = _linear(tx, "v_x", ty, "v_y", 0.0)
    if held:
        against: Code = [*speed, ("push", 1 / RULE.creeps), ("multiply", 0.0)]
        against += [("push", 1.0), ("min", 0.0), ("push", -1.0), ("max", 0.0)]
    else:
        against = [*speed, ("sign", 0.0)]
    code: Code = [*size.code, *against, ("multiply", 0.0)]
    if bearing.edge is not None and bearing.on.fixed:
        (x, y), (u, v) = (_placed(bearing.on, point) for point in (bearing.edge.start, bearing.edge.end))
        foot = x * tx + y * ty, u * tx + v * ty
        low, high = min(foot), max(foot)
        reach = nx * x + ny * y + (body.shape.radius if isinstance(body.shape, Disc) else 0.0) + skin
        for gate in (
            _linear(tx, "x", ty, "y", -low),
            _linear(-tx, "x", -ty, "y", high),
            _linear(-nx, "x", -ny, "y", reach),
        ):
            code += [*gate, ("sign", 0.0), ("push", 0.0), ("max", 0.0), ("multiply", 0.0)]
    x, y = (replace(size, code=(*code, ("push", -along), ("multiply", 0.0))) for along in (tx, ty))
    return Force(said.name, body.label, x, y)


def _linear(a: float, one: str, b: float, other: str, c: float) -> Code:
    """a · one + b · other + c."""
    return [
        ("read", float(STATE.index(one))),
        ("push", a),
        ("multiply", 0.0),
        ("read", float(STATE.index(other))),
        ("push", b),
        ("multiply", 0.0),
        ("add", 0.0),
        ("push", c),
        ("add", 0.0),
    ]


def _edge(body: Body, normal: Vector) -> Edge | None:
    """The edge of a block whose outward normal is nearest to `normal`; None for a disc."""
    if isinstance(body.shape, Disc):
        return None
    vertices = body.shape.vertices
    edges = [
        Edge(start, end)
        for start, end in zip(vertices, (*vertices[1:], vertices[0]), strict=True)
        if start != end
    ]

    def facing(edge: Edge) -> float:
        nx, ny = _normal(edge)
        return nx * normal[0] + ny * normal[1]

    return max(edges, key=facing)


def _normal(edge: Edge) -> Vector:
    """Outwards, of a block's edge as drawn (a block is built without a turn)."""
    (x1, y1), (x2, y2) = edge.start, edge.end
    length = hypot(x2 - x1, y2 - y1)
    return (y2 - y1) / length, (x1 - x2) / length


def _placed(body: Body, point: Vector) -> Vector:
    return body.position[0] + point[0], body.position[1] + point[1]
