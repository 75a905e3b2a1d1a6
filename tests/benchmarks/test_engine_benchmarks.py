"""The engine's benchmarks run, on tiny sizes, and their judge of soundness is not blind."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from physics.engine import simulate
from physics.scene import Block, Body, Disc
from random_scenes import scene_at
from soundness import depth, faults

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
PEERS = ("pymunk", "Box2D", "pyb2d3")
MISSING = [name for name in PEERS if find_spec(name) is None]


def measured(tmp_path: Path, script: str, *arguments: str) -> dict[str, Any]:
    """What the script writes as JSON."""
    target = tmp_path / "figures.json"
    command = [sys.executable, str(BENCHMARKS / script), *arguments, "--json", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(target.read_text(encoding="utf-8"))


def contest(tmp_path: Path, *only: str) -> dict[str, Any]:
    shortened = ("--case", "pendulum", "--seconds", "2", "--repeats", "1", "--hertz", "60", "240")
    return measured(tmp_path, "engine.py", *shortened, *(("--only", *only) if only else ()))


def test_inklined_alone_can_be_measured(tmp_path: Path) -> None:
    figures = contest(tmp_path, "inklined")
    assert set(figures["usual"]["pendulum"]) == {"inklined"}
    assert figures["usual"]["pendulum"]["inklined"]["error"] < figures["targets"]["position"]


@pytest.mark.skipif(bool(MISSING), reason=f"not installed: {', '.join(MISSING)} (the extra 'bench')")
def test_a_peer_converges_to_the_closed_form_as_its_steps_shrink(tmp_path: Path) -> None:
    points = contest(tmp_path)["error_and_cost"]["pendulum"]
    for peer in ("pymunk", "Box2D 2.3", "Box2D 3"):
        by_rate = {point["setting"]["hertz"]: point["error"] for point in points[peer]}
        assert by_rate[240] < 0.5 * by_rate[60], peer


def test_growth_with_the_number_of_bodies_can_be_measured(tmp_path: Path) -> None:
    figures = measured(
        tmp_path, "engine_scaling.py", "--only", "inklined", "--bodies", "1", "3", "--repeats", "1"
    )
    assert [cost["bodies"] for cost in figures["chain"]["inklined"]] == [1, 3]
    assert all(cost["error"] < 1e-6 for cost in figures["chain"]["inklined"])


def test_a_batch_is_right_and_the_same_on_any_number_of_threads(tmp_path: Path) -> None:
    figures = measured(tmp_path, "engine_batch.py", "--scenes", "12", "--seconds", "1")
    for problem in ("incline", "pendulum", "two wires"):
        one, two = figures[problem]
        assert one["digest"] == two["digest"], problem
        assert max(one["error"], two["error"]) < 1e-6, problem


def test_random_scenes_run_soundly_and_alike_in_every_process(tmp_path: Path) -> None:
    first, second = (measured(tmp_path, "engine_random.py", "--count", "15", "--seed", "5") for _ in range(2))
    assert first["failed"] == 0, first["failures"]
    assert first["digest"] == second["digest"]


def test_start_is_measured(tmp_path: Path) -> None:
    figures = measured(tmp_path, "engine_start.py", "--starts", "1", "--warm")
    assert 0 < figures["bare_s"] < figures["cached_s"]


def test_the_judge_measures_how_deep_blocks_are_in_one_another() -> None:
    square = Body("square", Block(((-1, -1), (1, -1), (1, 1), (-1, 1))), (0.0, 0.0), 1.0, 1.0)
    ball = Body("ball", Disc(0.5), (0.0, 0.0), 1.0, 1.0)
    at_origin = np.zeros((3, 3))
    beside = np.array([[1.9, 0.3, 0.0], [2.1, 0.3, 0.0], [1.9, 0.0, np.pi / 2]])
    assert depth(square, square, at_origin, beside)[[0, 2]] == pytest.approx([0.1, 0.1])
    assert depth(square, square, at_origin, beside)[1] < 0
    balls = np.array([[1.4, 0.2, 1.0], [0.8, 0.0, 0.0], [1.6, 0.0, 0.0]])
    assert depth(square, ball, at_origin, balls) == pytest.approx([0.1, 0.7, -0.1])
    assert depth(ball, square, balls, at_origin) == pytest.approx([0.1, 0.7, -0.1])

    def bodies_apart(index: int) -> bool:
        return all(
            depth(a, b, np.array([[*a.position, a.angle]]), np.array([[*b.position, b.angle]]))[0] <= 0
            for scene in [scene_at(3, index)]
            for k, a in enumerate(scene.bodies)
            for b in scene.bodies[k + 1 :]
            if not (a.fixed and b.fixed)
        )

    overlapping = sum(not bodies_apart(index) for index in range(200))
    assert 0 < overlapping < 20  # one scene in twenty is made to overlap, the others are not


@pytest.mark.parametrize("index", [6445, 9483, 9672])
def test_rows_that_contradict_one_another_throw_nothing_off_the_page(index: int) -> None:
    """Scenes whose crowds were once pressed upon until rounding gave them 1e46 joules."""
    scene = scene_at(1, index)
    motion = simulate(scene, 2.0)
    assert "robust" in motion.modes.values()
    assert faults(scene, motion) == []


@pytest.mark.parametrize("index", [6084, 7871, 8392, 9377])
def test_a_wire_that_tautens_and_slackens_again_within_a_step_does_not_stretch(index: int) -> None:
    scene = scene_at(1, index)
    assert faults(scene, simulate(scene, 2.0)) == []
