"""The memory of exact mode for one set of rows: rows, the system that they make, the state, what is watched.

One piece of memory, headed by `MACHINE` (see physics.engine.cells); `m` is always that head. Python
holds the same as a `Machine` of numpy views.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from physics.engine.cells import Layout, grid, integers, line, record
from physics.engine.rows import ROW
from physics.engine.world import IntArray, Table
from physics.jit import accessor
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
_ROW = ROW.itemsize


@dataclass(frozen=True, slots=True)
class System:
    """Which unknowns there are: row (m,) each belongs to, tangent (m,) 1 for the force along its tangent,
    start (m,) first column of the profile of each line, couples (k, 2) unknowns that share a body that can
    move, the greater first."""

    row: IntArray
    tangent: IntArray
    start: IntArray
    couples: IntArray


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

    def view(name: str) -> Any:
        return LAYOUT.view(cells, name, arrays[name])

    return Machine(
        cells,
        view("rows"),
        system,
        *(
            view(name)
            for name in (
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
        ),
    )


@accessor
def row_of(m: Any, k: int) -> Any:
    """Row k."""
    return record(m, m.rows_at + k * _ROW, ROW)


@accessor
def unknown_rows(m: Any) -> Any:
    """(unknowns,) the row that each belongs to."""
    return integers(m, m.row_at, m.unknowns)


@accessor
def tangents(m: Any) -> Any:
    """(unknowns,) 1 for forces along a row's tangent."""
    return integers(m, m.tangent_at, m.unknowns)


@accessor
def starts(m: Any) -> Any:
    """(unknowns,) the first column of each line's profile."""
    return integers(m, m.start_at, m.unknowns)


@accessor
def matrix(m: Any) -> FloatArray:
    """(unknowns, unknowns)."""
    return grid(m, m.matrix_at, m.unknowns, m.unknowns)


@accessor
def factor(m: Any) -> FloatArray:
    """(unknowns, unknowns) its LU."""
    return grid(m, m.factor_at, m.unknowns, m.unknowns)


@accessor
def given(m: Any) -> FloatArray:
    """(unknowns,) the right-hand side."""
    return line(m, m.given_at, m.unknowns)


@accessor
def found(m: Any) -> FloatArray:
    """(unknowns,) the solution."""
    return line(m, m.found_at, m.unknowns)


@accessor
def change(m: Any) -> FloatArray:
    """(unknowns,) room for a correction."""
    return line(m, m.change_at, m.unknowns)


@accessor
def forces_of(m: Any) -> FloatArray:
    """(bodies, 3) all forces on each body."""
    return grid(m, m.force_at, m.bodies, 3)


@accessor
def status(m: Any) -> Any:
    """[0]: 1 where the forces are not unique."""
    return integers(m, m.status_at, 1)


@accessor
def state(m: Any) -> FloatArray:
    """(size,) the state at the step's start."""
    return line(m, m.y_at, m.size)


@accessor
def newest(m: Any) -> FloatArray:
    """(size,) the state at the step's end."""
    return line(m, m.new_at, m.size)


@accessor
def slopes(m: Any) -> FloatArray:
    """(16, size) derivatives at the stages."""
    return grid(m, m.slopes_at, STAGES, m.size)


@accessor
def slope(m: Any, stage: int) -> FloatArray:
    """(size,) the derivative at one stage."""
    return line(m, m.slopes_at + 8 * stage * m.size, m.size)


@accessor
def dense_of(m: Any) -> FloatArray:
    """(8, size) dense output of the latest step."""
    return grid(m, m.dense_at, POWERS, m.size)


@accessor
def poses(m: Any) -> FloatArray:
    """(bodies, 3) of the latest evaluation."""
    return grid(m, m.pos_at, m.bodies, 3)


@accessor
def velocities(m: Any) -> FloatArray:
    """(bodies, 3)."""
    return grid(m, m.vel_at, m.bodies, 3)


@accessor
def accelerations(m: Any) -> FloatArray:
    """(bodies, 3)."""
    return grid(m, m.acc_at, m.bodies, 3)


@accessor
def power(m: Any) -> FloatArray:
    """(ledger,) W."""
    return line(m, m.power_at, m.ledger)


@accessor
def clock(m: Any) -> FloatArray:
    """[T], [H], [GREATEST], [AT]."""
    return line(m, m.clock_at, 4)


@accessor
def before(m: Any) -> FloatArray:
    """(watched,) at the step's start."""
    return line(m, m.before_at, m.watched)


@accessor
def after(m: Any) -> FloatArray:
    """(watched,) as last looked at."""
    return line(m, m.after_at, m.watched)


@accessor
def kept(m: Any) -> FloatArray:
    """(watched,) at the step's end."""
    return line(m, m.kept_at, m.watched)


@accessor
def hits(m: Any) -> Any:
    """(watched,) 1 for what crossed zero in this event."""
    return integers(m, m.hit_at, m.watched)


@accessor
def took(m: Any) -> Any:
    """(programs,) branches at the step's start."""
    return integers(m, m.took_at, m.programs)


@accessor
def takes(m: Any) -> Any:
    """(programs,) branches as last looked at."""
    return integers(m, m.takes_at, m.programs)


@accessor
def gaps(m: Any) -> FloatArray:
    """(pairs,) of the candidates."""
    return line(m, m.gaps_at, m.pairs)


@accessor
def olds(m: Any) -> FloatArray:
    """(pairs,) a sample ago."""
    return line(m, m.olds_at, m.pairs)


@accessor
def candidates(m: Any) -> Any:
    """(pairs,) those that may meet within the step."""
    return integers(m, m.candidates_at, m.pairs)


@accessor
def spans(m: Any) -> FloatArray:
    """(capacity, 2) begin and end of recorded steps."""
    return grid(m, m.spans_at, m.capacity, 2)


@accessor
def recording(m: Any, step: int) -> FloatArray:
    """(8 · size,) dense output of a recorded step."""
    return line(m, m.record_at + 64 * step * m.size, POWERS * m.size)


@accessor
def recorded(m: Any) -> Any:
    """[0]: how many steps are recorded."""
    return integers(m, m.recorded_at, 1)
