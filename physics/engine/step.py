"""One step of the motion.

Moreau's midpoint rule (Moreau 1999, "Numerical aspects of the sweeping process"), which
without contacts is the position Verlet method: half a step of position, a whole one of
velocity under the forces found there, half a step of position. Symplectic, of second order,
and exact for constant acceleration, along a flat incline too. Rows (contacts, wires) take the
impulses that keep their mean rate over the step from closing a closed gap.

A gap that would close within a step ends the step at that moment, and the next one begins
with the impact: Newton's restitution, all rows at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, sqrt

from physics.engine.contact import meet
from physics.engine.forces import Act, acting
from physics.engine.rows import WIRE, Row, Turns, turns_of
from physics.engine.solve import SolveRule, solve
from physics.engine.world import World


@dataclass(frozen=True, slots=True)
class StepRule:
    """Numbers of one step."""

    slop: float = 1e-8
    """m: a gap below this is closed. Far above rounding; an impact a hundredth of a micrometre early
    turns the line of centres by less than 1e-7."""
    drift: float = 1e-6
    """m/s: a contact that closes more slowly than this never bounces."""
    noise: float = 1e-11
    """m/s: a wire's rate below this is none: what the solver leaves over."""
    seep: float = 1e-7
    """m/s: the same of a contact, which has no long swings to keep exact: half a nanometre a step."""
    rounding: float = 1e-12
    """Share of the kinetic energy by which rounding may raise it in an impact."""
    exact: float = 1e-13
    """m: a wire's length is kept to this."""
    closing: int = 8
    """Sweeps over the rows to close drifts: each squares what a wire is off, and halves a pile's."""
    deep: float = 3e-4
    """m: overlap beyond this was drawn, not drifted into, and is let out gently."""
    ease: float = 0.2
    """Share of a deep overlap let out in one step: gone in some 20 steps, a tenth of a second."""
    rest_steps: float = 2.0
    """A contact that closes more slowly than gravity could make it in this many steps does not
    bounce: the bounce would be over within them."""
    least: float = 0.02
    """Share of a step: the shortest piece that a step is cut into. At 5 m/s and 1/240 s the overlap
    that this lets in is 0.4 mm, and only where two impacts come that close."""


RULE = StepRule()
SOLVE = SolveRule()


@dataclass(frozen=True, slots=True)
class Hit:
    """An impact: bodies i and j, how fast they closed, m/s."""

    i: int
    j: int
    speed: float


@dataclass(slots=True)
class State:
    """Where everything is: all that the next step depends on."""

    pos: list[float]
    vel: list[float]
    time: float = 0.0
    rows: dict[tuple[int, int], Row] = field(default_factory=dict[tuple[int, int], Row])
    """The last step's contact rows by name, for their impulses."""
    last: float = 0.0
    """Length of the last step, s: impulses grow with it."""


@dataclass(slots=True)
class Done:
    """What one step did. length: s; acts and rows: the forces, for the record; heat, work: J."""

    length: float
    acts: list[Act]
    rows: list[Row]
    hits: list[Hit]
    acceleration: list[float]
    heat: float
    work: float


def step(world: World, state: State, h: float, usual: float, patient: bool = True) -> Done:
    """Moves `state` on by at most h seconds, to the next impact if one comes first.

    usual: the step that h is a piece of, s; patient: cut at impacts and let things bounce. Raises
    FormulaStopped, with `state` as it was, when a formula has no value.
    """
    turns = turns_of(state.pos)
    rows = _rows(world, state, turns, h)
    hits, heat = _strike(world, state, rows, usual, patient)
    pos, vel, inverse = state.pos, state.vel, world.inverse
    closed = [row for row in rows if row.gap <= RULE.slop]
    # What is about to close too slowly to bounce is let close, and needs no moment of its own.
    near = [
        (row, row.gap)
        for row in rows
        if RULE.slop < row.gap <= h * _slow(world, row, usual) and row.rate(vel) >= -_slow(world, row, usual)
    ]
    landing = {row.name for row, _ in near}
    open_rows = [(row, row.gap) for row in rows if row.gap > RULE.slop and row.name not in landing]
    while True:
        middle = [p + 0.5 * h * v for p, v in zip(pos, vel, strict=True)]
        half = turns_of(middle)
        acts, rubbing = acting(world, middle, half, vel, state.time + 0.5 * h)
        free = _free(world, acts, middle, vel, h)
        for row in rows:
            row.refresh(middle, half, inverse)
        for row in rubbing:
            row.refresh(middle, half, inverse)
            row.pn *= h
            row.pt = 0.0
        before = [row.rate(vel) for row, _ in open_rows]
        ready = [*closed, *(row for row, _ in near), *rubbing]
        for row in closed:
            row.bias, row.low = row.rate(vel), 0.0
        for row, gap in near:
            row.bias, row.low, row.pn, row.pt = gap / h, 0.0, 0.0, 0.0
        warm = h / state.last if state.last else 0.0
        new = free[:]
        for row in closed:
            row.pn *= warm
            row.pt *= warm
            if row.pn or row.pt:
                row.push(new, inverse, row.pn, row.pt)
        if ready:
            solve(ready, new, inverse, SOLVE)
        state.last = h
        cut = _first_meeting(open_rows, before, new, h) if patient else h
        if cut >= h * (1 - RULE.least) or h <= RULE.least * usual:
            break
        h = max(cut, RULE.least * usual)
    for row in rows:
        row.held = row.pn > 0.0
    heat += _rubbed(ready, vel, new)
    after = [m + 0.5 * h * v for m, v in zip(middle, new, strict=True)]
    work = _worked(acts, pos, after, middle)
    acceleration = [(n - v) / h for n, v in zip(new, vel, strict=True)]
    if closed:
        level = _potential(world, after)
        _close_up(closed, after, inverse)
        if any(row.kind != WIRE for row in closed):
            # What a contact lifts had fallen too far: that much less was turned into heat.
            heat -= _potential(world, after) - level
    state.pos, state.vel = after, new
    state.time += h
    state.rows = {row.name: row for row in rows}
    return Done(h, acts, ready, hits, acceleration, heat, work)


def _rows(world: World, state: State, turns: Turns, h: float) -> list[Row]:
    """Rows of everything that touches or may touch within the step, refreshed, with the impulses
    that they carried in the last one."""
    pos, vel = state.pos, state.vel
    rows: list[Row] = []
    gravity = hypot(*world.gravity)
    for pair in world.pairs:
        i3, j3 = 3 * pair.i, 3 * pair.j
        speed = hypot(vel[j3] - vel[i3], vel[j3 + 1] - vel[i3 + 1])
        speed += abs(vel[i3 + 2]) * pair.solid_i.reach + abs(vel[j3 + 2]) * pair.solid_j.reach
        rows += meet(pair, pos, turns, 2.0 * h * (speed + gravity * h) + RULE.deep)
    for row in rows:
        known = state.rows.get(row.name)
        if known is not None:
            row.pn, row.pt, row.held = known.pn, known.pt, known.held
    rows += [cord.row for cord in world.cords if cord.tension is None and not cord.broken]
    for row in rows:
        row.refresh(pos, turns, world.inverse)
    return rows


def _strike(
    world: World, state: State, rows: list[Row], usual: float, patient: bool
) -> tuple[list[Hit], float]:
    """Impacts at this very moment: changes the velocities, tells who was hit and the heat (J).

    Rows that carried a force in the last step and drift slowly are not hit: their small rates, of third
    order in the step, are taken away on both sides.
    """
    vel, inverse = state.vel, world.inverse
    closed: list[Row] = []
    hits: list[Hit] = []
    needed = False
    for row in rows:
        if row.gap > RULE.slop:
            continue
        rate = row.rate(vel)
        slow = _slow(world, row, usual)
        row.bias, row.low = 0.0, 0.0
        if row.held and abs(rate) <= slow:
            row.low = -1e300
            needed = needed or abs(rate) > (RULE.noise if row.kind == WIRE else RULE.seep)
        elif rate < -(RULE.noise if row.kind == WIRE else RULE.seep):
            needed = True
            if rate < -slow:
                if row.kind != WIRE:
                    hits.append(Hit(row.i, row.j, -rate))
                row.bias = row.e * rate if patient else 0.0
        closed.append(row)
    if not needed:
        return hits, 0.0
    before = _kinetic(world, vel)
    carried = [(row.pn, row.pt) for row in closed]
    approach = vel[:]
    _struck(closed, vel, inverse)
    if _kinetic(world, vel) > before * (1 + RULE.rounding) and any(row.bias for row in closed):
        # Newton's restitution and friction together can create energy (Kane and Levinson 1985); the
        # dead impact never does. As much restitution as the energy allows:
        lively = vel[:]
        vel[:] = approach
        for row in closed:
            row.bias = 0.0
        _struck(closed, vel, inverse)
        share = _share(world, vel, lively, before)
        vel[:] = [dead + share * (live - dead) for dead, live in zip(vel, lively, strict=True)]
    for row, (pn, pt) in zip(closed, carried, strict=True):
        row.pn, row.pt = pn, pt
    return hits, before - _kinetic(world, vel)


def _struck(closed: list[Row], vel: list[float], inverse: list[float]) -> None:
    for row in closed:
        row.pn = row.pt = 0.0
    solve(closed, vel, inverse, SOLVE)


def _share(world: World, dead: list[float], lively: list[float], most: float) -> float:
    """How far from the dead towards the lively velocities the kinetic energy stays below `most`, 0 to 1."""
    start, end = _kinetic(world, dead), _kinetic(world, lively)
    middle = _kinetic(world, [0.5 * (a + b) for a, b in zip(dead, lively, strict=True)])
    # Along the way it is a parabola: start + slope s + bend s².
    bend = 2 * (start + end) - 4 * middle
    slope = end - start - bend
    room = max(most - start, 0.0)
    root = slope * slope + 4 * bend * room
    below = slope + sqrt(max(root, 0.0))
    return min(1.0, 2 * room / below) if below > 0 else 0.0


def _slow(world: World, row: Row, usual: float) -> float:
    """The speed, m/s, below which a row that closes does not bounce."""
    gx, gy = world.gravity
    return RULE.rest_steps * usual * abs(gx * row.nx + gy * row.ny) + RULE.drift


def _first_meeting(rows: list[tuple[Row, float]], before: list[float], new: list[float], h: float) -> float:
    """When the first open gap closes, s after the step's beginning; h if none does.

    A gap's rate is taken to change evenly within the step, as it does under constant forces.
    """
    first = h
    for (row, gap), rate in zip(rows, before, strict=True):
        last = row.rate(new)
        if gap + 0.5 * h * (rate + last) >= 0.0:
            continue
        bend = 0.5 * (last - rate) / h
        root = rate * rate - 4 * bend * gap
        # gap + rate t + bend t² = 0, the smaller root in the form that does not cancel
        below = -rate + sqrt(root) if root > 0 else 0.0
        time = 2 * gap / below if below > 0 else h
        first = min(first, time) if time > 0 else first
    return first


def _free(world: World, acts: list[Act], middle: list[float], vel: list[float], h: float) -> list[float]:
    """Velocities after the step if there were no rows."""
    free = vel[:]
    inverse = world.inverse
    for act in acts:
        at = 3 * act.i
        free[at] += h * inverse[at] * act.x
        free[at + 1] += h * inverse[at] * act.y
        lever = (act.px - middle[at]) * act.y - (act.py - middle[at + 1]) * act.x
        if lever:
            free[at + 2] += h * inverse[at + 2] * lever
    return free


def _rubbed(rows: list[Row], vel: list[float], new: list[float]) -> float:
    """Heat of friction, and of soft landings, in the step, J."""
    heat = 0.0
    for row in rows:
        if row.pn and not row.given:
            heat -= 0.5 * row.pn * (row.rate(vel) + row.rate(new))
        if row.pt:
            heat -= 0.5 * row.pt * (row.slip(vel) + row.slip(new))
    return heat


def _worked(acts: list[Act], pos: list[float], after: list[float], middle: list[float]) -> float:
    """Work of the student's forces in the step, J."""
    work = 0.0
    for act in acts:
        if act.student:
            at = 3 * act.i
            lever = (act.px - middle[at]) * act.y - (act.py - middle[at + 1]) * act.x
            work += act.x * (after[at] - pos[at]) + act.y * (after[at + 1] - pos[at + 1])
            work += lever * (after[at + 2] - pos[at + 2])
    return work


def _close_up(rows: list[Row], pos: list[float], inverse: list[float]) -> None:
    """Moves bodies, each by its share of mass, so that what touches neither overlaps nor drifts apart.

    Rows under force are closed from both sides (their drift is of third order in the step), others
    only opened.
    """
    for _ in range(RULE.closing):
        turns = turns_of(pos)
        worst = 0.0
        for row in rows:
            row.refresh(pos, turns, inverse)
            gap = row.gap
            if gap < -RULE.deep:
                # Once only in a step: it is let out slowly.
                gap = RULE.ease * gap if not worst else 0.0
            elif gap > 0.0 and not row.held:
                continue
            if abs(gap) <= (RULE.exact if row.kind == WIRE else 0.1 * RULE.slop):
                continue
            worst = max(worst, abs(gap) if row.gap >= -RULE.deep else 0.0)
            row.push(pos, inverse, -gap * row.kn, 0.0)
        if not worst:
            return


def _potential(world: World, pos: list[float]) -> float:
    gx, gy = world.gravity
    return -sum(
        mass * (gx * pos[3 * i] + gy * pos[3 * i + 1])
        for i, mass in enumerate(world.mass)
        if world.inverse[3 * i]
    )


def _kinetic(world: World, vel: list[float]) -> float:
    return 0.5 * sum(
        mass * (vel[3 * i] ** 2 + vel[3 * i + 1] ** 2) + inertia * vel[3 * i + 2] ** 2
        for i, (mass, inertia) in enumerate(zip(world.mass, world.inertia, strict=True))
        if world.inverse[3 * i]
    )
