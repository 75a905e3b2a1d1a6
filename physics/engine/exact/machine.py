"""The memory of exact mode for one set of rows: rows, the system that they make, the state, what is watched.

One piece of memory, headed by `MACHINE` (see physics.engine.cells); `m` is always that head. Python
holds the same as a `Machine` of numpy views.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from physics.engine.cells import CELL, REAL, WHOLE, Layout, Plan, head
from physics.engine.rows import ROW
from physics.engine.world import IntArray, Table
from physics.jit import kernel
from sketch.ink import FloatArray

POWERS = 8
"""Rows of a step's dense output: its start, and seven polynomials."""
STAGES = 16

FIRST = 1e-3
"""s: the first step tried."""

T, H, GREATEST, AT = 0, 1, 2, 3
"""What `clock` holds: time, step to try next, greatest force, and at which pair bodies met."""

BLOCKS = {
    "rows": (ROW, ("rows",)),
    "row": (WHOLE, ("unknowns",)),
    "tangent": (WHOLE, ("unknowns",)),
    "start": (WHOLE, ("unknowns",)),
    "couples": (WHOLE, ("couples", 2)),
    "matrix": (REAL, ("unknowns", "unknowns")),
    "factor": (REAL, ("unknowns", "unknowns")),
    "given": (REAL, ("unknowns",)),
    "found": (REAL, ("unknowns",)),
    "change": (REAL, ("unknowns",)),
    "force": (REAL, ("bodies", 3)),
    "status": (WHOLE, (1,)),
    "y": (REAL, ("size",)),
    "new": (REAL, ("size",)),
    "slopes": (REAL, (STAGES, "size")),
    "dense": (REAL, (POWERS, "size")),
    "pos": (REAL, ("bodies", 3)),
    "vel": (REAL, ("bodies", 3)),
    "acc": (REAL, ("bodies", 3)),
    "power": (REAL, ("ledger",)),
    "clock": (REAL, (4,)),
    "before": (REAL, ("watched",)),
    "after": (REAL, ("watched",)),
    "kept": (REAL, ("watched",)),
    "hit": (WHOLE, ("watched",)),
    "took": (WHOLE, ("programs",)),
    "takes": (WHOLE, ("programs",)),
    "gaps": (REAL, ("pairs",)),
    "olds": (REAL, ("pairs",)),
    "candidates": (WHOLE, ("pairs",)),
    "recorded": (WHOLE, (1,)),
}
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


class Machine:
    """Views of one machine's memory. rows: (rows,) of `ROW`; y: (size,) the state; slopes: (16, size), the first is
    the derivative of the state; clock: [T], [H], [GREATEST], [AT]; recorded: [0]: how many steps are recorded."""

    __slots__ = ("cells", "clock", "plan", "recorded", "rows", "slopes", "system", "y")

    def __init__(self, cells: FloatArray, plan: Plan, system: System) -> None:
        self.cells, self.plan, self.system = cells, plan, system
        self.rows: Table = plan.view(cells, "rows")
        self.y: FloatArray = plan.view(cells, "y")
        self.slopes: FloatArray = plan.view(cells, "slopes")
        self.clock: FloatArray = plan.view(cells, "clock")
        self.recorded: IntArray = plan.view(cells, "recorded")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as its memory, which everything else is a view of again when it is read."""
        return _restored, (self.cells, self.system)

    @property
    def pos(self) -> FloatArray:
        """(bodies, 3) of the latest evaluation."""
        return self.plan.view(self.cells, "pos")

    @property
    def hit(self) -> IntArray:
        """(watched,) 1 for what crossed zero in the latest event."""
        return self.plan.view(self.cells, "hit")

    @property
    def unique(self) -> bool:
        """Whether the forces of the latest evaluation are the only ones that do."""
        return not self.plan.view(self.cells, "status")[0]


def _restored(cells: FloatArray, system: System) -> Machine:
    return Machine(cells, LAYOUT.plan_of(cells), system)


def machine_of(
    rows: Table,
    system: System,
    counts: tuple[int, int, int, int, int],
    pos: FloatArray,
    vel: FloatArray,
    works: FloatArray,
    time: float,
    step: float,
) -> Machine:
    """A machine for these rows and unknowns, in this state (copied). counts: movable bodies, ledger, watched,
    programs, pairs."""
    movable, ledger, watched, programs, pairs = counts
    plan = LAYOUT.plan(
        len(rows),
        len(system.row),
        len(system.couples),
        len(pos),
        movable,
        6 * movable + ledger,
        ledger,
        watched,
        programs,
        pairs,
    )
    cells = plan.fresh()
    _lay(cells, rows, system.row, system.tangent, system.start, system.couples, pos, vel, works, time, step)
    return Machine(cells, plan, system)


row_of = LAYOUT.records("rows")
"""Row k."""
unknown_rows = LAYOUT.integers("row")
"""(unknowns,) the row that each belongs to."""
tangents = LAYOUT.integers("tangent")
"""(unknowns,) 1 for forces along a row's tangent."""
starts = LAYOUT.integers("start")
"""(unknowns,) the first column of each line's profile."""
couples_of = LAYOUT.integers("couples")
"""(couples, 2) unknowns that share a body."""
matrix = LAYOUT.numbers("matrix")
"""(unknowns, unknowns)."""
factor = LAYOUT.numbers("factor")
"""(unknowns, unknowns) its LU."""
given = LAYOUT.numbers("given")
"""(unknowns,) the right-hand side."""
found = LAYOUT.numbers("found")
"""(unknowns,) the solution."""
change = LAYOUT.numbers("change")
"""(unknowns,) room for a correction."""
forces_of = LAYOUT.numbers("force")
"""(bodies, 3) all forces on each body."""
status = LAYOUT.integers("status")
"""[0]: 1 where the forces are not unique."""
state = LAYOUT.numbers("y")
"""(size,) the state at the step's start."""
newest = LAYOUT.numbers("new")
"""(size,) the state at the step's end."""
slopes = LAYOUT.numbers("slopes")
"""(16, size) derivatives at the stages."""
slope = LAYOUT.lines("slopes")
"""(size,) the derivative at one stage."""
dense_of = LAYOUT.numbers("dense")
"""(8, size) dense output of the latest step."""
poses = LAYOUT.numbers("pos")
"""(bodies, 3) of the latest evaluation."""
velocities = LAYOUT.numbers("vel")
"""(bodies, 3)."""
accelerations = LAYOUT.numbers("acc")
"""(bodies, 3)."""
power = LAYOUT.numbers("power")
"""(ledger,) W."""
clock = LAYOUT.numbers("clock")
"""[T], [H], [GREATEST], [AT]."""
before = LAYOUT.numbers("before")
"""(watched,) at the step's start."""
after = LAYOUT.numbers("after")
"""(watched,) as last looked at."""
kept = LAYOUT.numbers("kept")
"""(watched,) at the step's end."""
hits = LAYOUT.integers("hit")
"""(watched,) 1 for what crossed zero in this event."""
took = LAYOUT.integers("took")
"""(programs,) branches at the step's start."""
takes = LAYOUT.integers("takes")
"""(programs,) branches as last looked at."""
gaps = LAYOUT.numbers("gaps")
"""(pairs,) of the candidates."""
olds = LAYOUT.numbers("olds")
"""(pairs,) a sample ago."""
candidates = LAYOUT.integers("candidates")
"""(pairs,) those that may meet within the step."""
recorded = LAYOUT.integers("recorded")
"""[0]: how many steps are recorded."""


@kernel
def _lay(
    memory: FloatArray,
    rows: Table,
    row: IntArray,
    tangent: IntArray,
    start: IntArray,
    couples: IntArray,
    pos: FloatArray,
    vel: FloatArray,
    works: FloatArray,
    time: float,
    step: float,
) -> None:
    """Writes rows, unknowns and state into a machine's memory."""
    m = head(memory, MACHINE)
    at = m.rows_at // CELL
    # A row is a line of numbers.
    lines = rows.view(np.float64)
    for k in range(len(lines)):
        memory[at + k] = lines[k]
    for a in range(m.unknowns):
        unknown_rows(m)[a], tangents(m)[a], starts(m)[a] = row[a], tangent[a], start[a]
    for k in range(m.couples):
        couples_of(m)[k, 0], couples_of(m)[k, 1] = couples[k, 0], couples[k, 1]
    y, n = state(m), 3 * m.movable
    for i in range(m.bodies):
        for a in range(3):
            poses(m)[i, a], velocities(m)[i, a] = pos[i, a], vel[i, a]
    for i in range(m.movable):
        for a in range(3):
            y[3 * i + a], y[n + 3 * i + a] = pos[i, a], vel[i, a]
    for k in range(m.ledger):
        y[2 * n + k] = works[k]
    now = clock(m)
    now[T], now[H], now[GREATEST], now[AT] = time, step, 1.0, -1.0
