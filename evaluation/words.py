"""What happened on a page, in words."""

from __future__ import annotations

from collections import Counter

import numpy as np

from physics.outcome import Outcome, touching
from physics.pipeline import Motion
from sketch.ink import FloatArray

STEADY = 0.02
"""Speed is called steady in its growth when it leaves a straight line by at most this share of its range."""

STEADY_FATES = ("rolls", "falls")
"""Fates of which a straight line of speed is worth telling: a shallow bounce hardly bends it, and is none."""
CARRIED = 0.2
"""Seconds of contact before a fall that are worth telling."""


def happened(motion: Motion, outcome: Outcome) -> list[str]:
    """Sentences: each movable body's fate with its way and speed, then what broke, then what the
    simulation had to remark."""
    trajectory = motion.trajectory
    if not outcome.fates:
        return ["Nothing on the page can move.", *motion.notices]
    span = float(trajectory.times[-1])
    told: list[str] = []
    for label, fate in outcome.fates.items():
        kind = motion.rectified.component(label).kind
        path, speed = trajectory.path(label), trajectory.speed(label)
        way = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
        told.append(
            f"{label}, a {kind}, {_rolling_first(motion, label) if fate == 'falls' else ''}{fate}: {way:.2f} m of way in {span:.2f} s, "
            f"{float(speed[-1]):.2f} m/s at the end."
            f"{_steadily(trajectory.times, speed) if fate in STEADY_FATES else ''}"
        )
    told += _impacts(motion)
    told += _turning_points(motion)
    return [*told, *motion.notices]


def _rolling_first(motion: Motion, label: str) -> str:
    """How long a body that ends up falling was carried first: off the end of an incline, say."""
    touched, times = touching(motion, label), motion.trajectory.times
    left = int(np.argmin(touched)) if not touched.all() else len(touched)
    if touched[left:].any() or left == len(touched) or times[left] < CARRIED:
        return ""
    return f"rolls until {times[left]:.2f} s, then "


def _steadily(times: FloatArray, speed: FloatArray) -> str:
    """A remark when speed against time is a rising straight line, with its slope."""
    span = float(np.ptp(speed))
    if span < 0.05 or len(times) < 3:
        return ""
    slope, start = np.polyfit(times, speed, 1)
    off = float(np.abs(speed - (start + slope * times)).max())
    return (
        f" Its speed grows steadily by {slope:.2f} m/s each second."
        if slope > 0 and off < STEADY * span
        else ""
    )


def _turning_points(motion: Motion) -> list[str]:
    """What broke, and the first time that each body was struck back or lifted off by a given force."""
    seen: set[tuple[str, tuple[str, ...]]] = set()
    told: list[str] = []
    for event in motion.trajectory.events:
        key = (event.kind, event.bodies)
        if event.kind == "break" or (event.kind in ("bounce", "lift-off") and key not in seen):
            told.append(f"At {event.time:.2f} s {event.message.rstrip('.')}.")
        seen.add(key)
    return told


def _impacts(motion: Motion) -> list[str]:
    """How often which bodies met."""
    met = Counter(event.bodies for event in motion.trajectory.events if event.kind in ("impact", "bounce"))
    return [f"{' and '.join(bodies)} met {_times(n)}." for bodies, n in met.items()]


def _times(n: int) -> str:
    return {1: "once", 2: "twice"}.get(n, f"{n} times")
