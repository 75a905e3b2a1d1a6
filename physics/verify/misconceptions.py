"""Known misconceptions, and which of them explains a wrong answer.

An answer that is a formula is corrected in every way that a misconception suggests; if the corrected
formula gives the true value, that was the mistake. An answer that is a number is compared with what the
misconception makes of the true value: by a factor or a sign, or, where it is in the physics (friction
forgotten, weight taken for mass), by the true value of the page changed accordingly, which the engine finds.

Several may explain one answer. They are tried in the order of belief: a sign, then what is in the physics,
then factors, from the common to the rare.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, degrees, pi, sin, sqrt, tan
from typing import Literal, get_args

import sympy

from physics.formula.program import Node

Misconception = Literal[
    "wrong sign",
    "sine for cosine",
    "forgot g",
    "weight for mass",
    "degrees for radians",
    "forgot friction",
    "elastic for inelastic",
    "inelastic for elastic",
    "masses exchanged",
    "forgot the start velocity",
    "factor 2",
    "forgot the root",
    "forgot the square",
    "turned upside down",
    "forgot 2 pi",
    "left out the angle",
    "factor 2 under the root",
    "unit not converted",
    "forgot gravity",
    "gravity upwards",
    "rounded too coarsely",
]
MISCONCEPTIONS: tuple[Misconception, ...] = get_args(Misconception)

WORDS: dict[Misconception, str] = {
    "wrong sign": "a sign is the wrong way round",
    "sine for cosine": "sine and cosine are exchanged",
    "forgot g": "the acceleration of free fall g was left out",
    "weight for mass": "the weight was put where the mass belongs",
    "degrees for radians": "an angle in degrees was read as one in radians",
    "forgot friction": "friction was left out",
    "elastic for inelastic": "it was worked out as if no energy were lost in the impact",
    "inelastic for elastic": "it was worked out as if the bodies stayed together",
    "masses exchanged": "two masses are exchanged",
    "forgot the start velocity": "the velocity at the start was left out",
    "forgot gravity": "the weight was left out",
    "gravity upwards": "the acceleration of free fall has the wrong sign",
    "factor 2": "it is off by a factor of 2",
    "forgot the root": "the square root was not taken",
    "forgot the square": "a quantity was not squared",
    "turned upside down": "it is the reciprocal",
    "forgot 2 pi": "a factor of 2π is missing",
    "left out the angle": "the sine or cosine of the angle is missing",
    "factor 2 under the root": "it is off by a factor of 2 under the square root",
    "unit not converted": "a unit was not converted",
    "rounded too coarsely": "it was rounded too coarsely; three digits are asked for",
}


def of_formula(tree: Node) -> Iterator[tuple[Misconception, Node]]:
    """What the formula would be without each misconception."""
    yield "wrong sign", -tree
    for part in _parts(tree, sympy.Add):
        for term in part.args:
            other = part - 2 * term
            if other != -part:
                yield "wrong sign", tree.xreplace({part: other})
    exchanged = tree.replace(
        lambda node: isinstance(node, sympy.sin | sympy.cos),
        lambda node: (sympy.cos if isinstance(node, sympy.sin) else sympy.sin)(node.args[0]),
    )
    if exchanged != tree:
        yield "sine for cosine", exchanged
    g, m, weight = sympy.symbols("g m W")
    yield "forgot g", tree * g
    yield "forgot g", tree * sympy.sqrt(g)
    if m in tree.free_symbols:
        yield "forgot g", tree.xreplace({m: m * g})
    if weight in tree.free_symbols:
        yield "weight for mass", tree.xreplace({weight: m})
    if g in tree.free_symbols:
        yield "weight for mass", tree.xreplace({g: sympy.Integer(1)})
    for factor in (2, sympy.Rational(1, 2)):
        yield "factor 2", tree * factor
    yield "forgot the root", sympy.sqrt(tree)
    yield "forgot the square", tree**2
    for symbol in sorted(tree.free_symbols - {g, m, weight}, key=str):
        yield "forgot the square", tree * symbol
        yield "forgot the square", tree / symbol
    yield "turned upside down", 1 / tree
    for root in _parts(tree, sympy.Pow):
        if abs(root.exp) == sympy.Rational(1, 2):
            yield "turned upside down", tree.xreplace({root: 1 / root})
    yield "forgot 2 pi", tree * 2 * sympy.pi
    for call in sorted(tree.atoms(sympy.Function), key=str):
        if isinstance(call, sympy.sin | sympy.cos | sympy.tan):
            radians = type(call)(call.args[0] * sympy.pi / 180)
            yield "degrees for radians", tree.xreplace({call: radians})
    for factor in (2, sympy.Rational(1, 2)):
        yield "factor 2 under the root", tree * sympy.sqrt(factor)


def _parts(tree: Node, kind: type) -> list[Node]:
    return sorted(tree.atoms(kind), key=str)


def of_number(true: float, angles: tuple[float, ...], g: float) -> Iterator[tuple[Misconception, float]]:
    """What each misconception that is a mere factor makes of the true value. angles: acute ones of the page, rad."""
    for angle in angles:
        yield "sine for cosine", true * tan(angle)
        yield "sine for cosine", true / tan(angle)
        for function in (sin, cos, tan):
            read = function(degrees(angle))
            for factor in (read / function(angle), function(angle) / read):
                yield "degrees for radians", true * factor
                yield "degrees for radians", true * abs(factor)
                yield "degrees for radians", true * factor**2
    for factor in (1 / g, g, sqrt(g), 1 / sqrt(g)):
        yield "forgot g", true * factor
    for factor in (2.0, 0.5):
        yield "factor 2", true * factor
    yield "forgot the root", true * true
    if true > 0:
        yield "forgot the square", sqrt(true)
    for factor in (2 * pi, 1 / (2 * pi)):
        yield "forgot 2 pi", true * factor
    for angle in angles:
        for function in (sin, cos):
            yield "left out the angle", true / function(angle)
            yield "left out the angle", true * function(angle)
    for factor in (sqrt(2), sqrt(0.5)):
        yield "factor 2 under the root", true * factor
    if true:
        yield "turned upside down", 1 / true
    for factor in (100.0, 0.01, 1000.0, 0.001, 3.6, 1 / 3.6):
        yield "unit not converted", true * factor
    for factor in (g**2, g**-2):
        yield "forgot g", true * factor
