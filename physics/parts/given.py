"""What a page gives its components: numbers and programs, checked, with a notice of what cannot be.

Page units, y down, become metres, y up.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from physics.formula.meaning import PER_METRE, Meanings, Role, Said
from physics.formula.names import MASS_ROLES, lookup, mass_of, solid_of, value_at_rest
from physics.formula.program import STATE, Lookup, Node, Program, ProgramError, compile_tree
from physics.scene import Vector
from sketch.page import Component, Sketch
from sketch.shapes import Point


def to_metres(point: Point) -> Vector:
    """A place of the page (units, y down) in the scene (m, y up)."""
    return point[0] / PER_METRE, -point[1] / PER_METRE


@dataclass(frozen=True, slots=True)
class Spoken:
    """What is said of each component, sorted by component, so that the many of which nothing is said cost nothing."""

    meanings: Meanings
    own: Mapping[str | None, Meanings]

    def of(self, part: Component, role: Role) -> Said | None:
        """The newest that is said of a component in this role."""
        own = self.own.get(part.label)
        return None if own is None else own.of(part.label, role, part.kind)

    def mass(self, sketch: Sketch, part: Component) -> tuple[float, str | None]:
        """(kg, a notice where what the page says of it cannot be), of a solid."""
        told = any(self.of(part, role) for role in MASS_ROLES)
        return mass_of(sketch, self.meanings if told else NOTHING, part)


NOTHING = Meanings((), ())


def spoken(meanings: Meanings) -> Spoken:
    """A page's meanings, sorted by component."""
    found: dict[str | None, list[Said]] = {}
    for said in meanings.said:
        found.setdefault(said.component, []).append(said)
    return Spoken(meanings, {label: Meanings(tuple(own), ()) for label, own in found.items()})


@dataclass(frozen=True, slots=True)
class Page:
    """A page that is being turned into a scene. masses: kg, and starts: the centre as drawn, m, of every
    solid that moves or is in the way; g: m/s²; notices: grow as things are found that cannot be; spoken: its
    meanings, by component."""

    sketch: Sketch
    meanings: Meanings
    masses: Mapping[str, float]
    starts: Mapping[str, Vector]
    g: float
    notices: list[str]
    spoken: Spoken

    def names(self, label: str) -> Lookup:
        """What names stand for in a component's formulas."""
        return lookup(self.sketch, self.meanings, label, self.masses, self.g)

    def said(self, part: Component, role: Role) -> Said | None:
        """The newest that is said of a component in this role."""
        return self.spoken.of(part, role)

    def constant(self, part: Component, role: Role, low: float, high: float, must: str) -> float | None:
        """A constant that the page gives a component, None when it gives none that can be."""
        said = self.said(part, role)
        return None if said is None else self.value(said, part.label, low, high, must)

    def value(self, said: Said, label: str, low: float, high: float, must: str) -> float | None:
        """The value at the start of what is said of a component, None when it cannot be."""
        try:
            made = compile_tree(said.tree, self.names(label), formula(said))
        except ProgramError:
            made = None
        value = None if made is None else value_at_rest(made)
        if made is None or value is None or not low <= value <= high:
            self.notices.append(f"{said.text} of {label}: {must}; it is not used.")
            return None
        self.tell_zeros(said, label, made)
        if not made.constant:
            self.notices.append(f"{said.text} of {label} changes in time; its value at the start is used.")
        return value

    def program(self, said: Said, label: str, tree: Node) -> Program | None:
        """A formula's program; what has no value counts as zero, visibly."""
        try:
            made = compile_tree(tree, self.names(label), formula(said))
        except ProgramError as error:
            self.refuse(said, label, error)
            return None
        self.tell_zeros(said, label, made)
        return self.from_start(made, label)

    def from_start(self, program: Program, label: str) -> Program:
        """The program with x and y measured from where its solid's centre was drawn."""
        solid = solid_of(self.sketch, label)
        x, y = self.starts.get(solid or "", (0.0, 0.0))
        code: list[tuple[str, float]] = []
        for operation, operand in program.code:
            code.append((operation, operand))
            if operation == "read" and operand in (STATE.index("x"), STATE.index("y")):
                code += [("push", -x if operand == STATE.index("x") else -y), ("add", 0.0)]
        return replace(program, code=tuple(code))

    def at_start(self, program: Program, label: str) -> float:
        """Its value at the start, everything where it was drawn and at rest; NaN where it has none."""
        state: list[float] = []
        for solid in (label, *program.others):
            x, y = self.starts[solid]
            state += [{"x": x, "y": y}.get(quantity, 0.0) for quantity in STATE]
        return program.value(state)

    def varies(self, said: Said, label: str, trees: tuple[Node, ...]) -> bool:
        """Whether any of the trees reads the time or the motion."""
        try:
            made = [compile_tree(tree, self.names(label), said.text) for tree in trees]
        except ProgramError:
            return False
        return not all(program.constant for program in made)

    def tell_zeros(self, said: Said, label: str, program: Program) -> None:
        """Names without a value count as zero, visibly (M5)."""
        for name in program.unspecified:
            self.notices.append(
                f"{name} in {said.text} of {label} has no value on this page; it counts as zero."
            )

    def refuse(self, said: Said, label: str, error: ProgramError) -> None:
        """What cannot be worked out is left out, visibly."""
        self.notices.append(f"{said.text} of {label} cannot be worked out: {error}. It is not used.")


def formula(said: Said) -> str:
    """The right side of what was written."""
    return said.text.partition("=")[2].strip() or said.text
