"""`inklined check-recognizer`: does a recognizer of one's own keep to the contract?"""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Annotated

import typer

MARKS = {"right": "  ", "odd": "? ", "wrong": "! "}


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        "check-recognizer", epilog='Example: inklined check-recognizer "run:node examples/recognizer.mjs"'
    )(check_recognizer)


def check_recognizer(
    name: Annotated[
        str,
        typer.Argument(
            help="module:Class, onnx:FILE, run:COMMAND, or a name that `inklined recognizers` lists."
        ),
    ],
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs.")] = False,
) -> None:
    """Run a recognizer on ink that has broken others, and say what is wrong with it."""
    from evaluation.contract import check_recognizer as findings_of
    from evaluation.contract import passes
    from evaluation.rivals import rival
    from inklined.options import rivals
    from inklined.terminal import out
    from recognizer.outside.process import RecognizerError

    rivals([name])
    findings = findings_of(rival(name))
    if as_json:
        typer.echo(json.dumps([asdict(finding) for finding in findings], indent=1, ensure_ascii=False))
    else:
        for finding in findings:
            style = {"wrong": "red", "odd": "yellow"}.get(finding.level, "")
            out.print(f"{MARKS[finding.level]}{finding.check}: {finding.text}", style=style, markup=False)
    wrong = sum(finding.level == "wrong" for finding in findings)
    if not passes(findings):
        raise RecognizerError(f"{name}: {wrong} of {len(findings)} checks found something wrong")
