"""The benchmark of rectification runs, on tiny sizes, and its pages are what it says they are."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from physics.build import build
from physics.rectify import rectify
from rectification import crowded

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def test_ways_and_times_are_told_and_written(tmp_path: Path) -> None:
    target = tmp_path / "figures.json"
    sizes = ("--pages", "6", "--crowded", "2", "--repeats", "1", "--json", str(target))
    command = [sys.executable, str(BENCHMARKS / "rectification.py"), *sizes]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    figures = json.loads(target.read_text(encoding="utf-8"))
    ways, times = figures["ways"], figures["times_ms"]
    assert 0 < ways["displacement_of_a_point"] <= ways["farthest_of_all"]
    assert ways["farthest_of_all"] <= ways["displacement_of_a_page"] * 6
    assert ways["corrections_on_a_page"] > 0
    assert 0 < times["both"]["p50"] <= times["both"]["p95"]
    assert "displacement of a page" in done.stdout


def test_a_crowded_page_has_twenty_components_and_needs_correction_only_where_a_hand_was() -> None:
    exact, rough = crowded(1, 0, 0.0), crowded(1, 0, 1.5)
    assert len(exact.components) == len(rough.components) >= 20
    assert rectify(exact).sketch == exact
    corrected = rectify(rough)
    assert corrected.corrections
    assert len(build(corrected.sketch).scene.bodies) == len(build(exact).scene.bodies)
