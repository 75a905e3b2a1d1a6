"""The tables of the contest's standings."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.examination import probability, spread
from evaluation.leaderboard import Pair, Standing, Standings
from evaluation.statistics.paired import McNemar
from evaluation.table import Cell, Table


def standing_tables(of: Standings) -> list[Table]:
    """For each suite a row a recognizer, a column a measure; then the pairs."""
    told: list[Table] = []
    for suite in dict.fromkeys(one.suite for one in of.standings):
        own = [one for one in of.standings if one.suite == suite]
        names = list(own[0].values)
        columns = {one.measure: _cells(one, names) for one in own}
        told.append(
            Table(
                f"{suite}: in %, with 95 % intervals{_about(own)}.",
                ("", *columns),
                tuple((name, *(cells[k] for cells in columns.values())) for k, name in enumerate(names)),
            )
        )
    for suite, measure in dict.fromkeys((pair.suite, pair.measure) for pair in of.pairs):
        own_pairs = [pair for pair in of.pairs if (pair.suite, pair.measure) == (suite, measure)]
        told.append(
            _shares(suite, measure, own_pairs)
            if isinstance(own_pairs[0].test, McNemar)
            else _ranks(suite, measure, own_pairs)
        )
    return told


def _about(own: Sequence[Standing]) -> str:
    """n of each measure, and of how many writers."""
    counts = {one.measure: next(iter(one.values.values())) for one in own}
    rows = {value.n for value in counts.values()}
    n = f"n = {rows.pop()}" if len(rows) == 1 else "n: " + ", ".join(f"{m} {v.n}" for m, v in counts.items())
    writers = max(value.clusters for value in counts.values())
    alike = own[0].alike
    return f", {n}; clusters (writers): {writers}" + (
        f", intraclass correlation {alike:.2f}" if alike else ""
    )


def _cells(one: Standing, names: Sequence[str]) -> list[Cell]:
    rivals = [one.values[name].value for name in names if name != "oracle"]
    best = max(rivals) if one.high else min(rivals)
    lone = len(rivals) < 2 or min(rivals) == max(rivals)
    return [
        Cell(spread(one.values[name]), not lone and name != "oracle" and one.values[name].value == best)
        for name in names
    ]


def _shares(suite: str, measure: str, pairs: Sequence[Pair]) -> Table:
    def cells(pair: Pair) -> tuple[Cell, ...]:
        test = pair.test
        assert isinstance(test, McNemar)
        odds = (
            "–"
            if test.odds is None
            else f"{_odds(test.odds)} ({_odds(test.odds_low)}–{_odds(test.odds_high)})"
        )
        texts = (
            str(test.only_first),
            str(test.only_second),
            spread(pair.apart, 2, signed=True),
            probability(test.p),
            probability(pair.adjusted),
            odds,
            "–" if test.g is None else f"{test.g:.2f}",
        )
        return tuple(map(Cell, texts))

    return Table(
        f"{suite}, {measure}: exact McNemar tests of all pairs, n = {pairs[0].test.n}; difference in points and odds with their 95 % intervals, g: Cohen's.",
        ("", "first alone", "second alone", "difference", "p", "p, Holm", "odds", "g"),
        tuple((f"{pair.first} – {pair.second}", *cells(pair)) for pair in pairs),
    )


def _ranks(suite: str, measure: str, pairs: Sequence[Pair]) -> Table:
    def cells(pair: Pair) -> tuple[Cell, ...]:
        test = pair.test
        assert not isinstance(test, McNemar)
        effect = "–" if test.effect is None else f"{test.effect:+.2f}"
        told = (
            str(test.n),
            spread(pair.apart, 2, signed=True),
            probability(test.p),
            probability(pair.adjusted),
        )
        return tuple(map(Cell, (*told, effect)))

    return Table(
        f"{suite}, {measure}: Wilcoxon's signed-rank tests of all pairs; difference: of the means, in points, with its 95 % interval; effect: rank-biserial, above 0 when the first has more.",
        ("", "pairs that differ", "difference", "p", "p, Holm", "effect"),
        tuple((f"{pair.first} – {pair.second}", *cells(pair)) for pair in pairs),
    )


def _odds(value: float | None) -> str:
    return "–" if value is None else "∞" if value == float("inf") else f"{value:.3g}"
