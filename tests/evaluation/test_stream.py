"""Runs of any size: the same bytes whoever works on them, nothing lost with a worker, nothing counted twice."""

from __future__ import annotations

import os
import signal
import threading
import time
from pathlib import Path

import pytest
from distributed import Client, LocalCluster
from pyarrow import parquet

from evaluation.stream import Run, evaluate, on_cluster, on_this_machine, place, shards, work
from inklined.cli import run as command
from sketch.files.errors import FileError

RUN = Run(strokes=230, seed=4, names=("paper", "geometric"), shard=25)


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The run made by this process alone."""
    folder = tmp_path_factory.mktemp("alone")
    evaluate(RUN, folder, on_this_machine(1))
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("*"))}


def test_every_stroke_is_there_once_for_every_recognizer(alone: Path) -> None:
    rows = [row for path in sorted(alone.glob("part-*")) for row in parquet.read_table(path).to_pylist()]
    assert sorted((row["index"], row["name"]) for row in rows) == [
        (index, name) for index in range(230) for name in sorted(RUN.names)
    ]
    found = {one.name: one for one in evaluate(RUN, alone, on_this_machine(1))}
    for name, one in found.items():
        own = [row for row in rows if row["name"] == name]
        assert one.rows == 230
        assert one.accuracy == pytest.approx(sum(row["label"] == row["claimed"] for row in own) / 230)


def test_a_run_that_was_stopped_goes_on_and_ends_in_the_same_bytes(alone: Path, tmp_path: Path) -> None:
    made: list[int] = []

    def until_the_third(left, _):
        for shard in left[:3]:
            made.append(shard.start)
            yield shard, work(shard)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        evaluate(RUN, tmp_path, until_the_third)
    assert len(list(tmp_path.glob("part-*"))) == 3

    def rest(left, _):
        for shard in left:
            made.append(shard.start)
            yield shard, work(shard)

    evaluate(RUN, tmp_path, rest)
    assert made == [shard.start for shard in shards(RUN)]
    assert contents(tmp_path) == contents(alone)


def test_a_part_that_is_damaged_is_named(alone: Path, tmp_path: Path) -> None:
    for name, data in contents(alone).items():
        (tmp_path / name).write_bytes(data)
    broken = place(tmp_path, shards(RUN)[2])
    broken.write_bytes(broken.read_bytes()[:50])
    with pytest.raises(FileError, match=r"part-000000000050.*delete it and run again"):
        evaluate(RUN, tmp_path, on_this_machine(1))


def test_a_folder_of_another_run_is_refused(alone: Path) -> None:
    with pytest.raises(FileError, match="another run"):
        evaluate(Run(230, 5, RUN.names, 25), alone, on_this_machine(1))


def test_on_a_cluster_nothing_is_lost_with_a_worker_and_nothing_counted_twice(
    alone: Path, tmp_path: Path
) -> None:
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=50
    ) as cluster:
        with Client(cluster, set_as_default=False) as client:
            pids = list(client.run(os.getpid).values())
        assert len(set(pids)) == 2 and os.getpid() not in pids

        def kill_one_halfway() -> None:
            until = time.monotonic() + 120
            while len(list(tmp_path.glob("part-*"))) < 3 and time.monotonic() < until:
                time.sleep(0.01)
            os.kill(pids[0], signal.SIGKILL)

        killer = threading.Thread(target=kill_one_halfway)
        killer.start()
        found = evaluate(RUN, tmp_path, on_cluster(cluster.scheduler_address))
        killer.join()
        with Client(cluster, set_as_default=False) as client:
            assert pids[0] not in client.run(os.getpid).values()
    assert contents(tmp_path) == contents(alone)
    assert [one.rows for one in found] == [230, 230]


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
    place(tmp_path / "results", shards(Run(60, 2026, ("paper",), 20))[1]).unlink()
    assert command(words) == 0
    assert "1 shards made, 2 were there" in capsys.readouterr().out
