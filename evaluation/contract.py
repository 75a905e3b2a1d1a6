"""Does a recognizer keep to the contract of `recognizer.claims.Recognizer`? Checks that are run on every newcomer.

Each check says what was asked and what came. What breaks the contract is wrong; what merely makes a recognizer odd, as one
that cares where on the page a stroke stands, is remarked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Literal

import numpy as np

from recognizer.claims import Claim, Recognizer
from sketch.ink import Ink, Stroke
from sketch.page import STROKE_KINDS

Level = Literal["right", "odd", "wrong"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One check: its name, what it found, and the sentence that says so."""

    check: str
    level: Level
    text: str


def check_recognizer(recognizer: Recognizer, seed: int = 0) -> tuple[Finding, ...]:
    """Every check's finding. What a recognizer raises is found, not raised."""
    return tuple(_findings(recognizer, _drawn(seed)))


def passes(findings: Sequence[Finding]) -> bool:
    """Whether nothing is wrong."""
    return all(finding.level != "wrong" for finding in findings)


def _findings(recognizer: Recognizer, page: Ink) -> Iterator[Finding]:
    yield _introduction(recognizer)
    for name, ink in _inks(page).items():
        yield _guarded(name, lambda ink=ink: _answer(recognizer, ink))
    yield _guarded("the same again", lambda: _same(recognizer, page))
    yield _guarded("claims what it says", lambda: _declared(recognizer, page))
    yield _guarded("moved and scaled", lambda: _moved(recognizer, page))
    yield _guarded("alone or together", lambda: _alone(recognizer, page))
    yield _guarded("time", lambda: _time(recognizer, page))


def _inks(page: Ink) -> dict[str, Ink]:
    """Ink that has broken recognizers, by what it is."""
    one = page[0]
    far = np.random.default_rng(0).uniform(-1e8, 1e8, (40, 2))
    angle = np.linspace(0, 40 * np.pi, 20_000)
    return {
        "an empty page": Ink(),
        "a dot": Ink((Stroke([[5, 5]]),)),
        "a dot of many points": Ink((Stroke([[5, 5]] * 30, [0.01 * k for k in range(30)]),)),
        "two points": Ink((Stroke([[0, 0], [1, 1]]),)),
        "no times": Ink(tuple(Stroke(stroke.points) for stroke in page)),
        "all at one time": Ink((Stroke(one.points, np.zeros(len(one))),)),
        "coordinates of a hundred million": Ink((Stroke(far),)),
        "coordinates of a millionth": Ink((one.moved_to(one.points * 1e-6),)),
        "a stroke of 20,000 points": Ink(
            (Stroke(np.column_stack([angle * np.cos(angle), angle * np.sin(angle)])),)
        ),
        "a page of strokes": page,
    }


def _introduction(recognizer: Recognizer) -> Finding:
    check = "introduction"
    name, claims = getattr(recognizer, "name", None), getattr(recognizer, "claims", None)
    if not isinstance(name, str) or not name:
        return Finding(check, "wrong", f"its name is {name!r}; it must be text")
    if not isinstance(claims, frozenset | set) or not claims:
        return Finding(check, "wrong", f"claims is {claims!r}; it must be a set of kinds that it can claim")
    strange = sorted(map(str, claims - set(STROKE_KINDS)))
    if strange:
        return Finding(
            check, "wrong", f"it claims {', '.join(strange)}; the kinds are {', '.join(STROKE_KINDS)}"
        )
    return Finding(
        check, "right", f"{name}, for {', '.join(kind for kind in STROKE_KINDS if kind in claims)}"
    )


def _answer(recognizer: Recognizer, ink: Ink) -> tuple[Level, str]:
    claims: Any = recognizer.recognize(ink)
    if not isinstance(claims, tuple | list):
        return "wrong", f"it answers with a {type(claims).__name__}; needed is a tuple of claims"
    if len(claims) != len(ink):
        return "wrong", f"it gives {len(claims)} claims for {len(ink)} strokes; needed is one for each"
    other = next((claim for claim in claims if not isinstance(claim, Claim)), None)
    if other is not None:
        return "wrong", f"it gives a {type(other).__name__} where a recognizer.claims.Claim is needed"
    return "right", f"{len(claims)} claims"


def _same(recognizer: Recognizer, page: Ink) -> tuple[Level, str]:
    first, second = _scores(recognizer, page), _scores(recognizer, page)
    if not np.array_equal(first, second):
        return (
            "wrong",
            f"the same page gets other scores the second time, by up to {np.abs(first - second).max():.2g}",
        )
    return "right", "the same page gets the same claims"


def _declared(recognizer: Recognizer, page: Ink) -> tuple[Level, str]:
    claimed = {claim.kind for claim in recognizer.recognize(page)}
    beyond = [kind for kind in STROKE_KINDS if kind in claimed - recognizer.claims]
    if beyond:
        return "wrong", f"it claims {', '.join(beyond)}, which are not among its claims"
    return (
        "right",
        f"of {len(page)} strokes it claims {', '.join(kind for kind in STROKE_KINDS if kind in claimed)}",
    )


def _moved(recognizer: Recognizer, page: Ink) -> tuple[Level, str]:
    there = Ink(tuple(stroke.moved_to(3.0 * stroke.points + (700.0, -250.0)) for stroke in page))
    return _compared(_scores(recognizer, page), _scores(recognizer, there), "moved and three times as large")


def _alone(recognizer: Recognizer, page: Ink) -> tuple[Level, str]:
    alone = np.stack([_scores(recognizer, Ink((stroke,)))[0] for stroke in page])
    level, text = _compared(_scores(recognizer, page), alone, "each alone on its page")
    return ("right", f"{text}: it uses context") if level == "odd" else (level, text)


def _compared(here: Any, there: Any, how: str) -> tuple[Level, str]:
    other = int((here.argmax(axis=1) != there.argmax(axis=1)).sum())
    if other:
        return "odd", f"{how}, {other} of {len(here)} strokes are taken for something else"
    return "right", f"{how}, the strokes are taken for the same"


def _time(recognizer: Recognizer, page: Ink) -> tuple[Level, str]:
    begun = perf_counter()
    recognizer.recognize(page)
    took = 1000 * (perf_counter() - begun) / len(page)
    return ("odd" if took > 100 else "right"), f"{took:.1f} ms a stroke"


def _scores(recognizer: Recognizer, ink: Ink) -> Any:
    return np.array([claim.scores for claim in recognizer.recognize(ink)])


def _guarded(check: str, run: Callable[[], tuple[Level, str]]) -> Finding:
    try:
        return Finding(check, *run())
    except Exception as error:
        return Finding(
            check, "wrong", f"it raises {type(error).__name__}: {' '.join(str(error).split())[:300]}"
        )


def _drawn(seed: int) -> Ink:
    """Generated strokes of all kinds on one page, in rows."""
    from data_gen.strokes import generate

    strokes: list[Stroke] = []
    for k, item in enumerate(generate(36, seed)):
        points = item.stroke.points - item.stroke.points.min(axis=0) + (500.0 * (k % 6), 500.0 * (k // 6))
        strokes.append(item.stroke.moved_to(points))
    return Ink(tuple(strokes))
