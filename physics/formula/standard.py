"""What holds where a page says nothing."""

from __future__ import annotations

from functools import lru_cache

from sketch.geometry import solid_area
from sketch.shapes import Solid

PER_METRE = 100.0
"""Page units in a metre."""
DENSITY = 1.0
"""kg per m² of area, of a solid of which nothing is said: a ball of 50 units across weighs 0.2 kg."""
GRAVITY = 9.81
"""m/s², unless the page says otherwise."""


@lru_cache(maxsize=1024)  # a page asks for each several times, and an edited formula changes none
def square_metres(solid: Solid) -> float:
    """A solid's area, m²."""
    return solid_area(solid) / PER_METRE**2
