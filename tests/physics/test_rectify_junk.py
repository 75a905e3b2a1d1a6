"""Laws of correction on pages that nobody meant: what is said of them cannot all be, and correction must still end."""

from __future__ import annotations

import numpy as np
import pytest
from physics_junk import junk
from physics_workshop import difference, ends, redrawn

from physics.rectify import rectify
from sketch.page import Sketch

SEEDS = range(300)


def farthest(one: Sketch, other: Sketch) -> float:
    return max(difference(part.shape, other.component(part.label).shape) for part in one.components)


@pytest.mark.parametrize("seed", SEEDS)
def test_correcting_junk_twice_is_correcting_it_once(seed: int) -> None:
    once = rectify(junk(seed))
    assert farthest(once.sketch, rectify(once.sketch).sketch) < 1e-9


@pytest.mark.parametrize("seed", range(0, 300, 3))
def test_the_order_of_drawing_changes_nothing_on_junk(seed: int) -> None:
    drawn = junk(seed)
    assert farthest(rectify(drawn).sketch, rectify(redrawn(drawn, seed)).sketch) < 1e-8


@pytest.mark.parametrize("seed", range(0, 300, 3))
def test_junk_stays_on_its_page(seed: int) -> None:
    """No angle is worth moving things to where nobody looks: within three pages' widths of the middle of the page."""
    for part in rectify(junk(seed)).sketch.components:
        assert np.abs(np.subtract(ends(part.shape), (300, 225))).max() < 1800


@pytest.mark.parametrize("seed", range(0, 300, 3))
def test_corrections_of_junk_tell_the_whole_way(seed: int) -> None:
    drawn = junk(seed)
    corrected = rectify(drawn)
    shapes = {part.label: part.shape for part in drawn.components}
    for correction in corrected.corrections:
        assert shapes[correction.component] == correction.before
        shapes[correction.component] = correction.after
    assert shapes == {part.label: part.shape for part in corrected.sketch.components}
