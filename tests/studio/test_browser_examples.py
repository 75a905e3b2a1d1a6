"""The two worked examples in a real browser (rows E6 and E7), from a blank page by a pen's strokes: once with what was
written corrected by hand, then with a wrong answer and what the page says about it; once by ink alone."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page

from data_gen.pages import page as generated
from sketch.formula.parse import parse
from sketch.formula.print import plain as as_typed
from sketch.page import Sketch
from studio_workshop import PICTURES, Pen, loop, picture, plain


def film(tab: Page, name: str, until: float, count: int = 20) -> None:
    """A short GIF of the run, its frames set by the slider of the time."""
    if not PICTURES:
        return
    tab.evaluate("document.getElementById('toasts').replaceChildren()")
    shots: list[Image.Image] = []
    for seconds in np.linspace(0.0, until, count).tolist():
        tab.evaluate("seconds => { inklined.player.pause(); inklined.player.seek(seconds); }", seconds)
        shot = (
            Image.open(BytesIO(tab.screenshot())).convert("RGB").resize((800, 500), Image.Resampling.LANCZOS)
        )
        shots.append(shot.quantize(48, dither=Image.Dither.NONE))
    pause = round(1000 * until / count)
    shots[0].save(
        Path(PICTURES) / f"{name}.gif",
        save_all=True,
        append_images=shots[1:],
        duration=pause,
        loop=0,
        optimize=True,
    )


def drawn(tab: Page, pen: Pen, truth: Sketch, live: bool = False) -> None:
    """Draws everything and analyzes it; live: when every line that was written is shown as it reads."""
    for stroke in truth.ink:
        pen.draw(stroke)
    pen.settled()
    assert tab.evaluate("inklined.page.state.strokes.length") == len(truth.ink), (
        "a stroke was taken for a gesture"
    )
    if live:
        tab.wait_for_function(
            """count => inklined.page.writing().reduce((sum, line) => sum + line.strokes.length, 0) === count
                && document.querySelectorAll('.formula.live math').length === inklined.page.writing().length""",
            arg=sum(len(line.strokes) for line in truth.expressions),
        )
        picture(tab, f"{len(truth.ink)}-strokes-live")
    tab.click("#analyze")
    tab.wait_for_function("inklined.page.state.components.length > 0")


def drawn_and_read(tab: Page, pen: Pen, truth: Sketch) -> None:
    """Draws everything, analyzes, and types what each line says, whatever was read."""
    drawn(tab, pen, truth)
    for line in truth.expressions:
        box = truth.ink.points_of(line.strokes)
        number, *chip = tab.evaluate(
            """([x, y]) => {
                const lines = inklined.page.state.lines.slice();
                const away = line => { const b = inklined.page.lineBox(line); return Math.hypot((b.left + b.right) / 2 - x, (b.top + b.bottom) / 2 - y); };
                const nearest = lines.sort((a, b) => away(a) - away(b))[0].line;
                const r = document.querySelector(`[data-line="${nearest}"]`).getBoundingClientRect();
                return [nearest, r.left + r.width / 2, r.top + r.height / 2];
            }""",
            ((box.min(axis=0) + box.max(axis=0)) / 2).tolist(),
        )
        tab.mouse.click(*chip)
        tab.fill(".formula-text", line.text)
        tab.press(".formula-text", "Enter")
        tab.wait_for_function(
            "([n, text]) => inklined.page.state.lines.find(line => line.line === n).text === text",
            arg=[number, line.text],
        )


def said_of(tab: Page, pen: Pen, truth: Sketch) -> None:
    """Circles each formula's ink and taps what it is said of."""
    for count, one in enumerate(truth.associations, start=1):
        pen.draw(loop(truth.ink, truth.expressions[one.expression].strokes))
        pen.settled()
        tab.wait_for_function("inklined.page.state.selected.lines.length === 1")
        (at,) = pen.on_screen([list(one.anchor)])
        pen.send("mousePressed", *at, 0.5)
        pen.send("mouseReleased", *at, 0.0, buttons=0)
        tab.wait_for_function("n => inklined.page.state.associations.length === n", arg=count)


def ran(tab: Page) -> str:
    tab.click("#run")
    tab.wait_for_function("inklined.scene.run?.ended")
    tab.wait_for_selector(".told li")
    return plain(tab.inner_text(".told"))


def rewritten(tab: Page, was: str, now: str) -> None:
    tab.click("#reset")
    number = tab.evaluate("was => inklined.page.state.lines.find(line => line.text === was).line", was)
    tab.evaluate("line => inklined.edit(line)", number)
    tab.fill(".formula-text", now)
    tab.press(".formula-text", "Enter")
    tab.wait_for_function("now => inklined.page.state.lines.some(line => line.text === now)", arg=now)


def test_e6_a_ball_rolls_down_an_incline_and_its_speed_is_a_straight_line(
    new_page: Callable[[], str], opened
) -> None:
    truth = generated("incline-and-ball", 7, 0, "right").truth
    tab, pen = opened(new_page())
    drawn_and_read(tab, pen, truth)
    said_of(tab, pen, truth)
    picture(tab, "e6-read")
    assert "rolls" in ran(tab)
    tab.wait_for_selector(".uplot")
    speeds = tab.evaluate(
        "Array.from(inklined.scene.run.series.get(`${inklined.scene.chosen[0].body} velocity`).values)"
    )
    speed = np.hypot(*np.array(speeds).reshape(-1, 2).T)[:48]  # while it is on the ramp
    line = np.polyfit(np.arange(48), speed, 1)
    assert np.abs(np.polyval(line, np.arange(48)) - speed).max() < 0.01 * np.ptp(speed)
    tab.evaluate("inklined.player.pause(); inklined.player.seek(0.6)")
    picture(tab, "e6-rolls")
    film(tab, "e6", 1.2)
    right = next(line.text for line in truth.expressions if line.text and line.text.startswith("f_1"))
    rewritten(tab, right, "f_1 = 1.2 |W| cos(theta)")
    tab.wait_for_selector("#remarks .verdict.wrong")
    assert "too great" in plain(tab.inner_text("#remarks"))
    assert "flies off" in ran(tab)
    picture(tab, "e6-flies-off")


def test_e7_a_box_on_two_wires_stays_and_a_wrong_tension_breaks_a_wire(
    new_page: Callable[[], str], opened
) -> None:
    truth = generated("box-on-two-wires", 7, 0, "right").truth
    tab, pen = opened(new_page())
    drawn_and_read(tab, pen, truth)
    said_of(tab, pen, truth)
    assert "stays" in ran(tab)
    picture(tab, "e7-stays")
    rewritten(tab, "T_1 = 5 sqrt(2)", "T_1 = 4")
    tab.wait_for_selector("#remarks .verdict.wrong")
    assert "too small" in plain(tab.inner_text("#remarks"))
    told = ran(tab)
    assert "stays" not in told
    assert "break" in tab.evaluate("inklined.scene.run.events.map(event => event.kind)")
    tab.evaluate("inklined.player.pause(); inklined.player.seek(0.5)")
    picture(tab, "e7-breaks")


@pytest.mark.parametrize(
    ("diagram", "writer", "happens"), [("incline-and-ball", 3, "rolls"), ("box-on-two-wires", 0, "stays")]
)
def test_e6_and_e7_by_ink_alone(
    new_page: Callable[[], str], opened, diagram: str, writer: int, happens: str
) -> None:
    truth = generated(diagram, 7, writer, "right").truth
    tab, pen = opened(new_page())
    drawn(tab, pen, truth, live=True)
    read = tab.evaluate("inklined.page.state.lines.map(line => line.text)")
    assert sorted(as_typed(parse(text)) for text in read) == sorted(
        as_typed(parse(line.text)) for line in truth.expressions if line.text
    )
    said_of(tab, pen, truth)
    assert happens in ran(tab)
    picture(tab, f"{diagram}-by-ink-alone")
