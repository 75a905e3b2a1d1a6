"""A simulated scene at any time: what its clusters found, put together under the bodies' own labels."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from physics.engine.acts import Act, energies, link_ends
from physics.engine.meetings import states_of
from physics.scene import Scene
from physics.trajectory import Energy, ForceSeries, Observed
from sketch.ink import FloatArray

if TYPE_CHECKING:
    from physics.engine.exact.run import ExactRun
    from physics.engine.robust.run import RobustRun
    from physics.engine.simulation import Strand


@dataclass(frozen=True, slots=True, eq=False)
class SceneSource:
    """strands: all clusters that there were; stopped: when a formula had no value, s: all stands still from then
    on."""

    scene: Scene
    strands: tuple[Strand, ...]
    stopped: float

    def states(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `physics.trajectory.Source`."""
        bodies = self.scene.bodies
        column = {body.label: k for k, body in enumerate(bodies)}
        poses, velocities = np.empty((len(times), len(bodies), 3)), np.zeros((len(times), len(bodies), 3))
        poses[:] = np.array([(*body.position, body.angle) for body in bodies], float).reshape(-1, 3)
        held = times if self.stopped == inf else np.minimum(times, self.stopped)
        for strand in self.strands:
            names = strand.run.names
            columns = [column[label] for label in names.bodies[: names.movable]]
            begin, end = self._frames(strand, held)
            if begin < end:
                pos, vel = states_of(strand, held[begin:end])
                poses[begin:end, columns] = pos[:, : names.movable]
                velocities[begin:end, columns] = vel[:, : names.movable]
        if self.stopped < inf:
            velocities[times > self.stopped] = 0.0
        return poses, velocities

    def observe(self, times: FloatArray) -> Observed:
        """See `physics.trajectory.Source`."""
        held = np.minimum(times, self.stopped)
        column = {body.label: k for k, body in enumerate(self.scene.bodies)}
        accelerations = np.zeros((len(times), len(column), 3))
        forces: dict[tuple[str, str], ForceSeries] = {}
        ledger = np.zeros((len(times), 3))
        heat, corrected = np.zeros((2, len(times)))
        works: dict[tuple[str, str], FloatArray] = {}
        links = (*self.scene.springs, *self.scene.wires, *self.scene.pins)
        anchors = {link.label: np.full((len(times), 2, 2), np.nan) for link in links}
        for strand in self.strands:
            for run, here in self._runs(strand, held):
                if not here.any():
                    continue
                names, when = run.names, held[here]
                pos, vel = run.states(when)
                acts, acc = run.observe(when)
                columns = np.array([column[label] for label in names.bodies[: names.movable]])
                accelerations[np.ix_(here, columns)] = np.nan_to_num(
                    acc[:, : names.movable], nan=0.0, posinf=0.0, neginf=0.0
                )
                for act in acts:
                    _add(forces, act, names.bodies[act.body], here)
                ledger[here] += np.column_stack(energies(run.world, names, pos, vel))
                ends = link_ends(run.world, pos)
                for k, label in enumerate(names.links):
                    anchors[label][here] = ends[:, k]
            self._add_works(strand, held, heat, corrected, works)
        for strand in self.strands:
            for event in (event for run in strand.runs for event in run.events if event.kind == "break"):
                anchors[event.bodies[0]][times >= event.time] = np.nan
        if self.stopped < inf:
            ledger[times > self.stopped, 0] = 0.0
        series = tuple(self._shown(force, times) for force in forces.values())
        worked = np.sum(list(works.values()), axis=0) if works else np.zeros(len(times))
        energy = Energy(ledger[:, 0], ledger[:, 1], ledger[:, 2], heat, corrected, worked, works)
        return Observed(accelerations, series, energy, anchors)

    def _frames(self, strand: Strand, times: FloatArray) -> tuple[int, int]:
        """The first of the frames that a cluster tells of, and the first after them."""
        begun = strand.runs[0].start
        begin = int(times.searchsorted(begun)) if begun > 0.0 else 0
        return begin, len(times) if strand.end == inf else int(times.searchsorted(strand.end))

    def _within(self, strand: Strand, times: FloatArray) -> np.ndarray:
        begun = strand.runs[0].start
        return ((times >= begun) | (begun == 0.0)) & (times < strand.end)

    def _runs(self, strand: Strand, times: FloatArray) -> list[tuple[ExactRun | RobustRun, np.ndarray]]:
        """The runs of a cluster, each with the frames that it tells of."""
        ends = [run.start for run in strand.runs[1:]] + [strand.end]
        within = self._within(strand, times)
        return [
            (run, within & ((times >= run.start) | (k == 0)) & (times < end))
            for k, (run, end) in enumerate(zip(strand.runs, ends, strict=True))
        ]

    def _add_works(
        self,
        strand: Strand,
        times: FloatArray,
        heat: FloatArray,
        corrected: FloatArray,
        works: dict[tuple[str, str], FloatArray],
    ) -> None:
        """What a cluster's ledger adds, also after its end. A later run's ledger goes on from the one before."""
        for k, run in enumerate(strand.runs):
            end = strand.runs[k + 1].start if k + 1 < len(strand.runs) else strand.end
            last = k + 1 == len(strand.runs)
            here = times >= run.start if last else (times >= run.start) & (times < end)
            if not here.any():
                continue
            entries = run.ledger(np.minimum(times[here], end))
            heat[here] += entries[:, 0]
            corrected[here] += run.corrected(np.minimum(times[here], end))
            names, world = run.names, run.world
            keys = [(name, int(push["body"])) for name, push in zip(names.pushes, world.pushes, strict=True)]
            keys += [
                (f"T of {name}", int(link["reader"]))
                for name, link in zip(names.links, world.links, strict=True)
            ]
            keys += [(name, int(s["i"])) for name, s in zip(names.supports, world.supports, strict=True)]
            keys += [(name, int(c["body"])) for name, c in zip(names.courses, world.courses, strict=True)]
            for column, (name, body) in enumerate(keys, start=1):
                if entries[:, column].any():
                    whole = works.setdefault((name, names.bodies[body]), np.zeros(len(times)))
                    whole[here] += entries[:, column]

    def _shown(self, force: ForceSeries, times: FloatArray) -> ForceSeries:
        """Where a force is absent it is shown at the centre of mass."""
        absent = np.isnan(force.points[:, 0])
        if absent.any():
            k = next(k for k, body in enumerate(self.scene.bodies) if body.label == force.body)
            force.points[absent] = self.states(times)[0][absent, k, :2]
        return force


def _add(forces: dict[tuple[str, str], ForceSeries], act: Act, label: str, here: np.ndarray) -> None:
    key = (act.name, label)
    known = forces.get(key)
    if known is None:
        values, points = np.zeros((len(here), 2)), np.full((len(here), 2), np.nan)
        known = forces[key] = ForceSeries(act.name, label, values, points, act.unique)
    # In the very frame at which a formula has no value it is left out.
    known.values[here] += np.nan_to_num(act.values, nan=0.0, posinf=0.0, neginf=0.0)
    known.points[here] = act.points
    if not act.unique and known.unique:
        forces[key] = ForceSeries(act.name, label, known.values, known.points, False)
