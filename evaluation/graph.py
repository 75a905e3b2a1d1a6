"""A small line graph as SVG, for curves through time or along an axis, with their intervals where they have any.

Frame: SVG pixels, y down, inside a viewBox; text and axes take the colour of the text around them
(`currentColor`), so that the graph suits light and dark pages.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from sketch.ink import FloatArray

COLOURS = ("#3b7dd8", "#d8703b", "#3b9c6b", "#a05bc0", "#b8952a", "#c0506b")
"""One a curve, in turn; mid-tones that read on white and on near-black. Beyond them curves are dashed."""
MARKED = 25
"""Curves of so many points at most have each of them marked: between them nothing was measured."""

SMALLEST = 0.05
"""Step of an axis at least, in its unit: what stands still must not look alive for its rounding errors."""


@dataclass(frozen=True, slots=True)
class GraphLayout:
    """Pixels."""

    width: int = 320
    height: int = 170
    left: int = 44
    right: int = 12
    top: int = 24
    bottom: int = 34
    ticks: int = 4
    """About so many steps along an axis."""
    letter: float = 5.4
    """Width of a letter of the curves' names, which stand in rows above the axes;"""
    row: int = 13
    """and a row's height."""
    points: int = 200
    """A curve of more points is thinned to so many: more than there are pixels is waste."""


LAYOUT = GraphLayout()


def line_graph(
    curves: Mapping[str, tuple[FloatArray, FloatArray]],
    x_label: str,
    y_label: str,
    layout: GraphLayout = LAYOUT,
    bands: Mapping[str, tuple[FloatArray, FloatArray]] | None = None,
    guide: tuple[FloatArray, FloatArray] | None = None,
) -> str:
    """SVG of curves by name, each (x, y) of (n,) values; axes start at 0 or below the smallest value.
    Values that are not finite break the curve. Without any finite value the axes stand alone.

    bands: for curves of these names how low and how high each value may be, (n,) each; guide: a dotted line to compare with."""
    spread = bands or {}
    xs = _finite([x for x, _ in curves.values()])
    ys = _finite([*(y for _, y in curves.values()), *(end for band in spread.values() for end in band)])
    x_ticks, y_ticks = _ticks(xs, layout.ticks), _ticks(ys, layout.ticks)
    wide = layout.width - layout.left - layout.right
    high = layout.height - layout.top - layout.bottom
    legend = _rows(list(curves), len(y_label), layout)
    top = layout.top + layout.row * (len(legend) - 1)
    height = top + high + layout.bottom

    def across(x: float) -> float:
        return layout.left + wide * (x - x_ticks[0]) / (x_ticks[-1] - x_ticks[0])

    def down(y: float) -> float:
        return top + high * (1 - (y - y_ticks[0]) / (y_ticks[-1] - y_ticks[0]))

    opening = (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="graph" viewBox="0 0 {layout.width} {height}" '
        f'role="img" aria-label="{escape(y_label)} against {escape(x_label)}" '
        'font-family="system-ui, sans-serif" font-size="10" fill="currentColor">'
    )
    parts = [opening]
    floor = top + high
    for tick in x_ticks:
        parts.append(_line(across(tick), top, across(tick), floor))
        parts.append(_text(across(tick), floor + 12, f"{tick:g}", "middle"))
    for tick in y_ticks:
        parts.append(_line(layout.left, down(tick), layout.left + wide, down(tick)))
        parts.append(_text(layout.left - 5, down(tick) + 3.5, f"{tick:g}", "end"))
    parts.append(_text(layout.left + wide / 2, height - 6, x_label, "middle"))
    parts.append(_text(2, 12, y_label, "start"))

    def path(run: Sequence[tuple[float, float]]) -> str:
        return " ".join(f"{across(a):.1f},{down(b):.1f}" for a, b in run)

    if guide is not None:
        for run in _runs(*guide, layout.points):
            parts.append(
                f'<polyline points="{path(run)}" fill="none" stroke="currentColor" stroke-opacity="0.5" stroke-dasharray="1.5 3"/>'
            )
    for k, (name, (x, y)) in enumerate(curves.items()):
        colour = COLOURS[k % len(COLOURS)]
        dashes = ' stroke-dasharray="5 2"' if k >= len(COLOURS) else ""
        if name in spread:
            below, above = (list(zip(x.tolist(), end.tolist(), strict=True)) for end in spread[name])
            parts.append(
                f'<polygon points="{path([*below, *above[::-1]])}" fill="{colour}" fill-opacity="0.13"/>'
            )
        for run in _runs(x, y, layout.points):
            parts.append(
                f'<polyline points="{path(run)}" fill="none" stroke="{colour}" stroke-width="1.8"{dashes}/>'
            )
            if len(x) <= MARKED:
                parts += [f'<circle cx="{across(a):.1f}" cy="{down(b):.1f}" r="2" fill="{colour}"/>' for a, b in run]  # fmt: skip
    colour_of = {name: COLOURS[k % len(COLOURS)] for k, name in enumerate(curves)}
    for k, names in enumerate(legend):
        spans = (f'<tspan dx="8" fill="{colour_of[name]}">{escape(name)}</tspan>' for name in names)
        parts.append(
            f'<text x="{layout.width - layout.right}" y="{12 + layout.row * k}" text-anchor="end" font-weight="600">{"".join(spans)}</text>'
        )
    return "".join(parts) + "</svg>"


def _rows(names: Sequence[str], taken: int, layout: GraphLayout) -> list[list[str]]:
    """The names in rows that are wide enough; `taken` letters of the first are another's."""
    room = int((layout.width - layout.right) / layout.letter)
    rows: list[list[str]] = [[]]
    left = room - taken - 2
    for name in names:
        if len(name) + 2 > left and (rows[-1] or len(rows) == 1):
            rows.append([])
            left = room
        rows[-1].append(name)
        left -= len(name) + 2
    return rows


def _finite(arrays: Sequence[FloatArray]) -> FloatArray:
    values = np.concatenate([np.zeros(1), *arrays])
    return values[np.isfinite(values)]


def _ticks(values: FloatArray, count: int) -> list[float]:
    """Round numbers from at or below the smallest value to at or above the greatest."""
    low, high = float(values.min()), float(values.max())
    rough = max((high - low) / count, SMALLEST)
    power = 10.0 ** np.floor(np.log10(rough))
    step = float(min(s * power for s in (1, 2, 2.5, 5, 10) if s * power >= rough * (1 - 1e-9)))
    first, last = np.floor(low / step + 1e-9), np.ceil(high / step - 1e-9)
    return [float(round(k * step, 10)) for k in range(int(first), int(max(last, first + 1)) + 1)]


def _runs(x: FloatArray, y: FloatArray, most: int) -> list[list[tuple[float, float]]]:
    """The curve thinned to at most `most` points and cut where a value is not finite."""
    kept = (
        np.unique(np.linspace(0, len(x) - 1, min(most, len(x))).astype(int)) if len(x) else np.array([], int)
    )
    runs: list[list[tuple[float, float]]] = [[]]
    for k in kept.tolist():
        if np.isfinite(x[k]) and np.isfinite(y[k]):
            runs[-1].append((float(x[k]), float(y[k])))
        elif runs[-1]:
            runs.append([])
    return [run for run in runs if run]


def _line(x1: float, y1: float, x2: float, y2: float) -> str:
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
        'stroke="currentColor" stroke-opacity="0.15"/>'
    )


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill-opacity="0.75">{escape(words)}</text>'
