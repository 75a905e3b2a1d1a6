"""Rates of contacts and rows, and what an impulse along one of them does to the velocities of its two bodies:
always the opposite to either, at one point, so momentum and its moment are kept."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.manifold import CA, CB, NX, NY, ONE, OTHER, TA, TB
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]


@part
def opening(real: FloatArray, whole: IntArray, k: int, vel: FloatArray) -> float:
    """How fast contact k's gap opens, m/s."""
    i, j = whole[ONE, k], whole[OTHER, k]
    return (
        real[NX, k] * (vel[j, 0] - vel[i, 0])
        + real[NY, k] * (vel[j, 1] - vel[i, 1])
        + real[CB, k] * vel[j, 2]
        - real[CA, k] * vel[i, 2]
    )


@part
def slipping(real: FloatArray, whole: IntArray, k: int, vel: FloatArray) -> float:
    """How fast contact k slips, m/s."""
    i, j = whole[ONE, k], whole[OTHER, k]
    return (
        real[NX, k] * (vel[j, 1] - vel[i, 1])
        - real[NY, k] * (vel[j, 0] - vel[i, 0])
        + real[TB, k] * vel[j, 2]
        - real[TA, k] * vel[i, 2]
    )


@part
def press(
    real: FloatArray,
    whole: IntArray,
    inverse: FloatArray,
    k: int,
    normal: float,
    tangent: float,
    vel: FloatArray,
) -> None:
    """Applies impulses along normal and tangent of contact k."""
    i, j = whole[ONE, k], whole[OTHER, k]
    x = real[NX, k] * normal - real[NY, k] * tangent
    y = real[NY, k] * normal + real[NX, k] * tangent
    vel[i, 0] -= inverse[i, 0] * x
    vel[i, 1] -= inverse[i, 1] * y
    vel[i, 2] -= inverse[i, 2] * (real[CA, k] * normal + real[TA, k] * tangent)
    vel[j, 0] += inverse[j, 0] * x
    vel[j, 1] += inverse[j, 1] * y
    vel[j, 2] += inverse[j, 2] * (real[CB, k] * normal + real[TB, k] * tangent)


@part
def rate_of(jacobian: FloatArray, ends: IntArray, k: int, vel: FloatArray) -> float:
    """The rate of row k: of its slack, of a pin's gap, of slip."""
    i, j = ends[k, 0], ends[k, 1]
    rate = 0.0
    for q in range(3):
        rate += jacobian[k, q] * vel[i, q] + jacobian[k, 3 + q] * vel[j, q]
    return rate


@part
def haul(
    jacobian: FloatArray, ends: IntArray, inverse: FloatArray, k: int, impulse: float, vel: FloatArray
) -> None:
    """Applies an impulse along row k."""
    i, j = ends[k, 0], ends[k, 1]
    for q in range(3):
        vel[i, q] += inverse[i, q] * jacobian[k, q] * impulse
        vel[j, q] += inverse[j, q] * jacobian[k, 3 + q] * impulse
