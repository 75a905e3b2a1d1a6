"""Whether a motion is sound: finite, nothing in anything else, no energy from nowhere, links that hold.

Worked out from the poses and velocities of a `Trajectory` and from its `Scene` alone, none of the engine's own
geometry. SI units, y up.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely

from physics.scene import Anchor, Block, Body, Disc, Scene
from physics.trajectory import Trajectory
from random_scenes import radius_of
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class Tolerance:
    """depth, stretch: m; energy: a share of what is there to begin with (see `_energy_scale`)."""

    depth: float
    stretch: float
    energy: float


EXACT = Tolerance(depth=1e-6, stretch=1e-6, energy=1e-6)
ROBUST = Tolerance(depth=0.01, stretch=0.01, energy=0.01)
"""Soft contacts sink in a little by design; a centimetre is a pen's width on the page."""

EVERY = 6
"""Every sixth frame is looked at for overlaps: ten a second."""


def faults(scene: Scene, motion: Trajectory) -> list[tuple[str, str]]:
    """(kind, words) of everything that is unsound; empty for a sound motion."""
    if not (np.isfinite(motion.poses).all() and np.isfinite(motion.velocities).all()):
        return [("not finite", f"first at {motion.times[_first_bad(motion)]:.4f} s")]
    found = [("stopped", event.message) for event in motion.events if event.kind == "stopped"]
    soft = any(mode == "robust" for mode in motion.modes.values())
    found += _overlaps(scene, motion)
    found += _loose_links(scene, motion, ROBUST if soft else EXACT)
    found += _created_energy(scene, motion, ROBUST if soft else EXACT)
    return found


def _first_bad(motion: Trajectory) -> int:
    good = np.isfinite(motion.poses).all(axis=(1, 2)) & np.isfinite(motion.velocities).all(axis=(1, 2))
    return int(np.argmin(good))


def _overlaps(scene: Scene, motion: Trajectory) -> list[tuple[str, str]]:
    pinned = {frozenset((pin.start.body, pin.end.body)) for pin in scene.pins}
    frames = np.arange(0, len(motion.times), EVERY)
    worst: tuple[float, str] | None = None
    for one, two in combinations(scene.bodies, 2):
        if (one.fixed and two.fixed) or frozenset((one.label, two.label)) in pinned:
            continue
        soft = "robust" in (motion.modes.get(one.label), motion.modes.get(two.label))
        deepest = depth(one, two, *(motion.poses[frames, motion.column(body.label)] for body in (one, two)))
        k = int(np.argmax(deepest))
        over = float(deepest[k]) - (ROBUST if soft else EXACT).depth
        if over > 0 and (worst is None or over > worst[0]):
            when = motion.times[frames[k]]
            worst = over, f"{one.label} and {two.label} by {deepest[k]:.1e} m at {when:.2f} s"
    return [] if worst is None else [("overlap", worst[1])]


def depth(one: Body, two: Body, first: FloatArray, second: FloatArray) -> FloatArray:
    """How deep two bodies at these poses (F, 3) are in one another, (F,) m; negative: apart, by about so much."""
    centres = np.hypot(*(first[:, :2] - second[:, :2]).T)
    deep = radius_of(one.shape) + radius_of(two.shape) - centres
    near = np.flatnonzero(deep > 0)
    if (isinstance(one.shape, Disc) and isinstance(two.shape, Disc)) or not len(near):
        return deep
    if isinstance(one.shape, Disc):
        return depth(two, one, second, first)
    block = corners(one.shape, first[near])
    if isinstance(two.shape, Disc):
        deep[near] = two.shape.radius - _outside(block, second[near, :2])
    else:
        deep[near] = _separating(block, corners(two.shape, second[near]))
    return deep


def corners(block: Block, poses: FloatArray) -> FloatArray:
    """(F, n, 2) m."""
    local = np.array(block.vertices)
    c, s = np.cos(poses[:, 2, None]), np.sin(poses[:, 2, None])
    x = poses[:, 0, None] + c * local[:, 0] - s * local[:, 1]
    y = poses[:, 1, None] + s * local[:, 0] + c * local[:, 1]
    return np.stack((x, y), axis=2)


def _outside(block: FloatArray, points: FloatArray) -> FloatArray:
    """Distance of points from blocks, (F,) m, negative within."""
    polygons, marks = shapely.polygons(block), shapely.points(points)
    edge = shapely.distance(shapely.boundary(polygons), marks)
    return np.where(shapely.contains(polygons, marks), -edge, edge)


def _separating(first: FloatArray, second: FloatArray) -> FloatArray:
    """The least overlap along any edge's normal, (F,) m: for convex blocks how deep they are in one another."""
    least = np.full(len(first), np.inf)
    for own, other in ((first, second), (second, first)):
        edges = np.roll(own, -1, axis=1) - own
        normals = (
            np.stack((edges[:, :, 1], -edges[:, :, 0]), axis=2) / np.linalg.norm(edges, axis=2)[:, :, None]
        )
        offsets = np.einsum("fed,fed->fe", normals, own)
        lowest = np.einsum("fed,fvd->fev", normals, other).min(axis=2)
        least = np.minimum(least, (offsets - lowest).min(axis=1))
    return least


def _end(motion: Trajectory, anchor: Anchor) -> FloatArray:
    if anchor.body is None:
        return np.broadcast_to(np.array(anchor.point), (len(motion.times), 2))
    x, y, angle = motion.poses[:, motion.column(anchor.body)].T
    (u, v), c, s = anchor.point, np.cos(angle), np.sin(angle)
    return np.column_stack((x + c * u - s * v, y + s * u + c * v))


def _length(motion: Trajectory, start: Anchor, end: Anchor) -> FloatArray:
    return np.linalg.norm(_end(motion, end) - _end(motion, start), axis=1)


def _loose_links(scene: Scene, motion: Trajectory, tolerance: Tolerance) -> list[tuple[str, str]]:
    """Wires that are longer than they are and pins that have come apart, until they break."""
    found: list[tuple[str, str]] = []
    for wire in scene.wires:
        broken = [
            event.time for event in motion.events if event.kind == "break" and wire.label in event.message
        ]
        whole = motion.times <= min(broken, default=np.inf)
        over = float((_length(motion, wire.start, wire.end)[whole] - wire.rest).max())
        if over > tolerance.stretch:
            found.append(("stretched", f"{wire.label} by {over:.1e} m"))
    for pin in scene.pins:
        apart = float(_length(motion, pin.start, pin.end).max())
        if apart > tolerance.stretch:
            found.append(("pin apart", f"{pin.label} by {apart:.1e} m"))
    return found


def _created_energy(scene: Scene, motion: Trajectory, tolerance: Tolerance) -> list[tuple[str, str]]:
    """Whether kinetic, potential and elastic energy together were ever more than at the start."""
    moving = [body for body in scene.bodies if not body.fixed]
    columns = [motion.column(body.label) for body in moving]
    masses = np.array([(body.mass, body.mass, body.inertia) for body in moving])
    kinetic = 0.5 * (masses * motion.velocities[:, columns] ** 2).sum(axis=(1, 2))
    height = (masses[:, :1] * np.array(scene.gravity) * motion.poses[:, columns, :2]).sum(axis=(1, 2))
    elastic = np.zeros(len(motion.times))
    for spring in scene.springs:
        stretch = _length(motion, spring.start, spring.end) - spring.rest
        elastic += 0.5 * spring.stiffness * stretch**2
    energy = kinetic - height + elastic
    scale = kinetic[0] + elastic[0] + masses[:, 0].sum() * 9.81
    gained = float((energy - energy[0]).max() / scale)
    return [("energy", f"{gained:.1e} of what was there")] if gained > tolerance.energy else []
