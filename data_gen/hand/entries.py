"""The ideal curves as Python calls them."""

from __future__ import annotations

from data_gen.hand import curves
from data_gen.hand.jit import kernel
from sketch.ink import FloatArray


@kernel
def superellipse(
    x: float, y: float, a: float, b: float, start: float, sweep: float, squareness: float, egg: float
) -> FloatArray:
    return curves.superellipse(x, y, a, b, start, sweep, squareness, egg)


@kernel
def polygon(corners: FloatArray, start: float, overlap: float) -> FloatArray:
    return curves.polygon(corners, start, overlap)


@kernel
def coil(loops: float, length: float, width: float, lead: float, lean: float) -> FloatArray:
    return curves.coil(loops, length, width, lead, lean)


@kernel
def zigzag(spacing: FloatArray, heights: FloatArray, length: float, width: float, lead: float) -> FloatArray:
    return curves.zigzag(spacing, heights, length, width, lead)
