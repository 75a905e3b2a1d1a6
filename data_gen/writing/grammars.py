"""Expressions drawn at random: of mathematics at large, of physics pages, of both, and exercises of signs and scripts.

A reader taught by the first does not merely guess physics; the second holds what people write beside diagrams.
"""

from __future__ import annotations

import numpy as np

from data_gen.writing.author import COMMON, GREEK, RULE, Author
from data_gen.writing.general import general
from data_gen.writing.physical import physics
from sketch.writing.rows import Node, Row, nodes_of
from sketch.writing.signs import ACCENTS, FRACTION, LETTERS, PRIME, ROOT, SIGNS

__all__ = ["Row", "aslant", "drill", "general", "mixed", "physics"]


def mixed(rng: np.random.Generator) -> Row:
    """One of the two grammars by chance, of some length at most: most lines are short, few are long."""
    most = RULE.longest * rng.random() ** 0.5
    while True:
        row = physics(rng) if rng.random() < RULE.physics else general(rng)
        if sum(1 for _ in nodes_of(row)) <= max(most, 4):
            return row


def aslant(rng: np.random.Generator) -> Row:
    """Letters and numbers with many scripts, of one sign or several: what tells scripts from neighbours."""
    author = Author(rng, tuple(str(name) for name in rng.choice([*COMMON, *GREEK], size=6)))

    def script(above: bool) -> Row:
        signs = [*author.pool, *"0123456789", "+", "-", "(", ")", ","]
        if above and author.chance(0.05):
            return (Node(PRIME),)
        length = author.count([0.6, 0.2, 0.14, 0.06])
        row = tuple(Node(author.pick(signs)) for _ in range(length))
        if author.chance(0.08):
            row = (*row[:-1], Node(row[-1].name, sub=(Node(author.pick(signs)),)))
        return row

    row: Row = ()
    for _ in range(int(rng.integers(1, 8))):
        name = (
            author.letter()
            if author.chance(0.75)
            else author.pick([*"0123456789", ")", "=", "+", "-", "/", ",", "("])
        )
        style = rng.random()
        sub = script(False) if style < 0.28 or style > 0.92 else ()
        sup = script(True) if 0.28 <= style < 0.5 or style > 0.92 else ()
        row = (*row, Node(name, sub=sub, sup=sup))
    return row


def drill(rng: np.random.Generator) -> Row:
    """Any signs side by side, all of them alike often, some with a script: what no grammar would teach."""
    pool = [sign for sign in SIGNS if sign not in (FRACTION, ROOT, PRIME, *ACCENTS)]
    row: Row = ()
    for _ in range(int(rng.integers(1, 7))):
        sub: Row = ()
        sup: Row = ()
        name = pool[int(rng.integers(len(pool)))]
        style = rng.random()
        if style < 0.12:
            sub = (Node(pool[int(rng.integers(len(pool)))]),)
        elif style < 0.24:
            sup = (Node(PRIME if style > 0.22 else pool[int(rng.integers(len(pool)))]),)
        elif style < 0.3 and name in LETTERS:
            row = (*row, Node(name, accent=Node(ACCENTS[int(rng.integers(len(ACCENTS)))])))
            continue
        elif style < 0.34:
            row = (*row, Node(ROOT, inside=(Node(name),)))
            continue
        elif style < 0.38:
            other = pool[int(rng.integers(len(pool)))]
            row = (*row, Node(FRACTION, over=(Node(name),), under=(Node(other),)))
            continue
        row = (*row, Node(name, sub=sub, sup=sup))
    return row
