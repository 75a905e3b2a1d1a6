"""Read mathematics against what was written: pure functions of two rows.

Two rows are equal when their canonical LaTeX is (`sketch.writing.rows`). A row's relations are those of
the symbol layout tree of CROHME: beside, below and above aslant, over, under, inside.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from sketch.writing.rows import Row, latex, nodes_of
from sketch.writing.signs import FRACTION, MERGED, ROOT

Token = tuple[str, int, str]
"""How a sign hangs on what stands before it, how deep it stands, and its name."""


def same(truth: Row, claim: Row) -> bool:
    """Whether the reading is right."""
    return latex(truth) == latex(claim)


def structure(row: Row) -> str:
    """The row with every sign but bars and roots made alike: what is left is how they lie."""

    def bare(part: Row) -> Row:
        return tuple(
            replace(
                node,
                name=node.name if node.name in (FRACTION, ROOT) else "x",
                sub=bare(node.sub),
                sup=bare(node.sup),
                over=bare(node.over),
                under=bare(node.under),
                inside=bare(node.inside),
            )
            for node in part
        )

    return latex(bare(row))


def tokens(row: Row) -> list[Token]:
    """The row's signs in the order of its LaTeX, each with how it hangs on the tree."""

    def walk(part: Row, relation: str, depth: int) -> Iterator[Token]:
        for at, node in enumerate(part):
            yield (relation if at == 0 else "right", depth, node.name)
            if node.accent is not None:
                yield ("accent", depth, node.accent.name)
            for name, inner in (
                ("over", node.over),
                ("under", node.under),
                ("inside", node.inside),
                ("sub", node.sub),
                ("sup", node.sup),
            ):
                yield from walk(inner, name, depth + 1)

    return list(walk(row, "first", 0))


def mistakes(truth: Row, claim: Row) -> int:
    """Least number of signs and relations to put right: Levenshtein's distance over `tokens`, where a sign
    or a relation that differs costs one, both two, and a sign too many or too few one."""
    written, read = tokens(truth), tokens(claim)
    before = list(range(len(read) + 1))
    for i, one in enumerate(written, start=1):
        row = [i]
        for j, other in enumerate(read, start=1):
            cost = (one[2] != other[2]) + (one[:2] != other[:2])
            row.append(min(before[j] + 1, row[j - 1] + 1, before[j - 1] + cost))
        before = row
    return before[-1]


@dataclass(frozen=True, slots=True)
class Found:
    """A written sign and what was read from just its strokes; None where they were shared out otherwise."""

    truth: str
    claim: str | None

    @property
    def right(self) -> bool:
        return self.truth == self.claim

    @property
    def merged(self) -> bool:
        """Right, or one of its twins."""
        return self.claim is not None and MERGED.get(self.truth, self.truth) == MERGED.get(
            self.claim, self.claim
        )


def signs(truth: Sequence[tuple[str, tuple[int, ...]]], claim: Row) -> list[Found]:
    """Each written sign, given by its name and strokes, with what was read. The bar of a fraction is a minus sign."""
    read = {tuple(sorted(node.strokes)): _plain(node.name) for node in nodes_of(claim)}
    return [Found(_plain(name), read.get(tuple(sorted(strokes)))) for name, strokes in truth]


def _plain(name: str) -> str:
    return "-" if name == FRACTION else name
