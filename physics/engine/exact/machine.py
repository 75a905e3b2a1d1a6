"""The memory of exact mode for one set of rows: rows, the system that they make, the state, what is watched.

One piece of memory, headed by `MACHINE` (see physics.engine.cells); `m` is always that head. Python
holds the same as a `Machine` of numpy views.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from physics.engine.cells import Layout
from physics.engine.rows import ROW
from physics.engine.world import IntArray, Table
from sketch.ink import FloatArray

POWERS = 8
"""Rows of a step's dense output: its start, and seven polynomials."""
STAGES = 16
CAPACITY = 32
"""Steps recorded before Python takes them away."""

FIRST = 1e-3
"""s: the first step tried."""

T, H, GREATEST, AT = 0, 1, 2, 3
"""What `clock` holds: time, step to try next, greatest force, and at which pair bodies met."""

BLOCKS = (
    "rows",
    "row",
    "tangent",
    "start",
    "couples",
    "matrix",
    "factor",
    "given",
    "found",
    "change",
    "force",
    "status",
    "y",
    "new",
    "slopes",
    "dense",
    "pos",
    "vel",
    "acc",
    "power",
    "clock",
    "before",
    "after",
    "kept",
    "hit",
    "took",
    "takes",
    "gaps",
    "olds",
    "candidates",
    "spans",
    "record",
    "recorded",
)
COUNTS = (
    "rows",
    "unknowns",
    "couples",
    "bodies",
    "movable",
    "size",
    "ledger",
    "watched",
    "programs",
    "pairs",
    "capacity",
)
LAYOUT = Layout(BLOCKS, COUNTS)
MACHINE = LAYOUT.head


@dataclass(frozen=True, slots=True)
class System:
    """Which unknowns there are: row (m,) each belongs to, tangent (m,) 1 for the force along its tangent,
    start (m,) first column of the profile of each line, couples (k, 2) unknowns that share a body that can
    move, the greater first."""

    row: IntArray
    tangent: IntArray
    start: IntArray
    couples: IntArray


VIEWS = (
    "rows",
    "force",
    "status",
    "y",
    "slopes",
    "pos",
    "vel",
    "acc",
    "clock",
    "hit",
    "spans",
    "record",
    "recorded",
)
"""Blocks that Python looks into."""


@dataclass(frozen=True, slots=True)
class Machine:
    """Views of one machine's memory."""

    cells: FloatArray
    rows: Table
    system: System
    force: FloatArray
    status: IntArray
    y: FloatArray
    slopes: FloatArray
    pos: FloatArray
    vel: FloatArray
    acc: FloatArray
    clock: FloatArray
    hit: IntArray
    spans: FloatArray
    record: FloatArray
    recorded: IntArray

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as its memory, which everything else is a view of again when it is read."""
        likes = {name: (getattr(self, name).dtype, getattr(self, name).shape) for name in VIEWS}
        return _restored, (self.cells, self.system, likes)


def _restored(cells: FloatArray, system: System, likes: dict[str, tuple[Any, tuple[int, ...]]]) -> Machine:
    views = {name: LAYOUT.view(cells, name, np.empty(shape, dtype)) for name, (dtype, shape) in likes.items()}
    return Machine(cells=cells, system=system, **views)


def machine_of(
    rows: Table,
    system: System,
    counts: dict[str, int],
    pos: FloatArray,
    vel: FloatArray,
    y: FloatArray,
    clock: FloatArray,
) -> Machine:
    """A machine for these rows and unknowns, in this state (copied). counts: programs, pairs, watched, ledger."""
    n, u, size, bodies = len(rows), len(system.row), len(y), len(pos)
    pairs, programs, watched = counts["pairs"], counts["programs"], counts["watched"]
    real: dict[str, tuple[int, ...]] = {
        "matrix": (u, u),
        "factor": (u, u),
        "given": (u,),
        "found": (u,),
        "change": (u,),
        "force": (bodies, 3),
        "new": (size,),
        "slopes": (STAGES, size),
        "dense": (POWERS, size),
        "acc": (bodies, 3),
        "power": (counts["ledger"],),
        "before": (watched,),
        "after": (watched,),
        "kept": (watched,),
        "gaps": (pairs,),
        "olds": (pairs,),
        "spans": (CAPACITY, 2),
        "record": (CAPACITY, POWERS, size),
    }
    whole = {
        "status": 1,
        "hit": watched,
        "took": programs,
        "takes": programs,
        "candidates": pairs,
        "recorded": 1,
    }
    arrays: dict[str, Any] = {
        "rows": rows,
        "row": system.row,
        "tangent": system.tangent,
        "start": system.start,
        "couples": system.couples,
        "y": y,
        "pos": pos,
        "vel": vel,
        "clock": clock,
        **{name: np.zeros(shape) for name, shape in real.items()},
        **{name: np.zeros(length, np.int64) for name, length in whole.items()},
    }
    sizes = {
        "rows": n,
        "unknowns": u,
        "couples": len(system.couples),
        "bodies": bodies,
        "movable": counts["movable"],
        "size": size,
        "ledger": counts["ledger"],
        "watched": watched,
        "programs": programs,
        "pairs": pairs,
        "capacity": CAPACITY,
    }
    cells = LAYOUT.laid(sizes, arrays)

    return Machine(
        cells=cells, system=system, **{name: LAYOUT.view(cells, name, arrays[name]) for name in VIEWS}
    )


row_of = LAYOUT.records("rows", ROW)
"""Row k."""
unknown_rows = LAYOUT.integers("row", "unknowns")
"""(unknowns,) the row that each belongs to."""
tangents = LAYOUT.integers("tangent", "unknowns")
"""(unknowns,) 1 for forces along a row's tangent."""
starts = LAYOUT.integers("start", "unknowns")
"""(unknowns,) the first column of each line's profile."""
matrix = LAYOUT.numbers("matrix", "unknowns", "unknowns")
"""(unknowns, unknowns)."""
factor = LAYOUT.numbers("factor", "unknowns", "unknowns")
"""(unknowns, unknowns) its LU."""
given = LAYOUT.numbers("given", "unknowns")
"""(unknowns,) the right-hand side."""
found = LAYOUT.numbers("found", "unknowns")
"""(unknowns,) the solution."""
change = LAYOUT.numbers("change", "unknowns")
"""(unknowns,) room for a correction."""
forces_of = LAYOUT.numbers("force", "bodies", 3)
"""(bodies, 3) all forces on each body."""
status = LAYOUT.integers("status", 1)
"""[0]: 1 where the forces are not unique."""
state = LAYOUT.numbers("y", "size")
"""(size,) the state at the step's start."""
newest = LAYOUT.numbers("new", "size")
"""(size,) the state at the step's end."""
slopes = LAYOUT.numbers("slopes", STAGES, "size")
"""(16, size) derivatives at the stages."""
slope = LAYOUT.lines("slopes", "size")
"""(size,) the derivative at one stage."""
dense_of = LAYOUT.numbers("dense", POWERS, "size")
"""(8, size) dense output of the latest step."""
poses = LAYOUT.numbers("pos", "bodies", 3)
"""(bodies, 3) of the latest evaluation."""
velocities = LAYOUT.numbers("vel", "bodies", 3)
"""(bodies, 3)."""
accelerations = LAYOUT.numbers("acc", "bodies", 3)
"""(bodies, 3)."""
power = LAYOUT.numbers("power", "ledger")
"""(ledger,) W."""
clock = LAYOUT.numbers("clock", 4)
"""[T], [H], [GREATEST], [AT]."""
before = LAYOUT.numbers("before", "watched")
"""(watched,) at the step's start."""
after = LAYOUT.numbers("after", "watched")
"""(watched,) as last looked at."""
kept = LAYOUT.numbers("kept", "watched")
"""(watched,) at the step's end."""
hits = LAYOUT.integers("hit", "watched")
"""(watched,) 1 for what crossed zero in this event."""
took = LAYOUT.integers("took", "programs")
"""(programs,) branches at the step's start."""
takes = LAYOUT.integers("takes", "programs")
"""(programs,) branches as last looked at."""
gaps = LAYOUT.numbers("gaps", "pairs")
"""(pairs,) of the candidates."""
olds = LAYOUT.numbers("olds", "pairs")
"""(pairs,) a sample ago."""
candidates = LAYOUT.integers("candidates", "pairs")
"""(pairs,) those that may meet within the step."""
spans = LAYOUT.numbers("spans", "capacity", 2)
"""(capacity, 2) begin and end of recorded steps."""
recording = LAYOUT.lines("record", POWERS, "size")
"""(8 · size,) dense output of a recorded step."""
recorded = LAYOUT.integers("recorded", 1)
"""[0]: how many steps are recorded."""
