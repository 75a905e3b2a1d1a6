"""The quantities of a page: which names they go by, what can have them, and what they do there.

A table, not code (rows M2, M4, M6). Each entry is one meaning; the first that fits a name and the
thing it is said of holds. In the names a * stands for any subscript or none; a name with a prime is
one after an impact, and so an answer always. Quantities are SI, with y up.

An *answer* governs nothing: it is a number that the student found, to be compared with what the
engine finds. `x`, `y`, and the pairs `r` and `s`, are metres from where the solid's centre was
drawn, right and up: an equation for them moves the solid (M7), and so does one for `v_x`, `v_y` or
`v` that depends on time or on the motion; a velocity that does not, and `v_0` ever, is what it has
at the start (M2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from physics.formula.si import (
    ACCELERATION,
    ANGULAR_ACCELERATION,
    AREAL_DENSITY,
    ENERGY,
    FORCE,
    INERTIA,
    LENGTH,
    MASS,
    MOMENTUM,
    NUMBER,
    POWER,
    RATE,
    STIFFNESS,
    TIME,
    VELOCITY,
    Dimension,
)
from sketch.shapes import ComponentKind

Role = Literal[
    "a_x", "a_y", "acceleration", "angle", "angular_acceleration", "angular_velocity", "density", "distance",
    "energy", "force", "force_peak", "frequency", "friction", "gravity", "heat", "height", "impulse", "inertia",
    "kinetic", "length",
    "mass", "momentum", "p_x", "p_y", "period", "position", "potential", "power", "pull", "restitution",
    "speed", "spin", "stiffness", "stretch", "tension", "tension_peak", "time", "torque", "v_x", "v_y", "velocity", "way_x", "way_y",
    "weight", "work", "x", "y",
]  # fmt: skip

Owner = ComponentKind | None
"""What can have a quantity; None: the page as a whole."""

Form = Literal["scalar", "vector", "either"]
"""Whether its value is a number, a pair, or may be both: a force that is a number acts along the
normal, a velocity that is one to the right."""

SOLIDS: tuple[ComponentKind, ...] = ("circle", "polygon")
LINKS: tuple[ComponentKind, ...] = ("spring", "wire")
NAMES_OF: Mapping[Owner, str] = {
    "circle": "a ball",
    "polygon": "a block",
    "spring": "a spring",
    "wire": "a wire",
    "arrow": "an arrow",
    None: "the whole page",
}


@dataclass(frozen=True, slots=True)
class Quantity:
    """role: what it is to physics; names: what it is called; owners: what can have it; form: scalar or
    vector; constant: applied once, at the start, an equation otherwise; size: its SI dimension; what:
    in words; changes: what it does to the owner, None for an answer."""

    role: Role
    names: tuple[str, ...]
    owners: tuple[Owner, ...]
    form: Form
    constant: bool
    size: Dimension
    what: str
    changes: str | None = None

    @property
    def answer(self) -> bool:
        """Whether it governs nothing, and can only be verified."""
        return self.changes is None

    @property
    def spoken(self) -> str:
        """In words, with its unit: "a mass (kg)"."""
        return self.what if self.size == NUMBER else f"{self.what} ({self.size})"


PEAKS = tuple(f"{name}_{most}" for name in ("f", "F", "N", "R") for most in ("max", "min"))
"""Names of what a force gets to at most or at least: nothing pushes with it all the time."""
QUANTITIES: tuple[Quantity, ...] = (
    # What governs.
    Quantity("mass", ("m*", "M*"), SOLIDS, "scalar", True, MASS, "a mass", "how it responds to forces"),
    Quantity("density", ("rho*",), SOLIDS, "scalar", True, AREAL_DENSITY, "a mass for each area", "its mass"),
    Quantity("weight", ("W",), SOLIDS, "either", True, FORCE, "a weight", "its mass, where no mass is given"),
    Quantity("friction", ("mu*",), SOLIDS, "scalar", True, NUMBER, "a coefficient of friction", "how it slides"),
    Quantity("restitution", ("e",), SOLIDS, "scalar", True, NUMBER, "a coefficient of restitution", "how it bounces"),
    Quantity("x", ("x",), SOLIDS, "scalar", False, LENGTH, "a way to the right of where it was drawn", "how it moves"),
    Quantity("y", ("y",), SOLIDS, "scalar", False, LENGTH, "a way upwards from where it was drawn", "how it moves"),
    Quantity("position", ("r", "s"), SOLIDS, "vector", False, LENGTH, "a way from where it was drawn", "how it moves"),
    Quantity("v_x", ("v_x", "v_0x", "v_x0"), SOLIDS, "scalar", True, VELOCITY, "a velocity to the right", "how it starts"),
    Quantity("v_y", ("v_y", "v_0y", "v_y0"), SOLIDS, "scalar", True, VELOCITY, "a velocity upwards", "how it starts"),
    Quantity("velocity", ("v", "v_0"), SOLIDS, "either", True, VELOCITY, "a velocity", "how it starts"),
    Quantity("spin", ("omega", "omega_0"), SOLIDS, "scalar", True, RATE, "an angular velocity", "how it starts to turn"),
    Quantity("force_peak", PEAKS, SOLIDS, "scalar", False, FORCE, "the greatest or smallest that a force gets"),
    Quantity("force", ("f*", "F*", "N*", "R*"), SOLIDS, "either", False, FORCE, "a force", "what pushes it"),
    Quantity("angle", ("alpha*",), ("polygon", *LINKS), "scalar", True, NUMBER, "an angle", "how it is inclined"),
    Quantity("angle", ("theta*", "beta*", "gamma*", "phi*"), (*SOLIDS, *LINKS), "scalar", True, NUMBER, "an angle", "how it is inclined"),
    Quantity("stiffness", ("k*",), ("spring",), "scalar", True, STIFFNESS, "a spring's stiffness", "how hard it pulls"),
    Quantity("length", ("L*", "l*"), LINKS, "scalar", True, LENGTH, "a link's length at rest", "how long it is at rest"),
    Quantity("tension_peak", ("T_max", "T_min"), ("wire",), "scalar", False, FORCE, "the greatest or smallest that a tension gets"),
    Quantity("tension", ("T*",), ("wire",), "scalar", False, FORCE, "a wire's tension", "how hard it pulls"),
    Quantity("gravity", ("g",), (None,), "scalar", True, ACCELERATION, "the acceleration of free fall", "how all things fall"),
    # What is answered.
    Quantity("angular_acceleration", ("alpha*",), SOLIDS, "scalar", False, ANGULAR_ACCELERATION, "an angular acceleration"),
    Quantity("a_x", ("a_x",), SOLIDS, "scalar", False, ACCELERATION, "an acceleration to the right"),
    Quantity("a_y", ("a_y",), SOLIDS, "scalar", False, ACCELERATION, "an acceleration upwards"),
    Quantity("acceleration", ("a*",), SOLIDS, "either", False, ACCELERATION, "an acceleration"),
    Quantity("speed", ("v*", "u*"), SOLIDS, "either", False, VELOCITY, "a speed"),
    Quantity("angular_velocity", ("omega*",), SOLIDS, "scalar", False, RATE, "an angular velocity"),
    Quantity("period", ("T",), (*SOLIDS, None), "scalar", False, TIME, "a period"),
    Quantity("frequency", ("nu*",), (*SOLIDS, None), "scalar", False, RATE, "a frequency"),
    Quantity("time", ("t*",), (*SOLIDS, None), "scalar", False, TIME, "a time"),
    Quantity("work", ("W*",), (*SOLIDS, None), "scalar", False, ENERGY, "a work"),
    Quantity("kinetic", ("E_k", "E_kin", "K*"), (*SOLIDS, None), "scalar", False, ENERGY, "a kinetic energy"),
    Quantity("potential", ("E_p", "E_pot", "U*"), (*SOLIDS, "spring", None), "scalar", False, ENERGY, "a potential energy"),
    Quantity("energy", ("E*",), (*SOLIDS, "spring", None), "scalar", False, ENERGY, "an energy"),
    Quantity("power", ("P*",), SOLIDS, "scalar", False, POWER, "a power"),
    Quantity("p_x", ("p_x",), SOLIDS, "scalar", False, MOMENTUM, "a momentum to the right"),
    Quantity("p_y", ("p_y",), SOLIDS, "scalar", False, MOMENTUM, "a momentum upwards"),
    Quantity("momentum", ("p*",), (*SOLIDS, None), "either", False, MOMENTUM, "a momentum"),
    Quantity("impulse", ("J*",), SOLIDS, "either", False, MOMENTUM, "an impulse"),
    Quantity("inertia", ("I*",), SOLIDS, "scalar", False, INERTIA, "a moment of inertia"),
    Quantity("torque", ("tau*",), SOLIDS, "scalar", False, ENERGY, "a torque"),
    Quantity("height", ("h*", "H*"), (*SOLIDS, None), "scalar", False, LENGTH, "a height"),
    Quantity("distance", ("d*", "D*", "R*"), (*SOLIDS, *LINKS, None), "scalar", False, LENGTH, "a distance"),
    Quantity("way_x", ("x*",), SOLIDS, "scalar", False, LENGTH, "a way to the right from where it was drawn"),
    Quantity("way_y", ("y*",), SOLIDS, "scalar", False, LENGTH, "a way upwards from where it was drawn"),
    Quantity("heat", ("Q*",), (*SOLIDS, None), "scalar", False, ENERGY, "a heat"),
    Quantity("stretch", ("x", "s"), ("spring",), "scalar", False, LENGTH, "a spring's stretch"),
    Quantity("pull", ("F*", "f*"), ("spring",), "scalar", False, FORCE, "a spring's pull"),
)  # fmt: skip

INSTEAD: Mapping[tuple[Role, Owner], str] = {
    ("stiffness", "wire"): "a wire does not stretch; draw a spring, or give the wire a length L",
    ("stiffness", "circle"): "a ball does not stretch; say it of the spring that holds it",
    ("stiffness", "polygon"): "a block does not stretch; say it of the spring that holds it",
    ("tension", "spring"): "what a spring pulls with follows from its stretch; give it k or L",
    ("tension", "circle"): "say it of the wire that pulls it, or write a force F",
    ("tension", "polygon"): "say it of the wire that pulls it, or write a force F",
    ("mass", "spring"): "springs weigh nothing here; say it of what hangs from it",
    ("mass", "wire"): "wires weigh nothing here; say it of what hangs from it",
    ("density", "spring"): "springs weigh nothing here; say it of what hangs from it",
    ("density", "wire"): "wires weigh nothing here; say it of what hangs from it",
    ("weight", "spring"): "springs weigh nothing here; say it of what hangs from it",
    ("weight", "wire"): "wires weigh nothing here; say it of what hangs from it",
    ("length", "circle"): "say it of a wire or a spring; a ball is as large as it is drawn",
    ("length", "polygon"): "say it of a wire or a spring; a block is as large as it is drawn",
    ("force", "wire"): "the force in a wire is its tension T",
    ("friction", "spring"): "only what slides on something has friction; say it of a ball or a block",
    ("friction", "wire"): "only what slides on something has friction; say it of a ball or a block",
    ("restitution", "spring"): "only what bounces has one; say it of a ball or a block",
    ("restitution", "wire"): "only what bounces has one; say it of a ball or a block",
    ("velocity", "spring"): "a spring moves with what hangs from it; say it of that",
    ("velocity", "wire"): "a wire moves with what hangs from it; say it of that",
    ("gravity", "circle"): "all things fall alike; write it beside the drawing, associated with nothing",
    ("gravity", "polygon"): "all things fall alike; write it beside the drawing, associated with nothing",
    ("gravity", "spring"): "all things fall alike; write it beside the drawing, associated with nothing",
    ("gravity", "wire"): "all things fall alike; write it beside the drawing, associated with nothing",
    ("mass", None): "tap the ball or the block whose mass it is",
    ("force", None): "tap the ball or the block that it acts on",
    ("velocity", None): "tap the ball or the block that moves so",
    ("angle", None): "tap the incline, the wire or the spring that has it",
    ("tension", None): "tap the wire that has it",
    ("stiffness", None): "tap the spring that has it",
    ("friction", None): "tap the ball or the block that slides",
    ("restitution", None): "tap the ball or the block that bounces",
}
"""For what a thing cannot have: what a student may have meant, and what to write."""


@lru_cache(maxsize=4096)
def quantity_of(name: str, kind: Owner) -> Quantity | None:
    """The quantity that goes by this name on such a thing (kind None: the whole page); None when
    the name is nobody's, or not one that such a thing can have."""
    for quantity in QUANTITIES:
        if kind in quantity.owners and goes_by(name, quantity):
            return quantity
    return None


def axis_of(name: str) -> str | None:
    """The axis that a name's subscript tells, x or y, alone or after a number (F_x, f_2y); None: F_max tells none."""
    index = name.partition("_")[2]
    tells = index[-1:] in ("x", "y") and (len(index) == 1 or index[:-1].isdigit())
    return index[-1] if tells else None


@lru_cache(maxsize=4096)
def quantities_named(name: str) -> tuple[Quantity, ...]:
    """All quantities that anything could have under this name."""
    return tuple(quantity for quantity in QUANTITIES if goes_by(name, quantity))


def role_of(role: Role, kind: Owner) -> Quantity:
    """The quantity of this role that such a thing has. Raises KeyError when it has none."""
    for quantity in QUANTITIES:
        if quantity.role == role and kind in quantity.owners:
            return quantity
    raise KeyError(f"{NAMES_OF[kind]} has no {role}")


def goes_by(name: str, quantity: Quantity) -> bool:
    """Whether the name is one of the quantity's."""
    bare = name.rstrip("'")
    if bare != name and not quantity.answer:
        return False
    return any(
        bare == pattern.rstrip("*") or (pattern.endswith("*") and bare.startswith(f"{pattern[:-1]}_"))
        for pattern in quantity.names
    )
