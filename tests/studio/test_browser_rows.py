"""One test in a real browser for each row of the feature list that a person meets: P1-P6, C6, E4.

Pages are prepared by a client without a screen, so that each test draws only what it is about.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page

from sketch.files import document, inkml
from sketch.ink import Ink
from studio_workshop import RAMP, Client, Pen, Served, client, dense, loop, picture, ring, zigzag

INK = {
    "ramp": dense(RAMP),
    "ball": ring(330, 180, 34, start=3.0),
    "equation": dense([(60, 60), (110, 60)], start=6.0),
}


def prepared(studio: Served, page: str) -> None:
    """A ramp and a ball that have been read; the ramp stays."""
    with client(studio.url, page) as one:
        ready(one)


def ready(one: Client) -> tuple[str, str]:
    """(ramp's label, ball's) on a page that was drawn and read."""
    for name in ("ramp", "ball"):
        assert one.draw(INK[name])["said"] == "drawn"
    one.ask(type="analyze")
    kinds = {part["kind"]: part["label"] for part in one.state["components"]}
    one.do(do="fix", component=kinds["polygon"], fixed=True)
    return kinds["polygon"], kinds["circle"]


def state(tab: Page) -> Any:
    return tab.evaluate("inklined.page.state")


def tap(pen: Pen, x: float, y: float) -> None:
    ((x, y),) = pen.on_screen([[x, y]])
    pen.send("mousePressed", x, y, 0.5)
    pen.send("mouseReleased", x, y, 0.0, buttons=0)
    pen.settled()


@pytest.fixture
def read_page(studio: Served, new_page: Callable[[], str], opened) -> tuple[Page, Pen]:
    page = new_page()
    prepared(studio, page)
    tab, pen = opened(page)
    tab.wait_for_function("inklined.page.state.components.length === 2")
    return tab, pen


def test_p1_strokes_of_a_pen_have_time_and_pressure_and_leave_as_inkml_without_loss(
    new_page, opened, tmp_path: Path
) -> None:
    tab, pen = opened(new_page())
    pressed = dense([(100, 100), (220, 140), (300, 90)])
    pen.draw(type(pressed)(pressed.points, pressed.times, np.linspace(0.2, 0.9, len(pressed))))
    pen.settled()
    with tab.expect_download() as saved:
        tab.click("#save")
        tab.click("[data-kind=inkml]")
    file = tmp_path / "ink.inkml"
    saved.value.save_as(file)
    (stroke,) = inkml.read(file)
    assert stroke.pressure is not None and stroke.times is not None
    assert np.ptp(stroke.pressure) > 0.4
    assert np.all(np.diff(stroke.times) >= 0) and stroke.times[-1] > stroke.times[0]
    sent = tab.evaluate("[...inklined.page.ink.values()][0].points")
    assert stroke.points.tolist() == sent


def test_p1_a_mouse_draws_too_and_what_was_drawn_is_there_after_a_reload(new_page, opened) -> None:
    tab, pen = opened(new_page())
    paper = tab.locator("#paper").bounding_box()
    tab.mouse.move(paper["x"] + 100, paper["y"] + 100)
    tab.mouse.down()
    tab.mouse.move(paper["x"] + 300, paper["y"] + 160, steps=8)
    tab.mouse.up()
    pen.settled()
    before = tab.evaluate("[...inklined.page.ink.values()].map(one => one.points)")
    tab.reload()
    tab.wait_for_function("inklined.page.state.strokes.length === 1")
    assert tab.evaluate("[...inklined.page.ink.values()].map(one => one.points)") == before


def test_p2_nothing_is_read_before_somebody_asks_for_it(new_page, opened) -> None:
    tab, pen = opened(new_page())
    for name in ("ramp", "ball"):
        pen.draw(INK[name])
    pen.settled()
    assert state(tab)["components"] == []
    assert "Analyze" in tab.inner_text("#mode")
    tab.keyboard.press("a")
    tab.wait_for_function("inklined.page.state.components.length === 2")
    tab.keyboard.press("Control+z")
    tab.wait_for_function("inklined.page.state.components.length === 0")
    assert len(state(tab)["strokes"]) == 2
    tab.keyboard.press("Control+Shift+Z")
    tab.wait_for_function("inklined.page.state.components.length === 2")


def test_p3_a_tap_frees_and_fixes_a_lasso_selects_what_is_dragged_a_scribble_erases(read_page) -> None:
    tab, pen = read_page
    tap(pen, 400, 300)
    tab.wait_for_function("inklined.page.state.components.every(part => !part.fixed)")
    tap(pen, 400, 300)
    tab.wait_for_function("inklined.page.state.components.some(part => part.fixed)")
    ball = next(part for part in state(tab)["components"] if part["kind"] == "circle")
    pen.draw(loop(Ink((INK["ball"],)), [0], margin=6))
    pen.settled()
    tab.wait_for_function("inklined.page.state.selected.components.length === 1")
    assert "Drag" in tab.inner_text("#mode")
    x, y = ball["shape"]["centre"]
    pen.draw(dense([(x, y), (x - 60, y - 70)]))
    tab.wait_for_function(
        "y => inklined.page.state.components.find(part => part.kind === 'circle').drawn.centre[1] < y - 60",
        arg=y,
    )
    tab.keyboard.press("Escape")
    tab.wait_for_function("inklined.page.state.selected.components.length === 0")
    pen.draw(zigzag(Ink((INK["ramp"],)), [0]), most=80)
    pen.settled()
    tab.wait_for_function("inklined.page.state.components.length === 1")
    for _ in range(2):
        tab.keyboard.press("Control+z")
    tab.wait_for_function("inklined.page.state.components.length === 2")


def test_p3_to_p5_a_formula_that_was_circled_is_said_of_what_is_tapped_shown_on_hover_and_outlives_edits(
    read_page,
) -> None:
    tab, pen = read_page
    tab.keyboard.press("f")
    tab.fill(".formula-text", "v = (2, 1)")
    tab.wait_for_selector(".editor .preview math")
    tab.press(".formula-text", "Enter")
    tab.wait_for_function("inklined.page.state.lines.length === 1")
    x, y = state(tab)["lines"][0]["at"]
    angle = np.linspace(0, 2 * np.pi + 0.1, 80)
    pen.draw(dense(np.column_stack([x + 120 * np.cos(angle), y + 50 * np.sin(angle)])))
    pen.settled()
    tab.wait_for_function("inklined.page.state.selected.lines.length === 1")
    assert "tap" in tab.inner_text("#mode")
    ball = next(part for part in state(tab)["components"] if part["kind"] == "circle")
    tap(pen, *ball["shape"]["centre"])
    tab.wait_for_function("inklined.page.state.associations.length === 1")
    (spot,) = pen.on_screen([ball["shape"]["centre"]])
    tab.mouse.move(5, 5)
    assert tab.locator(".formula.bright").count() == 0
    tab.mouse.move(*spot)
    tab.wait_for_selector(".formula.bright")
    chip = tab.locator(".formula").bounding_box()
    tab.mouse.click(chip["x"] + chip["width"] / 2, chip["y"] + chip["height"] / 2)
    tab.fill(".formula-text", "v = (3, 1)")
    tab.press(".formula-text", "Enter")
    tab.wait_for_function("inklined.page.state.lines[0].text === 'v = (3, 1)'")
    tab.click("#run")
    tab.wait_for_function("inklined.scene.run?.ended")
    tab.click("#reset")
    assert [one["component"] for one in state(tab)["associations"]] == [ball["label"]]


def test_p6_reset_goes_back_to_the_start_values_are_changed_and_it_runs_again(read_page) -> None:
    tab, _pen = read_page
    tab.click("#run")
    tab.wait_for_function("inklined.scene.run?.ended && inklined.player.time > 0.2")
    first = tab.evaluate("inklined.scene.run.pose(inklined.scene.run.head.bodies[0].label, 1).y")
    tab.click("#reset")
    assert tab.evaluate("inklined.scene.run") is None
    assert tab.evaluate("inklined.player.time") == 0
    tab.keyboard.press("f")
    tab.fill(".formula-text", "g = 1.6")
    tab.press(".formula-text", "Enter")
    tab.wait_for_function("inklined.page.state.lines.length === 1")
    tab.keyboard.press("Enter")
    tab.wait_for_function("inklined.scene.run?.ended")
    start = tab.evaluate("inklined.scene.run.pose(inklined.scene.run.head.bodies[0].label, 0).y")
    second = tab.evaluate("inklined.scene.run.pose(inklined.scene.run.head.bodies[0].label, 1).y")
    assert 0 < second - start < 0.5 * (first - start)  # on the moon things fall slowly


def test_c6_every_correction_can_be_seen_and_undone(read_page) -> None:
    tab, _pen = read_page
    made = [one for one in state(tab)["corrections"] if one["made"]]
    assert made
    key = f"correction-{made[0]['rule']}-{made[0]['component']}"
    tab.click("[data-id=compare]")
    assert tab.evaluate("inklined.scene.comparing")
    tab.click("[data-id=compare]")
    before = state(tab)["components"]
    tab.click(f"[data-id='{key}']")
    tab.wait_for_function("inklined.page.state.corrections.some(one => !one.made)")
    assert state(tab)["components"] != before
    tab.click(f"[data-id='{key}']")
    tab.wait_for_function("inklined.page.state.corrections.every(one => one.made)")
    assert state(tab)["components"] == before


def test_e4_quantities_of_a_body_are_arrows_and_graphs_that_can_be_saved(read_page, tmp_path: Path) -> None:
    tab, _pen = read_page
    tab.click("#run")
    tab.wait_for_function("inklined.scene.run?.ended")
    for name in ("net force", "acceleration", "x-displacement"):
        tab.check(f"[data-id='observe-{name}']")
    tab.wait_for_function("document.querySelectorAll('.uplot').length === 4")
    chosen = tab.evaluate("inklined.scene.chosen")
    assert [one["quantity"] for one in chosen if one["bold"]] == ["x-displacement"]
    tab.wait_for_function(
        "inklined.scene.scale.size === 3"
    )  # velocity, force, acceleration: one scale a unit
    with tab.expect_download() as saved:
        tab.click("#csv")
    file = tmp_path / "graphs.csv"
    saved.value.save_as(file)
    head, *rows = file.read_text().splitlines()
    assert head.count(",") == 7 and len(rows) == tab.evaluate("inklined.scene.run.rows")
    tab.evaluate("inklined.player.pause()")
    tab.keyboard.press(".")
    tab.keyboard.press(",")


def test_a_page_is_saved_and_opened_as_a_file_and_the_contest_shows_four_readings(
    read_page, tmp_path: Path
) -> None:
    tab, _pen = read_page
    with tab.expect_download() as saved:
        tab.click("#save")
        tab.click("[data-kind=inklined]")
    file = tmp_path / "page.inklined"
    saved.value.save_as(file)
    assert len(document.read(file).components) == 2
    was = tab.evaluate("inklined.page.state.page")
    tab.set_input_files("input[type=file]", str(file))
    # The address changes first; the page is another one when its first state has come.
    tab.wait_for_function("was => inklined.page.state.page !== was", arg=was)
    tab.wait_for_function("inklined.page.state.components.length === 2")
    tab.keyboard.press("c")
    tab.wait_for_function("document.querySelectorAll('.pane').length === 4")
    names = tab.eval_on_selector_all("[data-reading]", "panes => panes.map(pane => pane.dataset.reading)")
    assert sorted(names) == ["geometric", "hybrid", "learned", "paper"]
    tab.wait_for_timeout(300)  # the panes are drawn
    picture(tab, "contest")
    (spot,) = Pen(tab).on_screen([tab.evaluate("[...inklined.page.ink.values()][0].points[3]")])
    tab.mouse.move(*spot)
    tab.wait_for_selector(".tip .claims")


def test_everything_on_the_page_can_be_walked_by_keyboard(read_page) -> None:
    tab, _pen = read_page
    seen: list[str] = []
    tab.locator("#side").focus()
    for _ in range(14):
        tab.keyboard.press("Tab")
        seen.append(
            tab.evaluate(
                "document.activeElement.getAttribute('aria-label') || document.activeElement.textContent"
            )
        )
    assert any(one.startswith("block") for one in seen) and any(one.startswith("ball") for one in seen)
    names = json.loads(
        tab.evaluate(
            "JSON.stringify([...document.querySelectorAll('button')].filter(b => !b.textContent.trim() && !b.ariaLabel).length)"
        )
    )
    assert names == 0
