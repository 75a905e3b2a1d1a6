"""The lines and arcs of a path, and where its pen was slow: see `recognizer.geometric.corners`."""

from __future__ import annotations

from math import atan2, hypot, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from recognizer.jit import kernel, part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

FINER = 4
"""Moments looked at between two even points when the pen's speed is taken."""


@kernel
def slowness(points: FloatArray, times: FloatArray, count: int, reach: float, away: float) -> FloatArray:
    """Logarithm of the time that the pen took to pass within `reach` of each of `count` even points, over what it took for
    as much at the quickest place up to `away` to either side (the geometric mean of the two): (count,). 0 where the path has
    no room; NaN everywhere where no time passes. Lengths in the frame of the points."""
    n = len(points)
    travelled = np.zeros(n)
    for i in range(1, n):
        travelled[i] = travelled[i - 1] + hypot(
            points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1]
        )
    total, lasted = travelled[-1], times[-1] - times[0]
    if not (total > 0.0 and lasted > 0.0):
        return np.full(count, np.nan)
    moments = FINER * (count - 1) + 1
    step = total / (moments - 1)
    passed = np.empty(moments)
    piece = 0
    for k in range(moments):
        while piece < n - 2 and travelled[piece + 1] < k * step:
            piece += 1
        span = travelled[piece + 1] - travelled[piece]
        share = (k * step - travelled[piece]) / span if span > 0 else 1.0
        passed[k] = times[piece] + share * (times[piece + 1] - times[piece])
    passed[-1] = times[-1]
    near = max(round(reach / step), 1)
    far = max(round(away / step), near + 1)
    least = 1e-3 * lasted
    spent = np.full(moments, np.inf)
    for k in range(near, moments - near):
        spent[k] = max(passed[k + near] - passed[k - near], least)
    slow = np.zeros(count)
    for place in range(count):
        k = FINER * place
        if k < near or k >= moments - near:
            continue
        before = after = np.inf
        for away_by in range(near, far + 1):
            if k - away_by >= near:
                before = min(before, spent[k - away_by])
            if k + away_by < moments - near:
                after = min(after, spent[k + away_by])
        if before == np.inf:
            before = after
        if after == np.inf:
            after = before
        if before < np.inf:
            slow[place] = log(spent[k]) - 0.5 * (log(before) + log(after))
    return slow


@kernel
def cut(
    path: FloatArray, prices: FloatArray, scale: float, arc: float, tightest: float, widest: float
) -> tuple[IntArray, NDArray[np.bool_]]:
    """The lines and arcs that explain an equally spaced path best for what they cost: the indices where they begin and
    end, (k + 1,), and which are arcs, (k,). prices: of a piece that ends at each point, (n,); scale: what squared
    distances are multiplied by; arc: what an arc costs more.

    Errors from running sums: of a line by total least squares, of an arc by Kåsa's circle, its algebraic error over
    (2 r)² for the distance (Taubin 1991). Optimal by dynamic programming (Bellman 1961): n² of both.
    """
    n = len(path)
    total = np.full(n, np.inf)
    total[0] = 0.0
    before = np.zeros(n, dtype=np.int64)
    bent = np.zeros(n, dtype=np.bool_)
    step = hypot(path[1, 0] - path[0, 0], path[1, 1] - path[0, 1])
    for i in range(n - 1):
        sx = sy = sz = sxx = sxy = syy = sxz = syz = szz = 0.0
        for j in range(i, n):
            x, y = path[j, 0], path[j, 1]
            z = x * x + y * y
            sx += x
            sy += y
            sz += z
            sxx += x * x
            sxy += x * y
            syy += y * y
            sxz += x * z
            syz += y * z
            szz += z * z
            if j == i:
                continue
            m = j - i + 1
            xx, xy, yy = sxx - sx * sx / m, sxy - sx * sy / m, syy - sy * sy / m
            error = max(0.5 * (xx + yy) - hypot(0.5 * (xx - yy), xy), 0.0) * scale
            is_arc = False
            determinant = xx * yy - xy * xy
            if m > 3 and error > arc and determinant > 1e-15:
                xz, yz, zz = sxz - sx * sz / m, syz - sy * sz / m, szz - sz * sz / m
                a = (xz * yy - yz * xy) / determinant  # a, b: twice the centre
                b = (yz * xx - xz * xy) / determinant
                square = (sz - a * sx - b * sy) / m + 0.25 * (a * a + b * b)  # of the radius
                if square > tightest * tightest and (m - 1) * step < widest * sqrt(square):
                    curved = max(zz - a * xz - b * yz, 0.0) / (4 * square) * scale + arc
                    if curved < error:
                        error, is_arc = curved, True
            reached = total[i] + error + prices[j]
            if reached < total[j]:
                total[j], before[j], bent[j] = reached, i, is_arc
    count, last = 1, n - 1
    while last > 0:
        count, last = count + 1, before[last]
    ends = np.empty(count, dtype=np.int64)
    last = n - 1
    for k in range(count - 1, -1, -1):
        ends[k] = last
        last = before[last]
    return ends, bent[ends[1:]]


@kernel
def described(path: FloatArray, ends: IntArray, bent: NDArray[np.bool_]) -> FloatArray:
    """Of each piece of a path its heading where it begins and where it ends, radians, its length and its radius,
    infinite for a line: (k, 4)."""
    found = np.empty((len(bent), 4))
    for k in range(len(bent)):
        run = path[ends[k] : ends[k + 1] + 1]
        length = 0.0
        for i in range(1, len(run)):
            length += hypot(run[i, 0] - run[i - 1, 0], run[i, 1] - run[i - 1, 1])
        begins, finishes, radius = _arc(run) if bent[k] else _line(run)
        found[k, 0], found[k, 1], found[k, 2], found[k, 3] = begins, finishes, length, radius
    return found


@part
def _line(run: FloatArray) -> tuple[float, float, float]:
    """Heading of the best line through a run of points, in the sense in which they follow it."""
    mx, my = run[:, 0].mean(), run[:, 1].mean()
    xx = xy = yy = 0.0
    for i in range(len(run)):
        x, y = run[i, 0] - mx, run[i, 1] - my
        xx += x * x
        xy += x * y
        yy += y * y
    way = 0.5 * atan2(2 * xy, xx - yy)
    if np.cos(way) * (run[-1, 0] - run[0, 0]) + np.sin(way) * (run[-1, 1] - run[0, 1]) < 0:
        way += pi
    return way, way, np.inf


@part
def _arc(run: FloatArray) -> tuple[float, float, float]:
    """Headings at both ends of the circle through a run of points (Kåsa), and its radius."""
    n = len(run)
    mx, my = run[:, 0].mean(), run[:, 1].mean()
    xx = xy = yy = xz = yz = 0.0
    for i in range(n):
        x, y = run[i, 0] - mx, run[i, 1] - my
        z = x * x + y * y
        xx += x * x
        xy += x * y
        yy += y * y
        xz += x * z
        yz += y * z
    determinant = xx * yy - xy * xy
    cx = mx + 0.5 * (xz * yy - yz * xy) / determinant
    cy = my + 0.5 * (yz * xx - xz * xy) / determinant
    radius = turned = 0.0
    for i in range(n):
        x, y = run[i, 0] - cx, run[i, 1] - cy
        radius += hypot(x, y) / n
        if i > 0:
            px, py = run[i - 1, 0] - cx, run[i - 1, 1] - cy
            turned += atan2(px * y - py * x, px * x + py * y)
    side = 0.5 * pi if turned > 0 else -0.5 * pi
    begins = atan2(run[0, 1] - cy, run[0, 0] - cx) + side
    return begins, atan2(run[-1, 1] - cy, run[-1, 0] - cx) + side, radius
