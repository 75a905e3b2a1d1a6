"""Does the claimed drawing move as the true one does?

Lengths are fractions of the diagram's size (the diagonal of the box around its true components),
so that 0.01 is hardly seen and 1 is the whole drawing away.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from evaluation.metrics.geometry import diagram_size
from evaluation.metrics.matching import match_components
from physics.build import to_metres
from physics.formula.meaning import PER_METRE
from physics.outcome import Outcome
from physics.pipeline import Motion
from sketch.geometry import centroid
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Circle, Polygon

TIMES: tuple[float, ...] = tuple(k / 8 for k in range(17))
"""Seconds after the start at which the divergence of motions is told, up to `AT`."""
AT = 2.0
"""Seconds after the start at which positions are compared."""
WORST = 1.0
"""The error of a body is capped at the diagram's whole size; a body that is movable on one side and
has no counterpart on the other has this error."""


@dataclass(frozen=True, slots=True)
class MotionError:
    """error: mean over bodies of the distance between true and claimed position at `at` seconds;
    0 when nothing is movable on either side. bodies: how many were compared or missed; missed: how
    many of them have no counterpart."""

    error: float
    bodies: int
    missed: int


def motion_error(truth: Motion, claim: Motion, at: float = AT) -> MotionError:
    """Compares the trajectories of all solids that are movable in the truth or in the claim, paired
    by the strokes that they share. A fixed solid stays where it is drawn."""
    return _error(truth, claim, (at,))[0]


def divergence(truth: Motion, claim: Motion, times: Sequence[float] = TIMES) -> tuple[float, ...]:
    """The motion error at each of these times."""
    return tuple(error.error for error in _error(truth, claim, times))


def _error(truth: Motion, claim: Motion, times: Sequence[float]) -> list[MotionError]:
    movable, claimed_movable = _movable(truth.rectified), _movable(claim.rectified)
    pairs = {
        a: b
        for a, b in match_components(truth.rectified, claim.rectified).items()
        if (a in movable or b in claimed_movable)
        and _is_solid(truth.rectified, a)
        and _is_solid(claim.rectified, b)
    }
    size = diagram_size(truth.rectified) / PER_METRE
    missed = len(movable - pairs.keys()) + len(claimed_movable - set(pairs.values()))
    bodies = len(pairs) + missed

    def at(time: float) -> MotionError:
        apart = (
            float(np.linalg.norm(_place(claim, b, time) - _place(truth, a, time))) for a, b in pairs.items()
        )
        total = sum(min(WORST, distance / size) for distance in apart) + WORST * missed
        return MotionError(total / bodies if bodies else 0.0, bodies, missed)

    return [at(time) for time in times]


def same_outcome(pairs: Mapping[str, str], truth: Outcome, claim: Outcome) -> bool:
    """Whether every movable body has the same fate and the same links broke; `pairs` says which true
    label is which claimed one (`match_components`)."""

    def renamed(labels: Collection[str]) -> list[str | None]:
        return [pairs.get(label) for label in labels]

    fates = dict(zip(renamed(truth.fates), truth.fates.values(), strict=True))
    return fates == dict(claim.fates) and set(renamed(truth.broken)) == set(claim.broken)


def until(motion: Motion, seconds: float) -> Motion:
    """The motion up to and including `seconds`; the whole of it if it is not longer."""
    cut = motion.trajectory.until(seconds)
    return motion if cut is motion.trajectory else replace(motion, trajectory=cut)


def _movable(sketch: Sketch) -> set[str]:
    return {part.label for part in sketch.components if _is_solid(sketch, part.label) and not part.fixed}


def _is_solid(sketch: Sketch, label: str) -> bool:
    return isinstance(sketch.component(label).shape, Circle | Polygon)


def _place(motion: Motion, label: str, seconds: float) -> FloatArray:
    """Where a solid's centre is at that time, (2,) metres, y up."""
    trajectory, component = motion.trajectory, motion.rectified.component(label)
    if label in trajectory.bodies and not component.fixed:
        path = trajectory.path(label)
        return np.array([np.interp(seconds, trajectory.times, path[:, axis]) for axis in (0, 1)])
    match component.shape:
        case Circle(centre, _):
            return np.array(to_metres(centre))
        case Polygon(vertices=vertices):
            x, y = centroid(vertices).tolist()
            return np.array(to_metres((x, y)))
        case _:
            raise TypeError(f"{label} is no solid, it has no centre")
