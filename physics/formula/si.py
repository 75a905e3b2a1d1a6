"""Dimensions of mechanics: exponents of the kilogram, the metre and the second.

Exponents are rational, since a root of an area is a length. Angles are plain numbers, as in the SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

_RAISED = str.maketrans("-0123456789/", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹ᐟ")


@dataclass(frozen=True, slots=True)
class Dimension:
    """kg^kilograms · m^metres · s^seconds. `str` gives its SI unit (`m/s²`), `spoken` what it measures."""

    kilograms: Fraction = Fraction(0)
    metres: Fraction = Fraction(0)
    seconds: Fraction = Fraction(0)

    def __hash__(self) -> int:
        # A fraction's own hash is a modular inverse, which takes longer than all that is looked up by it.
        return hash((self.kilograms.numerator, self.metres.numerator, self.seconds.numerator))

    def __mul__(self, other: Dimension) -> Dimension:
        return Dimension(
            self.kilograms + other.kilograms, self.metres + other.metres, self.seconds + other.seconds
        )

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    def __pow__(self, exponent: Fraction | int) -> Dimension:
        return Dimension(self.kilograms * exponent, self.metres * exponent, self.seconds * exponent)

    def __str__(self) -> str:
        return _KNOWN[self][0] if self in _KNOWN else _in_base_units(self)

    @property
    def spoken(self) -> str:
        """In words, with its unit: "a force (N)"."""
        if self == NUMBER:
            return "a plain number"
        return f"{_KNOWN[self][1]} ({self})" if self in _KNOWN else f"a quantity in {self}"


def dimension(kilograms: int = 0, metres: int = 0, seconds: int = 0) -> Dimension:
    """The dimension with these whole exponents."""
    return Dimension(Fraction(kilograms), Fraction(metres), Fraction(seconds))


NUMBER = dimension()
MASS = dimension(kilograms=1)
LENGTH = dimension(metres=1)
TIME = dimension(seconds=1)
AREA = LENGTH**2
RATE = TIME**-1
VELOCITY = LENGTH / TIME
ACCELERATION = VELOCITY / TIME
ANGULAR_ACCELERATION = RATE / TIME
FORCE = MASS * ACCELERATION
MOMENTUM = MASS * VELOCITY
ENERGY = FORCE * LENGTH
POWER = ENERGY / TIME
STIFFNESS = FORCE / LENGTH
INERTIA = MASS * AREA
PRESSURE = FORCE / AREA
AREAL_DENSITY = MASS / AREA

_KNOWN: dict[Dimension, tuple[str, str]] = {
    NUMBER: ("1", "a plain number"),
    MASS: ("kg", "a mass"),
    LENGTH: ("m", "a length"),
    TIME: ("s", "a time"),
    AREA: ("m²", "an area"),
    LENGTH**3: ("m³", "a volume"),
    RATE: ("1/s", "a rate, such as an angular velocity"),
    VELOCITY: ("m/s", "a velocity"),
    ACCELERATION: ("m/s²", "an acceleration"),
    ANGULAR_ACCELERATION: ("1/s²", "an angular acceleration"),
    FORCE: ("N", "a force"),
    MOMENTUM: ("kg m/s", "a momentum"),
    ENERGY: ("J", "an energy or a torque"),
    POWER: ("W", "a power"),
    STIFFNESS: ("N/m", "a stiffness"),
    INERTIA: ("kg m²", "a moment of inertia"),
    PRESSURE: ("Pa", "a pressure"),
    AREAL_DENSITY: ("kg/m²", "a mass for each area"),
    MASS / LENGTH**3: ("kg/m³", "a density"),
    INERTIA / TIME: ("kg m²/s", "an angular momentum"),
    MASS / TIME: ("kg/s", "a drag coefficient"),
    VELOCITY**2: ("m²/s²", "the square of a velocity"),
    FORCE * AREA / MASS**2: ("N m²/kg²", "a constant of gravitation"),
}
"""SI unit and words of what mechanics has a name for."""


def _in_base_units(size: Dimension) -> str:
    units = (("kg", size.kilograms), ("m", size.metres), ("s", size.seconds))
    above = [_raised(name, power) for name, power in units if power > 0]
    below = [_raised(name, -power) for name, power in units if power < 0]
    if not below:
        return " ".join(above)
    under = below[0] if len(below) == 1 else f"({' '.join(below)})"
    return f"{' '.join(above) or '1'}/{under}"


def _raised(name: str, power: Fraction) -> str:
    return name if power == 1 else name + str(power).translate(_RAISED)
