"""The true value of what a page asks, from the engine, with a bound of the engine's own error.

SI units. **The bound.** A step of the engine errs by no more than its accuracy, and its error follows the
accuracy: the same scene simulated a thousand times less accurately differs from it by about a thousand
times its own error. The whole difference of the two runs is therefore a bound with a wide margin, to which
rounding is added. It does not hold in robust mode, whose steps are of fixed length: there it is unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np

from physics.engine.simulation import ACCURACY
from physics.observables import observe
from physics.scene import Scene
from physics.trajectory import Trajectory
from physics.verify.asked import Asked
from physics.verify.watch import WATCHING, NotDetermined, Watch
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class BoundRule:
    """How the engine's error is bounded."""

    coarser: float = 1e3
    """How many times less accurate the second run is."""
    rounding: float = 1e-12
    """Relative; some thousand roundings of double precision."""


BOUND = BoundRule()


@dataclass(frozen=True, slots=True)
class About:
    """What is asked, of which body or wire; on: what a normal force or friction comes from; time: the page's
    own `t`, s."""

    asked: Asked
    label: str
    on: str | None = None
    time: float | None = None


@dataclass(frozen=True, slots=True)
class Truth:
    """value: SI; bound: how far off the engine may be, SI, None where that is not known."""

    value: float
    bound: float | None


def truth(scene: Scene, about: About) -> Truth:
    """The value with its bound. Raises NotDetermined, with the reason, where the scene settles none."""
    fine = Watch(scene, ACCURACY)
    value = _value(fine, about)
    coarse = _value(Watch(scene, ACCURACY * BOUND.coarser), about)
    robust = "robust" in fine.until(0.0).modes.values()
    return Truth(value, None if robust else abs(value - coarse) + BOUND.rounding * max(abs(value), 1e-300))


def true_value(scene: Scene, about: About) -> float:
    """The value alone. Raises NotDetermined as `truth`."""
    return _value(Watch(scene, ACCURACY), about)


def state_at(scene: Scene, about: About) -> Trajectory:
    """The motion at the moment that is asked about: the one at which an answer that speaks of the motion
    is worked out. Raises NotDetermined where there is no such moment."""
    watch = Watch(scene, ACCURACY)
    if about.asked.moment in ("max", "min") or about.asked.kind == "period":
        return watch.at(0.0)
    return watch.at(_time(watch, about))


def _value(watch: Watch, about: About) -> float:
    asked = about.asked
    if asked.kind == "period":
        return watch.period(about.label)
    if asked.moment in ("max", "min"):
        return watch.extreme(lambda run: _measured(watch.scene, run, about), asked.moment == "max")
    time = _time(watch, about)
    if asked.kind == "time":
        return time
    value = float(_measured(watch.scene, watch.at(time), about)[0])
    if not isfinite(value):
        raise NotDetermined("it has no value at that moment")
    return value


def _time(watch: Watch, about: About) -> float:
    match about.asked.moment:
        case "0":
            return 0.0
        case "":
            return about.time or 0.0
        case "t":
            if about.time is None:
                raise NotDetermined("the page gives no time; write it alone, such as t = 2")
            return about.time
        case "f" | "a" as side:
            beside = WATCHING.beside if side == "a" else -WATCHING.beside
            met = watch.meeting(about.label)
            return met if about.asked.kind == "time" else met + beside
        case "s":
            return watch.stop(about.label)
        case "max" | "min":
            raise AssertionError("an extreme has no moment of its own")


def _measured(scene: Scene, run: Trajectory, about: About) -> FloatArray:
    """The quantity through the run's times, (T,); NaN where it has no value."""
    label = about.label

    def seen(quantity: str) -> FloatArray:
        return observe(scene, run, label, quantity).values

    def size(values: FloatArray) -> FloatArray:
        return np.hypot(values[:, 0], values[:, 1])

    match about.asked.kind:
        case "speed":
            return seen("speed")
        case "v_x" | "v_y" as name:
            return seen("velocity")[:, "xy".index(name[-1])]
        case "acceleration":
            return size(seen("acceleration"))
        case "a_x" | "a_y" as name:
            return seen("acceleration")[:, "xy".index(name[-1])]
        case "x":
            return seen("x-displacement")
        case "y":
            return seen("y-displacement")
        case "momentum":
            return size(seen("momentum"))
        case "p_x" | "p_y" as name:
            return seen("momentum")[:, "xy".index(name[-1])]
        case "kinetic energy" | "potential energy" as name:
            return seen(name)
        case "angular velocity":
            return seen("angular velocity")
        case "heat":
            return run.energy.dissipated
        case "normal":
            return _force(run, f"contact with {about.on}", label)
        case "friction":
            return _force(run, f"friction of {about.on}", label)
        case "tension":
            pulled = next((one.body for one in run.forces if one.name == f"T of {label}"), None)
            return np.zeros(len(run.times)) if pulled is None else _force(run, f"T of {label}", pulled)
        case "time" | "period":
            raise AssertionError("a time is not read from the motion at a time")


def _force(run: Trajectory, name: str, label: str) -> FloatArray:
    """A force's size, (T,); zero where it never acts."""
    found = [one for one in run.forces if (one.name, one.body) == (name, label)]
    if any(not one.unique for one in found):
        raise NotDetermined("the laws of motion leave it open: more holds this body than is needed")
    return sum((np.hypot(one.values[:, 0], one.values[:, 1]) for one in found), np.zeros(len(run.times)))
