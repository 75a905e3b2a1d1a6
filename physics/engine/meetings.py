"""When clusters that have nothing to do with each other first meet.

Each cluster's motion is known at any time; the gap between two bodies of different clusters is looked
at on a grid fine enough not to miss a passage, then its zero is found to rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from physics.engine.exact.touch import gaps_between
from physics.engine.world import IntArray, Names, World, start_of
from physics.scene import Block, Body, Disc, Scene
from sketch.ink import FloatArray

if TYPE_CHECKING:
    from physics.engine.simulation import Strand

GRID = 1 / 120
"""s: the coarsest grid on which gaps are looked at."""
FINEST = 4096
"""Places in an epoch, at most: a bullet of 1 mm at 16 m/s."""
Tables = Callable[[tuple[str, ...]], tuple[World, Names]]

CLOSED = -1e-9
"""m: gaps below this have closed."""


@dataclass(frozen=True, slots=True)
class Meeting:
    """Two clusters that meet at a time, s."""

    time: float
    first: Strand
    second: Strand


def first_meeting(
    scene: Scene, strands: Sequence[Strand], begin: float, end: float, tables: Tables
) -> Meeting | None:
    """The first meeting of any two clusters within (begin, end], all of which have been simulated so far.
    tables: the world of such movable bodies."""
    times = np.linspace(begin, end, max(2, int(np.ceil((end - begin) / GRID)) + 1))
    bodies = {body.label: body for body in scene.bodies}
    paths: list[tuple[FloatArray, FloatArray]] = [_paths(strand, times) for strand in strands]
    boxes = [_box(strand, path, bodies) for strand, path in zip(strands, paths, strict=True)]
    best: Meeting | None = None
    low, high = np.array([low for low, _ in boxes]), np.array([high for _, high in boxes])
    apart = np.any((low[:, None] > high[None]) | (low[None] > high[:, None]), axis=2)
    for a, b in np.argwhere(np.triu(~apart, 1)).tolist():
        one, other = strands[a], strands[b]
        if (one.run.time < end and one.run.stopped) or (other.run.time < end and other.run.stopped):
            continue
        # To the end, though another meeting may have been found: when two meet depends on them alone, to the bit.
        when = _first_of(scene, one, other, begin, end, bodies, tables)
        if when is not None and (best is None or when < best.time):
            best = Meeting(when, one, other)
    return best


def _paths(strand: Strand, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    begun = max(strand.runs[0].start, float(times[0]))
    pos, vel = states_of(strand, np.maximum(times, begun))
    n = strand.run.names.movable
    return pos[:, :n], vel[:, :n]


def states_of(strand: Strand, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Poses and velocities of a cluster's world at ascending times, from the runs that it had then."""
    if len(strand.runs) == 1:
        return strand.run.states(times)
    starts = [run.start for run in strand.runs]
    which = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
    parts = [strand.runs[k].states(times[which == k]) for k in np.unique(which)]
    return np.concatenate([pos for pos, _ in parts]), np.concatenate([vel for _, vel in parts])


def _box(
    strand: Strand, path: tuple[FloatArray, FloatArray], bodies: dict[str, Body]
) -> tuple[FloatArray, FloatArray]:
    """The corners of what a cluster sweeps over, with room for what it does between two looks."""
    pos, vel = path
    reach = np.array([_reach(bodies[label]) for label in strand.run.names.bodies[: strand.run.names.movable]])
    slack = reach + 2.0 * GRID * np.hypot(vel[:, :, 0], vel[:, :, 1]).max(axis=0) + 1e-6
    low = (pos[:, :, :2].min(axis=0) - slack[:, None]).min(axis=0)
    high = (pos[:, :, :2].max(axis=0) + slack[:, None]).max(axis=0)
    return low, high


def _first_of(
    scene: Scene,
    one: Strand,
    other: Strand,
    begin: float,
    end: float,
    bodies: dict[str, Body],
    tables: Tables,
) -> float | None:
    """When the first bodies of two clusters meet, s."""
    begin = max(begin, one.runs[0].start, other.runs[0].start)
    if end <= begin:
        return None
    members = (*one.members, *other.members)
    world, names = tables(members)
    start, _ = start_of(scene, names)
    coarse = np.linspace(begin, end, max(2, int(np.ceil((end - begin) / GRID)) + 1))
    fastest = max(float(np.abs(states_of(s, coarse)[1]).max()) for s in (one, other))
    spin = max(_reach(bodies[label]) for label in members)
    width = min(_width(bodies[label]) for label in members)
    looks = int(np.ceil((end - begin) * 2.0 * fastest * max(1.0, spin) / (0.25 * width)))
    times = np.linspace(begin, end, min(FINEST, max(len(coarse), looks + 1)))
    pos = _joined(names, start, (one, other), times)
    first: float | None = None
    gaps = np.zeros(len(times))
    for i in range(names.movable):
        for j in range(i + 1, names.movable):
            if (names.bodies[i] in one.members) == (names.bodies[j] in one.members):
                continue
            apart = np.hypot(pos[:, i, 0] - pos[:, j, 0], pos[:, i, 1] - pos[:, j, 1]).min()
            if apart > _reach(bodies[names.bodies[i]]) + _reach(bodies[names.bodies[j]]) + 0.25 * width:
                continue
            gaps_between(world.cells, pos, i, j, gaps)
            when = _closing(world, names, start, (one, other), times, gaps, i, j)
            if when is not None and (first is None or when < first):
                first = when
    return first


def _joined(names: Names, start: FloatArray, strands: tuple[Strand, Strand], times: FloatArray) -> FloatArray:
    """Poses of both clusters in one world, (T, bodies + 1, 3)."""
    pos = np.broadcast_to(start, (len(times), *start.shape)).copy()
    for strand in strands:
        places, _ = states_of(strand, times)
        pos[:, _rows(strand, names)] = places[:, : strand.run.names.movable]
    return pos


def _rows(strand: Strand, names: Names) -> IntArray:
    """Where a cluster's movable bodies stand in a world of more."""
    own = strand.run.names
    return np.array([names.bodies.index(label) for label in own.bodies[: own.movable]])


def _closing(
    world: World,
    names: Names,
    start: FloatArray,
    strands: tuple[Strand, Strand],
    times: FloatArray,
    gaps: FloatArray,
    i: int,
    j: int,
) -> float | None:
    """When a gap that was looked at on a grid first closes, s: a zero between two looks, or a dip."""
    # Here, for it takes long to import and lone clusters never need it.
    from scipy.optimize import minimize_scalar

    pos, found = start[None].copy(), np.zeros(1)
    movers = [(strand, _rows(strand, names)) for strand in strands]

    def gap(t: float) -> float:
        for strand, rows in movers:
            if len(strand.runs) == 1:
                strand.run.place(t, rows, pos[0])
            else:
                pos[0, rows] = states_of(strand, np.array([t]))[0][0, : len(rows)]
        gaps_between(world.cells, pos, i, j, found)
        return float(found[0])

    if gaps[0] < CLOSED:
        return float(times[0])
    below = np.flatnonzero(gaps < CLOSED)
    end = int(below[0]) if len(below) else len(gaps)
    for k in range(1, min(end, len(gaps) - 1)):
        step = abs(gaps[k + 1] - gaps[k - 1])
        if gaps[k] <= gaps[k - 1] and gaps[k] < gaps[k + 1] and gaps[k] < step:
            low, high = float(times[k - 1]), float(times[k + 1])
            least: Any = minimize_scalar(gap, bounds=(low, high), method="bounded", options={"xatol": 1e-12})
            if least.fun < CLOSED:
                return _zero(gap, low, float(least.x)) if gap(low) > 0 else low
    if not len(below):
        return None
    k = int(below[0])
    low, high = float(times[k - 1]), float(times[k])
    if gaps[k - 1] <= 0:
        return low
    return _zero(gap, low, high)


def _zero(gap: Callable[[float], float], low: float, high: float) -> float:
    """When a gap that is open at low and closed at high closes, to rounding."""
    from scipy.optimize import brentq

    found: Any = brentq(gap, low, high, xtol=1e-15)
    return float(found)


def _reach(body: Body) -> float:
    if isinstance(body.shape, Disc):
        return body.shape.radius
    return max(float(np.hypot(x, y)) for x, y in body.shape.vertices)


def _width(body: Body) -> float:
    """The least width of a body, m."""
    if isinstance(body.shape, Disc):
        return 2 * body.shape.radius
    assert isinstance(body.shape, Block)
    points = np.asarray(body.shape.vertices)
    along = np.roll(points, -1, axis=0) - points
    lengths = np.hypot(along[:, 0], along[:, 1])
    normals = np.column_stack([along[:, 1], -along[:, 0]])[lengths > 0] / lengths[lengths > 0][:, None]
    return float(np.ptp(points @ normals.T, axis=0).min())
