"""Tells how far each stage is: bars on a terminal, a line every tenth in a log."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn

Tell = Callable[[str, float, str], None]
"""Told a stage, the share of it that is done, and a note."""


@contextmanager
def progress(console: Console) -> Generator[Tell]:
    """A function that tells how far each stage is, for as long as it lasts."""
    if not console.is_terminal:
        told: dict[str, int] = {}

        def tell(stage: str, share: float, note: str) -> None:
            tenth = int(10 * share)
            if told.get(stage) != tenth:
                told[stage] = tenth
                console.print(f"{stage} {10 * tenth} % {note}")

        yield tell
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[note]}"))
    with Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=console) as bars:
        stages: dict[str, TaskID] = {}

        def draw(stage: str, share: float, note: str) -> None:
            if stage not in stages:
                stages[stage] = bars.add_task(stage, total=1.0, note="")
            bars.update(stages[stage], completed=share, note=note)

        yield draw
