"""A line of the formula language as handwriting: which glyph stands where, on one line of text.

Frame: y down, the baseline at 0, lengths in heights of a capital letter until `line` scales them to
page units. Proportions (x-height 0.62, scripts at 0.65, fraction bars on the axis of `+` and `=`)
are those of a school copybook; a writer's slant, stretch and size are then laid over them. Every
glyph is fitted into its own slot, since the allographs' own boxes say nothing of the baseline.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from data_gen.glyphs.alphabet import strokes, variants
from data_gen.writers import Writer
from sketch.formula.lexer import FormulaError, Token, tokens
from sketch.geometry import bounding_box
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class Proportions:
    """Lengths in capital heights."""

    x_height: float = 0.62
    descent: float = 0.32
    axis: float = 0.38
    """Height of fraction bars, minus signs and the middle of `=` and `+` above the baseline."""
    gap: float = 0.14
    """Between letters of a product."""
    space: float = 0.38
    """Around `=`, `+` and `−`."""
    script: float = 0.65
    sub_drop: float = 0.28
    super_rise: float = 0.55
    bar_gap: float = 0.14
    """Between a fraction's bar (or a root's) and what stands under or over it."""
    uneven: float = 0.03
    """Standard deviation of a glyph's baseline and (twice that) of the logarithm of its size."""
    loose: float = 0.25
    """Relative standard deviation of gaps."""
    other_way: float = 0.12
    """Share of glyphs that a writer forms otherwise than usual."""
    stacked: float = 0.7
    """Share of writers who put a fraction's numerator over a bar; the rest use a slash."""


PROPORTIONS = Proportions()


@dataclass(frozen=True, slots=True, eq=False)
class Written:
    """Strokes of a piece of a line: paths, each (n, 2); left 0, right `width`, from top (negative) to
    bottom below the baseline."""

    paths: tuple[FloatArray, ...]
    width: float
    top: float
    bottom: float

    def moved(self, x: float, y: float) -> Written:
        shift = np.array([x, y])
        return Written(tuple(path + shift for path in self.paths), self.width, self.top + y, self.bottom + y)

    def scaled(self, factor: float) -> Written:
        return Written(
            tuple(path * factor for path in self.paths),
            self.width * factor,
            self.top * factor,
            self.bottom * factor,
        )


@dataclass(frozen=True, slots=True)
class Hand:
    """How one writer forms glyphs: the habits, the usual allographs, and the chance of the moment."""

    writer: Writer
    usual: int
    stacked: bool
    rng: np.random.Generator = field(repr=False)


def hand(writer: Writer, rng: np.random.Generator) -> Hand:
    """The writer's choices for a whole page: an allograph for each symbol, the form of fractions."""
    return Hand(writer, int(rng.integers(1 << 16)), bool(rng.random() < PROPORTIONS.stacked), rng)


def line(text: str, by: Hand) -> tuple[FloatArray, ...]:
    """The strokes of a formula in writing order, each (n, 2) page units, the line's centre at (0, 0).

    Raises FormulaError when the text is no formula, KeyError for a letter that has no glyph.
    """
    queue = _Queue(text, tokens(text))
    row = _row(queue, by, ())
    queue.expect("end")
    slanted = [path @ np.array([[1.0, 0.0], [-by.writer.slant, 1.0]]) for path in row.paths]
    low, high = bounding_box(np.concatenate(slanted))
    return tuple((path - (low + high) / 2) * by.writer.height for path in slanted)


class _Queue:
    """Tokens yet to be written."""

    def __init__(self, text: str, found: list[Token]) -> None:
        self.text, self._found, self._at = text, found, 0

    def peek(self) -> str:
        return self._found[self._at].kind

    def take(self) -> Token:
        self._at += 1
        return self._found[self._at - 1]

    def expect(self, kind: str) -> None:
        token = self.take()
        if token.kind != kind:
            raise FormulaError(
                f"{kind!r} was expected here, not {token.value or 'the end'!r}", self.text, token.start
            )


_CLOSING = {"(": ")", "[": "]", "{": "}", "|": "|", "‖": "‖"}


def _row(queue: _Queue, by: Hand, stop: tuple[str, ...]) -> Written:
    """What stands side by side until a token of kind `stop` or the end, neither taken."""
    pieces: list[Written] = []
    room: list[float] = []  # what each piece asks for on its left beyond the usual gap
    sign_space = PROPORTIONS.space - PROPORTIONS.gap
    operand = False  # whether what stands last is an operand, so that a sign after it joins two
    lone = False  # whether what stands last is the sign of one number
    while queue.peek() not in (*stop, "end"):
        kind = queue.peek()
        if kind == "*":
            queue.take()
        elif kind in ("/", "^") and not operand:
            raise FormulaError(f"{kind!r} needs something before it", queue.text, queue.take().start)
        elif kind == "/":
            queue.take()
            pieces[-1:] = [_fraction(pieces[-1], _atom(queue, by)[1], by)]
        elif kind == "^":
            queue.take()
            pieces[-1:] = [_raised(pieces[-1], _atom(queue, by)[1], by)]
        elif kind in ("=", "+", "-", ","):
            queue.take()
            room.append(sign_space if pieces and kind != "," else 0.0)
            pieces.append(_glyph(kind, by))
            operand, lone = False, not operand and kind != "="
        else:
            whole, bare = _atom(queue, by)
            # A bracket round a numerator is for the keyboard; over a bar it is not written.
            pieces.append(bare if queue.peek() == "/" and by.stacked else whole)
            after_sign = len(pieces) > 1 and not operand and not lone
            apart = kind in ("function", "|", "‖")
            room.append(sign_space if after_sign else PROPORTIONS.gap if apart and operand else 0.0)
            operand = True
    return _row_of(pieces, _loosened(pieces, room, by))


def _atom(queue: _Queue, by: Hand) -> tuple[Written, Written]:
    """One factor: as it stands in a row, and without the brackets that only group it."""
    token = queue.take()
    match token.kind:
        case "number" | "function":
            both = _word(list(token.value), by)
        case "name":
            letter, _, below = token.value.partition("_")
            both = _glyph(_symbol(letter), by)
            if below:
                both = _lowered(both, _word(list(below), by), by)
        case "sqrt":
            both = _root(_atom(queue, by)[1], by)
        case "frac":
            over, under = _atom(queue, by)[1], _atom(queue, by)[1]
            both = _fraction(over, under, by)
        case "(" | "[" | "{" | "|" | "‖":
            inner = _row(queue, by, (_CLOSING[token.kind],))
            queue.expect(_CLOSING[token.kind])
            return (inner if token.kind == "{" else _bracketed(token.kind, inner, by)), inner
        case "-" | "+":
            sign, (_, number) = _glyph(token.kind, by), _atom(queue, by)
            both = _beside([sign, number], by)
        case _:
            raise FormulaError(f"{token.value or 'the end'!r} cannot stand here", queue.text, token.start)
    return both, both


def _word(signs: Sequence[str], by: Hand) -> Written:
    return _beside([_glyph(_symbol(sign), by) for sign in signs], by)


def _beside(pieces: Sequence[Written], by: Hand) -> Written:
    return _row_of(pieces, _loosened(pieces, (), by))


def _row_of(pieces: Sequence[Written], gaps: Sequence[float]) -> Written:
    """Pieces from left to right; gaps[k] is the room left before piece k."""
    at, paths = 0.0, list[FloatArray]()
    for piece, gap in zip(pieces, gaps, strict=True):
        at += gap
        paths.extend(piece.moved(at, 0.0).paths)
        at += piece.width
    top = min((piece.top for piece in pieces), default=-1.0)
    bottom = max((piece.bottom for piece in pieces), default=0.0)
    return Written(tuple(paths), at, top, bottom)


def _loosened(pieces: Sequence[Written], extra: Sequence[float], by: Hand) -> list[float]:
    """The room before each piece: the usual gap and what its neighbours ask for, unevenly kept."""
    if not pieces:
        return []
    asked = np.asarray(extra) if len(extra) else np.zeros(len(pieces))
    spread = 1 + PROPORTIONS.loose * np.clip(by.rng.standard_normal(len(pieces)), -2, 2)
    gaps = (PROPORTIONS.gap + asked) * spread
    gaps[0] = 0.0
    return gaps.tolist()


def _lowered(base: Written, below: Written, by: Hand) -> Written:
    """A subscript."""
    small = below.scaled(PROPORTIONS.script)
    drop = PROPORTIONS.sub_drop * (1 + PROPORTIONS.loose * by.rng.uniform(-1, 1))
    return _row_of([base, small.moved(0, drop)], [0.0, 0.5 * PROPORTIONS.gap])


def _raised(base: Written, above: Written, by: Hand) -> Written:
    """An exponent."""
    rise = PROPORTIONS.super_rise * (1 + PROPORTIONS.loose * by.rng.uniform(-1, 1))
    small = above.scaled(PROPORTIONS.script)
    return _row_of([base, small.moved(0, -rise + min(0.0, base.top + 1))], [0.0, 0.5 * PROPORTIONS.gap])


def _fraction(over: Written, under: Written, by: Hand) -> Written:
    """One over the other with a bar between, or both beside a slash."""
    if not by.stacked:
        return _beside([over, _glyph("/", by), under], by)
    width = max(over.width, under.width) + 2 * PROPORTIONS.gap
    above = over.moved((width - over.width) / 2, -PROPORTIONS.axis - PROPORTIONS.bar_gap - _reach(over)[1])
    beneath = under.moved(
        (width - under.width) / 2, -PROPORTIONS.axis + PROPORTIONS.bar_gap - _reach(under)[0]
    )
    bar = np.array([[0.0, -PROPORTIONS.axis], [width, -PROPORTIONS.axis]])
    paths = (*above.paths, bar, *beneath.paths)
    return Written(paths, width, above.top, beneath.bottom)


def _reach(piece: Written) -> tuple[float, float]:
    """How far up and down its ink goes; slots say where it should."""
    heights = np.concatenate([path[:, 1] for path in piece.paths])
    return float(heights.min()), float(heights.max())


def _root(inner: Written, by: Hand) -> Written:
    """A hook, a rising line and a bar over what stands under it, in one stroke."""
    top, bottom = _reach(inner)[0] - PROPORTIONS.bar_gap, inner.bottom
    lead = 0.45 * (1 + PROPORTIONS.loose * by.rng.uniform(-1, 1))
    low = bottom - 0.42 * (bottom - top)
    sign = np.array(
        [
            [0, low + 0.1],
            [0.3 * lead, low],
            [0.55 * lead, bottom],
            [lead, top],
            [lead + inner.width + 0.1, top],
        ]
    )
    paths = (sign, *inner.moved(lead + 0.05, 0).paths)
    return Written(paths, lead + inner.width + 0.1, top, bottom)


def _bracketed(sign: str, inner: Written, by: Hand) -> Written:
    """Brackets or bars as tall as what they hold."""
    top, bottom = min(inner.top, -1.0) - 0.12, max(inner.bottom, 0.0) + 0.12
    marks = [
        _fitted(_symbol(mark), by, top, bottom, width=None if mark in "|‖" else 0.22)
        for mark in (sign, _CLOSING[sign])
    ]
    return _row_of([marks[0], inner, marks[1]], [0.0, PROPORTIONS.gap, PROPORTIONS.gap])


_ALIKE = {"0": "O", "‖": "\\Vert"}
"""Signs written with another's allographs."""


def _symbol(name: str) -> str:
    """The glyph's name for a sign or for a canonical letter name (`theta`)."""
    return f"\\{name}" if len(name) > 1 else name


_HIGH = -1.0
_X = -PROPORTIONS.x_height
_LOW = PROPORTIONS.descent
_SLOTS: dict[str, tuple[float, float]] = {
    **dict.fromkeys("acemnorsuvwxz", (_X, 0.0)),
    **dict.fromkeys("gpqy", (_X, _LOW)),
    **{f"\\{name}": (_X, 0.0) for name in ("alpha", "pi", "omega", "sigma", "epsilon", "tau")},
    **{f"\\{name}": (_X, _LOW) for name in ("mu", "gamma", "rho", "eta")},
    **{f"\\{name}": (_HIGH, _LOW) for name in ("beta", "phi")},
    "f": (_HIGH, 0.2),
    "i": (-0.9, 0.0),
    "j": (-0.9, _LOW),
    "t": (-0.88, 0.0),
    "/": (-1.1, 0.12),
    "+": (-PROPORTIONS.axis - 0.25, -PROPORTIONS.axis + 0.25),
    "=": (-PROPORTIONS.axis - 0.13, -PROPORTIONS.axis + 0.13),
    "-": (-PROPORTIONS.axis, -PROPORTIONS.axis),
    ".": (-0.08, 0.0),
    ",": (-0.1, 0.2),
}
"""Top and bottom of a glyph against the baseline; whatever is not here is as tall as a capital."""
_WIDTHS: dict[str, float] = {"+": 0.5, "=": 0.5, "-": 0.45, ".": 0.08, ",": 0.08, "0": 0.55}
"""Widths of glyphs whose height says nothing of it; of others the allograph's own aspect."""


def _glyph(symbol: str, by: Hand) -> Written:
    top, bottom = _SLOTS.get(symbol, (_HIGH, 0.0))
    return _fitted(symbol, by, top, bottom, _WIDTHS.get(symbol))


def _fitted(symbol: str, by: Hand, top: float, bottom: float, width: float | None) -> Written:
    """The writer's allograph in its slot, unevenly: size and baseline waver from glyph to glyph."""
    glyph = _ALIKE.get(symbol, symbol)
    ways = variants(glyph)
    usual = by.rng.random() >= PROPORTIONS.other_way
    way = strokes(glyph, by.usual % ways if usual else int(by.rng.integers(ways)))
    low, high = bounding_box(np.concatenate(way))
    size = high - low
    grown = np.exp(2 * PROPORTIONS.uneven * by.rng.standard_normal())
    sunk = PROPORTIONS.uneven * by.rng.standard_normal()
    tall = (bottom - top) / size[1] if size[1] > 0 else 0.0
    # Thin glyphs (1, |, l) have no width of their own; the others stay within a letter's proportions.
    own = float(np.clip(size[0] * tall, 0.0, 1.1 * (bottom - top)))
    wide = (own if width is None else width) * float(np.exp(by.writer.stretch)) / max(float(size[0]), 1e-9)
    scale = grown * np.array([wide if size[0] > 0 else 1.0, tall])
    paths = tuple((path - [low[0], high[1]]) * scale + [0.0, bottom + sunk] for path in way)
    return Written(paths, float(size[0] * scale[0]), top, bottom)
