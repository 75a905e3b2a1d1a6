"""A cluster's tables as kernels see them: one piece of memory, headed by `WORLD` (see physics.engine.cells).

The accessors are named after the fields of `physics.engine.world.World`, whose arrays are views of the
same memory. `w` is always the head of a world's cells.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.cells import REAL, WHOLE, Layout
from physics.formula.kernel import branches, evaluate
from physics.jit import part
from sketch.ink import FloatArray

_INDICES = ("kind", "i", "j", "tension", "reader", "over", "broken")
_SIZES = ("ax", "ay", "bx", "by", "rest", "stiffness", "damping", "tolerance", "limit", "wound")
LINK = np.dtype([(name, np.int64) for name in _INDICES] + [(name, np.float64) for name in _SIZES])
"""kind; bodies i, j and the link's ends in their frames; tension: a program, −1: none; reader: whose state
it reads; over: the pulley, −1: none; wound: the angle that the wire sweeps about it, within half a turn, rad
(physics.engine.wheel)."""

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

BLOCKS = {
    "gravity": (REAL, (2,)),
    "mass": (REAL, ("bodies", 3)),
    "inverse": (REAL, ("bodies", 3)),
    "radius": (REAL, ("bodies",)),
    "first": (WHOLE, ("bodies",)),
    "sides": (WHOLE, ("bodies",)),
    "reach": (REAL, ("bodies",)),
    "corners": (REAL, ("vertices", 2)),
    "normals": (REAL, ("vertices", 2)),
    "edges": (REAL, ("vertices",)),
    "links": (LINK, ("links",)),
    "pairs": (PAIR, ("pairs",)),
    "pushes": (PUSH, ("pushes",)),
    "supports": (SUPPORT, ("supports",)),
    "courses": (COURSE, ("courses",)),
    "ops": (WHOLE, ("code",)),
    "args": (REAL, ("code",)),
    "who": (WHOLE, ("code",)),
    "spans": (WHOLE, ("programs", 2)),
    "switches": (WHOLE, ("programs",)),
    "stack": (REAL, ("depth",)),
}
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

PUSHED = 0
"""The opcode of a number in a program (physics.formula.kernel)."""

gravity = LAYOUT.numbers("gravity")
"""(2,) m/s²."""
masses = LAYOUT.numbers("mass")
"""(bodies, 3) kg, kg, kg m²."""
inverses = LAYOUT.numbers("inverse")
"""(bodies, 3) 1 / mass; zero for what is fixed and along a course."""
radii = LAYOUT.numbers("radius")
"""(bodies,) m."""
firsts = LAYOUT.integers("first")
"""(bodies,) first corner."""
counts = LAYOUT.integers("sides")
"""(bodies,) number of corners; none: a disc."""
reaches = LAYOUT.numbers("reach")
"""(bodies,) m."""
corners = LAYOUT.numbers("corners")
"""(vertices, 2) m."""
normals = LAYOUT.numbers("normals")
"""(vertices, 2)."""
edges = LAYOUT.numbers("edges")
"""(vertices,) m."""
link_of = LAYOUT.records("links")
"""Link k."""
pair_of = LAYOUT.records("pairs")
"""Pair k."""
push_of = LAYOUT.records("pushes")
"""Student's force k."""
support_of = LAYOUT.records("supports")
"""Given normal force k."""
course_of = LAYOUT.records("courses")
"""Course k."""
_ops = LAYOUT.integers("ops")
_args = LAYOUT.numbers("args")
_who = LAYOUT.integers("who")
_spans = LAYOUT.integers("spans")
_switches = LAYOUT.integers("switches")
_stack = LAYOUT.numbers("stack")


@part
def value(w: Any, program: int, t: float, pos: FloatArray, vel: FloatArray) -> float:
    """A program's value; NaN where it has none."""
    spans, ops, args = _spans(w), _ops(w), _args(w)
    start, stop = spans[program, 0], spans[program, 1]
    if stop == start + 1 and ops[start] == PUSHED:
        return float(args[start])
    return evaluate(ops, args, _who(w), start, stop, t, pos, vel, _stack(w))


@part
def branch(w: Any, program: int, t: float, pos: FloatArray, vel: FloatArray) -> int:
    """Which branches a program takes, as a number; 0 where it has none to take."""
    if _switches(w)[program] == 0:
        return 0
    spans = _spans(w)
    start, stop = spans[program, 0], spans[program, 1]
    return branches(_ops(w), _args(w), _who(w), start, stop, t, pos, vel, _stack(w))
