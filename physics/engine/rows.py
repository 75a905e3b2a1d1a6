"""One-sided constraints: contacts and taut wires, as rows of one Jacobian.

A row says gap >= 0 between two bodies i and j. Its impulse p >= 0 acts on j along the unit
vector n, on i along −n. For a contact n points from i to j; for a wire the gap is what is left
of its length, and n points from j's end to i's. A row keeps its geometry in the bodies' own
frames, so that `refresh` can state it anew at any pose, the middle of a step included.

Bodies are numbered; body b has its pose (x, y, angle) at b3 = 3b in flat lists of floats.
"""

from __future__ import annotations

from math import cos, hypot, sin
from typing import Final

FACE: Final = 0
"""A face of body i against a point (with a radius) of body j."""
POINT: Final = 1
"""A point of body i against a point of body j: discs, a disc at a corner."""
WIRE: Final = 2
"""The two ends of a wire."""

Turns = list[tuple[float, float]]
"""(cos, sin) of every body's angle."""


class Row:
    """Mutable on purpose: rows live through many steps and carry their impulses along."""

    __slots__ = (
        "at",
        "bias",
        "ca",
        "cb",
        "e",
        "end_i",
        "end_j",
        "gap",
        "given",
        "held",
        "i",
        "i3",
        "j",
        "j3",
        "kind",
        "kn",
        "kt",
        "low",
        "mu",
        "name",
        "normal",
        "nx",
        "ny",
        "pn",
        "pt",
        "px",
        "py",
        "radius_i",
        "size",
        "ta",
        "tb",
    )

    def __init__(
        self,
        kind: int,
        name: tuple[int, int],
        bodies: tuple[int, int],
        end_i: tuple[float, float],
        end_j: tuple[float, float],
        size: float,
        normal: tuple[float, float] = (0.0, 1.0),
        radius_i: float = 0.0,
        e: float = 0.0,
        mu: float = 0.0,
    ) -> None:
        """size: radii to be taken off a contact's distance, or a wire's length; radius_i: i's share.
        normal: a face's, in i's frame. e: restitution; mu: friction. name: which row this is, from
        step to step."""
        self.kind, self.name = kind, name
        self.i, self.j = bodies
        self.i3, self.j3 = 3 * bodies[0], 3 * bodies[1]
        self.end_i, self.end_j = end_i, end_j
        self.size, self.normal, self.radius_i = size, normal, radius_i
        self.e, self.mu = e, mu
        self.held = self.given = False
        self.pn = self.pt = self.bias = self.low = 0.0

    def refresh(self, pos: list[float], turns: Turns, inverse: list[float]) -> None:
        """States the row at a pose: gap, normal, levers and effective masses."""
        i3, j3 = self.i3, self.j3
        ci, si = turns[self.i]
        cj, sj = turns[self.j]
        ax, ay = self.end_i
        bx, by = self.end_j
        rax, ray = ci * ax - si * ay, si * ax + ci * ay
        rbx, rby = cj * bx - sj * by, sj * bx + cj * by
        dx = pos[j3] + rbx - pos[i3] - rax
        dy = pos[j3 + 1] + rby - pos[i3 + 1] - ray
        if self.kind == FACE:
            lx, ly = self.normal
            nx, ny = ci * lx - si * ly, si * lx + ci * ly
            distance = nx * dx + ny * dy
            self.gap = distance - self.size
            rbx -= nx * self.size
            rby -= ny * self.size
            self.px, self.py = pos[j3] + rbx, pos[j3 + 1] + rby
            rax, ray = self.px - pos[i3], self.py - pos[i3 + 1]
        else:
            distance = hypot(dx, dy)
            if distance > 0.0:
                nx, ny = dx / distance, dy / distance
            else:
                nx, ny = 0.0, 1.0
            if self.kind == POINT:
                self.gap = distance - self.size
                rax += nx * self.radius_i
                ray += ny * self.radius_i
                self.px, self.py = pos[i3] + rax, pos[i3 + 1] + ray
                rbx, rby = self.px - pos[j3], self.py - pos[j3 + 1]
            else:
                self.gap = self.size - distance
                nx, ny = -nx, -ny
                self.px, self.py = pos[j3] + rbx, pos[j3 + 1] + rby
        self.nx, self.ny = nx, ny
        self.ca = ca = rax * ny - ray * nx
        self.cb = cb = rbx * ny - rby * nx
        mass = inverse[i3] + inverse[j3]
        ii, ij = inverse[i3 + 2], inverse[j3 + 2]
        k = mass + ii * ca * ca + ij * cb * cb
        self.kn = 1.0 / k if k > 0.0 else 0.0
        if self.mu > 0.0:
            self.ta = ta = rax * nx + ray * ny
            self.tb = tb = rbx * nx + rby * ny
            k = mass + ii * ta * ta + ij * tb * tb
            self.kt = 1.0 / k if k > 0.0 else 0.0

    def rate(self, vel: list[float]) -> float:
        """How fast the gap opens, m/s."""
        i, j = self.i3, self.j3
        return (
            self.nx * (vel[j] - vel[i])
            + self.ny * (vel[j + 1] - vel[i + 1])
            + self.cb * vel[j + 2]
            - self.ca * vel[i + 2]
        )

    def slip(self, vel: list[float]) -> float:
        """How fast j slides over i along the tangent (−n_y, n_x), m/s. Rows with friction only."""
        i, j = self.i3, self.j3
        return (
            self.nx * (vel[j + 1] - vel[i + 1])
            - self.ny * (vel[j] - vel[i])
            + self.tb * vel[j + 2]
            - self.ta * vel[i + 2]
        )

    def push(self, vel: list[float], inverse: list[float], pn: float, pt: float) -> None:
        """Applies an impulse (N s) along the normal and the tangent."""
        i, j = self.i3, self.j3
        x, y = self.nx * pn - self.ny * pt, self.ny * pn + self.nx * pt
        turn_i, turn_j = self.ca * pn, self.cb * pn
        if pt:
            turn_i += self.ta * pt
            turn_j += self.tb * pt
        vel[i] -= inverse[i] * x
        vel[i + 1] -= inverse[i + 1] * y
        vel[i + 2] -= inverse[i + 2] * turn_i
        vel[j] += inverse[j] * x
        vel[j + 1] += inverse[j + 1] * y
        vel[j + 2] += inverse[j + 2] * turn_j


def turns_of(pos: list[float]) -> Turns:
    """(cos, sin) of every body's angle."""
    return [(cos(angle), sin(angle)) if angle else (1.0, 0.0) for angle in pos[2::3]]
