"""Mathematics as it lies on paper: signs side by side, with rows above, below, inside and aslant of them.

    row   = node*           node = sign with rows: sub, sup, over, under (of a fraction's bar), inside (of a root)

`latex` writes a row in one canonical way and `row_of` reads LaTeX into a row, so that two rows are
the same reading exactly when their LaTeX is the same: equality by tree, after spacing, braces and
synonyms (`\\lt` for <, `\\left(` for (, `x^\\prime` for x') are out of the way.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from sketch.writing.signs import ACCENTS, DEGREE, FRACTION, FUNCTIONS, NUMBER, PRIME, ROOT


@dataclass(frozen=True, slots=True)
class Node:
    """One sign and what hangs on it. name: as in `signs`, or as LaTeX had it where that is not known;
    strokes: indices into the page's ink; accent: \\vec or \\hat over a letter, a node of its own."""

    name: str
    strokes: tuple[int, ...] = ()
    sub: Row = ()
    sup: Row = ()
    over: Row = ()
    under: Row = ()
    inside: Row = ()
    accent: Node | None = None


Row = tuple[Node, ...]

_SYNONYMS = {
    "\\lt": "<", "\\gt": ">", "\\le": "\\leq", "\\ge": "\\geq", "\\prime": PRIME, "\\lbrace": "\\{", "\\rbrace": "\\}",
    "\\|": "\\Vert", "\\vert": "|", "\\lvert": "|", "\\rvert": "|", "\\ast": "*", "\\degree": DEGREE, "\\to": "\\rightarrow",
    "\\dfrac": "\\frac", "\\tfrac": "\\frac", "\\overrightarrow": "\\vec", "\\varepsilon": "\\epsilon", "\\varphi": "\\phi",
    "\\vartheta": "\\theta", "\\lVert": "\\Vert", "\\rVert": "\\Vert", "−": "-", "\\colon": ":", "\\lbrack": "[", "\\rbrack": "]",
}  # fmt: skip
_SILENT = frozenset(
    [
        r"\left",
        r"\right",
        r"\mathrm",
        r"\rm",
        r"\text",
        r"\,",
        r"\;",
        r"\:",
        r"\!",
        r"\quad",
        r"\qquad",
        r"\displaystyle",
        r"\mathit",
        r"\mathbf",
        r"\operatorname",
    ]
) | {r"\ ", r"\limits", r"\big", r"\Big", "$", "~"}
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[^\s\\]", re.DOTALL)


class RowError(ValueError):
    """LaTeX that is no row of signs: the message says what is wrong."""


def latex(row: Row) -> str:
    """The row in canonical LaTeX: tokens apart by one space, every script in braces, the lower one first."""
    return " ".join(_tokens(row))


def _tokens(row: Row) -> Iterator[str]:
    for node in row:
        if node.accent is not None:
            yield from (node.accent.name, "{", node.name, "}")
        elif node.name == FRACTION:
            yield from ("\\frac", "{", *_tokens(node.over), "}", "{", *_tokens(node.under), "}")
        elif node.name == ROOT:
            if node.over:
                yield from (ROOT, "[", *_tokens(node.over), "]", "{", *_tokens(node.inside), "}")
            else:
                yield from (ROOT, "{", *_tokens(node.inside), "}")
        else:
            yield node.name
        if node.sub:
            yield from ("_", "{", *_tokens(node.sub), "}")
        if node.sup:
            yield from ("^", "{", *_tokens(node.sup), "}")


def sign_named(label: str) -> str:
    """The name in the vocabulary of a sign that is labelled so: `\\lt` is <."""
    return _SYNONYMS.get(label, label)


def row_of(text: str) -> Row:
    """The row that the LaTeX stands for. Raises RowError where braces or scripts do not fit."""
    found = [sign_named(token.group()) for token in _TOKEN.finditer(text)]
    reader = _Reader([token for token in found if token not in _SILENT])
    row = reader.row()
    if reader.rest:
        raise RowError(f"a closing brace without an opening one: {text}")
    return row


class _Reader:
    """A cursor over the tokens."""

    def __init__(self, tokens: list[str]) -> None:
        self.rest = tokens[::-1]

    def row(self, closer: str | None = None) -> Row:
        nodes: list[Node] = []
        while self.rest and self.rest[-1] != (closer or "}"):
            if self.rest[-1] == "{":
                self.rest.pop()
                nodes += self._closed("}")
            elif self.rest[-1] in ("_", "^") or (self.rest[-1] == PRIME and nodes):
                self._script(nodes)
            else:
                nodes.append(self._node())
        return tuple(nodes)

    def _closed(self, closer: str) -> Row:
        row = self.row(closer)
        if not self.rest or self.rest.pop() != closer:
            raise RowError(f"{closer} is missing")
        return row

    def _script(self, nodes: list[Node]) -> None:
        """Hangs what follows _ or ^ on the last node; primes are an exponent."""
        kind = self.rest.pop()
        base = nodes.pop() if nodes else Node("")
        below, above = base.sub, base.sup
        if kind == "_":
            below = below + self._argument()
        elif kind == PRIME:
            above = (*above, Node(PRIME))
        else:
            above = above + self._argument()
        nodes.append(
            Node(base.name, base.strokes, below, above, base.over, base.under, base.inside, base.accent)
        )

    def _argument(self) -> Row:
        if not self.rest:
            raise RowError("the LaTeX ends where a script should follow")
        if self.rest[-1] == "{":
            self.rest.pop()
            return self._closed("}")
        return (self._node(),)

    def _node(self) -> Node:
        token = self.rest.pop()
        match token:
            case "\\frac":
                return Node(FRACTION, over=self._argument(), under=self._argument())
            case "\\sqrt":
                degree: Row = ()
                if self.rest and self.rest[-1] == "[":
                    self.rest.pop()
                    degree = self._closed("]")
                return Node(ROOT, over=degree, inside=self._argument())
            case _ if token in ACCENTS:
                inner = self._argument()
                if len(inner) != 1:
                    raise RowError(f"{token} stands over one letter, not over {len(inner)}")
                return Node(inner[0].name, sub=inner[0].sub, sup=inner[0].sup, accent=Node(token))
            case "}":
                raise RowError("a closing brace where a sign should stand")
            case _:
                return Node(token)


def nodes_of(row: Row) -> Iterator[Node]:
    """Every node of the row with all that hangs on it, accents too, in the order of the LaTeX."""
    for node in row:
        yield node
        if node.accent is not None:
            yield node.accent
        for part in (node.over, node.under, node.inside, node.sub, node.sup):
            yield from nodes_of(part)


def known(row: Row) -> bool:
    """Whether every sign of the row is in the vocabulary."""
    return all(node.name in NUMBER for node in nodes_of(row))


def formula(row: Row) -> str:
    """The row as a line of the formula language, which `sketch.formula.parse` reads: LaTeX with functions set
    apart from what follows, decimals joined and primes as signs."""
    text = latex(row)
    text = re.sub(r"(?<=\d) (?=[\d.])|(?<=\.) (?=\d)", "", text)
    text = text.replace(" ^ { " + PRIME + " }", PRIME).replace("\\log", "\\ln")
    text = re.sub(r"\^ \{ \\circ \}", "°", text)
    for name in FUNCTIONS:
        text = text.replace(f"{name} (", f"{name}(")
    # In `F_x` a name's subscript is letters and digits without blanks between them.
    return re.sub(r"_ \{ ([^{}^_]*?) \}", lambda found: "_{" + found[1].replace(" ", "") + "}", text)
