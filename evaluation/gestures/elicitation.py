"""An elicitation study in tables: what participants proposed for each referent, and how far they agree (AGATe).

A file is CSV: a head with the referents' names, then a row a participant, each cell the proposal (any word; empty: none made,
which agrees with nobody). Intervals of agreement rates are by the jackknife over participants, as the rate is a U-statistic
(Arvesen 1969): participants drawn with replacement would agree with themselves.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Hashable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy import stats

from evaluation.examination import probability, spread
from evaluation.gestures.agreement import agreement_differs, agreement_rate
from evaluation.statistics.intervals import LEVEL, Interval
from evaluation.table import Cell, Table


@dataclass(frozen=True, slots=True)
class Referent:
    """One referent: the agreement rate with its interval, how many proposals are distinct, and the one made most."""

    name: str
    agreement: Interval
    distinct: int
    favourite: str
    favoured: int


@dataclass(frozen=True, slots=True)
class Elicitation:
    """referents: in the file's order; statistic, p: whether their agreement differs, None where there is but one."""

    referents: tuple[Referent, ...]
    statistic: float | None
    p: float | None


def elicitation(text: str) -> Elicitation:
    """The study in a CSV text. Raises ValueError, which says what is wrong and in which line."""
    lines = list(csv.reader(io.StringIO(text)))
    if not lines or not any(name.strip() for name in lines[0]):
        raise ValueError("line 1 must name the referents")
    names = [name.strip() for name in lines[0]]
    people = [
        (number, line) for number, line in enumerate(lines[1:], start=2) if any(cell.strip() for cell in line)
    ]
    for number, line in people:
        if len(line) != len(names):
            raise ValueError(f"line {number} has {len(line)} proposals; there are {len(names)} referents")
    if len(people) < 2:
        raise ValueError(f"{len(people)} participants cannot agree; two at least are needed")
    columns = [[_proposal(line[k], number) for number, line in people] for k in range(len(names))]
    told = tuple(_referent(name, column) for name, column in zip(names, columns, strict=True))
    statistic, p = agreement_differs(*columns) if len(names) > 1 else (None, None)
    return Elicitation(told, statistic, p)


def rate_interval(proposals: Sequence[Hashable], level: float = LEVEL) -> Interval:
    """The agreement rate of at least two proposals with its jackknife interval, within 0 and 1; no interval below four."""
    n = len(proposals)
    value = agreement_rate(proposals)
    if value is None:
        raise ValueError("two proposals at least are needed")
    if n < 4:
        return Interval(value, None, None, n, n, level)
    left = [agreement_rate([*proposals[:k], *proposals[k + 1 :]]) or 0.0 for k in range(n)]
    error = float(np.sqrt((n - 1) / n * ((np.array(left) - np.mean(left)) ** 2).sum()))
    reach = error * float(stats.t.ppf((1 + level) / 2, n - 1))
    return Interval(value, max(0.0, value - reach), min(1.0, value + reach), n, n, level)


def elicitation_table(of: Elicitation) -> Table:
    """A row a referent."""
    n = of.referents[0].agreement.n
    differ = (
        ""
        if of.p is None
        else f" Agreement differs between referents: V_rd = {of.statistic:.2f}, p = {probability(of.p)}."
    )
    return Table(
        f"Agreement rates in % (95 % jackknife intervals), {n} participants.{differ}",
        ("", "agreement", "distinct", "made most", "by"),
        tuple(
            (
                one.name,
                Cell(spread(one.agreement)),
                Cell(str(one.distinct)),
                Cell(one.favourite),
                Cell(str(one.favoured)),
            )
            for one in of.referents
        ),
    )


def plain(of: Elicitation) -> dict[str, Any]:
    """As JSON has it."""
    return asdict(of)


def _referent(name: str, proposals: Sequence[Hashable]) -> Referent:
    made = [proposal for proposal in proposals if isinstance(proposal, str)]
    favourite = max(sorted(set(made)), key=made.count, default="none")
    return Referent(name, rate_interval(proposals), len(set(made)), favourite, made.count(favourite))


def _proposal(cell: str, number: int) -> Hashable:
    """The word; for an empty cell something that is like no other."""
    return cell.strip() or ("none of line", number)
