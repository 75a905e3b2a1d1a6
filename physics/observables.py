"""What can be observed of a body in motion: as arrays with units, as a table, as a figure, as arrows (row E4).

    series = observe(motion.scene, motion.trajectory, "A", "velocity")

Frame: SI, x to the right, y up; arrows in page units, y down. Everything is read from the trajectory, so
it holds under any regime: a body that follows a student's equation of motion (row M7) has a velocity, an
acceleration and a net force like any other, m a being what must act on it.

Work is ∫ F · v dt with v that of the point where the force acts, by Gauss and Legendre's rule with three
points a frame: exact for polynomials of the fifth degree, so that between events only the engine errs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from physics.formula.meaning import PER_METRE
from physics.scene import Body, Scene
from physics.trajectory import ForceSeries, Trajectory
from sketch.ink import FloatArray
from sketch.shapes import Point

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class ObservableError(ValueError):
    """A quantity that this body has not: the message says which it has."""


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """One quantity of one body through time. unit: as text; times: (T,) s; values: (T,), or (T, 2) for a
    vector, x and y."""

    name: str
    body: str
    unit: str
    times: FloatArray
    values: FloatArray

    @property
    def vector(self) -> bool:
        """Whether it has a direction."""
        return self.values.ndim == 2

    @property
    def size(self) -> FloatArray:
        """The magnitude of a vector, a scalar as it is: (T,)."""
        return np.hypot(self.values[:, 0], self.values[:, 1]) if self.vector else self.values


def quantities(trajectory: Trajectory, body: str) -> tuple[str, ...]:
    """What can be observed of a body: the general quantities, then each of its forces and their works."""
    forces = list(dict.fromkeys(force.name for force in trajectory.forces if force.body == body))
    return (*_GENERAL, *forces, *(f"work of {name}" for name in forces))


def observe(scene: Scene, trajectory: Trajectory, body: str, quantity: str) -> Series:
    """A quantity of `quantities` through the trajectory's times.

    Raises ObservableError for a body that is not there or cannot move, and for a quantity that it has not.
    """
    solid = _movable(scene, body)
    if quantity in _GENERAL:
        unit, of = _GENERAL[quantity]
        return Series(quantity, body, unit, trajectory.times, of(scene, solid, trajectory))
    name = quantity.removeprefix("work of ")
    force = next((one for one in trajectory.forces if (one.name, one.body) == (name, body)), None)
    if force is None:
        known = ", ".join(quantities(trajectory, body))
        raise ObservableError(f"{body} has no {quantity!r} to observe; it has {known}")
    if quantity == name:
        return Series(quantity, body, "N", trajectory.times, force.values)
    return Series(quantity, body, "J", trajectory.times, _work(trajectory, force))


def observe_all(scene: Scene, trajectory: Trajectory, body: str) -> tuple[Series, ...]:
    """Everything of a body, works of single forces left out, which take the longest."""
    names = (name for name in quantities(trajectory, body) if not name.startswith("work of "))
    return tuple(observe(scene, trajectory, body, name) for name in names)


Of = Callable[[Scene, Body, Trajectory], FloatArray]


def _velocity(_scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    return trajectory.velocities[:, trajectory.column(body.label), :2]


def _acceleration(_scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    return trajectory.accelerations[:, trajectory.column(body.label), :2]


def _way(_scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    return trajectory.path(body.label) - np.asarray(body.position)


def _turning(_scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    return trajectory.velocities[:, trajectory.column(body.label), 2]


def _kinetic(scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    speed, spin = trajectory.speed(body.label), _turning(scene, body, trajectory)
    return 0.5 * body.mass * speed**2 + 0.5 * body.inertia * spin**2


def _potential(scene: Scene, body: Body, trajectory: Trajectory) -> FloatArray:
    return -body.mass * _way(scene, body, trajectory) @ np.asarray(scene.gravity)


_GENERAL: Mapping[str, tuple[str, Of]] = {
    "velocity": ("m/s", _velocity),
    "speed": ("m/s", lambda _, body, trajectory: trajectory.speed(body.label)),
    "acceleration": ("m/s²", _acceleration),
    "net force": ("N", lambda scene, body, run: body.mass * _acceleration(scene, body, run)),
    "x-displacement": ("m", lambda scene, body, run: _way(scene, body, run)[:, 0]),
    "y-displacement": ("m", lambda scene, body, run: _way(scene, body, run)[:, 1]),
    "position": ("m", lambda _, body, run: run.path(body.label)),
    "angle": ("rad", lambda _, body, run: run.poses[:, run.column(body.label), 2]),
    "angular velocity": ("rad/s", _turning),
    "momentum": ("kg m/s", lambda scene, body, run: body.mass * _velocity(scene, body, run)),
    "kinetic energy": ("J", _kinetic),
    "potential energy": ("J", _potential),
}
"""Quantity -> (unit, how it follows from the motion). Displacement and potential energy are measured from
where the body was drawn."""


def _movable(scene: Scene, label: str) -> Body:
    movable = [body for body in scene.bodies if not body.fixed]
    found = next((body for body in movable if body.label == label), None)
    if found is None:
        known = ", ".join(body.label for body in movable) or "nothing"
        raise ObservableError(f"{label!r} is nothing that can move here; {known} can")
    return found


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)


def _work(trajectory: Trajectory, force: ForceSeries) -> FloatArray:
    """∫ F · v dt from the start to each frame, (T,) J."""
    starts, steps = trajectory.times[:-1], np.diff(trajectory.times)
    if not len(steps):
        return np.zeros(len(trajectory.times))
    inner = trajectory.at((starts[:, None] + steps[:, None] * (1 + _NODES) / 2).ravel())
    acting, column = inner.force(force.name, force.body), inner.column(force.body)
    arm = acting.points - inner.poses[:, column, :2]
    velocity, spin = inner.velocities[:, column, :2], inner.velocities[:, column, 2]
    there = velocity + spin[:, None] * np.column_stack([-arm[:, 1], arm[:, 0]])
    # Where a force is not acting it may have no point.
    power = np.nan_to_num((acting.values * there).sum(axis=1)).reshape(-1, 3)
    return np.concatenate([[0.0], np.cumsum(steps / 2 * (power @ _WEIGHTS))])


def columns(series: Sequence[Series]) -> dict[str, FloatArray]:
    """A table's columns: the time, then each series, a vector as its x and y; names bear body and unit.

    Raises ObservableError where the series are not of the same times.
    """
    if not series:
        raise ObservableError("there is nothing to write; observe a quantity first")
    times = series[0].times
    table = {"t (s)": times}
    for one in series:
        if not np.array_equal(one.times, times):
            raise ObservableError(f"{one.name} of {one.body} is of other times than {series[0].name}")
        parts = [(" x", one.values[:, 0]), (" y", one.values[:, 1])] if one.vector else [("", one.values)]
        table |= {f"{one.name}{axis} of {one.body} ({one.unit})": values for axis, values in parts}
    return table


def csv(series: Sequence[Series]) -> str:
    """The table as CSV (RFC 4180 with line feeds), every number to the bit."""
    table = columns(series)
    head = ",".join(f'"{name}"' for name in table)
    rows = np.column_stack(list(table.values())).tolist()
    return "\n".join([head, *(",".join(repr(value) for value in row) for row in rows)]) + "\n"


def parquet(series: Sequence[Series]) -> bytes:
    """The table as a Parquet file (zstd), double precision."""
    import pyarrow as arrow
    from pyarrow import parquet as files

    sink = arrow.BufferOutputStream()
    files.write_table(arrow.table(columns(series)), sink, compression="zstd")
    return sink.getvalue().to_pybytes()


def figure(series: Sequence[Series]) -> Figure:
    """Line graphs over time, one below the other, one for each unit; a vector is drawn by its size and
    its two parts."""
    from matplotlib.figure import Figure

    if not series:
        raise ObservableError("there is nothing to draw; observe a quantity first")
    units = list(dict.fromkeys(one.unit for one in series))
    drawn = Figure(figsize=(7.0, 2.4 * len(units)), layout="constrained")
    axes = np.atleast_1d(drawn.subplots(len(units), 1, sharex=True))
    for unit, graph in zip(units, axes, strict=True):
        for one in (one for one in series if one.unit == unit):
            name = f"{one.name} of {one.body}"
            graph.plot(one.times, one.size, label=name)
            if one.vector:
                graph.plot(one.times, one.values[:, 0], "--", label=f"{name}, to the right")
                graph.plot(one.times, one.values[:, 1], ":", label=f"{name}, upwards")
        graph.set_ylabel(unit)
        graph.legend(fontsize="small")
    axes[-1].set_xlabel("time (s)")
    return drawn


@dataclass(frozen=True, slots=True)
class ArrowRule:
    """How arrows are scaled."""

    longest: float = 90.0
    """Page units: the arrow of the greatest size of its unit in the whole motion."""
    shortest: float = 1.0
    """Page units: what would be shorter is not drawn."""


ARROWS = ArrowRule()


@dataclass(frozen=True, slots=True)
class ScaledArrow:
    """A vector in one frame: from tail to tip, page units, y down; weight: "bold" for the one chosen."""

    name: str
    body: str
    tail: Point
    tip: Point
    weight: Literal["bold", "normal"]


def arrows(
    trajectory: Trajectory, series: Sequence[Series], frame: int, chosen: str | None = None
) -> tuple[ScaledArrow, ...]:
    """The vectors among the series at a frame, from the middle of their bodies.

    Length follows magnitude, and vectors of one unit share one scale, the same in all frames, so that two
    forces can be compared. Raises ObservableError for a frame that is not there.
    """
    if not -len(trajectory.times) <= frame < len(trajectory.times):
        raise ObservableError(
            f"there is no frame {frame}; the motion has {len(trajectory.times)}, counted from 0"
        )
    vectors = [one for one in series if one.vector and one.name != "position"]
    greatest: dict[str, float] = {}
    for one in vectors:
        greatest[one.unit] = max(greatest.get(one.unit, 0.0), float(np.nan_to_num(one.size).max()))
    drawn: list[ScaledArrow] = []
    for one in vectors:
        if greatest[one.unit] == 0:
            continue
        x, y = trajectory.path(one.body)[frame] * (PER_METRE, -PER_METRE)
        dx, dy = one.values[frame] * (1, -1) * ARROWS.longest / greatest[one.unit]
        if np.hypot(dx, dy) >= ARROWS.shortest:
            weight = "bold" if one.name == chosen else "normal"
            tip = (float(x + dx), float(y + dy))
            drawn.append(ScaledArrow(one.name, one.body, (float(x), float(y)), tip, weight))
    return tuple(drawn)
