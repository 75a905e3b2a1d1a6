"""A scene watched until something happens: the moments that answers speak of.

SI units. The engine's dense output makes every moment exact to rounding: it is bracketed on a grid,
then on finer and finer ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from physics.engine import Simulation
from physics.scene import Scene
from physics.trajectory import Event, Trajectory
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class Watching:
    """How long and how closely a scene is watched."""

    horizons: tuple[float, ...] = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
    """s: until a moment is found; what takes longer on a page of six metres does not happen."""
    extremes: float = 10.0
    """s: for the greatest and the smallest value."""
    zooms: int = 4
    """Grids within one another for an extreme: the last is a hundred millionth of the first's step, and what
    an extreme misses goes with the square."""
    rate: float = 120.0
    """Frames a second: things that fit on a page are not done within a hundredth of a second."""
    beside: float = 1e-9
    """s before or after a meeting at which the motion before or after it is read: an acceleration of
    1000 m/s² changes a velocity by 1e-6 m/s in it."""
    still: float = 1e-6
    """Share of the greatest speed so far that is standing still."""
    same: float = 5e-3
    """Share of the way to and fro, and of the greatest speed, by which a motion may come back otherwise and
    still be called periodic."""


WATCHING = Watching()


class NotDetermined(Exception):
    """The page does not settle what is asked; the message says why."""


class Watch:
    """A scene on its way, as far as it had to be run. Mutable, like the simulation that it holds."""

    def __init__(self, scene: Scene, accuracy: float) -> None:
        self.scene = scene
        self._run = Simulation(scene, accuracy=accuracy)

    def until(self, seconds: float) -> Trajectory:
        """The motion of the first `seconds`, on the grid. Raises NotDetermined where a formula stops it."""
        self._run.run_to(seconds)
        if self._run.stopped < seconds:
            raise NotDetermined(
                f"a formula of the page has no value {self._run.stopped:.3g} s after the start"
            )
        return self._run.trajectory(WATCHING.rate, seconds)

    def at(self, time: float) -> Trajectory:
        """The motion at one moment (s)."""
        return self.until(max(time, 0.0)).at(np.array([max(time, 0.0)]))

    def longer_and_longer(self) -> Iterator[Trajectory]:
        """The motion within each horizon."""
        for seconds in WATCHING.horizons:
            yield self.until(seconds)

    def meeting(self, label: str) -> float:
        """When the body first meets another, s. Raises NotDetermined where it meets none."""
        for run in self.longer_and_longer():
            met = next((event.time for event in run.events if _meets(event, label)), None)
            if met is not None:
                return met
        raise NotDetermined(f"{label} meets nothing within {WATCHING.horizons[-1]:g} s")

    def stop(self, label: str) -> float:
        """When the body first stands still after it has moved, s. Raises NotDetermined where it never does."""
        for run in self.longer_and_longer():
            speed, velocity = run.speed(label), run.velocities[:, run.column(label), :2]
            moving = speed > WATCHING.still * np.maximum.accumulate(speed)
            # Turning back counts as well: then velocities before and after point to opposite sides.
            back = (velocity[:-1] * velocity[1:]).sum(axis=1) <= 0
            ends = np.flatnonzero(moving[:-1] & (back | ~moving[1:]))
            if len(ends):
                first = int(ends[0])
                before = velocity[first]
                return _crossing(
                    run,
                    (float(run.times[first]), float(run.times[first + 1])),
                    lambda inner, before=before: inner.velocities[:, inner.column(label), :2] @ before,
                )
        raise NotDetermined(f"{label} does not stop within {WATCHING.horizons[-1]:g} s")

    def period(self, label: str) -> float:
        """How long the body takes to come back to where it was, moving as it did, s. Raises NotDetermined
        where it does not."""
        for run in self.longer_and_longer():
            found = _period(run, label)
            if found is not None:
                return found
        raise NotDetermined(f"{label} does not move to and fro, or round, within {WATCHING.horizons[-1]:g} s")

    def extreme(self, measure: Callable[[Trajectory], FloatArray], greatest: bool) -> float:
        """The greatest (or the smallest) value of a measure (T,) while the scene is watched. Raises
        NotDetermined where it is still growing at the end."""
        run = self.until(WATCHING.extremes)
        sense = 1.0 if greatest else -1.0
        times, found = run.times, -np.inf
        for _ in range(WATCHING.zooms):
            values = sense * np.nan_to_num(measure(run.at(times)), nan=-np.inf)
            best = int(np.argmax(values))
            if times[best] == run.times[-1]:
                raise NotDetermined(f"it is still changing after {WATCHING.extremes:g} s")
            found = float(values[best])
            times = np.linspace(times[max(best - 1, 0)], times[min(best + 1, len(times) - 1)], 41)
        return sense * found


def _meets(event: Event, label: str) -> bool:
    return event.kind in ("impact", "bounce") and label in event.bodies and event.time > WATCHING.beside


def _crossing(
    run: Trajectory, span: tuple[float, float], measure: Callable[[Trajectory], FloatArray]
) -> float:
    """Where the measure (T,) is first no longer positive within the span, to rounding: a grid within a grid,
    since the engine gives sixty-four moments in the time of one."""
    low, high = span
    while True:
        times = np.linspace(low, high, 65)
        if not np.all(np.diff(times) > 0):
            return high
        past = np.flatnonzero(measure(run.at(times[1:-1])) <= 0)
        first = int(past[0]) + 1 if len(past) else len(times) - 1
        low, high = float(times[first - 1]), float(times[first])


def _period(run: Trajectory, label: str) -> float | None:
    """The time between two passages through the middle of its way, in the same sense."""
    path = run.path(label)
    ranges = np.ptp(path, axis=0)
    axis = int(np.argmax(ranges))
    if ranges[axis] == 0:
        return None
    level = 0.5 * float(path[:, axis].max() + path[:, axis].min())
    high = path[:, axis] > level
    rises = np.flatnonzero(~high[:-1] & high[1:])
    if len(rises) < 2:
        return None
    first, second = (
        _crossing(
            run,
            (float(run.times[k]), float(run.times[k + 1])),
            lambda inner: level - inner.path(label)[:, axis],
        )
        for k in rises[:2]
    )
    ends = run.at(np.array([first, second]))
    places, speeds = ends.path(label), ends.velocities[:, ends.column(label), :2]
    fastest = float(run.speed(label).max())
    apart = np.hypot(*(places[1] - places[0])) <= WATCHING.same * ranges[axis]
    return second - first if apart and np.hypot(*(speeds[1] - speeds[0])) <= WATCHING.same * fastest else None
