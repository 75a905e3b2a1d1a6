"""The contest's standings: every measure of every recognizer with its interval, and who differs from whom.

Rows of strokes and expressions come in clusters, their writers; every page is by a writer of its own. All recognizers are
resampled alike.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from evaluation.contest import Contest
from evaluation.formula_contest import FormulaResult
from evaluation.formula_suites import FormulaSuite
from evaluation.page_contest import ORACLE, PageResult
from evaluation.page_scores import by_problem
from evaluation.statistics.intervals import Interval, balanced, clustering, difference
from evaluation.statistics.paired import McNemar, SignedRanks, mcnemar, wilcoxon
from evaluation.statistics.several import Friedman, Ranking, friedman, holm, ranking
from evaluation.stroke_contest import DIAGRAM_KINDS, StrokeResult
from evaluation.suites import StrokeSuite

DRAWS = 1000
FEWEST_SUITES = 2
FEWEST_RIVALS = 3


@dataclass(frozen=True, slots=True)
class Standing:
    """One measure on one suite: each recognizer's interval, by name; high: whether more is better; alike: how alike a writer's
    rows are (intraclass correlation of the first recognizer's errors)."""

    suite: str
    measure: str
    values: dict[str, Interval]
    high: bool = True
    alike: float = 0.0


@dataclass(frozen=True, slots=True)
class Pair:
    """Two recognizers on the same rows: McNemar's test of a share, or Wilcoxon's of a quantity; apart: the first's mean less the
    second's, its interval with writers resampled whole; adjusted: p after Holm's correction for all pairs of that suite and
    measure."""

    suite: str
    measure: str
    first: str
    second: str
    test: McNemar | SignedRanks
    apart: Interval
    adjusted: float | None


@dataclass(frozen=True, slots=True)
class Standings:
    """standings, pairs: in the order of the suites; order, ranks: over all suites together, where there are three
    recognizers and two suites at least."""

    standings: tuple[Standing, ...]
    pairs: tuple[Pair, ...]
    order: Friedman | None
    ranks: Ranking | None
    suites: tuple[str, ...]


@lru_cache(maxsize=1)
def standings(contest: Contest) -> Standings:
    """Everything that the contest's results say with their doubts; the same seed of the contest gives the same intervals."""
    seed = contest.seed or 0
    found: list[Standing] = []
    pairs: list[Pair] = []
    for suite, results in contest.stroke_suites():
        if suite.labels:
            found += _of_strokes(suite, results, seed)
            pairs += _pairs(suite.name, "right", {r.name: r.right for r in results}, suite.clusters, seed)
    results = [result for result in contest.page_results if result.pages]
    if results and contest.pages is not None:
        found += _of_pages(contest.pages.name, results, seed)
        rivals = [result for result in results if result.name != ORACLE]
        outcome = {r.name: [page.same_outcome for page in r.pages] for r in rivals}
        motion = {r.name: [page.motion.error for page in r.pages] for r in rivals}
        drawn = range(len(results[0].pages))
        pairs += _pairs(contest.pages.name, "same outcome", outcome, drawn, seed)
        pairs += _pairs(contest.pages.name, "motion error", motion, drawn, seed, wilcoxon)
    for suite, read in contest.formulas:
        found += _of_formulas(suite, read, seed)
        pairs += _pairs(suite.name, "right", {r.name: r.right for r in read}, suite.clusters, seed)
    suites, table = _suite_scores(contest)
    enough = len(contest.names) >= FEWEST_RIVALS and len(suites) >= FEWEST_SUITES
    return Standings(
        tuple(found),
        tuple(pairs),
        friedman(table) if enough else None,
        ranking(contest.names, table) if enough else None,
        tuple(suites),
    )


def plain(of: Standings) -> dict[str, Any]:
    """As JSON has it; infinite odds are null."""
    return {
        "standings": [
            {
                "suite": one.suite,
                "measure": one.measure,
                "intraclass_correlation": one.alike,
                "values": {name: asdict(value) for name, value in one.values.items()},
            }
            for one in of.standings
        ],
        "pairs": [
            {
                "suite": pair.suite,
                "measure": pair.measure,
                "first": pair.first,
                "second": pair.second,
                "test": "mcnemar" if isinstance(pair.test, McNemar) else "wilcoxon",
                "p_holm": pair.adjusted,
                "apart": asdict(pair.apart),
                **{key: None if value == float("inf") else value for key, value in asdict(pair.test).items()},
            }
            for pair in of.pairs
        ],
        "friedman": None if of.order is None else {**asdict(of.order), "suites": list(of.suites)},
        "critical_difference": None if of.ranks is None else asdict(of.ranks),
    }


def _of_strokes(suite: StrokeSuite, results: Sequence[StrokeResult], seed: int) -> list[Standing]:
    clusters, labels = suite.clusters, suite.labels
    columns = [result.right for result in results]
    names = [result.name for result in results]
    alike, _ = clustering(columns[0], clusters)
    five = [
        k
        for k, (single, label) in enumerate(zip(suite.single, labels, strict=True))
        if single and label in DIAGRAM_KINDS
    ]

    def standing(measure: str, rows: Sequence[int], kinds: Sequence[object]) -> Standing:
        values = balanced(
            [[column[k] for k in rows] for column in columns],
            [str(kinds[k]) for k in rows],
            [clusters[k] for k in rows],
            np.random.default_rng(seed),
            draws=DRAWS,
        )
        return Standing(suite.name, measure, dict(zip(names, values, strict=True)), True, alike)

    every = range(len(labels))
    told = [standing("balanced accuracy", every, labels), standing("accuracy", every, [0] * len(labels))]
    return [*told, standing("five kinds", five, labels)] if five else told


def _of_formulas(suite: FormulaSuite, results: Sequence[FormulaResult], seed: int) -> list[Standing]:
    """Of expressions, and of their signs where the suite says which strokes are which sign."""
    alike, _ = clustering(results[0].right, suite.clusters)

    def standing(measure: str, columns: Sequence[ArrayLike], clusters: Sequence[str]) -> Standing:
        values = balanced(columns, [0] * len(clusters), clusters, np.random.default_rng(seed), draws=DRAWS)
        named = {result.name: value for result, value in zip(results, values, strict=True)}
        return Standing(suite.name, measure, named, True, alike)

    told = [
        standing("expressions right", [result.right for result in results], suite.clusters),
        standing("one mistake at most", [result.nearly for result in results], suite.clusters),
        standing("structure right", [result.structured for result in results], suite.clusters),
    ]
    whose = [
        writer
        for writer, one in zip(suite.clusters, results[0].reads, strict=True)
        for _ in range(len(one.signs))
    ]
    if whose:
        each = [[sign.right for one in result.reads for sign in one.signs] for result in results]
        told.append(standing("signs right", each, whose))
    return told


def _of_pages(suite: str, results: Sequence[PageResult], seed: int) -> list[Standing]:
    def standing(measure: str, columns: Sequence[ArrayLike], high: bool) -> Standing:
        count = len(np.asarray(columns[0]))
        values = balanced(columns, [0] * count, range(count), np.random.default_rng(seed), draws=DRAWS)
        return Standing(suite, measure, {r.name: v for r, v in zip(results, values, strict=True)}, high)

    told = [
        standing("read exactly", [[page.match.exact for page in r.pages] for r in results], True),
        standing("same outcome", [[page.same_outcome for page in r.pages] for r in results], True),
        standing("motion error", [[page.motion.error for page in r.pages] for r in results], False),
    ]
    answered = [k for k, page in enumerate(results[0].pages) if page.same_verdict is not None]
    if answered:
        verdicts = [[bool(r.pages[k].same_verdict) for k in answered] for r in results]
        told.append(standing("same verdict", verdicts, True))
    return told


def _pairs(
    suite: str,
    measure: str,
    columns: Mapping[str, ArrayLike],
    clusters: Sequence[Hashable],
    seed: int,
    compare: Callable[[ArrayLike, ArrayLike], McNemar | SignedRanks] = mcnemar,
) -> list[Pair]:
    """Every two columns, whose rows come in clusters."""
    tests = {(a, b): compare(columns[a], columns[b]) for a, b in combinations(columns, 2)}
    told = [pair for pair, test in tests.items() if test.p is not None]
    adjusted = dict(zip(told, holm([tests[pair].p or 0.0 for pair in told]), strict=True))
    alike = [0] * len(clusters)
    apart = {
        (a, b): difference(columns[a], columns[b], alike, clusters, np.random.default_rng(seed), draws=DRAWS)
        for a, b in tests
    }
    return [
        Pair(suite, measure, *pair, test, apart[pair], adjusted.get(pair)) for pair, test in tests.items()
    ]


def _suite_scores(contest: Contest) -> tuple[list[str], list[list[float]]]:
    """A row of scores for each suite of strokes (balanced accuracy) and each diagram (pages with the right outcome)."""
    suites: list[str] = []
    table: list[list[float]] = []
    for suite, results in contest.stroke_suites():
        if suite.labels:
            suites.append(suite.name)
            table.append([result.scores.balanced_accuracy or 0.0 for result in results])
    split = [by_problem(result.pages) for result in contest.page_results if result.name != ORACLE]
    for problem in split[0] if split else ():
        suites.append(problem)
        table.append([each[problem].same_outcome or 0.0 for each in split])
    return suites, table
