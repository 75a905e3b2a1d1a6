"""What a person sees in the terminal: tables and results on stdout, progress on stderr."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TaskID, TextColumn, TimeElapsedColumn
from rich.progress import Progress as RichProgress
from rich.table import Table as RichTable
from rich.text import Text

if TYPE_CHECKING:
    from evaluation.tables import Table

out = Console(highlight=False)
err = Console(stderr=True, highlight=False)


@contextmanager
def progress() -> Generator[Callable[[str, int, int], None]]:
    """A bar for every stage of a long piece of work; the function within is told the stage, how much
    of it is done and how much there is. Bars vanish with the block."""
    bars = RichProgress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=err,
        transient=True,
        disable=not err.is_terminal,
    )
    with bars:
        tasks: dict[str, TaskID] = {}

        def tell(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                tasks[stage] = bars.add_task(stage, total=total)
            bars.update(tasks[stage], completed=done, total=total)

        yield tell


def as_rich(table: Table) -> RichTable:
    """A table of the contest for the terminal; what is best stands out."""
    drawn = RichTable(
        title=Text(table.caption, style="dim italic"),
        title_justify="left",
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    for k, name in enumerate(table.head):
        drawn.add_column(Text(name), justify="left" if k == 0 else "right")
    for name, *cells in table.rows:
        drawn.add_row(
            Text(name, style="bold"),
            *(Text(cell.text, style="bold green" if cell.best else "") for cell in cells),
        )
    return drawn
