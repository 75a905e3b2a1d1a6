"""What on a page is an answer, and what it answers: the convention.

A page asks by leaving a quantity to be found, and a student answers by associating `name = value` with the
thing that has it. Three kinds of names are answers; everything else is given.

- **A force that stands in for the engine's own**: a scalar normal force of a solid that rests on something
  (`N`, `f_1`, `F`, `R`) and a wire's tension (`T`, `T_1`); and friction, `f_s` or `f_k` (static, kinetic;
  see `physics.infer` for others), by its size.
- **An observable**: a name below with the moment as its subscript, after an axis or a kind where it has
  one: `v_f`, `v_xf`, `x_max`, `E_kf`, `t_s`.

      v  v_x v_y     speed, and its parts          a  a_x a_y   acceleration, by its size, and its parts
      x  y  h        way right, up, up again       p  p_x p_y   momentum, by its size, and its parts
      E_k  E_p       kinetic, potential energy     omega        angular velocity
      Q              heat of the whole scene       t            the moment itself
      T              period (of a solid; no moment)

  x, y, h and E_p are measured from where the solid was drawn. The moments:

      0      the start
      t      the time that the page gives with `t = …`, associated with nothing
      f      just before the thing first meets another: "final", as it reaches the ground
      a      just after that meeting
      s      when it first stops
      max min    the greatest and the smallest value while it is watched (`Watching`)

  Without a subscript, a, p, E_k, E_p, h, Q and forces are those at the page's time `t`; where the page
  gives none, those at the start. A number is no moment (`T_1`, `a_2` count things).

- `v`, `v_0`, `x`, `y`, `omega` and whatever else a solid is given are not answers, nor is what is
  associated with nothing: `h = 2` for the whole page is a name for formulas.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from physics.infer import FRICTION_NAMES
from sketch.shapes import ComponentKind

Moment = Literal["", "0", "t", "f", "a", "s", "max", "min"]
MOMENTS: tuple[Moment, ...] = ("0", "t", "f", "a", "s", "max", "min")
Kind = Literal[
    "normal",
    "friction",
    "tension",
    "speed",
    "v_x",
    "v_y",
    "acceleration",
    "a_x",
    "a_y",
    "x",
    "y",
    "momentum",
    "p_x",
    "p_y",
    "kinetic energy",
    "potential energy",
    "angular velocity",
    "heat",
    "time",
    "period",
]


@dataclass(frozen=True, slots=True)
class Asked:
    """kind: the quantity; moment: when; unit: SI, as text."""

    kind: Kind
    moment: Moment
    unit: str


@dataclass(frozen=True, slots=True)
class _Name:
    """kind, unit: of what goes by the name; given: without a moment (or at the start) it is no answer;
    moments: whether it can have one at all."""

    kind: Kind
    unit: str
    given: bool = False
    moments: bool = True


_NAMES: dict[str, _Name] = {
    "v": _Name("speed", "m/s", given=True),
    "v_x": _Name("v_x", "m/s", given=True),
    "v_y": _Name("v_y", "m/s", given=True),
    "a": _Name("acceleration", "m/s²"),
    "a_x": _Name("a_x", "m/s²"),
    "a_y": _Name("a_y", "m/s²"),
    "x": _Name("x", "m", given=True),
    "y": _Name("y", "m", given=True),
    "h": _Name("y", "m"),
    "p": _Name("momentum", "kg m/s"),
    "p_x": _Name("p_x", "kg m/s"),
    "p_y": _Name("p_y", "kg m/s"),
    "E_k": _Name("kinetic energy", "J"),
    "E_p": _Name("potential energy", "J"),
    "omega": _Name("angular velocity", "rad/s", given=True),
    "Q": _Name("heat", "J"),
    "t": _Name("time", "s", given=True),
    "T": _Name("period", "s", moments=False),
}
_NORMAL = ("f", "F", "N", "R")


def asked(name: str, kind: ComponentKind) -> Asked | None:
    """What an association of `name` with such a thing asks for; None where it is given, not asked."""
    base, _, below = name.partition("_")
    if kind == "wire":
        return Asked("tension", _moment_in(below), "N") if base == "T" else None
    if kind not in ("circle", "polygon"):
        return None
    if base in ("f", "F") and below in FRICTION_NAMES:
        return Asked("friction", "", "N")
    if base in _NORMAL:
        return None if below[-1:] in ("x", "y") else Asked("normal", _moment_in(below), "N")
    stem, moment = _parted(name)
    found = _NAMES.get(stem)
    if found is None or (found.given and moment in ("", "0")) or (moment and not found.moments):
        return None
    if found.kind == "time" and moment not in ("f", "a", "s"):
        return None
    return Asked(found.kind, moment, found.unit)


def _moment_in(below: str) -> Moment:
    """Of a force's subscript, which mostly counts or names forces, the moment."""
    return "max" if below == "max" else "min" if below == "min" else ""


def _parted(name: str) -> tuple[str, Moment]:
    """The quantity's own name, and the moment: E_kf is (E_k, f), v_x is (v_x, ""), a_1 is (a, "")."""
    base, _, below = name.partition("_")
    if not below or (below.isdigit() and below != "0"):
        return base, ""
    if below in MOMENTS:
        return base, below
    stem, rest = f"{base}_{below[0]}", below[1:]
    if not rest:
        return stem, ""
    return (stem, rest) if rest in MOMENTS else (name, "")
