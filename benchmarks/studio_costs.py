"""What the studio costs in a real Chromium.

    python benchmarks/studio_costs.py --json studio.json

load: a first load over loopback, milliseconds and bytes; pen: work in each pointer event with 500 strokes on the page;
analyze: from the click to the drawn page of 40 strokes, of which the lines have been read as they are while one draws; formula: from pressing a key to the formula shown; live: from a pen-up
to the MathML of the line that it went on with, the 40 strokes of a page drawn one after the other; play: milliseconds between
frames, and of work in them, with 20 bodies and three graphs. Figures hang on what else the machine does: its load is told. What does
not is the CPU time of the server's part of live and of analyze, which is measured apart, in this process (--cpu: it alone).
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
import urllib.request
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from playwright.sync_api import Page, sync_playwright

from data_gen.pages import Page as Drawn
from data_gen.pages import page as generated
from sketch.files import document
from sketch.ink import Ink
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon
from studio.actions import done
from studio.board import Board
from studio.live import begun, read_on, reader_from
from studio.reading import HandReader, analyzed, reader
from studio.view import shown
from studio_workshop import Pen, Served, chromium, dense, ready, ring, served

T = TypeVar("T")


def main() -> None:
    parser = argparse.ArgumentParser(description="The studio in Chromium.")
    parser.add_argument("--times", type=int, default=20, help="analyses")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--cpu", action="store_true", help="measure the server's CPU time only")
    options = parser.parse_args()
    figures: dict[str, Any] = {"server's part, ms of CPU": _cpu(options.times)}
    if options.cpu:
        print(json.dumps(figures, indent=1))
        return
    with (
        tempfile.TemporaryDirectory() as folder,
        served(Path(folder), warm=True) as studio,
        sync_playwright() as playwright,
    ):
        ready(studio)
        browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        context = browser.new_context(viewport={"width": 1280, "height": 800}, bypass_csp=True)
        context.add_init_script("localStorage.setItem('inklined-guided', 'done')")
        tab = context.new_page()
        tab.set_default_timeout(300_000)
        figures |= {
            "load average": os.getloadavg()[0],
            "load": _load(tab, studio),
            "pen, ms an event": _pen(tab, studio),
            "analyze of 40 strokes, ms": _analyze(tab, studio, options.times),
            "formula, ms": _formula(tab),
            "live mathematics, ms": _live(tab, studio),
            "play": _play(tab, studio),
        }
        browser.close()
    print(json.dumps(figures, indent=1))
    if options.json:
        options.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


def _cpu(times: int) -> dict[str, Any]:
    """Milliseconds of this process's CPU: a line going on by a stroke, as the 40 of a page are drawn; the page analyzed then,
    and analyzed where nothing had been read before."""
    ink = _forty().truth.ink
    names = tuple(f"s{k}" for k in range(len(ink)))

    def board(count: int) -> Board:
        return Board(names[:count], Sketch(Ink(ink.strokes[:count])), ((0.0, 0.0),) * count)

    def spent(job: Callable[[], T]) -> tuple[float, T]:
        began = time.process_time()
        result = job()
        return 1000 * (time.process_time() - began), result

    whole = board(len(ink))
    analyzed(whole)  # all is loaded and compiled
    live, pen_ups = begun(), list[float]()
    for count in range(1, len(ink) + 1):
        took, live = spent(partial(read_on, live, board(count), reader()))
        pen_ups.append(took)
    known = [spent(lambda: shown(after(whole, reader_from(live))))[0] for _ in range(times)]
    anew = [spent(lambda: shown(after(whole, None)))[0] for _ in range(times)]
    return {
        "pen-up": _spread(pen_ups),
        "analyze": _spread(known),
        "analyze, nothing read before": _spread(anew),
    }


def after(board: Board, hand: HandReader | None) -> Board:
    """The board when it has been analyzed."""
    return done(board, analyzed(board, hand=hand), lambda name: board.sketch.ink[int(name[1:])])


def _spread(values: list[float]) -> dict[str, float]:
    array = np.array(values)
    return {
        "median": round(float(np.median(array)), 2), "p95": round(float(np.percentile(array, 95)), 2),
        "most": round(float(array.max()), 2), "n": len(array),
    }  # fmt: skip


def _open(tab: Page, studio: Served, sketch: Sketch) -> None:
    request = urllib.request.Request(
        f"{studio.url}/api/open?name=bench.inklined", document.dumps(sketch).encode(), method="POST"
    )
    page = json.loads(urllib.request.urlopen(request).read())["id"]
    tab.goto(f"{studio.url}/#page={page}")
    tab.wait_for_function("id => inklined.page.state.page === id", arg=page)
    tab.wait_for_timeout(500)


def _load(tab: Page, studio: Served) -> dict[str, Any]:
    tab.goto(studio.url)
    tab.wait_for_function("window.inklined && inklined.page.state.page !== ''")
    return tab.evaluate(
        """() => {
            const entries = [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")];
            return { ms: Math.round(performance.now()), dom_ms: Math.round(performance.getEntriesByType("navigation")[0].domContentLoadedEventEnd),
                     kB: Math.round(entries.reduce((sum, one) => sum + (one.transferSize || 0), 0) / 1000) };
        }"""
    )


def _pen(tab: Page, studio: Served) -> dict[str, float]:
    strokes = [
        dense(
            [(20 + 40 * (k % 20), 20 + 24 * (k // 20)), (44 + 40 * (k % 20), 34 + 24 * (k // 20))], step=1.0
        )
        for k in range(500)
    ]
    _open(tab, studio, Sketch(Ink(tuple(strokes))))
    assert tab.evaluate("inklined.page.state.strokes.length") == 500
    pen = Pen(tab)
    tab.evaluate("inklined.wet.spent.length = 0")
    for turn in range(8):
        pen.draw(ring(300 + 10 * turn, 300, 60 + 5 * turn), most=60)
    return _spread(tab.evaluate("Array.from(inklined.wet.spent)"))


def _forty() -> Drawn:
    """A generated page of some 40 strokes."""
    pages = (generated("box-on-two-wires", seed, 0) for seed in range(100))
    return next(page for page in pages if 38 <= len(page.truth.ink) <= 42)


def _analyze(tab: Page, studio: Served, times: int) -> dict[str, float]:
    truth = _forty().truth
    spent: list[float] = []
    for _ in range(times):
        _open(tab, studio, Sketch(truth.ink))
        # Whoever has drawn a page has had its lines read meanwhile: a page that has just been opened waits for that.
        tab.wait_for_function("count => inklined.page.live.length === count", arg=len(truth.expressions))
        spent.append(
            tab.evaluate(
                """async () => {
                    const began = performance.now();
                    document.getElementById("analyze").click();
                    while (!inklined.page.state.components.length) await new Promise(requestAnimationFrame);
                    await new Promise(requestAnimationFrame);
                    return performance.now() - began;
                }"""
            )
        )
    return _spread(spent)


def _live(tab: Page, studio: Served) -> dict[str, Any]:
    """Everything is drawn, a sixth of a second between strokes, as fast hands do."""
    truth = _forty().truth
    _open(tab, studio, Sketch())
    tab.evaluate("inklined.formulas.spent.length = 0")
    pen = Pen(tab)
    for stroke in truth.ink:
        pen.draw(stroke, most=20)
        tab.wait_for_timeout(160)
    tab.wait_for_timeout(1500)
    lines = tab.locator(".formula.live").count()
    spent: list[float] = tab.evaluate("Array.from(inklined.formulas.spent)")
    return {
        **_spread(spent),
        # The others are strokes that look like a drawing until what is written after them says otherwise.
        "share within 200 ms": sum(one <= 200 for one in spent) / len(spent),
        "lines shown": lines,
        "lines": len(truth.expressions),
    }


def _formula(tab: Page) -> dict[str, float]:
    tab.keyboard.press("f")
    spent: list[float] = []
    for text in (
        "v",
        "v = 3",
        "v = 3 m/s",
        "F = m a",
        "theta = pi/6",
        "f = mu N",
        "x = 1/2 g t^2",
        "E = 1/2 m v^2",
    ):
        spent.append(
            tab.evaluate(
                """async text => {
                    const input = document.querySelector(".formula-text"), shown = document.querySelector(".preview");
                    const before = shown.innerHTML, began = performance.now();
                    input.value = text;
                    input.dispatchEvent(new Event("input"));
                    while (shown.innerHTML === before) await new Promise(requestAnimationFrame);
                    return performance.now() - began;
                }""",
                text,
            )
        )
    return _spread(spent)


def _play(tab: Page, studio: Served) -> dict[str, Any]:
    floor = Component(Polygon([[0, 560], [1200, 560], [1200, 600], [0, 600]]), (), "F", fixed=True)
    balls = tuple(
        Component(Circle((60 + 110 * (k % 10), 120 + 160 * (k // 10)), 24), (), f"B{k}") for k in range(20)
    )
    _open(tab, studio, Sketch(components=(floor, *balls)))
    tab.click("#run")
    tab.wait_for_function("inklined.scene.run?.ended")
    for name in ("acceleration", "x-displacement"):
        tab.check(f"[data-id='observe-{name}']")
    tab.wait_for_function("document.querySelectorAll('.uplot').length === 3")
    tab.evaluate(
        "inklined.player.pause(); inklined.player.seek(0); inklined.player.frames.length = inklined.player.work.length = 0; inklined.player.play()"
    )
    tab.wait_for_function("!inklined.player.playing")
    between, work = tab.evaluate("[inklined.player.frames.slice(2), inklined.player.work.slice(2)]")
    late = sum(one > 33.4 for one in between)
    return {
        "between frames, ms": _spread(between),
        "frames over 33 ms": late,
        "work in a frame, ms": _spread(work),
    }


if __name__ == "__main__":
    main()
