"""The variations by name: what they do, in which range, and why. Each can be left out by its name.

Lengths are fractions of the stroke's or shape's size unless another unit stands beside them. Sources:
van Sommers, Drawing and Cognition (1984); Goodnow and Levine, The grammar of action (1973); Plamondon
(1995); Viviani and Flash (1995); Elble and Koller, Tremor (1990); Meulenbroek and van Galen (1988).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Variation:
    """span: the range in words, with units; reason: why people's ink has it."""

    span: str
    reason: str


VARIATIONS: Mapping[str, Variation] = {
    "direction": Variation(
        "any start and sense; five in six begin at the top and go anti-clockwise or to the right",
        "the grammar of action: starts at the top left are usual, none is sure",
    ),
    "rotation": Variation("tilts of 3 to 15 degrees, one item in five at any angle", "posture; free drawing"),
    "aspect": Variation("log of width over height: s.d. 0.1 (letters) to 0.4", "nobody measures"),
    "shear": Variation("x grows by up to 0.1 (shapes) or 0.3 (letters) of the height", "slant of the wrist"),
    "proportions": Variation(
        "teeth, loops, heads and dashes of uneven size: log s.d. 0.1 to 0.5", "teeth are drawn by rhythm"
    ),
    "roundness": Variation("superellipse exponent 1.7 to 3, egg up to 0.4, spiral 5 %", "arcs of the wrist"),
    "corners": Variation(
        "a corner strays by s.d. 2 % of the shape", "aim is a tenth of an inch at speed (Fitts)"
    ),
    "sides": Variation("sagitta of a side s.d. 3.5 % of it", "a wrist turns about a point"),
    "closure": Variation("gap or overlap s.d. 3.5 % of the perimeter", "the end is steered by eye, late"),
    "tail": Variation("one closed shape in five runs on by 3 to 25 %", "the pen leaves in motion"),
    "backtrack": Variation(
        "one wire in twelve runs back by up to a third", "the pen returns before it lifts"
    ),
    "retracing": Variation(
        "3 % of strokes go over 5 to 20 % of their path again", "a line is mended at once"
    ),
    "several_strokes": Variation("boxes in 2 to 4, rings in 2, arrows in 2 or 3 strokes", "lifts at corners"),
    "broken": Variation("a stroke broken in two, its halves 0 to 4 % apart", "lifts, lost contact"),
    "overshoot": Variation("pieces end within s.d. 3 % of a corner, past it or short", "aim"),
    "ends": Variation("both ends of a letter's stroke stray by s.d. 2 %", "entry and exit of joined writing"),
    "field": Variation(
        "smooth distortion of the plane, rms 0.3 to 3 %", "letters bulge and taper as a whole"
    ),
    "wobble": Variation(
        "waves of 0.5 to 9 periods along the path, rms 0.3 to 3 %", "memory of form, arm posture"
    ),
    "bow": Variation(
        "the whole stroke bent by s.d. 0.3 to 3 % of its chord", "the arm swings about the elbow"
    ),
    "hooks": Variation(
        "2 to 6 %, at most 10 page units, in up to a third of strokes", "contact before the pen stops"
    ),
    "late": Variation("the first 0 to 18 % a straight line", "a slow device wakes up late"),
    "kinematics": Variation(
        "sigma-lognormal strokelets; without it the pen runs evenly", "two-thirds power law"
    ),
    "rounding": Variation("strokelets overlap by 5 to 45 % of their time", "haste cuts corners"),
    "tremor": Variation(
        "4 to 12 Hz, rms 0.05 to 3 %", "physiological 8-12 Hz, essential 4-8 Hz, Parkinson 4-6 Hz"
    ),
    "jitter": Variation("white noise, rms 0.05 to 0.6 page units", "the digitiser"),
    "speed": Variation("3 to 11 strokelets a second", "Plamondon 1995: 4 to 9 in practised hands"),
    "rate": Variation("20 to 250 samples a second; without it 100", "web pages to tablets"),
    "sparse": Variation("one ring in five seen at 12 to 60 uneven points", "a busy device skips events"),
    "quantisation": Variation("points on a grid of 1 or 0.25 page units in two of three devices", "pixels"),
    "missing": Variation("one device in six gives no times, one in three no pressure", "mouse, old files"),
}

NAMES: tuple[str, ...] = tuple(VARIATIONS)


def mask(*left_out: str) -> Mask:
    """Which variations are on, in the order of `NAMES`: all but those named.

    Raises ValueError on a name that is none.
    """
    for name in left_out:
        if name not in VARIATIONS:
            raise ValueError(f"no variation is called {name!r}; there are {', '.join(NAMES)}")
    on = np.array([name not in left_out for name in NAMES])
    on.setflags(write=False)
    return on


(
    DIRECTION,
    ROTATION,
    ASPECT,
    SHEAR,
    PROPORTIONS,
    ROUNDNESS,
    CORNERS,
    SIDES,
    CLOSURE,
    TAIL,
    BACKTRACK,
    RETRACING,
    SEVERAL,
    BROKEN,
    OVERSHOOT,
    ENDS,
    FIELD,
    WOBBLE,
    BOW,
    HOOKS,
    LATE,
    KINEMATICS,
    ROUNDING,
    TREMOR,
    JITTER,
    SPEED,
    RATE,
    SPARSE,
    QUANTISATION,
    MISSING,
) = range(len(NAMES))
"""Places in a mask; also the names under which a variation's random numbers are split off."""
