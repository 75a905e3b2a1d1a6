"""What a person would say happened, in one word for each thing that can move.

Made to agree for two pages that differ as two drawings of one diagram do: every threshold is far
above what the pen's noise does to the motion, and far below what the diagrams show. SI units.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from physics.pipeline import Motion
from physics.scene import Body, Disc
from physics.trajectory import Trajectory

Fate = Literal["stays", "rolls", "bounces", "flies off", "falls", "swings", "drifts"]


@dataclass(frozen=True, slots=True)
class OutcomeRule:
    """Where one word ends and the next begins."""

    stays: float = 0.03
    """m (3 page units): the farthest that any point of a thing may get that still stays."""
    bounce: float = 0.5
    """m/s: a slower meeting with something fixed is no bounce to the eye (it rises 0.3 units at
    restitution 0.5); dropped from a gap of the pen's making, 1 unit, a thing arrives at 0.44 m/s."""
    bounces: int = 2
    """Times, for ordinary meetings: a thing that falls, lands and lies has met once."""
    touching: float = 0.6
    """Share of the time in contact, for something that rolls or slides."""
    falls: float = 0.5
    """Share of the way that goes along gravity, for something that falls."""


RULE = OutcomeRule()


@dataclass(frozen=True, slots=True)
class Outcome:
    """fates: of each movable body, by label; broken: labels of the links that broke."""

    fates: Mapping[str, Fate]
    broken: frozenset[str]


def outcome(motion: Motion) -> Outcome:
    """The fate of every movable body, and which links broke.

    First that fits: stays (no point of it gets anywhere); flies off (it left a support whose normal
    force was too great); bounces (struck back by one too small, or by something fixed, twice);
    swings (an unbroken link holds it); rolls (in contact most of the time, whether it turns or slides);
    falls (mostly along gravity); drifts.
    """
    trajectory = motion.trajectory
    broken = frozenset(event.bodies[0] for event in trajectory.events if event.kind == "break")
    fates: dict[str, Fate] = {
        body.label: _fate(motion, body, broken) for body in motion.scene.bodies if not body.fixed
    }
    return Outcome(fates, broken)


def _fate(motion: Motion, body: Body, broken: frozenset[str]) -> Fate:
    trajectory = motion.trajectory
    if _reach(trajectory, body) <= RULE.stays:
        return "stays"
    kinds = {event.kind for event in trajectory.events if body.label in event.bodies[:1]}
    if "lift-off" in kinds:
        return "flies off"
    if "bounce" in kinds or _bounces(motion, body.label) >= RULE.bounces:
        return "bounces"
    links = (*motion.scene.springs, *motion.scene.wires)
    if any(body.label in (one.start.body, one.end.body) and one.label not in broken for one in links):
        return "swings"
    if _contact(motion, body.label) >= RULE.touching:
        return "rolls"
    gravity = np.asarray(motion.scene.gravity)
    strength = float(np.hypot(*gravity))
    path = trajectory.path(body.label)
    way = path[-1] - path[0]
    if strength > 0 and float(way @ gravity) / strength >= RULE.falls * float(np.hypot(*way)):
        return "falls"
    return "drifts"


def _reach(trajectory: Trajectory, body: Body) -> float:
    """The farthest that any point of a body gets from where it was, m."""
    poses = trajectory.poses[:, trajectory.column(body.label)]
    way = poses - poses[0]
    if isinstance(body.shape, Disc):
        # A disc that turns on the spot looks as it did.
        return float(np.hypot(way[:, 0], way[:, 1]).max())
    size = max(float(np.hypot(x, y)) for x, y in body.shape.vertices)
    return float((np.hypot(way[:, 0], way[:, 1]) + size * np.abs(way[:, 2])).max())


def _bounces(motion: Motion, label: str) -> int:
    """How often a body met something fixed fast enough to be seen to bounce."""
    return sum(
        label in event.bodies
        and any(motion.scene.body(one).fixed for one in event.bodies)
        and (event.speed or 0.0) > RULE.bounce
        for event in motion.trajectory.events
        if event.kind == "impact"
    )


def touching(motion: Motion, label: str) -> NDArray[np.bool_]:
    """In which frames something touches the body from outside, (T,)."""
    trajectory = motion.trajectory
    touched = np.zeros(len(trajectory.times), dtype=bool)
    given = {support.name for support in motion.scene.supports if support.body == label}
    for force in trajectory.forces:
        if force.body == label and (force.name.startswith("contact with") or force.name in given):
            touched |= np.hypot(force.values[:, 0], force.values[:, 1]) > 0
    return touched


def _contact(motion: Motion, label: str) -> float:
    """Share of the frames in which something touches the body from outside."""
    touched = touching(motion, label)
    return float(touched.mean()) if len(touched) else 0.0
