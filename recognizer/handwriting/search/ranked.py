"""The best so far, in order: what both searches keep, compiled by numba."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from recognizer.jit import kernel
from sketch.ink import FloatArray


@kernel
def room(gain: float, best: FloatArray, ways: NDArray[np.int64], held: int) -> int:
    """Makes room among the `held` best gains, (width,) in descending order, and their ways, (width, n): the place where the
    gain now stands and its way is to be written; −1, and nothing changed, where all are held and none is less."""
    width = len(best)
    if held == width and gain <= best[width - 1]:
        return -1
    place = held if held < width else width - 1
    while place > 0 and best[place - 1] < gain:
        best[place] = best[place - 1]
        ways[place] = ways[place - 1]
        place -= 1
    best[place] = gain
    return place
