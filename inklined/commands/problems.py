"""`inklined problems`: textbook problems with right and wrong answers, judged; and drawn by simulated pens."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from inklined.options import ClusterAddress, Jobs, known, rivals, workers_of

SEED = 2026
ORACLE = "oracle"


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(epilog="Example: inklined problems --draws 5 --family incline orbit --json problems.json")(
        problems
    )


def problems(
    draws: Annotated[
        int, typer.Option(min=0, max=10_000, help="How often each problem is drawn with other numbers.")
    ] = 25,
    family: Annotated[
        list[str] | None, typer.Option(help="Families of problems, one or more; all by default.")
    ] = None,
    pens: Annotated[
        int, typer.Option(min=0, max=10_000, help="Also draw each problem by so many simulated pens.")
    ] = 0,
    recognizer: Annotated[
        list[str] | None,
        typer.Option(help="Who reads what the pens drew: oracle (told what each stroke is) and others."),
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write all figures here as JSON.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the problems' numbers.")] = SEED,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
) -> None:
    """Judge right and wrong answers to textbook problems.

    Each answer is put beside its problem; the engine finds the true value, and the verdict says whether the
    answer is right, and which misconception explains a wrong one.
    """
    from inklined.output import check_writable, write_text
    from inklined.terminal import as_rich, out, progress

    others = [name for name in recognizer or () if name != ORACLE]
    rivals(others)
    readers = tuple(dict.fromkeys(recognizer or (ORACLE, "geometric", "learned")))
    if not draws and not pens:
        raise typer.BadParameter("--draws 0 --pens 0 leaves nothing to judge; give one of them a number")
    if json_file:
        check_writable(json_file)

    with progress() as tell:
        from data_gen.textbook.roster import FAMILIES, names
        from evaluation.textbook import judge_problems, summary, tables
        from evaluation.textbook_pens import pens_summary, pens_table, read_problems

        chosen = known("--family", family or FAMILIES, FAMILIES)
        asked = [name for name in names() if name[0] in chosen]
        workers = workers_of(jobs, cluster)
        judged = judge_problems(asked, draws, seed, workers, tell) if draws else ()
        read = read_problems(asked, pens, seed, readers, workers, tell) if pens else ()

    if json_file:
        figures = summary(judged, draws, seed) | ({"pens": pens_summary(read)} if read else {})
        write_text(json_file, json.dumps(figures, indent=1, ensure_ascii=False) + "\n")
    for table in (*(tables(judged) if judged else ()), *([pens_table(read)] if read else ())):
        out.print(as_rich(table))
    if json_file:
        out.print(f"Figures: {json_file}", markup=False)
