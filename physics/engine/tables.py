"""A cluster's tables as kernels see them: one piece of memory, headed by `WORLD` (see physics.engine.cells).

The accessors are named after the fields of `physics.engine.world.World`, whose arrays are views of the
same memory. `w` is always the head of a world's cells.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.cells import Layout, grid, integers, line, record
from physics.formula.kernel import branches, evaluate
from physics.jit import accessor, part
from sketch.ink import FloatArray

_INDICES = ("kind", "i", "j", "tension", "reader", "over", "broken")
_SIZES = ("ax", "ay", "bx", "by", "rest", "stiffness", "damping", "tolerance", "limit", "sense")
LINK = np.dtype([(name, np.int64) for name in _INDICES] + [(name, np.float64) for name in _SIZES])
"""kind; bodies i, j and the link's ends in their frames; tension: a program, −1: none; reader: whose state
it reads; over: the pulley, −1: none; sense: +1 where the wire goes round it anti-clockwise."""

PAIR = np.dtype(
    [(name, np.int64) for name in ("i", "j", "support")]
    + [(name, np.float64) for name in ("e", "mu", "reach", "size")]
)
"""Two bodies that may meet; support: the given normal force that stands in for their contact, −1: none;
reach: how far apart their centres can be and touch, m; size: of the smaller one, m."""

PUSH = np.dtype([(name, np.int64) for name in ("body", "x", "y")])
"""A student's force: programs for its parts."""

SUPPORT = np.dtype(
    [(name, np.int64) for name in ("i", "j", "force", "over", "risen", "pair")]
    + [(name, np.float64) for name in ("ax", "ay", "nx", "ny", "length", "skin", "mu")]
)
"""A student's normal force on i in place of what j gives: the edge in j's frame from (ax, ay), along the
normal (nx, ny) turned by a quarter, `length` long; length 0: j is a disc."""

COURSE = np.dtype(
    [(name, np.int64) for name in ("body", "axis", "position", "velocity", "acceleration", "on")]
)
"""A student's equation of motion for one coordinate; programs, −1: none."""

BLOCKS = (
    "gravity",
    "mass",
    "inverse",
    "radius",
    "first",
    "count",
    "reach",
    "corners",
    "normals",
    "edges",
    "links",
    "pairs",
    "pushes",
    "supports",
    "courses",
    "ops",
    "args",
    "who",
    "spans",
    "switches",
    "stack",
)
COUNTS = (
    "bodies",
    "movable",
    "vertices",
    "links",
    "pairs",
    "pushes",
    "supports",
    "courses",
    "code",
    "programs",
    "depth",
)
LAYOUT = Layout(BLOCKS, COUNTS)
WORLD = LAYOUT.head
_LINK, _PAIR, _PUSH, _SUPPORT, _COURSE = (d.itemsize for d in (LINK, PAIR, PUSH, SUPPORT, COURSE))

PUSHED = 0
"""The opcode of a number in a program (physics.formula.kernel)."""


@accessor
def gravity(w: Any) -> FloatArray:
    """(2,) m/s²."""
    return line(w, w.gravity_at, 2)


@accessor
def masses(w: Any) -> FloatArray:
    """(bodies, 3) kg, kg, kg m²."""
    return grid(w, w.mass_at, w.bodies, 3)


@accessor
def inverses(w: Any) -> FloatArray:
    """(bodies, 3) 1 / mass; zero for what is fixed and along a course."""
    return grid(w, w.inverse_at, w.bodies, 3)


@accessor
def radii(w: Any) -> FloatArray:
    """(bodies,) m."""
    return line(w, w.radius_at, w.bodies)


@accessor
def firsts(w: Any) -> Any:
    """(bodies,) first corner."""
    return integers(w, w.first_at, w.bodies)


@accessor
def counts(w: Any) -> Any:
    """(bodies,) number of corners; none: a disc."""
    return integers(w, w.count_at, w.bodies)


@accessor
def reaches(w: Any) -> FloatArray:
    """(bodies,) m."""
    return line(w, w.reach_at, w.bodies)


@accessor
def corners(w: Any) -> FloatArray:
    """(vertices, 2) m."""
    return grid(w, w.corners_at, w.vertices, 2)


@accessor
def normals(w: Any) -> FloatArray:
    """(vertices, 2)."""
    return grid(w, w.normals_at, w.vertices, 2)


@accessor
def edges(w: Any) -> FloatArray:
    """(vertices,) m."""
    return line(w, w.edges_at, w.vertices)


@accessor
def link_of(w: Any, k: int) -> Any:
    """Link k."""
    return record(w, w.links_at + k * _LINK, LINK)


@accessor
def pair_of(w: Any, k: int) -> Any:
    """Pair k."""
    return record(w, w.pairs_at + k * _PAIR, PAIR)


@accessor
def push_of(w: Any, k: int) -> Any:
    """Student's force k."""
    return record(w, w.pushes_at + k * _PUSH, PUSH)


@accessor
def support_of(w: Any, k: int) -> Any:
    """Given normal force k."""
    return record(w, w.supports_at + k * _SUPPORT, SUPPORT)


@accessor
def course_of(w: Any, k: int) -> Any:
    """Course k."""
    return record(w, w.courses_at + k * _COURSE, COURSE)


@part
def value(w: Any, program: int, t: float, pos: FloatArray, vel: FloatArray) -> float:
    """A program's value; NaN where it has none."""
    spans = integers(w, w.spans_at, 2 * w.programs)
    start, stop = spans[2 * program], spans[2 * program + 1]
    ops, args = integers(w, w.ops_at, w.code), line(w, w.args_at, w.code)
    if stop == start + 1 and ops[start] == PUSHED:
        return args[start]
    who, stack = integers(w, w.who_at, w.code), line(w, w.stack_at, w.depth)
    return evaluate(ops, args, who, start, stop, t, pos, vel, stack)


@part
def branch(w: Any, program: int, t: float, pos: FloatArray, vel: FloatArray) -> int:
    """Which branches a program takes, as a number; 0 where it has none to take."""
    if integers(w, w.switches_at, w.programs)[program] == 0:
        return 0
    spans = integers(w, w.spans_at, 2 * w.programs)
    start, stop = spans[2 * program], spans[2 * program + 1]
    ops, args = integers(w, w.ops_at, w.code), line(w, w.args_at, w.code)
    who, stack = integers(w, w.who_at, w.code), line(w, w.stack_at, w.depth)
    return branches(ops, args, who, start, stop, t, pos, vel, stack)
