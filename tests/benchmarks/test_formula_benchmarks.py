"""The benchmarks of formulas measure what they say."""

from __future__ import annotations

import pytest

import fuzz_formulas
import page_to_scene
from physics.build import build
from physics.formula.dimensions import check
from physics.formula.meaning import read
from physics.rectify import rectify


def test_the_page_has_twenty_components_and_nothing_on_it_is_refused() -> None:
    drawn = rectify(page_to_scene.page()).sketch
    built = build(drawn)
    assert len(drawn.components) == 20
    assert len(built.scene.forces) == 2
    assert all("not used" not in notice or "gives v_2" in notice for notice in built.notices)
    assert check(drawn, read(drawn)) == ()


def test_every_figure_is_measured() -> None:
    figures = page_to_scene.measure(repeat=2)
    assert set(page_to_scene.TARGETS) <= set(figures)
    assert all(0 < figure["p50"] <= figure["p95"] for figure in figures.values())


@pytest.mark.parametrize("text", fuzz_formulas.SEEDS)
def test_the_seeds_of_the_fuzzer_keep_its_laws(text: str) -> None:
    assert fuzz_formulas.exercise(text)


def test_what_fails_is_kept() -> None:
    tally = fuzz_formulas.Tally()
    assert not tally.attempt("m = = 5")
    assert (tally.lines, tally.formulas, tally.failures) == (1, 0, {})
