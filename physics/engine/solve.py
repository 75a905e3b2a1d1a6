"""Impulses of all rows together, by projected Gauss-Seidel.

Each row in turn takes the impulse that makes its own rate right, clamped to what it may be
(a contact only pushes, friction stays within Coulomb's cone |p_t| <= μ p_n), until no row
wants more. In two dimensions the cone is an interval, so the friction law is exact, not a
pyramid. Started from the last step's impulses, which are the answer wherever the motion is
steady. (Moreau 1988; Jourdan, Alart and Jean 1998 for the convergence.)

Sweeps carry a force only one row further each time, so a tall stack needs hundreds. Where they
are slow, the rows that they found under force are solved as one linear system, and the sweeps
check the answer (the subspace step of Silcowitz, Niebuhr and Erleben 2010).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from physics.engine.rows import Row


@dataclass(frozen=True, slots=True)
class SolveRule:
    """When the sweeps may stop."""

    tolerance: float = 1e-13
    """m/s: no row's rate changed by more in a whole sweep. A few units in the last place of 1 m/s
    and up to some 100 rows; a slower walk to the answer is cut off by `sweeps`."""
    sweeps: int = 4
    """In a row, before the linear system is tried: one or two bodies are done by then."""
    rounds: int = 6
    """Of sweeps and linear system: each finds more of the rows that carry force; two are the rule.
    What is left over after the last is taken up by the next step, which starts from here."""


STICK = 1 - 1e-9
"""Share of Coulomb's limit below which a row sticks; rounding alone must not make it."""
SINGULAR = 1e-10
"""Share of the largest singular value below which one counts as zero."""


def solve(rows: list[Row], vel: list[float], inverse: list[float], rule: SolveRule) -> None:
    """Changes `vel` so that every row has rate >= −bias (rate = −bias where low < 0: two-sided),
    adding to the impulses that the rows carry. Those must have been applied to `vel` already."""
    for _ in range(rule.rounds):
        if _sweep(rows, vel, inverse, rule):
            return
        _leap(rows, vel, inverse)
    _sweep(rows, vel, inverse, rule)


def _sweep(rows: list[Row], vel: list[float], inverse: list[float], rule: SolveRule) -> bool:
    """Projected Gauss-Seidel, forth and back; whether nothing changes any more."""
    tolerance = rule.tolerance
    forward = rows
    backward = rows[::-1]
    for sweep in range(rule.sweeps):
        change = 0.0
        for row in backward if sweep & 1 else forward:
            i, j = row.i3, row.j3
            nx, ny = row.nx, row.ny
            if row.mu > 0.0:
                slip = (
                    nx * (vel[j + 1] - vel[i + 1])
                    - ny * (vel[j] - vel[i])
                    + row.tb * vel[j + 2]
                    - row.ta * vel[i + 2]
                )
                most = row.mu * row.pn if row.pn > 0.0 else 0.0
                wanted = row.pt - slip * row.kt
                wanted = most if wanted > most else -most if wanted < -most else wanted
                step = wanted - row.pt
                if step:
                    row.pt = wanted
                    row.push(vel, inverse, 0.0, step)
                    change = max(change, abs(step) / (row.kt or 1.0))
            if row.given:
                continue
            rate = (
                nx * (vel[j] - vel[i])
                + ny * (vel[j + 1] - vel[i + 1])
                + row.cb * vel[j + 2]
                - row.ca * vel[i + 2]
                + row.bias
            )
            wanted = row.pn - rate * row.kn
            if wanted < row.low:
                wanted = row.low
            step = wanted - row.pn
            if step:
                row.pn = wanted
                x, y = nx * step, ny * step
                vel[i] -= inverse[i] * x
                vel[i + 1] -= inverse[i + 1] * y
                vel[i + 2] -= inverse[i + 2] * row.ca * step
                vel[j] += inverse[j] * x
                vel[j + 1] += inverse[j + 1] * y
                vel[j + 2] += inverse[j + 2] * row.cb * step
                change = max(change, abs(step) / (row.kn or 1.0))
        if change <= tolerance:
            return True
    return False


def _leap(rows: list[Row], vel: list[float], inverse: list[float]) -> None:
    """Solves the rows under force as one linear system, sticking where they stick; friction that
    slides stays what it is until the next sweep, which keeps the system symmetric and definite. The
    answer is taken only as far as every contact still pushes."""
    size = len(vel)
    equations: list[tuple[Row, bool]] = []
    for row in rows:
        if not row.given and (row.pn > 0.0 or row.low < 0.0):
            equations.append((row, False))
        # It sticks if the impulse that would stop its slip is within the cone.
        if row.mu > 0.0 and abs(row.pt - row.slip(vel) * row.kt) < STICK * row.mu * row.pn:
            equations.append((row, True))
    if not equations:
        return
    # Rows of the Jacobian: of the gap, or of the slip along it …
    jacobian = np.zeros((len(equations), size))
    wanted = np.zeros(len(equations))
    for k, (row, along) in enumerate(equations):
        i, j = row.i3, row.j3
        if along:
            jacobian[k, i : i + 3] = (row.ny, -row.nx, -row.ta)
            jacobian[k, j : j + 3] = (-row.ny, row.nx, row.tb)
        else:
            jacobian[k, i : i + 3] = (-row.nx, -row.ny, -row.ca)
            jacobian[k, j : j + 3] = (row.nx, row.ny, row.cb)
            wanted[k] = -row.bias
    # … what each unknown impulse does to the bodies, and the change of all of them that gives every
    # row its rate. Rows that say the same twice, or contradict each other, make the system singular:
    # least squares of least norm shares the load among them.
    effect = jacobian * np.asarray(inverse)
    missing = wanted - jacobian @ np.asarray(vel)
    change = np.linalg.lstsq(jacobian @ effect.T, missing, rcond=SINGULAR)[0]
    share = 1.0
    for (row, along), step in zip(equations, change.tolist(), strict=True):
        if not along and row.low == 0.0 and row.pn + step < 0.0:
            share = min(share, row.pn / -step)
    change *= share
    for (row, along), step in zip(equations, change.tolist(), strict=True):
        if along:
            row.pt += step
        else:
            row.pn += step
    vel[:] = (np.asarray(vel) + change @ effect).tolist()
