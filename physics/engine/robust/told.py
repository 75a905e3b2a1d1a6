"""Events of robust mode in words, and who a program belongs to."""

from __future__ import annotations

from typing import Any

from physics.engine.robust.watch import BOUNCE, BREAK, IMPACT, LIFT, RELEASED, REST, SLACK, STRETCHED, TAUT
from physics.engine.world import WIRE, Names, World
from physics.trajectory import Event


def told(
    world: World, names: Names, time: float, kind: float, number: int, size: float
) -> tuple[Event, tuple[str, int] | None]:
    """(the event that a kernel noted, ("link", its number) if a given tension or wire ends with it)."""
    row: Any
    if kind == IMPACT:
        row = world.pairs[number]
        one, other = names.bodies[row["i"]], names.bodies[row["j"]]
        message = f"{one} and {other} meet at {size:.3g} m/s"
        return Event(time, "impact", (one, other), message, size), None
    if kind in (BREAK, SLACK, TAUT, STRETCHED):
        label, bodies = names.links[number], _ends(world, names, number)
        if kind == BREAK:
            message = f"wire {label} breaks at {size:.3g} N"
            return Event(time, "break", bodies, message), ("link", number)
        if kind == STRETCHED:
            change = "longer" if size > 0 else "shorter"
            message = f"wire {label} breaks: {abs(size):.3g} m {change} than drawn, under the tension given"
            return Event(time, "break", bodies, message), ("link", number)
        if kind == SLACK:
            return Event(time, "slack", bodies, f"wire {label} hangs slack"), None
        return Event(time, "taut", bodies, f"wire {label} is taut again"), None
    if kind in (BOUNCE, LIFT):
        row = world.supports[number]
        pair = (names.bodies[row["i"]], names.bodies[row["j"]])
        name = names.supports[number]
        if kind == BOUNCE:
            message = f"{name} is too small to carry {pair[0]}: it sinks into {pair[1]} and is struck back"
            return Event(time, "bounce", pair, message), None
        message = f"{name} is greater than {pair[0]} needs: it leaves {pair[1]}"
        return Event(time, "lift-off", pair, message), None
    if kind == RELEASED:
        label = names.bodies[world.courses[number]["body"]]
        message = f"{label} collides and leaves the course that {names.courses[number]} gave it"
        return Event(time, "released", (label,), message), None
    assert kind == REST, kind
    return Event(time, "rest", (names.bodies[number],), f"{names.bodies[number]} rests"), None


def whose(world: World, names: Names, program: int) -> tuple[str, str]:
    """(name, body) of what a program gives."""
    row: Any
    for name, row in zip(names.pushes, world.pushes, strict=True):
        if program in (row["x"], row["y"]):
            return name, names.bodies[row["body"]]
    for name, row in zip(names.supports, world.supports, strict=True):
        if program == row["force"]:
            return name, names.bodies[row["i"]]
    for name, row in zip(names.courses, world.courses, strict=True):
        if program in (row["position"], row["velocity"], row["acceleration"]):
            return name, names.bodies[row["body"]]
    for name, row in zip(names.links, world.links, strict=True):
        if row["kind"] == WIRE and row["tension"] == program:
            return f"T of {name}", names.bodies[row["reader"]]
    raise ValueError(f"program {program} belongs to nothing")


def _ends(world: World, names: Names, number: int) -> tuple[str, ...]:
    link: Any = world.links[number]
    page = len(names.bodies)
    return (names.links[number], *(names.bodies[b] for b in (link["i"], link["j"]) if b < page))
