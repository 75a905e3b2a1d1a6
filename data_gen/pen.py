"""The motion of a pen along the paths it means to draw.

Kinematics after the sigma-lognormal model (Plamondon 1995; O'Reilly and Plamondon 2009): a
movement is the vector sum of strokelets, each travelling its own piece of the path with a
lognormal speed, the next one starting before the last has ended. Speed so follows curvature, and
corners are rounded by overlap in time as a hand rounds them.

Frame: page units, y down; seconds. Everything is vectorised over a ragged batch of strokes; the
random numbers of each stroke come from its own generator, so a stroke made alone is the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

from data_gen.perturb import bow, compose, field, sizes, wobble
from data_gen.writers import Writer, habits
from sketch.geometry import resample
from sketch.ink import FloatArray, Stroke

Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class PenRule:
    """Numbers of the pen motion."""

    path_points: int = 128
    """Points that carry the meant path: 14 for each loop of a spring with nine coils."""
    strokelet_turn: float = np.radians(65.0)
    """A new strokelet begins each time the path has turned this far: every corner, every sixth of a circle."""
    sigma: float = 0.35
    """Width of a strokelet's lognormal, log seconds: the skewed bell of measured speed profiles."""
    isochrony: float = 0.35
    """A strokelet's time grows as its length to this power: long ones are drawn faster (Viviani 1982)."""
    unit_length: float = 40.0
    """Page units that a strokelet of the writer's mean time covers."""
    shortest: float = 0.03
    """No strokelet is quicker than this, seconds: a tap of the finger."""
    reach: float = 2.6
    """A strokelet is followed over ± this many sigmas; the tails left out are 0.9 % of it and are rescaled."""
    slowest: float = 25.0
    """Strokelets of one stroke never take longer than this together, seconds."""
    fewest: int = 2
    """A stroke that moves has at least this many samples."""
    most: int = 300
    """More samples than this are thinned evenly; real strokes of these kinds stay below."""
    hook: tuple[float, float] = (0.02, 0.06)
    """Length of a hook, fraction of the stroke's size."""
    hook_most: float = 10.0
    """Hooks are never longer than this, page units: the hand's flick does not grow with the drawing."""
    shake: float = 9.0
    """Frequency of tremor, Hz: physiological tremor is 8 to 12 Hz."""


RULE = PenRule()


def draw(paths: Sequence[FloatArray], writer: Writer, rng: np.random.Generator) -> list[Stroke]:
    """Draws each path, (n, 2) page units, as one stroke of one writer; times start at 0 in each."""
    rngs = rng.spawn(len(paths))
    return strokes_from(draw_batch(paths, [writer] * len(paths), rngs))


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """Many strokes one below the other: points (P, 2), times (P,), pressure (P,); stroke k owns rows
    offsets[k] : offsets[k + 1]."""

    points: FloatArray
    times: FloatArray
    pressure: FloatArray
    offsets: Indices


def strokes_from(batch: Batch) -> list[Stroke]:
    """The batch as strokes, which own their points: a kept stroke does not keep its batch."""
    return [
        Stroke.trusted(batch.points[a:b].copy(), batch.times[a:b].copy(), batch.pressure[a:b].copy())
        for a, b in zip(batch.offsets[:-1].tolist(), batch.offsets[1:].tolist(), strict=True)
    ]


def draw_batch(
    paths: Sequence[FloatArray], writers: Sequence[Writer], rngs: Sequence[np.random.Generator]
) -> Batch:
    """Draws path k, (n, 2) page units, by writer k with the generator k."""
    if not paths:
        empty = np.empty(0)
        return Batch(np.empty((0, 2)), empty, empty, np.zeros(1, dtype=np.int64))
    habit = habits(writers)
    hand = compose(field(0.6 * habit["wobble"]), wobble(habit["wobble"]), bow(0.8 * habit["wobble"]))
    normals = np.array([rng.standard_normal(hand.draws + 8) for rng in rngs])
    hooked = [_hooked(path, share, rng) for path, share, rng in zip(paths, habit["hooks"], rngs, strict=True)]
    even = _late(np.array([resample(path, RULE.path_points) for path in hooked]), habit["late"])
    meant = hand.apply(even, normals[:, : hand.draws])
    points, times, offsets = _travel(meant, habit, normals[:, hand.draws :])
    points = _shaken(points, times, offsets, meant, habit, normals[:, hand.draws :], rngs)
    points = _rounded(points, np.repeat(habit["grid"], np.diff(offsets)))
    return Batch(points, times, _pressure(offsets, habit, normals[:, hand.draws :]), offsets)


def _hooked(path: FloatArray, share: float, rng: np.random.Generator) -> FloatArray:
    """The path with, now and then, a short hook where the pen comes down or leaves."""
    at_start, at_end, length, angle_start, angle_end = rng.random(5).tolist()
    if at_start >= share and at_end >= share:
        return path
    size = float(np.linalg.norm(path.max(axis=0) - path.min(axis=0)))
    reach = min(RULE.hook_most, size * (RULE.hook[0] + length * (RULE.hook[1] - RULE.hook[0])))
    pieces = [path]
    if at_start < share:
        angle = 2 * np.pi * angle_start
        pieces.insert(0, path[:1] + reach * np.array([[np.cos(angle), np.sin(angle)]]))
    if at_end < share:
        angle = 2 * np.pi * angle_end
        pieces.append(path[-1:] + reach * np.array([[np.cos(angle), np.sin(angle)]]))
    return np.concatenate(pieces)


def _late(paths: FloatArray, share: FloatArray) -> FloatArray:
    """The first share of each path as a straight line: what a device sees that wakes up late."""
    place = np.linspace(0.0, 1.0, paths.shape[1])
    seen = np.minimum((share * (paths.shape[1] - 1)).astype(int), paths.shape[1] - 1)
    slow = np.flatnonzero(seen)
    reach = place[seen[slow], None]
    start = paths[slow, :1]
    chord = start + (place / reach)[..., None] * (paths[slow, seen[slow]][:, None] - start)
    bridged = paths.copy()
    bridged[slow] = np.where((place < reach)[..., None], chord, paths[slow])
    return bridged


def _travel(
    meant: FloatArray, habit: dict[str, FloatArray], normals: FloatArray
) -> tuple[FloatArray, FloatArray, Indices]:
    """Sums the strokelets along the meant paths and samples the motion at the writer's rate."""
    owner, from_, to = _strokelets(meant)
    start, end, total = _timing(meant, owner, from_, to, habit, normals)
    samples = np.clip(np.ceil(total * habit["rate"]).astype(int) + 1, RULE.fewest, RULE.most)
    offsets = np.concatenate([[0], np.cumsum(samples)])
    stroke_of = np.repeat(np.arange(len(samples)), samples)
    interval = total / (samples - 1)
    clock = (np.arange(offsets[-1]) - offsets[stroke_of]) * interval[stroke_of]
    # What the strokelets that are done have moved is where the first one still to be done begins.
    opening = np.minimum((start / interval[owner]).astype(int) + 1, samples[owner])
    closing = np.minimum(np.ceil(end / interval[owner]).astype(int), samples[owner] - 1)
    finished = np.bincount(offsets[owner] + closing, minlength=int(offsets[-1]))
    ended = np.cumsum(finished)
    pending = np.minimum(
        ended, (np.searchsorted(owner, np.arange(len(samples)), side="right") - 1)[stroke_of]
    )
    # Points as complex numbers: one gather serves both coordinates.
    flat = np.ascontiguousarray(meant).view(np.complex128).ravel()
    row0 = owner * meant.shape[1]
    origin = flat[row0 + from_]
    reached = np.where(ended > pending, flat[row0 + to][pending], origin[pending])
    # The strokelets under way at each sample, as flat pairs.
    lengths = np.maximum(closing - opening, 0)
    strokelet = np.repeat(np.arange(len(owner)), lengths)
    into = np.arange(lengths.sum()) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    sample = (offsets[owner] + opening)[strokelet] + into
    share = _lognormal_progress((clock[sample] - start[strokelet]) / (end - start)[strokelet])
    place = from_[strokelet] + share * (to - from_)[strokelet]
    low = np.minimum(place.astype(int), meant.shape[1] - 2)
    row = row0[strokelet] + low
    here = flat[row]
    moved = here + (place - low) * (flat[row + 1] - here) - origin[strokelet]
    points = reached.view(np.float64).reshape(-1, 2)
    points[:, 0] += np.bincount(sample, weights=moved.real, minlength=len(clock))
    points[:, 1] += np.bincount(sample, weights=moved.imag, minlength=len(clock))
    return points, clock, offsets


def _strokelets(meant: FloatArray) -> tuple[Indices, Indices, Indices]:
    """Cuts each path where it has turned enough: owner, first and last path point of each strokelet."""
    steps = meant.shape[1] - 1
    x, y = np.diff(meant[..., 0], axis=1), np.diff(meant[..., 1], axis=1)
    bend = np.arctan2(
        x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:], x[:, :-1] * x[:, 1:] + y[:, :-1] * y[:, 1:]
    )
    # A strokelet begins at path point j + 1 where the turn so far passes a whole number.
    turned = (np.cumsum(np.abs(bend), axis=1) * (1 / RULE.strokelet_turn)).astype(int)
    first = np.ones((len(meant), steps), dtype=bool)
    first[:, 1] = turned[:, 0] > 0
    np.greater(turned[:, 1:], turned[:, :-1], out=first[:, 2:])
    owner, from_ = np.nonzero(first)
    last = np.concatenate([owner[1:] != owner[:-1], [True]])
    return owner, from_, np.where(last, steps, np.concatenate([from_[1:], [0]]))


def _timing(
    meant: FloatArray,
    owner: Indices,
    from_: Indices,
    to: Indices,
    habit: dict[str, FloatArray],
    normals: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Start and end of each strokelet and the total time of each stroke, seconds; ends are in order."""
    share = (to - from_) / (meant.shape[1] - 1)
    pieces = np.bincount(owner)
    first = np.searchsorted(owner, np.arange(len(pieces)))
    rank = np.arange(len(owner)) - first[owner]
    length = np.hypot(np.diff(meant[..., 0], axis=1), np.diff(meant[..., 1], axis=1)).sum(axis=1)
    duration = (share * length[owner] / RULE.unit_length) ** RULE.isochrony / habit["speed"][owner]
    duration = np.maximum(duration, RULE.shortest)
    duration *= np.exp(0.12 * normals[owner, rank % 6])
    start, end, total = (np.zeros(len(owner)), np.zeros(len(owner)), np.zeros(len(pieces)))
    for turn in range(int(pieces.max())):
        now = first[pieces > turn] + turn
        begin = np.zeros(len(now))
        if turn > 0:
            shared = np.minimum(duration[now - 1], duration[now])
            begin = end[now - 1] - habit["overlap"][owner[now]] * shared
        start[now], end[now] = begin, begin + duration[now]
        total[owner[now]] = end[now]
    squeeze = np.minimum(1.0, RULE.slowest / total)
    return start * squeeze[owner], end * squeeze[owner], total * squeeze


def _lognormal_progress(phase: FloatArray) -> FloatArray:
    """Share of a strokelet done at a phase of its time (0 start, 1 end): a lognormal's distribution function.

    The bell is cut at ± `reach` sigmas and rescaled, so that 0 and 1 are met exactly.
    """
    low, high = np.exp(-RULE.reach * RULE.sigma), np.exp(RULE.reach * RULE.sigma)
    time = low + np.clip(phase, 0.0, 1.0) * (high - low)
    tail = ndtr(-RULE.reach)
    return (ndtr(np.log(time) / RULE.sigma) - tail) / (1 - 2 * tail)


def _shaken(
    points: FloatArray,
    times: FloatArray,
    offsets: Indices,
    meant: FloatArray,
    habit: dict[str, FloatArray],
    normals: FloatArray,
    rngs: Sequence[np.random.Generator],
) -> FloatArray:
    """Tremor: an oscillation at the hand's own frequency and the digitiser's independent noise."""
    counts = np.diff(offsets)
    amount = np.repeat(habit["tremor"] * sizes(meant), counts)[:, None]
    noise = np.concatenate(
        [rng.standard_normal((n, 2)) for rng, n in zip(rngs, counts.tolist(), strict=True)]
    )
    frequency = RULE.shake * np.exp(0.15 * normals[:, 6])
    phase = (
        2 * np.pi * (np.repeat(frequency, counts) * times)[:, None]
        + np.repeat(normals[:, 6:8], counts, axis=0) * 3
    )
    return points + amount * (0.6 * noise + np.sin(phase))


def _rounded(points: FloatArray, grid: FloatArray) -> FloatArray:
    """Points on their device's pixel grid."""
    size = np.where(grid > 0, grid, 1.0)[:, None]
    return np.where(grid[:, None] > 0, np.round(points / size) * size, points)


def _pressure(offsets: Indices, habit: dict[str, FloatArray], normals: FloatArray) -> FloatArray:
    """Pressure rises within the first tenth of a stroke, falls in the last, and drifts in between."""
    counts = np.diff(offsets)
    place = (np.arange(offsets[-1]) - np.repeat(offsets[:-1], counts)) / np.repeat(
        np.maximum(counts - 1, 1), counts
    )
    envelope = np.minimum(1.0, 0.35 + 6.5 * np.minimum(place, 1 - place))
    drift = 1.0 + 0.1 * np.repeat(normals[:, 0], counts) * np.sin(2 * np.pi * place)
    return np.clip(np.repeat(habit["pressure"], counts) * envelope * drift, 0.0, 1.0)
