"""The contest over strokes: every recognizer claims the same strokes, and is scored on them.

Raw claims are compared, before anybody asks whether a wire is attached to anything. What whole
pages add is `evaluation.page_contest`'s.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from evaluation.latency import Latency, latency
from evaluation.memory import Memory, memory
from evaluation.metrics.strokes import StrokeScores, score
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.rivals import resident, rival
from evaluation.suites import StrokeSuite, claim_of_row
from recognizer.claims import Claim, Recognizer
from sketch.ink import Ink
from sketch.page import STROKE_KINDS, StrokeKind

DIAGRAM_KINDS: tuple[StrokeKind, ...] = ("circle", "polygon", "wire", "spring", "math")
"""What a diagram is made of: the five kinds of which the published rules speak."""
BATCH = 200
"""Pages in one task: some 0.1 s of work, so that progress is seen and little is lost in sending."""


@dataclass(frozen=True, slots=True, eq=False)
class StrokeResult:
    """One recognizer on one suite of strokes.

    scores: over all scored rows; single, several: over rows of one stroke, and of more (a row's
    claim is then `claim_of_row`); five: over single strokes that truly are of `DIAGRAM_KINDS`;
    claimable: over rows whose kind this recognizer can claim; unclaimable: the others by label,
    those that are no stroke kind included; rejected: rows it would rather not have named;
    right: for each scored row whether its claim is its label; claimed, sure: what it was taken for, and how surely; memory: what
    it takes.
    """

    name: str
    scores: StrokeScores
    single: StrokeScores
    several: StrokeScores
    five: StrokeScores
    claimable: StrokeScores
    unclaimable: dict[str, int]
    rejected: int
    latency: Latency
    memory: Memory
    right: tuple[bool, ...]
    claimed: tuple[StrokeKind, ...]
    sure: tuple[float, ...]


def stroke_contest(
    suite: StrokeSuite, names: Sequence[str], workers: Workers = 1, progress: Progress = silent
) -> tuple[StrokeResult, ...]:
    """Runs the recognizers of these names over the suite, by the workers, then takes their
    latency in this one and their memory in one of their own. Raises ValueError for a name that is not known."""
    for k, name in enumerate(names):
        progress("Preparing recognizers", k, len(names))
        rival(name)
    progress("Preparing recognizers", len(names), len(names))
    claimed = _claims(suite.inks, names, workers, progress)
    results: list[StrokeResult] = []
    for k, name in enumerate(names):
        progress("Timing recognizers", k, len(names))
        results.append(_result(suite, name, rival(name), claimed[name]))
    progress("Timing recognizers", len(names), len(names))
    return tuple(results)


def _claims(
    inks: Sequence[Ink], names: Sequence[str], workers: Workers, progress: Progress
) -> dict[str, list[Claim]]:
    tasks = [(name, inks[k : k + BATCH]) for name in names for k in range(0, len(inks), BATCH)]
    claimed: dict[str, list[Claim]] = {name: [] for name in names}
    batches = in_parallel(_claim_batch, tasks, workers, "Recognizing strokes", progress)
    for (name, _), batch in zip(tasks, batches, strict=True):
        claimed[name].extend(batch)
    return claimed


def _claim_batch(task: tuple[str, Sequence[Ink]]) -> list[Claim]:
    name, inks = task
    here = resident(name)
    return [claim_of_row(here.recognize(ink)) for ink in inks]


def _result(suite: StrokeSuite, name: str, recognizer: Recognizer, claims: Sequence[Claim]) -> StrokeResult:
    labels = suite.labels

    def over(chosen: Sequence[bool]) -> StrokeScores:
        rows = [k for k, yes in enumerate(chosen) if yes]
        return score([labels[k] for k in rows], [claims[k] for k in rows])

    claimable = [label in recognizer.claims for label in labels]
    beyond = Counter(label for label in labels if label not in recognizer.claims)
    return StrokeResult(
        name=recognizer.name,
        scores=score(labels, claims),
        single=over(suite.single),
        several=over([not single for single in suite.single]),
        five=over([s and label in DIAGRAM_KINDS for s, label in zip(suite.single, labels, strict=True)]),
        claimable=over(claimable),
        unclaimable={**{kind: beyond[kind] for kind in STROKE_KINDS if beyond[kind]}, **suite.unknown},
        rejected=sum(claim.rejected for claim in claims),
        latency=latency(recognizer, suite.inks),
        memory=memory(name),
        right=tuple(claim.kind == label for claim, label in zip(claims, labels, strict=True)),
        claimed=tuple(claim.kind for claim in claims),
        sure=tuple(claim.confidence for claim in claims),
    )
