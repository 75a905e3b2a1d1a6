"""The statistics against worked examples, exact arithmetic and other people's programs, and intervals against simulation.

Reference values: statsmodels 0.15.0 (`mcnemar`, `multipletests`, `proportion_confint`), Darwin's plants (scipy's and Siegel's
example of Wilcoxon's test), table 6 of Demšar (JMLR 2006), Agresti's approval ratings (Categorical Data Analysis, table 10.1).
"""

from __future__ import annotations

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from evaluation.statistics import closed, intervals, paired, planner, several

CLOSE = 1e-9


@pytest.mark.parametrize(
    ("first", "second", "p"),
    [
        (86, 150, 3.7159361395713866e-05),
        (3, 12, 0.03515625),
        (15, 161, 4.584559752988367e-32),
        (59, 121, 4.4344492637551645e-06),
    ],
)
def test_mcnemar_is_statsmodels(first: int, second: int, p: float) -> None:
    assert paired.mcnemar_of(first, second, 1600).p == pytest.approx(p, rel=CLOSE)


@given(st.integers(0, 60), st.integers(0, 60))
def test_mcnemar_is_the_exact_sum_of_binomial_terms(first: int, second: int) -> None:
    n = first + second
    found = paired.mcnemar_of(first, second, n)
    if n == 0:
        assert found.p is None and found.odds is None
        return
    tail = sum(Fraction(comb(n, k), 2**n) for k in range(min(first, second) + 1))
    assert found.p == pytest.approx(float(min(Fraction(1), 2 * tail)), rel=CLOSE)
    mirrored = paired.mcnemar_of(second, first, n)
    assert mirrored.p == pytest.approx(found.p, rel=CLOSE)
    assert mirrored.difference == -found.difference and mirrored.g == found.g


def test_the_odds_of_differing_rows_have_clopper_and_pearson_s_interval() -> None:
    found = paired.mcnemar_of(13, 7, 100)
    low, high = 0.40781146546717184, 0.8460907952154588  # statsmodels, 13 of 20
    assert (found.odds, found.odds_low, found.odds_high) == pytest.approx(
        (13 / 7, low / (1 - low), high / (1 - high)), rel=CLOSE
    )
    assert paired.mcnemar_of(5, 0, 9).odds == float("inf")
    assert paired.mcnemar([1, 1, 0, 0], [1, 0, 1, 0]) == paired.mcnemar_of(1, 1, 4)


def test_wilcoxon_of_darwin_s_plants() -> None:
    apart = [6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75]
    found = paired.wilcoxon(apart, [0] * 15)
    assert (found.statistic, found.n) == (24, 15)
    assert found.p == pytest.approx(0.041259765625, rel=CLOSE)
    assert found.effect == pytest.approx((96 - 24) / 120, rel=CLOSE)
    assert paired.wilcoxon([1, 2], [1, 2]) == paired.SignedRanks(None, None, 0, None)


def test_holm_is_statsmodels() -> None:
    p = [0.001, 0.04, 0.03, 0.005, 0.2, 0.04]
    assert several.holm(p) == pytest.approx([0.006, 0.12, 0.12, 0.025, 0.2, 0.12], rel=CLOSE)


DEMSAR = np.array(
    [
        [0.763, 0.768, 0.771, 0.798], [0.599, 0.591, 0.590, 0.569], [0.954, 0.971, 0.968, 0.967],
        [0.628, 0.661, 0.654, 0.657], [0.882, 0.888, 0.886, 0.898], [0.936, 0.931, 0.916, 0.931],
        [0.661, 0.668, 0.609, 0.685], [0.583, 0.583, 0.563, 0.625], [0.775, 0.838, 0.866, 0.875],
        [1.000, 1.000, 1.000, 1.000], [0.940, 0.962, 0.965, 0.962], [0.619, 0.666, 0.614, 0.669],
        [0.972, 0.981, 0.975, 0.9749], [0.957, 0.978, 0.946, 0.970],
    ]
)  # fmt: skip
"""AUC of four variants of C4.5 on 14 data sets. The paper ranks a tie of voting 2 and 3, hence the last digit here."""
VARIANTS = ("C4.5", "C4.5+m", "C4.5+cf", "C4.5+m+cf")


def test_friedman_and_the_critical_difference_of_demsar_s_worked_example() -> None:
    found = several.friedman(DEMSAR)
    assert found.ranks == pytest.approx((3.143, 2.000, 2.893, 1.964), abs=5e-4)
    uncorrected = 12 * 14 / (4 * 5) * (sum(rank**2 for rank in found.ranks) - 4 * 25 / 4)
    assert uncorrected == pytest.approx(9.28, abs=5e-3)
    assert several.critical_difference(4, 14) == pytest.approx(1.25, abs=5e-3)
    assert several.critical_difference(4, 14, 0.1) == pytest.approx(1.12, abs=5e-3)
    tested = stats.friedmanchisquare(*DEMSAR.T)
    assert (found.chi2, found.p) == pytest.approx((tested.statistic, tested.pvalue), rel=CLOSE)
    assert found.w == pytest.approx(found.chi2 / (14 * 3), rel=CLOSE)
    ranked = several.ranking(VARIANTS, DEMSAR)
    assert ranked.names == ("C4.5+m+cf", "C4.5+m", "C4.5+cf", "C4.5")
    assert ranked.groups == ((0, 1, 2, 3),)  # the paper: not powerful enough to tell any two apart


def test_recognizers_of_one_mind_do_not_differ() -> None:
    assert several.friedman(np.full((5, 3), 0.5)).p == 1.0
    with pytest.raises(ValueError, match="two suites and three recognizers"):
        several.friedman([[1, 2]])


def share(right, clusters, rng: np.random.Generator) -> intervals.Interval:
    """Of rows that are right: all of one kind."""
    return intervals.balanced([right], [0] * len(clusters), clusters, rng)[0]


# Intervals --------------------------------------------------------------------------------------


@pytest.mark.parametrize("writers", [8, 30])
def test_an_interval_holds_the_truth_as_often_as_it_says_though_a_writer_s_rows_are_alike(
    writers: int,
) -> None:
    rng = np.random.default_rng(7)
    held = naive = 0
    trials, rows, truth = 300, 10, 0.8
    for _ in range(trials):
        skill = rng.beta(4, 1, writers)
        right = rng.random((writers, rows)) < skill[:, None]
        clusters = np.repeat(np.arange(writers), rows).tolist()
        found = intervals.balanced([right.ravel()], [0] * len(clusters), clusters, rng, draws=400)[0]
        held += (found.low or 0) <= truth <= (found.high or 0)
        reach = 1.96 * np.sqrt(right.mean() * (1 - right.mean()) / right.size)
        naive += abs(right.mean() - truth) <= reach
    assert 0.91 <= held / trials <= 0.985
    assert naive / trials < 0.9  # what leaving the writers out would have claimed to be 95 %


def test_with_each_row_a_writer_the_interval_of_a_share_is_near_the_normal_one() -> None:
    rng = np.random.default_rng(3)
    right = rng.random(900) < 0.7
    found = share(right, list(range(900)), rng)
    reach = 1.96 * np.sqrt(found.value * (1 - found.value) / 900)
    assert (found.low, found.high) == pytest.approx((found.value - reach, found.value + reach), abs=0.004)
    assert (found.n, found.clusters) == (900, 900)


def test_where_all_are_right_the_interval_is_clopper_and_pearson_s() -> None:
    found = share([1] * 60, [k // 3 for k in range(60)], np.random.default_rng(0))
    assert (found.value, found.low, found.high) == pytest.approx((1.0, 0.8315665290169146, 1.0), rel=CLOSE)
    none = share([0] * 20, list(range(20)), np.random.default_rng(0))
    assert (none.low, none.high) == pytest.approx((0.0, 1 - 0.8315665290169146), rel=CLOSE)


def test_one_writer_gives_no_interval_and_no_row_no_value() -> None:
    found = share([1, 0], ["w", "w"], np.random.default_rng(0))
    assert (found.value, found.low, found.high) == (0.5, None, None)
    with pytest.raises(ValueError, match="no row"):
        share([], [], np.random.default_rng(0))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000))
def test_a_balanced_mean_is_the_mean_of_the_kinds_recalls_and_a_difference_is_of_the_same_resamples(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    kinds, clusters = rng.integers(3, size=40).tolist(), rng.integers(6, size=40).tolist()
    first, second = rng.random(40) < 0.6, rng.random(40) < 0.8
    recalls = [first[np.array(kinds) == kind].mean() for kind in set(kinds)]
    one, _ = intervals.balanced([first, second], kinds, clusters, rng, draws=50)
    assert one.value == pytest.approx(np.mean(recalls))
    apart = intervals.difference(first, first, kinds, clusters, rng, draws=50)
    assert (apart.value, apart.low, apart.high) == (0, 0, 0)


def test_rows_of_one_writer_that_are_alike_count_for_fewer() -> None:
    clusters = [k // 10 for k in range(200)]
    assert intervals.clustering([k // 10 % 2 for k in range(200)], clusters) == pytest.approx((1.0, 10.0))
    alike, effect = intervals.clustering(np.random.default_rng(0).random(200), clusters)
    assert alike < 0.1 and 1 <= effect < 1.9


# Closed forms for suites too large to resample -----------------------------------------------------


@pytest.mark.parametrize(("right", "n"), [(13, 20), (0, 7), (7, 7), (999_990, 1_000_000)])
def test_the_interval_of_a_share_is_wilson_s_formula(right: int, n: int) -> None:
    z, share = stats.norm.ppf(0.975), right / n
    middle = (share + z**2 / (2 * n)) / (1 + z**2 / n)
    reach = z / (1 + z**2 / n) * np.sqrt(share * (1 - share) / n + z**2 / (4 * n**2))
    found = closed.of_share(right, n)
    assert (found.value, found.n) == (share, n)
    assert (found.low, found.high) == pytest.approx((middle - reach, middle + reach), rel=CLOSE, abs=1e-12)


@given(st.lists(st.floats(-5, 5), min_size=2, max_size=30))
def test_a_mean_by_sums_is_the_mean_of_the_values(values: list[float]) -> None:
    array = np.array(values)
    found = closed.of_mean(len(array), float(array.sum()), float((array**2).sum()))
    assert found.value == pytest.approx(array.mean(), abs=1e-12)
    reach = stats.norm.ppf(0.975) * array.std(ddof=1) / np.sqrt(len(array))
    assert found.high is not None and found.high - found.value == pytest.approx(reach, abs=1e-6)
    assert closed.of_mean(1, 0.3, 0.09).low is None


def test_the_interval_of_mean_recalls_holds_the_truth_as_often_as_it_says() -> None:
    rng = np.random.default_rng(3)
    sizes, recalls = np.array([40, 60, 0, 90]), np.array([0.95, 0.7, 0.1, 0.99])
    truth = recalls[sizes > 0].mean()
    held = [
        found.low <= truth <= found.high
        for found in (closed.of_recalls(rng.binomial(sizes, recalls), sizes) for _ in range(2000))
        if found.low is not None and found.high is not None
    ]
    assert 0.935 <= np.mean(held) <= 0.985


@pytest.mark.parametrize("nothing", [lambda: closed.of_share(0, 0), lambda: closed.of_mean(0, 0, 0), lambda: closed.of_recalls([0], [0])])  # fmt: skip
def test_of_no_row_there_is_no_interval(nothing) -> None:
    with pytest.raises(ValueError, match="no row"):
        nothing()


# The planner ------------------------------------------------------------------------------------


def test_the_power_of_mcnemar_s_test_is_that_of_every_table_added_up() -> None:
    n, first, second = 25, 0.3, 0.1
    spread = stats.multinomial(n, [first, second, 1 - first - second])
    total = sum(
        spread.pmf([a, b, n - a - b])
        for a in range(n + 1)
        for b in range(n + 1 - a)
        if a + b and stats.binomtest(a, a + b).pvalue <= 0.05
    )
    assert planner.mcnemar_power(n, first, second) == pytest.approx(total, rel=1e-7)


def test_a_plan_has_the_power_and_one_row_less_has_not() -> None:
    plan = planner.rows_for_difference(0.08, 0.02)
    assert (
        planner.mcnemar_power(plan.rows, 0.08, 0.02) >= 0.8 > planner.mcnemar_power(plan.rows - 1, 0.08, 0.02)
    )
    grouped = planner.rows_for_difference(0.08, 0.02, per_writer=20, alike=0.1)
    assert grouped.effect == pytest.approx(2.9)
    assert grouped.rows == grouped.writers * 20 >= 2.9 * plan.rows
    with pytest.raises(ValueError, match="cannot be told apart"):
        planner.rows_for_difference(0.1, 0.1)


def test_a_margin_of_five_points_around_a_half_needs_385_rows() -> None:
    assert planner.rows_for_margin(0.5, 0.05).rows == 385
