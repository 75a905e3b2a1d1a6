"""Vectors of the plane in formulas (row M4): pairs, the weight W, the velocity v, their sums and multiples."""

from __future__ import annotations

import sympy

from physics.formula.program import Node, ProgramError


def split(tree: Node) -> tuple[Node, Node] | None:
    """The x and y parts of a vector tree; None for a scalar.

    Pairs, the weight W (straight down) and the velocity v are vectors; |W| and ‖v‖ are not. Raises
    ProgramError where a vector meets what it cannot be added to or multiplied by.
    """
    if isinstance(tree, sympy.Tuple):
        if len(tree.args) != 2:
            raise ProgramError(f"{tree} has {len(tree.args)} parts; a vector of the plane has two")
        return tree.args[0], tree.args[1]
    if isinstance(tree, sympy.Symbol):
        if tree.name == "W":
            return sympy.Integer(0), -tree
        if tree.name == "v":
            return sympy.Symbol("v_x"), sympy.Symbol("v_y")
        return None
    if isinstance(tree, sympy.Add):
        parts = [split(part) for part in tree.args]
        if all(part is None for part in parts):
            return None
        if any(part is None for part in parts):
            raise ProgramError(f"{tree} adds a vector to a number")
        pairs = [part for part in parts if part is not None]
        return sympy.Add(*(x for x, _ in pairs)), sympy.Add(*(y for _, y in pairs))
    if isinstance(tree, sympy.Mul):
        vectors = [part for part in tree.args if split(part) is not None]
        if not vectors:
            return None
        if len(vectors) > 1:
            raise ProgramError(f"{tree} multiplies two vectors; write which product is meant, or |…|")
        pair = split(vectors[0])
        others = [part for part in tree.args if part is not vectors[0]]
        assert pair is not None
        return sympy.Mul(*others, pair[0]), sympy.Mul(*others, pair[1])
    return None
