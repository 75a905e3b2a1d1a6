"""The engines' benchmark in print."""

from __future__ import annotations

from collections.abc import Sequence

from engine_cases import Case
from engine_study import Closeness, Point
from engine_targets import TARGETS, verdict
from peers.roster import INKLINED, Engine

WIDTH = 12
"""Of a column of figures."""

ROUNDING = 1e-12
"""Errors below this are all alike: what is left is the rounding of the last digits."""


def print_closeness(
    rows: dict[str, dict[str, Closeness]], cases: Sequence[Case], names: Sequence[str]
) -> None:
    """Every engine at its usual setting, one table for each thing that is measured."""
    position = [case for case in cases if case.measure == "position"]
    target = {case.name: TARGETS.position for case in position if case.single}
    _table(
        "Position error at 2 s, m",
        {c.name: {n: rows[c.name][n].error for n in names} for c in position},
        target,
    )
    pulled = {c.name: {n: rows[c.name][n].tension for n in names} for c in cases if c.tension}
    _table("Tension error from 1 s to 2 s, share", pulled, dict.fromkeys(pulled, TARGETS.tension))
    swinging = [case.name for case in cases if case.swing is not None]
    energy = {name: TARGETS.chain_energy if name == "chain" else TARGETS.energy for name in swinging}
    worst = {name: {n: rows[name][n].worst for n in names} for name in swinging}
    _table("Energy, how far it ever was from where it began, share of what swings", worst, energy)
    lasting = {name: {n: rows[name][n].lasting for n in names} for name in swinging}
    _table(
        "Energy, how far its mean over the last quarter is from where it began, the same share",
        lasting,
        energy,
    )
    piles = [case.name for case in cases if case.measure == "displacement"]
    moved = {name: {n: rows[name][n].error for n in names} for name in piles}
    _table("Displacement of a pile after 5 s, m", moved, dict.fromkeys(piles, TARGETS.displacement))
    shaking = {name: {n: rows[name][n].jitter for n in names} for name in piles}
    _table("Jitter of a pile after 5 s, m/s or rad/s", shaking, dict.fromkeys(piles, TARGETS.jitter))
    cpu: dict[str, dict[str, float | None]] = {c.name: {n: rows[c.name][n].cpu for n in names} for c in cases}
    _table("CPU time, ms a simulated second, each at its usual setting", cpu, {})
    if INKLINED in names and len(names) > 1:
        shares = {
            name: {n: _over(row[n], row[INKLINED]) for n in names if n != INKLINED}
            for name, row in cpu.items()
        }
        _table("The same, times inklined's", shares, {})


def _over(peer: float | None, own: float | None) -> float | None:
    return None if peer is None or own is None else peer / own


def _table(
    title: str,
    rows: dict[str, dict[str, float | None]] | dict[str, dict[str, float]],
    targets: dict[str, float],
) -> None:
    if not rows:
        return
    columns = list(next(iter(rows.values())))
    target = "   inklined's target" if targets and INKLINED in columns else ""
    print(f"\n{title}\n{'':12}" + "".join(f"{name:>{WIDTH}}" for name in columns) + target)
    for name, row in rows.items():
        figures = "".join(f"{_figure(row[column]):>{WIDTH}}" for column in columns)
        own = row.get(INKLINED)
        judged = "   " + verdict(own, targets[name]) if own is not None and name in targets else ""
        print(f"{name:12}{figures}{judged}")


def _figure(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.3g}" if 1e-2 <= abs(value) < 1e4 or value == 0 else f"{value:.1e}"


def print_error_and_cost(case: Case, points: dict[str, list[Point]], engines: Sequence[Engine]) -> int:
    """Error against cost of every engine; how many of the peers' points inklined misses."""
    print(f"\n{case.name}: {case.measure} error against CPU time, ms a simulated second")
    own = points.get(INKLINED, [])
    missed = 0
    for engine in engines:
        for point in points[engine.name]:
            line = f"  {engine.name:10} {engine.words(point.setting):16} {point.error:9.1e} {point.cpu:9.3f}"
            if engine.name != INKLINED and own:
                ratio = share_of(point, own)
                fits = ratio is not None and ratio <= TARGETS.cpu
                missed += not fits
                words = "inklined never so close" if ratio is None else f"inklined {ratio:6.2f} of it"
                line += f"   {words}" + (("" if fits else "  MISSED") if case.single else "")
            print(line)
    return missed if case.single else 0


def share_of(peer: Point, own: Sequence[Point]) -> float | None:
    """inklined's least CPU time at the peer's accuracy or better, as a share of the peer's; None where it
    never gets so close."""
    good_enough = [point.cpu for point in own if point.error <= max(peer.error, ROUNDING)]
    return min(good_enough) / peer.cpu if good_enough else None
