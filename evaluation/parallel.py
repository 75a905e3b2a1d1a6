"""The same work on many things, in several processes of this machine or of a Dask cluster, watched."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import islice
from typing import Any, TypeVar, cast

import joblib

from evaluation.code import ROOMS, digest

Progress = Callable[[str, int, int], None]
"""Told what is being done, how much of it is done and how much there is."""
Task = TypeVar("Task")
Result = TypeVar("Result")

IN_FLIGHT = 4
"""Tasks that each worker of a cluster has waiting: it never idles, and results do not pile up."""
RETRIES = 5
"""How often a task may lose its worker before the whole is given up."""


@dataclass(frozen=True, slots=True)
class Cluster:
    """The workers of the Dask cluster (the extra `cluster`) whose scheduler is at that address, tcp://HOST:PORT. They share no
    file system with this process, and must have the same version of inklined."""

    address: str


Workers = int | Cluster
"""Who works: so many processes of this machine, or a cluster's."""


def silent(stage: str, done: int, total: int) -> None:
    """Progress that nobody watches."""


def in_parallel(
    work: Callable[[Task], Result], tasks: Sequence[Task], workers: Workers, stage: str, progress: Progress
) -> Iterator[Result]:
    """The results of `work` in the order of the tasks, as soon as they and all before them are there. Raises as `as_done`."""
    early: dict[int, Result] = {}
    following = 0
    for index, result in as_done(work, tasks, workers, stage, progress):
        early[index] = result
        while following in early:
            yield early.pop(following)
            following += 1


def as_done(
    work: Callable[[Task], Result], tasks: Sequence[Task], workers: Workers, stage: str, progress: Progress
) -> Iterator[tuple[int, Result]]:
    """The result of every task once, with the task's number, in whatever order they come; in this process when one job is asked
    for or there is one task only, since another takes seconds to start. A task whose worker is lost is worked on by another.

    Raises ValueError when Dask is not installed or a worker has another version of inklined, OSError when nobody answers at the
    cluster's address."""
    progress(stage, 0, len(tasks))
    match workers:
        case Cluster(address):
            results = _on_cluster(work, tasks, address)
        case int() if workers == 1 or len(tasks) < 2:
            results = ((index, work(task)) for index, task in enumerate(tasks))
        case int():
            parallel = joblib.Parallel(n_jobs=min(workers, len(tasks)), return_as="generator_unordered")
            numbered = (joblib.delayed(_numbered)(work, index, task) for index, task in enumerate(tasks))
            results = cast("Iterator[tuple[int, Result]]", parallel(numbered))
    for done, result in enumerate(results, start=1):
        progress(stage, done, len(tasks))
        yield result


def check_dask() -> None:
    """Raises ValueError when Dask is not installed."""
    if find_spec("distributed") is None:
        raise ValueError("--cluster needs Dask; pip install 'inklined[cluster]' adds it")


def _numbered(work: Callable[[Task], Result], index: int, task: Task) -> tuple[int, Result]:
    return index, work(task)


def _on_cluster(
    work: Callable[[Task], Result], tasks: Sequence[Task], address: str
) -> Iterator[tuple[int, Result]]:
    check_dask()
    from distributed import Client, as_completed

    with Client(address, set_as_default=False) as client:
        code = digest(*ROOMS)
        waiting = iter(enumerate(tasks))
        room = IN_FLIGHT * max(1, len(client.scheduler_info()["workers"]))
        asked: dict[str, int] = {}

        def ask(index: int, task: Task) -> Any:
            future = client.submit(_by_the_same_code, code, work, task, pure=False, retries=RETRIES)
            asked[str(future.key)] = index
            return future

        running = as_completed([ask(*each) for each in islice(waiting, room)], loop=client.loop)
        for future in running:
            result = cast("tuple[Result] | str", future.result())
            if isinstance(result, str):
                raise ValueError(result)
            yield asked.pop(str(future.key)), result[0]
            for after in islice(waiting, 1):
                running.add(ask(*after))


def _by_the_same_code(code: str, work: Callable[[Task], Result], task: Task) -> tuple[Result] | str:
    """The result, or what is wrong with this worker: results of two versions must not be mixed."""
    if digest(*ROOMS) == code:
        return (work(task),)
    import socket

    return f"the worker on {socket.gethostname()} has another version of inklined; install the same on all"
