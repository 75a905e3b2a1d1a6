"""The same work on many things, in several processes, watched."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar, cast

import joblib

Progress = Callable[[str, int, int], None]
"""Told what is being done, how much of it is done and how much there is."""
Task = TypeVar("Task")
Result = TypeVar("Result")


def silent(stage: str, done: int, total: int) -> None:
    """Progress that nobody watches."""


def in_parallel(
    work: Callable[[Task], Result], tasks: Sequence[Task], jobs: int, stage: str, progress: Progress
) -> Iterator[Result]:
    """The results of `work` in the order of the tasks, as they come; in this process when one job is
    asked for or there is one task only, since another takes seconds to start."""
    progress(stage, 0, len(tasks))
    if jobs == 1 or len(tasks) < 2:
        results: Iterator[Result] = map(work, tasks)
    else:
        parallel = joblib.Parallel(n_jobs=min(jobs, len(tasks)), return_as="generator")
        results = cast(Iterator[Result], parallel(joblib.delayed(work)(task) for task in tasks))
    for done, result in enumerate(results, start=1):
        progress(stage, done, len(tasks))
        yield result
