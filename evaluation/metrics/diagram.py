"""Is the diagram what was drawn: the parts of an exact match between truth and claim."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from evaluation.metrics.matching import match_components
from sketch.page import Component, Sketch


@dataclass(frozen=True, slots=True)
class DiagramMatch:
    """components: the same number of each kind; grouping: every component has the same strokes and
    the same kind; ends: every spring and wire hangs on the same components; fixed: the same
    components are immobile."""

    components: bool
    grouping: bool
    ends: bool
    fixed: bool

    @property
    def exact(self) -> bool:
        return self.components and self.grouping and self.ends and self.fixed


def diagram_match(truth: Sketch, claim: Sketch) -> DiagramMatch:
    """Compares two readings of the same ink; labels and the order of components do not matter,
    neither does which end of a spring or wire comes first. A component that is missing on one
    side or too many on the other counts against every part."""
    pairs = match_components(truth, claim)
    counterparts = [(truth.component(a), claim.component(b)) for a, b in pairs.items()]
    whole = len(pairs) == len(truth.components) == len(claim.components)
    return DiagramMatch(
        components=_kinds(truth) == _kinds(claim),
        grouping=_groups(truth) == _groups(claim),
        ends=whole and all(_same_ends(a, b, pairs) for a, b in counterparts),
        fixed=whole and all(a.fixed == b.fixed for a, b in counterparts),
    )


def _kinds(sketch: Sketch) -> Counter[str]:
    return Counter(component.kind for component in sketch.components)


def _groups(sketch: Sketch) -> Counter[tuple[str, frozenset[int]]]:
    return Counter((component.kind, frozenset(component.strokes)) for component in sketch.components)


def _same_ends(true: Component, claimed: Component, pairs: dict[str, str]) -> bool:
    wanted = Counter(None if end is None else pairs.get(end, "") for end in true.ends)
    return wanted == Counter(claimed.ends)
