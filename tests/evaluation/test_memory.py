"""Memory by recognizer: what a fresh process grows by, and the size of what was learnt."""

from __future__ import annotations

import pytest

from evaluation.memory import MEGABYTE, learnt, memory, peak
from recognizer.handwriting.roster import READERS
from recognizer.learned.recognizer import WEIGHTS
from recognizer.roster import ROSTER

HUNGRY = """
import numpy as np
from recognizer.roster import recognizer

class Hungry:
    name, claims = "hungry", frozenset({"math"})
    def __init__(self):
        self.kept = np.ones(20_000_000)  # 153 MB
    def recognize(self, ink):
        return recognizer("paper").recognize(ink)
"""


def test_what_a_recognizer_keeps_is_what_the_process_grows_by(tmp_path, monkeypatch):
    (tmp_path / "hungry_recognizer.py").write_text(HUNGRY)
    monkeypatch.chdir(tmp_path)
    paper, hungry = memory("paper"), memory("hungry_recognizer:Hungry")
    assert paper.grown is not None and hungry.grown is not None
    assert hungry.grown - paper.grown == pytest.approx(20_000_000 * 8 / MEGABYTE, rel=0.2)
    assert hungry.learnt is None


def test_the_size_of_what_ours_have_learnt_is_that_of_their_files():
    assert all(learnt(name, "reader") for name in READERS)
    sizes = {name: learnt(name) for name in ROSTER}
    assert sizes["paper"] == sizes["geometric"] == 0
    assert sizes["learned"] == WEIGHTS.stat().st_size / MEGABYTE < (sizes["hybrid"] or 0)


def test_a_program_s_memory_is_not_ours_to_measure():
    found = memory("run:nothing that is there")
    assert (found.grown, found.learnt) == (None, None)


def test_the_peak_only_grows():
    before = peak()
    kept = bytearray(64 * MEGABYTE)
    assert peak() >= before > 10
    assert len(kept) == 64 * MEGABYTE
