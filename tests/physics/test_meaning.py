"""What names mean of what: the table, labels in names, conflicts, what cannot be (rows M2-M6)."""

from __future__ import annotations

import pytest
from formula_pages import BALL, FLOOR, PARTS, WIRE
from physics_pages import page

from physics.build import build
from physics.formula.meaning import read
from physics.formula.quantities import INSTEAD, QUANTITIES, axis_of, quantities_named, quantity_of
from physics.formula.si import ACCELERATION, ENERGY, FORCE, LENGTH, MASS, NUMBER, TIME, VELOCITY, Dimension
from sketch.formula.parse import parse
from sketch.shapes import COMPONENT_KINDS, ComponentKind

LABELS: dict[str, str] = {"circle": "B", "polygon": "C", "spring": "E", "wire": "D"}


@pytest.mark.parametrize(
    ("name", "kind", "role"),
    [
        ("m", "circle", "mass"),
        ("m_1", "polygon", "mass"),
        ("M", "polygon", "mass"),
        ("rho", "circle", "density"),
        ("W", "circle", "weight"),
        ("W_1", "circle", "work"),
        ("mu_k", "polygon", "friction"),
        ("e", "circle", "restitution"),
        ("x", "circle", "x"),
        ("x", "spring", "stretch"),
        ("v", "circle", "velocity"),
        ("v_0", "circle", "velocity"),
        ("v_0y", "circle", "v_y"),
        ("v_2", "circle", "speed"),
        ("v'", "circle", "speed"),
        ("v_x'", "circle", "speed"),
        ("a", "polygon", "acceleration"),
        ("a_x", "polygon", "a_x"),
        ("f_1", "circle", "force"),
        ("F_net", "circle", "force"),
        ("F", "spring", "pull"),
        ("N", "polygon", "force"),
        ("T", "wire", "tension"),
        ("T_2", "wire", "tension"),
        ("T", "circle", "period"),
        ("k", "spring", "stiffness"),
        ("L", "wire", "length"),
        ("theta", "wire", "angle"),
        ("alpha", "wire", "angle"),
        ("alpha", "circle", "angular_acceleration"),
        ("omega", "circle", "spin"),
        ("p", "circle", "momentum"),
        ("tau", "circle", "torque"),
        ("E_k", "circle", "kinetic"),
        ("E_2", "circle", "energy"),
        ("h", None, "height"),
        ("t_1", None, "time"),
        ("g", None, "gravity"),
    ],
)
def test_a_name_is_a_quantity_of_a_kind(name: str, kind: ComponentKind | None, role: str) -> None:
    found = quantity_of(name, kind)
    assert found is not None
    assert found.role == role


@pytest.mark.parametrize(
    ("name", "kind"),
    [("k", "circle"), ("T", "spring"), ("T_1", "polygon"), ("m", "wire"), ("m'", "circle"), ("g", "circle"), ("q", "wire"), ("F", None)],
)  # fmt: skip
def test_a_kind_has_no_such_quantity(name: str, kind: ComponentKind | None) -> None:
    assert quantity_of(name, kind) is None


def test_the_table_is_of_one_mind() -> None:
    """One role has one dimension; no quantity is without a name, an owner or words; every hint is
    about what cannot be."""
    assert len({(entry.role, entry.size) for entry in QUANTITIES}) == len(
        {entry.role for entry in QUANTITIES}
    )
    assert all(entry.names and entry.owners and entry.what for entry in QUANTITIES)
    for role, owner in INSTEAD:
        assert all(owner not in entry.owners for entry in QUANTITIES if entry.role == role)
    for entry in QUANTITIES:
        for owner in entry.owners:
            found = [
                quantity_of(name.replace("*", below), owner) for name in entry.names for below in ("", "_9")
            ]
            assert entry in found or (entry.role, owner) == ("angular_acceleration", "polygon"), entry


@pytest.mark.parametrize("kind", [*COMPONENT_KINDS, None])
@pytest.mark.parametrize("name", sorted({name.rstrip("*") for entry in QUANTITIES for name in entry.names}))
def test_every_name_of_the_table_on_everything_means_something_or_is_explained(
    name: str, kind: ComponentKind | None
) -> None:
    if kind == "arrow":
        return
    meanings = read(page(PARTS, ((f"{name} = 0.5", None if kind is None else LABELS[kind], None),)))
    (said,) = meanings.said
    if said.quantity is None:
        assert any(name in notice and "not used" in notice for notice in meanings.notices)
        assert quantities_named(name)
    else:
        told = [notice for notice in meanings.notices if "taken for a period" not in notice]
        assert not told


@pytest.mark.parametrize(
    ("text", "label", "name", "owner"),
    [
        ("v_B = 3", None, "v", "B"),
        ("v_B = 3", "B", "v", "B"),
        ("v_B = 3", "C", "v", "B"),
        ("v_xB = 3", None, "v_x", "B"),
        ("v_{Bx} = 3", None, "v_x", "B"),
        ("m_B = 3", None, "m_B", "B"),
        ("W_B = 3", None, "W", "B"),
        ("k_E = 3", None, "k_E", "E"),
        ("T_D = 3", None, "T_D", "D"),
        ("f_C = 3", "B", "f_C", "B"),
        ("f_C = 3", None, "f_C", "C"),
        ("E_C = 3", "B", "E_C", "B"),
        ("v_Q = 3", "B", "v_Q", "B"),
        ("k_B = 3", "E", "k_B", "E"),
    ],
)
def test_a_label_in_a_name_tells_whose_it_is(text: str, label: str | None, name: str, owner: str) -> None:
    (said,) = read(page(PARTS, ((text, label, None),))).said
    assert (said.name, said.component) == (name, owner)


def test_alpha_is_an_angle_of_what_is_inclined_and_otherwise_an_angular_acceleration() -> None:
    for label, role in (("F", "angle"), ("A", "angle"), ("D", "angle"), ("C", "angular_acceleration")):
        (said,) = read(page(PARTS, (("alpha = 0.5", label, None),))).said
        assert said.quantity is not None
        assert said.quantity.role == role


def test_a_period_of_what_hangs_from_a_wire_is_told_from_a_tension() -> None:
    assert any("of the wire" in notice for notice in read(page(PARTS, (("T = 2", "B", None),))).notices)
    assert read(page(PARTS, (("T = 2 s", "B", None),))).notices == ()
    assert read(page(PARTS, (("T = 2", "C", None),))).notices == ()


def test_two_masses_under_two_names_are_a_conflict_and_the_newest_association_wins() -> None:
    built = build(page((BALL,), (("m_1 = 2", "B", None), ("m_2 = 5", "B", None))))
    assert built.scene.body("B").mass == 5
    assert any("m_1 = 2" in notice and "newest" in notice for notice in built.notices)
    assert not any("newest" in notice for notice in build(page((BALL,), (("v = t", "B", None), ("v_0 = 2", "B", None)))).notices)  # fmt: skip


def test_an_answer_governs_nothing() -> None:
    bare = build(page((FLOOR, BALL)))
    answered = build(page((FLOOR, BALL), tuple((f"{name} = 7", "B", None) for name in ("a", "p", "T", "tau", "E_k", "h", "W_1", "v_2"))))  # fmt: skip
    assert answered.scene == bare.scene
    assert answered.notices == bare.notices


def test_a_mass_follows_from_a_weight_or_a_density_where_none_is_given() -> None:
    def mass(*texts: str) -> float:
        remarks = (("g = 10", None, None), *((text, "B", None) for text in texts))
        return build(page((BALL,), remarks)).scene.body("B").mass

    area = build(page((BALL,))).scene.body("B").mass
    assert mass("W = 20") == pytest.approx(2)
    assert mass("W = (0, -20)") == pytest.approx(2)
    assert mass("m = 3", "W = 20") == 3
    assert mass("rho = 4") == pytest.approx(4 * area)
    assert mass("W = m g") == area


@pytest.mark.parametrize(
    ("size", "unit"),
    [
        (FORCE, "N"),
        (ENERGY, "J"),
        (ACCELERATION, "m/s²"),
        (FORCE * TIME / LENGTH, "kg/s"),
        (LENGTH**4, "m⁴"),
        (NUMBER / TIME**3, "1/s³"),
        (MASS**2 / (LENGTH * TIME), "kg²/(m s)"),
        (NUMBER, "1"),
        ((LENGTH * MASS) ** 2, "kg² m²"),
    ],
)  # fmt: skip
def test_a_dimension_is_written_as_its_unit(size: Dimension, unit: str) -> None:
    assert str(size) == unit


def test_dimensions_multiply_as_quantities_do() -> None:
    assert FORCE * LENGTH == MASS * VELOCITY**2 == ENERGY
    assert (LENGTH / ACCELERATION) ** 1 == TIME**2
    assert VELOCITY.spoken == "a velocity (m/s)"


def test_the_formula_of_a_line_stays_with_what_it_says() -> None:
    meanings = read(page((BALL, WIRE), (("g = 10", None, None), ("(v_x, v_y) = (1, 2)", "B", None))))
    assert [(said.name, said.expression) for said in meanings.said] == [("g", 0), ("v_x", 1), ("v_y", 1)]
    assert meanings.said[1].tree == parse("1")


@pytest.mark.parametrize(
    ("name", "axis"),
    [("F_x", "x"), ("f_2y", "y"), ("v_0x", "x"), ("F_max", None), ("F", None), ("x", None), ("F_xy", None)],
)
def test_a_subscript_tells_an_axis_alone_or_after_a_number(name: str, axis: str | None) -> None:
    assert axis_of(name) == axis
