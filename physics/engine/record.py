"""What is kept of a run, frame by frame, and made into a `Trajectory` at its end."""

from __future__ import annotations

import numpy as np

from physics.engine.forces import elongation, place
from physics.engine.rows import WIRE, Row, turns_of
from physics.engine.step import Done
from physics.engine.world import World
from physics.scene import Scene
from physics.trajectory import Energy, Event, ForceSeries, Trajectory
from sketch.ink import FloatArray


class Record:
    """Mutable: grows with the run."""

    def __init__(self, scene: Scene, world: World, frames: int, rate: float) -> None:
        bodies = len(world.labels)
        self.world = world
        self.times = np.arange(frames) / rate
        self.poses = np.zeros((frames, bodies + 1, 3))
        self.velocities = np.zeros((frames, bodies + 1, 3))
        self.accelerations = np.zeros((frames, bodies + 1, 3))
        self.ledger = np.zeros((frames, 5))
        self.forces: dict[tuple[str, int], tuple[FloatArray, FloatArray]] = {}
        self.anchors = {
            link.label: np.full((frames, 2, 2), np.nan) for link in (*scene.springs, *scene.wires)
        }
        self.carried: dict[tuple[str, int], float] = {}
        self.heat = self.work = 0.0

    def account(self, done: Done) -> None:
        """Adds what a step made into heat and what the student's forces did."""
        self.heat += done.heat
        self.work += done.work

    def keep(self, frame: int, pos: list[float], vel: list[float]) -> None:
        """Frame number `frame`: poses and velocities (three per body), and where links end."""
        self.poses[frame] = np.reshape(pos, (-1, 3))
        self.velocities[frame] = np.reshape(vel, (-1, 3))
        self._keep_anchors(frame, pos)
        self.ledger[frame] = (*self._energy(pos, vel), self.heat, self.work)

    def keep_forces(self, frame: int, done: Done) -> None:
        """The forces of the step that begins with the frame, and what they do."""
        self.accelerations[frame] = np.reshape(done.acceleration, (-1, 3))
        for act in done.acts:
            self._add(frame, act.name, act.i, (act.x, act.y), (act.px, act.py), 1.0)
        # Several rows of one pair are one force, at the centre of pressure.
        for row in done.rows:
            if not row.pn and not row.pt:
                continue
            normal = 0.0 if row.given else row.pn / done.length
            along = row.pt / done.length
            x, y = row.nx * normal - row.ny * along, row.ny * normal + row.nx * along
            for body, other, sign in ((row.i, row.j, -1.0), (row.j, row.i, 1.0)):
                at = (row.px, row.py)
                if row.kind == WIRE and body == row.i:
                    at = self._start_of(row.name[1], frame)
                self._add(frame, self._row_name(row, other), body, (sign * x, sign * y), at, row.pn)

    def freeze(self, frame: int) -> None:
        """From this frame on, the last one kept, all stands still: the run was stopped."""
        self.velocities[frame] = 0.0
        self.ledger[frame, 0] = 0.0
        self._repeat(frame)

    def hold(self, frame: int) -> None:
        """From this frame on, the last one kept, all stays as it is: the scene has settled."""
        for values, points in self.forces.values():
            values[frame + 1 :] = values[frame]
            points[frame + 1 :] = points[frame]
        self._repeat(frame)

    def _repeat(self, frame: int) -> None:
        for array in (self.poses, self.velocities, self.accelerations, self.ledger, *self.anchors.values()):
            array[frame + 1 :] = array[frame]

    def trajectory(self, events: tuple[Event, ...]) -> Trajectory:
        """All that was kept."""
        labels = self.world.labels
        kinetic, potential, elastic, dissipated, worked = self.ledger.T.copy()
        forces = tuple(
            ForceSeries(name, labels[body], values, self._filled(points, body))
            for (name, body), (values, points) in self.forces.items()
        )
        return Trajectory(
            self.times,
            labels,
            self.poses[:, :-1].copy(),
            self.velocities[:, :-1].copy(),
            self.accelerations[:, :-1].copy(),
            forces,
            events,
            Energy(kinetic, potential, elastic, dissipated, worked),
            self.anchors,
        )

    def _filled(self, points: FloatArray, body: int) -> FloatArray:
        """Where a force is absent it is shown at the centre of mass."""
        absent = np.isnan(points[:, 0])
        points[absent] = self.poses[absent, body, :2]
        return points

    def _row_name(self, row: Row, other: int) -> str:
        if row.kind == WIRE:
            return f"T of {self.world.cords[row.name[1]].label}"
        return f"{'friction of' if row.given else 'contact with'} {self.world.labels[other]}"

    def _start_of(self, cord: int, frame: int) -> tuple[float, float]:
        x, y = self.anchors[self.world.cords[cord].label][frame, 0]
        return float(x), float(y)

    def _add(
        self,
        frame: int,
        name: str,
        body: int,
        force: tuple[float, float],
        at: tuple[float, float],
        weight: float,
    ) -> None:
        if body >= len(self.world.labels):
            return
        key = (name, body)
        if key not in self.forces:
            shape = (len(self.times), 2)
            self.forces[key] = (np.zeros(shape), np.full(shape, np.nan))
        values, points = self.forces[key]
        values[frame] += force
        if np.isnan(points[frame, 0]):
            points[frame] = at
            self.carried[key] = weight
        else:
            total = self.carried[key] + weight
            share = weight / total if total > 0 else 0.5
            points[frame] += share * (np.asarray(at) - points[frame])
            self.carried[key] = total

    def _keep_anchors(self, frame: int, pos: list[float]) -> None:
        turns = turns_of(pos)
        world = self.world
        for spring in world.springs:
            self.anchors[spring.label][frame] = (
                place(spring.i, spring.end_i, pos, turns),
                place(spring.j, spring.end_j, pos, turns),
            )
        for cord in world.cords:
            if not cord.broken:
                row = cord.row
                self.anchors[cord.label][frame] = (
                    place(row.i, row.end_i, pos, turns),
                    place(row.j, row.end_j, pos, turns),
                )

    def _energy(self, pos: list[float], vel: list[float]) -> tuple[float, float, float]:
        """(kinetic, potential, elastic), J."""
        world = self.world
        gx, gy = world.gravity
        kinetic = potential = 0.0
        for i, (mass, inertia) in enumerate(zip(world.mass, world.inertia, strict=True)):
            if world.inverse[3 * i]:
                vx, vy, spin = vel[3 * i : 3 * i + 3]
                kinetic += 0.5 * (mass * (vx * vx + vy * vy) + inertia * spin * spin)
                potential -= mass * (gx * pos[3 * i] + gy * pos[3 * i + 1])
        turns = turns_of(pos)
        elastic = sum(0.5 * s.stiffness * elongation(s, pos, turns) ** 2 for s in world.springs)
        return kinetic, potential, elastic
