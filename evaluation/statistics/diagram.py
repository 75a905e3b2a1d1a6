"""The critical-difference diagram of Demšar (JMLR 2006) as SVG: mean ranks on a line, bars over those that do not differ.

Frame: SVG pixels, y down; text and lines take the colour of the text around them.
"""

from __future__ import annotations

from html import escape

from evaluation.statistics.several import Ranking

WIDTH, LEFT, RIGHT, ROW = 640, 150, 150, 20


def critical_difference_diagram(of: Ranking) -> str:
    """SVG of the ranking; the best is to the left."""
    names, ranks = of.names, of.ranks
    most = len(names)
    span = WIDTH - LEFT - RIGHT

    def across(rank: float) -> float:
        return LEFT + span * (rank - 1) / max(most - 1, 1)

    axis = 56
    bars = axis + 14
    first = bars + 9 * len(of.groups) + 14
    half = (most + 1) // 2
    height = first + ROW * max(half, most - half) + 6
    pieces = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img" aria-label="Critical-difference diagram" font-family="system-ui, sans-serif" font-size="13" fill="currentColor">',
        _line(LEFT, 18, LEFT + span * of.critical / max(most - 1, 1), 18, 2.0),
        f'<text x="{LEFT}" y="12" font-size="11">critical difference {of.critical:.2f}</text>',
        _line(LEFT, axis, LEFT + span, axis, 1.0),
    ]
    for rank in range(1, most + 1):
        pieces.append(_line(across(rank), axis - 5, across(rank), axis, 1.0))
        pieces.append(
            f'<text x="{across(rank):.1f}" y="{axis - 9}" text-anchor="middle" font-size="11">{rank}</text>'
        )
    for k, (name, rank) in enumerate(zip(names, ranks, strict=True)):
        left = k < half
        y = first + ROW * (k if left else most - 1 - k)
        end, anchor = (LEFT - 12, "end") if left else (LEFT + span + 12, "start")
        pieces.append(_line(across(rank), axis, across(rank), y, 0.8))
        pieces.append(_line(across(rank), y, end + (4 if left else -4), y, 0.8))
        pieces.append(f'<text x="{end}" y="{y + 4}" text-anchor="{anchor}">{escape(name)} {rank:.2f}</text>')
    for k, group in enumerate(of.groups):
        y = bars + 9 * k
        pieces.append(_line(across(ranks[group[0]]) - 4, y, across(ranks[group[-1]]) + 4, y, 4.0))
    return "".join(pieces) + "</svg>"


def _line(x1: float, y1: float, x2: float, y2: float, width: float) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="currentColor" stroke-width="{width:g}"/>'
