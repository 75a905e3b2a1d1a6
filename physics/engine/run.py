"""A scene through time.

    from physics.engine.run import simulate

Steps (see `physics.engine.step`) from one frame of the output to the next; between steps the
things that happen once: a wire breaks or goes slack, a student's normal force turns out too
small or too great, a body comes to rest, a formula has no value.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, hypot, isfinite

from physics.engine.forces import FormulaStopped, clearance, place
from physics.engine.record import Record
from physics.engine.rows import turns_of
from physics.engine.step import Done, Hit, State, step
from physics.engine.world import World, quickest, world_of
from physics.scene import Scene, SceneError
from physics.trajectory import Event, Trajectory


@dataclass(frozen=True, slots=True)
class RunRule:
    """Numbers of a run."""

    longest: float = 1 / 240
    """s: the longest step. A pendulum of 1 m errs by 7e-6 of its period with it."""
    turn: float = 0.05
    """rad: the most that the fastest spring may advance in a step: its period errs by (0.05)²/24, or
    1e-4, and its energy swings by 3e-4 at most."""
    shortest: float = 1 / 20_000
    """s: however stiff a spring is. Beyond 40 kHz (stiffness a million times its load) it would be
    unstable, and is refused."""
    crowd: int = 24
    """Steps within one frame after which impacts bounce no more, so that infinitely many bounces end."""
    calm: float = 1e-7
    """(m/s)² of smoothed motion below which a body rests: 0.3 mm/s, a page unit in half a minute."""
    calm_acceleration: float = 1e-3
    """m/s²: it rests only if it is not about to fall, either (a pendulum's turning point is no rest)."""
    smoothing: float = 0.8
    """Share of the newest frame in the smoothed motion (row E2)."""
    still: float = 1e-12
    """m/s: below it on every body, with nothing that depends on time, a scene stays as it is."""
    slack: float = 1e-3
    """m: a wire that is shorter by this hangs slack, to the eye."""


RULE = RunRule()


def simulate(scene: Scene, seconds: float, rate: float = 60.0) -> Trajectory:
    """The motion of a scene, on a grid of floor(seconds · rate) + 1 times.

    seconds: >= 0; rate: frames per second, > 0. Forces and accelerations at a time are those of
    the step that begins there. Where a formula has no value, everything stands still from then on
    and an event "stopped" says why.
    Raises SceneError for times that are not such numbers, and for springs too stiff for their load.
    """
    if not (isfinite(seconds) and isfinite(rate) and seconds >= 0 and rate > 0):
        raise SceneError(
            f"cannot move for {seconds:g} s at {rate:g} frames a second; both must be positive numbers"
        )
    world = world_of(scene)
    frames = floor(seconds * rate + 1e-9) + 1
    pos, vel = _beginning(scene)
    state = State(pos, vel)
    events: list[Event] = []
    record = Record(scene, world, frames, rate)
    pace = _pace(world, 1.0 / rate)
    motion = [0.0] * len(world.labels)
    for frame in range(frames):
        start = [*state.pos], [*state.vel]
        record.keep(frame, *start)
        until = (frame + 1) / rate
        first = _frame(world, state, frame, until, pace, events, record)
        if first is None:
            record.freeze(frame)
            break
        settled = _settled(world, start, state, first)
        _note_rest(world, state, first, motion, frame / rate, events, settled)
        if settled:
            record.hold(frame)
            break
    last = (frames - 1) / rate
    return record.trajectory(tuple(event for event in events if event.time <= last + 1e-9))


def _beginning(scene: Scene) -> tuple[list[float], list[float]]:
    pos: list[float] = []
    vel: list[float] = []
    for body in scene.bodies:
        pos += [*body.position, body.angle]
        vel += body.velocity
    return [*pos, 0.0, 0.0, 0.0], [*vel, 0.0, 0.0, 0.0]


def _pace(world: World, frame: float) -> float:
    """The step, s: a whole part of a frame, short enough for the stiffest spring."""
    fastest = quickest(world)
    wanted = min(RULE.longest, RULE.turn / fastest) if fastest > 0 else RULE.longest
    if fastest * RULE.shortest > 1.0:
        raise SceneError(
            f"a spring would swing at {fastest / 6.283:.3g} Hz; make it softer or its load heavier, "
            f"below {1 / RULE.shortest / 6.283:.0f} Hz"
        )
    return frame / ceil(frame / max(wanted, RULE.shortest) - 1e-9)


def _frame(
    world: World, state: State, frame: int, until: float, pace: float, events: list[Event], record: Record
) -> Done | None:
    """Steps to the frame's end. Returns its first step, or None when a formula stopped the run."""
    first: Done | None = None
    begun = until - state.time
    pieces = 0
    while first is None or until - state.time > 1e-9 * begun:
        now = state.time
        try:
            done = step(world, state, min(pace, until - now), pace, pieces < RULE.crowd)
        except FormulaStopped as stopped:
            events.append(Event(now, "stopped", (stopped.body,), str(stopped)))
            return None
        pieces += 1
        if first is None:
            first = done
            record.keep_forces(frame, done)
        record.account(done)
        events += [_impact(world, hit, now) for hit in done.hits]
        _watch_wires(world, state, events)
        _watch_props(world, state, events)
    state.time = until
    return first


def _impact(world: World, hit: Hit, time: float) -> Event:
    one, other = world.labels[hit.i], world.labels[hit.j]
    return Event(time, "impact", (one, other), f"{one} and {other} meet at {hit.speed:.3g} m/s")


def _watch_wires(world: World, state: State, events: list[Event]) -> None:
    if not world.cords:
        return
    turns = turns_of(state.pos)
    for cord in world.cords:
        if cord.broken:
            continue
        row = cord.row
        (ax, ay), (bx, by) = (
            place(row.i, row.end_i, state.pos, turns),
            place(row.j, row.end_j, state.pos, turns),
        )
        off = hypot(bx - ax, by - ay) - row.size
        bodies = tuple(world.labels[b] for b in (row.i, row.j) if b < len(world.labels))
        if cord.tension is not None and abs(off) > cord.tolerance:
            cord.broken = True
            change = "longer" if off > 0 else "shorter"
            message = (
                f"wire {cord.label} breaks: {abs(off):.3g} m {change} than drawn, under the tension given"
            )
            events.append(Event(state.time, "break", (cord.label, *bodies), message))
        elif cord.tension is None and cord.slack != (off < -RULE.slack):
            cord.slack = not cord.slack
            message = f"wire {cord.label} {'hangs slack' if cord.slack else 'is taut again'}"
            events.append(
                Event(state.time, "slack" if cord.slack else "taut", (cord.label, *bodies), message)
            )


def _watch_props(world: World, state: State, events: list[Event]) -> None:
    for prop in world.props:
        pair = (prop.i, prop.j) if prop.i < prop.j else (prop.j, prop.i)
        if not prop.over:
            if pair in world.spare:
                world.pairs.append(world.spare.pop(pair))
            continue
        row, turns = prop.row, turns_of(state.pos)
        row.refresh(state.pos, turns, world.inverse)
        gap, rate = clearance(prop, turns), row.rate(state.vel)
        names = (world.labels[prop.i], world.labels[prop.j])
        if gap < -prop.skin and rate < 0:
            # Struck back without loss, on the centre of mass: twice what stops it.
            i, j = row.i3, row.j3
            give = world.inverse[i] + world.inverse[j]
            blow = -2 * rate / give if give else 0.0
            for at, sign in ((i, -1.0), (j, 1.0)):
                state.vel[at] += sign * blow * row.nx * world.inverse[at]
                state.vel[at + 1] += sign * blow * row.ny * world.inverse[at]
            message = (
                f"{prop.name} is too small to carry {names[0]}: it sinks into {names[1]} and is struck back"
            )
            events.append(Event(state.time, "bounce", names, message))
        elif gap > prop.skin and not prop.risen:
            prop.risen = True
            message = f"{prop.name} is greater than {names[0]} needs: it leaves {names[1]}"
            events.append(Event(state.time, "lift-off", names, message))


def _note_rest(
    world: World,
    state: State,
    done: Done,
    motion: list[float],
    time: float,
    events: list[Event],
    settled: bool,
) -> None:
    """Rest by exponentially smoothed motion (Cheema and LaViola), and by acceleration; at the latest
    when the whole scene has settled. motion: smoothed so far, (m/s)², changed."""
    for i, label in enumerate(world.labels):
        at = 3 * i
        if not world.inverse[at]:
            continue
        frame = sum(v * v for v in state.vel[at : at + 3])
        was = motion[i]
        motion[i] = (1 - RULE.smoothing) * was + RULE.smoothing * frame
        pulled = hypot(done.acceleration[at], done.acceleration[at + 1])
        if pulled > RULE.calm_acceleration:
            motion[i] = max(motion[i], RULE.calm)
        if settled:
            motion[i] = 0.0
        if motion[i] < RULE.calm <= was:
            events.append(Event(time, "rest", (label,), f"{label} rests"))


def _settled(world: World, start: tuple[list[float], list[float]], state: State, done: Done) -> bool:
    """Whether nothing will ever change: all is still, was still and in its place a frame ago, and
    nothing reads time."""
    pos, vel = start
    return (
        world.timeless
        and all(abs(v) < RULE.still for v in vel)
        and all(abs(v) < RULE.still for v in state.vel)
        and all(abs(a - b) < RULE.still for a, b in zip(pos, state.pos, strict=True))
        and all(abs(a) < 1e-6 for a in done.acceleration)
    )
