"""The command `inklined`. Without arguments it runs the contest: `inklined compare`.

Every command ends with exit code 0, or with another one and one line on stderr that says what
was wrong and what would be right: 1 for files and pages, 2 for the command line itself, 70 for a
fault of inklined's own, 130 when interrupted.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import typer

from inklined.commands import (
    check_recognizer,
    compare,
    compile,
    data,
    evaluate,
    generate,
    mathematics,
    observe,
    problems,
    reading,
    recognizers,
    reproduce,
    studies,
    studio,
    train,
)
from inklined.typed import TYPED

HELP = """Ink that knows physics: reads pages of pen strokes, sets them in motion, and compares
recognizers by what comes out. Without a command: inklined compare."""

REPEATED: dict[str, tuple[str, ...]] = {
    "compare": ("--ink", "--recognizer", "--train", "--formulas", "--reader"),
    "evaluate": ("--recognizer",),
    "export": ("--label",),
    "early": ("--recognizer",),
    "protocol": ("--recognizer", "--templates"),
    "stress": ("--recognizer", "--axis"),
    "problems": ("--family", "--recognizer"),
    "observe": ("--quantity",),
}
"""For each command the options that may be given several values at once: --recognizer paper learned."""
INTERRUPTED = 130
"""What a shell reports for a process that SIGINT ended."""

app = typer.Typer(
    name="inklined",
    help=HELP,
    epilog="Example: inklined compare --ink strokes.jsonl.gz --json scores.json",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
compare.register(app)
recognizers.register(app)
data.register(app)
studies.register(app)
reproduce.register(app)
evaluate.register(app)
check_recognizer.register(app)
reading.register(app)
mathematics.register(app)
observe.register(app)
generate.register(app)
problems.register(app)
studio.register(app)
train.register(app)
compile.register(app)


def main() -> None:
    """The entry point of the command."""
    sys.exit(run(sys.argv[1:]))


def run(arguments: Sequence[str]) -> int:
    """Runs one command line and returns its exit code. With INKLINED_DEBUG set, errors are raised."""
    typed = TYPED.set(tuple(arguments) or ("compare",))
    try:
        code = app(spread(arguments) or ["compare"], prog_name="inklined", standalone_mode=False)
    except BaseException as error:
        if os.environ.get("INKLINED_DEBUG") or isinstance(error, SystemExit):
            raise
        line, code = _verdict(error)
        if line:
            _complain(line)
    else:
        if code == INTERRUPTED:  # typer has caught the signal and says it by this code
            _complain("interrupted")
    finally:
        TYPED.reset(typed)
    return code if isinstance(code, int) else 0


def _complain(line: str) -> None:
    print(f"inklined: {line}", file=sys.stderr)  # noqa: T201 - this is the terminal


def spread(arguments: Sequence[str]) -> list[str]:
    """`--ink a b` as `--ink a --ink b`, for the options in `REPEATED`."""
    if not arguments or arguments[0] not in REPEATED:
        return list(arguments)
    many = REPEATED[arguments[0]]
    spelled: list[str] = []
    repeated: str | None = None
    for argument in arguments:
        if argument.startswith("-"):
            repeated = argument if argument in many else None
        elif repeated and spelled[-1] != repeated:
            spelled.append(repeated)
        spelled.append(argument)
    return spelled


def _verdict(error: BaseException) -> tuple[str, int]:
    """One line for a person, and the exit code."""
    from inklined.output import OutputError
    from physics.observables import ObservableError
    from physics.scene import SceneError
    from recognizer.outside.process import RecognizerError
    from sketch.files.errors import FileError
    from sketch.formula.parse import FormulaError
    from sketch.ink import InkError
    from sketch.page import SketchError
    from sketch.shapes import ShapeError

    match error:
        case typer.TyperException():
            return _one_line(error.format_message()) + " (--help shows the options)", 2
        case KeyboardInterrupt() | typer.Abort():
            return "interrupted", INTERRUPTED
        case (
            FileError()
            | InkError()
            | SketchError()
            | ShapeError()
            | FormulaError()
            | SceneError()
            | ObservableError()
            | OutputError()
            | RecognizerError()
        ):
            return _one_line(str(error)), 1
        case BrokenPipeError():
            # Whoever read our output has gone: say nothing, and let Python's own flush say nothing.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return "", 1
        case OSError():
            place = f"{error.filename}: " if error.filename else ""
            return _one_line(f"{place}{error.strerror or error}"), 1
        case _:
            fault = f"{type(error).__name__}: {error}"
            return (
                _one_line(f"a fault of inklined's own, {fault}; INKLINED_DEBUG=1 shows where"),
                70,
            )


def _one_line(text: str) -> str:
    return " ".join(text.split())
