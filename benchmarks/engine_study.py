"""What is measured of an engine on a case: its error, its drift, its CPU time."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from engine_cases import Case
from peers.roster import Engine
from peers.world import RATE, Run, Setting, movable, place
from physics.scene import Scene
from sketch.ink import FloatArray

ENOUGH = 0.02
"""Seconds of CPU that a short run is repeated for, each time its turn comes."""

AT_MOST = 40
"""Runs in one turn."""


@dataclass(frozen=True, slots=True)
class Point:
    """One engine at one setting. error: as the case measures it; cpu: ms a simulated second, the median."""

    setting: Setting
    error: float
    cpu: float


@dataclass(frozen=True, slots=True)
class Closeness:
    """One engine at its usual setting. error: as the case measures it; tension: share of the true one; worst,
    lasting: how far energy ever was, and how far its mean over the last quarter of the run is, from where it
    began, shares of what swings (some engines' energy sways with every swing and is not lost); jitter: m/s and
    rad/s at the end.
    None: not measured on this case."""

    error: float
    cpu: float
    tension: float | None
    worst: float | None
    lasting: float | None
    jitter: float | None


def turns(
    engines: Sequence[Engine],
    settings: Callable[[Engine], Sequence[Setting]],
    scene: Scene,
    seconds: float,
    repeats: int,
) -> dict[tuple[str, Setting], float]:
    """CPU ms a simulated second of every engine at its settings, medians; the engines take turns, one setting at
    a time, so that whatever else the machine does hits all of them alike."""
    spent: dict[tuple[str, Setting], list[float]] = defaultdict(list)
    longest = max(len(settings(engine)) for engine in engines)
    for _ in range(repeats):
        for k in range(longest):
            for engine in engines:
                own = settings(engine)
                if k < len(own):
                    spent[engine.name, own[k]] += _turn(engine, own[k], scene, seconds)
    return {key: 1000 * median(times) / seconds for key, times in spent.items()}


def _turn(engine: Engine, setting: Setting, scene: Scene, seconds: float) -> list[float]:
    times: list[float] = []
    while sum(times) < ENOUGH and len(times) < AT_MOST:
        times.append(engine.run(scene, seconds, setting, False).cpu)
    return times


def error_and_cost(case: Case, engines: Sequence[Engine], repeats: int) -> dict[str, list[Point]]:
    """Every engine at every setting."""
    cpu = turns(engines, lambda engine: engine.settings, case.scene, case.seconds, repeats)
    points: dict[str, list[Point]] = {}
    for engine in engines:
        points[engine.name] = [
            Point(setting, error(case, engine, setting), cpu[engine.name, setting])
            for setting in engine.settings
        ]
    return points


def closeness(
    case: Case, engines: Sequence[Engine], repeats: int, drift_seconds: float
) -> dict[str, Closeness]:
    """Every engine at its usual setting."""
    cpu = turns(engines, lambda engine: [engine.usual], case.scene, case.seconds, repeats)
    rows: dict[str, Closeness] = {}
    for engine in engines:
        run = engine.run(case.scene, case.seconds, engine.usual, True)
        worst, lasting = None, None
        if case.swing is not None:
            long = engine.run(case.scene, drift_seconds, engine.usual, True)
            worst, lasting = drift(case.scene, long, case.swing)
        rows[engine.name] = Closeness(
            _error(case, run),
            cpu[engine.name, engine.usual],
            tension_error(case, run) if case.tension else None,
            worst,
            lasting,
            float(np.abs(run.speeds[-1]).max())
            if case.measure == "displacement" and run.speeds is not None
            else None,
        )
    return rows


def error(case: Case, engine: Engine, setting: Setting) -> float:
    """An engine's error at a setting, as the case measures it."""
    return _error(case, engine.run(case.scene, case.seconds, setting, case.measure == "tension"))


def _error(case: Case, run: Run) -> float:
    if case.measure == "tension":
        return tension_error(case, run)
    away = run.places[-1, :, :2] - case.places(case.seconds)
    return float(np.linalg.norm(away, axis=1).max())


def tension_error(case: Case, run: Run) -> float:
    """The worst over wires and the frames of the run's second half, as a share of the true tension: game engines
    may take the first half to settle."""
    assert run.tensions is not None and case.tension is not None
    frames = np.arange(len(run.places))[len(run.places) // 2 :]
    true = np.array([case.tension(k / RATE) for k in frames])
    return max(float(np.abs(pull[frames] / true - 1).max()) for pull in run.tensions.values())


def drift(scene: Scene, run: Run, swing: float) -> tuple[float, float]:
    """(worst, lasting) of `Closeness`."""
    energy = mechanical(scene, run)
    quarter = max(len(energy) // 4, 1)
    lasting = energy[-quarter:].mean() - energy[0]
    return float(np.abs(energy - energy[0]).max() / swing), float(abs(lasting) / swing)


def mechanical(scene: Scene, run: Run) -> FloatArray:
    """Kinetic, potential and elastic energy at every frame, (F,) J, from what was read off."""
    assert run.speeds is not None
    bodies = movable(scene)
    masses = np.array([(body.mass, body.mass, body.inertia) for body in bodies])
    weights = np.array([body.mass for body in bodies])[:, None] * np.array(scene.gravity)
    energy = 0.5 * (masses * run.speeds**2).sum(axis=(1, 2)) - (weights * run.places[:, :, :2]).sum(
        axis=(1, 2)
    )
    labels = [body.label for body in bodies]
    for spring in scene.springs:
        ends: list[FloatArray] = []
        for anchor in (spring.start, spring.end):
            if anchor.body is None or anchor.body not in labels:
                ends.append(np.array(place(scene, anchor)))
                continue
            x, y, angle = run.places[:, labels.index(anchor.body)].T
            (u, v), c, s = anchor.point, np.cos(angle), np.sin(angle)
            ends.append(np.column_stack((x + c * u - s * v, y + s * u + c * v)))
        stretch = np.linalg.norm(ends[1] - ends[0], axis=1) - spring.rest
        energy += 0.5 * spring.stiffness * stretch**2
    return energy
