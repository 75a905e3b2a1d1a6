"""Runs of any size: the same bytes whoever works on them, nothing lost with a worker, nothing counted twice."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from distributed import Client, LocalCluster
from pyarrow import parquet

from data_gen.strokes import generate
from evaluation.page_contest import ORACLE, page_contest
from evaluation.page_scores import summarize
from evaluation.parallel import Cluster, as_done, in_parallel, silent
from evaluation.stream import Run, evaluate, place, shards
from evaluation.suites import generated_pages
from inklined.cli import run as command
from sketch.files import formats
from sketch.files.errors import FileError

RUN = Run(count=230, seed=4, names=("paper", "geometric"), shard=25)
PAGES = Run(count=12, seed=4, names=("paper", ORACLE), suite="pages", shard=1)
PROBLEMS = Run(count=10, seed=4, names=("paper", ORACLE), suite="problems", shard=1)
INK = Run(count=230, seed=4, suite="ink", shard=25)


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The run made by this process alone."""
    folder = tmp_path_factory.mktemp("alone")
    evaluate(RUN, folder, 1)
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("*"))}


def test_every_stroke_is_there_once_for_every_recognizer(alone: Path) -> None:
    rows = [row for path in sorted(alone.glob("part-*")) for row in parquet.read_table(path).to_pylist()]
    assert sorted((row["index"], row["name"]) for row in rows) == [
        (index, name) for index in range(230) for name in sorted(RUN.names)
    ]
    found = {one.name: one for one in evaluate(RUN, alone, 1)}
    for name, one in found.items():
        own = [row for row in rows if row["name"] == name]
        assert one.rows == 230
        assert one.measures["accuracy"].value == pytest.approx(
            sum(row["label"] == row["claimed"] for row in own) / 230
        )


def test_a_run_that_was_stopped_goes_on_and_ends_in_the_same_bytes(alone: Path, tmp_path: Path) -> None:
    def stop_at_the_fourth(_stage: str, done: int, _total: int) -> None:
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        evaluate(RUN, tmp_path, 1, stop_at_the_fourth)
    made = {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("part-*")}
    assert len(made) == 3
    asked: list[int] = []
    evaluate(RUN, tmp_path, 1, lambda _stage, _done, total: asked.append(total))
    assert set(asked) == {len(shards(RUN)) - 3}
    assert contents(tmp_path) == contents(alone)
    assert made.items() <= {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("part-*")}.items()


def test_two_processes_make_the_same_bytes_as_one(alone: Path, tmp_path: Path) -> None:
    evaluate(RUN, tmp_path, 2)
    assert contents(tmp_path) == contents(alone)


def test_streamed_pages_come_to_what_the_contest_of_pages_says(tmp_path: Path) -> None:
    found = {one.name: one for one in evaluate(PAGES, tmp_path, 1)}
    for result in page_contest(generated_pages(PAGES.count, PAGES.seed), ("paper",)):
        told, own = summarize(result.pages), found[result.name].measures
        assert own["read exactly"].value == pytest.approx(told.exact)
        assert own["same outcome"].value == pytest.approx(told.same_outcome)
        assert own["same verdict"].value == pytest.approx(told.same_verdict)
        assert own["same verdict"].n == sum(page.same_verdict is not None for page in result.pages)
        assert own["motion error"].value == pytest.approx(told.motion)
        spread = np.std([page.motion.error for page in result.pages], ddof=1) / np.sqrt(PAGES.count)
        low, high = own["motion error"].low, own["motion error"].high
        assert low is not None and high is not None
        assert (high - low) / 2 == pytest.approx(1.959963984540054 * spread)


def test_streamed_ink_is_the_generator_s_and_can_be_read_as_a_suite(tmp_path: Path) -> None:
    assert evaluate(INK, tmp_path, 1) == []
    rows = [row for path in sorted(tmp_path.glob("part-*")) for row in formats.read(path).rows]
    made = generate(INK.count, INK.seed)
    assert [row.label for row in rows] == [item.kind for item in made]
    for row, item in zip(rows, made, strict=True):
        assert row.ink[0].points.tobytes() == item.stroke.points.tobytes()


def test_a_part_that_is_damaged_is_named(alone: Path, tmp_path: Path) -> None:
    for name, data in contents(alone).items():
        (tmp_path / name).write_bytes(data)
    broken = place(tmp_path, shards(RUN)[2])
    broken.write_bytes(broken.read_bytes()[:50])
    with pytest.raises(FileError, match=r"part-000000000050.*delete it and run again"):
        evaluate(RUN, tmp_path, 1)


def test_a_folder_of_another_run_is_refused(alone: Path) -> None:
    with pytest.raises(FileError, match="another run"):
        evaluate(Run(230, 5, RUN.names, shard=25), alone, 1)


@pytest.fixture(scope="module")
def cluster() -> Iterator[LocalCluster]:
    """A real scheduler with two worker processes; one that is killed is replaced."""
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=50
    ) as made:
        yield made


def pids(cluster: LocalCluster) -> set[int]:
    with Client(cluster, set_as_default=False) as client:
        client.wait_for_workers(2)
        return set(client.run(os.getpid).values())


@pytest.mark.parametrize("run", [RUN, PAGES, PROBLEMS, INK], ids=lambda run: run.suite)
def test_on_a_cluster_nothing_is_lost_with_a_worker_and_nothing_counted_twice(
    run: Run, cluster: LocalCluster, tmp_path: Path
) -> None:
    evaluate(run, tmp_path / "alone", 1)
    there = tmp_path / "there"
    workers = pids(cluster)
    assert len(workers) == 2 and os.getpid() not in workers
    victim = min(workers)

    def kill_one_halfway() -> None:
        until = time.monotonic() + 120
        while len(list(there.glob("part-*"))) < 3 and time.monotonic() < until:
            time.sleep(0.01)
        os.kill(victim, signal.SIGKILL)

    killer = threading.Thread(target=kill_one_halfway)
    killer.start()
    found = evaluate(run, there, Cluster(cluster.scheduler_address))
    killer.join()
    assert victim not in pids(cluster)
    assert contents(there) == contents(tmp_path / "alone")
    assert [one.rows for one in found] == [run.count for _ in run.names]


def test_every_task_of_a_comparison_is_done_once_on_a_cluster_and_its_error_comes_back(
    cluster: LocalCluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    there = Cluster(cluster.scheduler_address)
    assert list(in_parallel(str, range(30), there, "Counting", silent)) == [str(k) for k in range(30)]
    assert sorted(as_done(abs, [-3, 2], there, "Counting", silent)) == [(0, 3), (1, 2)]
    with pytest.raises(ValueError, match="invalid literal"):
        list(in_parallel(int, ["1", "x"], there, "Counting", silent))
    # The leader says that it is of another version; the workers, real ones, reckon their own. Two installations would be needed.
    monkeypatch.setattr("evaluation.parallel.digest", lambda *_rooms: "another")
    with pytest.raises(ValueError, match="another version of inklined"):
        list(in_parallel(str, range(3), there, "Counting", silent))


def test_the_command_tells_what_was_made_and_what_was_there(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = [
        "evaluate",
        "results",
        "--strokes",
        "60",
        "--shard",
        "20",
        "--recognizer",
        "paper",
        "--jobs",
        "1",
    ]
    assert command(words) == 0
    assert "3 shards made, 0 were there" in capsys.readouterr().out
    place(tmp_path / "results", shards(Run(60, 2026, ("paper",), shard=20))[1]).unlink()
    assert command(words) == 0
    assert "1 shards made, 2 were there" in capsys.readouterr().out
