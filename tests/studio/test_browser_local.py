"""Recognition in the browser alone: a static page, whose host knows nothing of ink, says what was drawn."""

from __future__ import annotations

import re
from collections.abc import Generator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import numpy as np
import pytest
from playwright.sync_api import Browser, Page

from recognizer.learned.recognizer import Learned
from sketch.files import jsonl
from sketch.ink import Ink, Stroke
from studio.bundle import copy
from studio_workshop import PATIENCE, Pen, Served, dense, ring


class Silent(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: object) -> None: ...


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Generator[str]:
    """Serves nothing but files."""
    folder = tmp_path_factory.mktemp("host")
    copy(folder)
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Silent, directory=str(folder)))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/local.html"
    server.shutdown()


def shown(browser: Browser, url: str) -> tuple[Page, Pen]:
    tab = browser.new_context(viewport={"width": 1000, "height": 700}, accept_downloads=True).new_page()
    tab.set_default_timeout(PATIENCE * 1000)
    tab.goto(url)
    tab.wait_for_selector("text=says what each is")
    return tab, Pen(tab)


def draw(tab: Page, pen: Pen, stroke: Stroke) -> None:
    """By a pen, in pixels of the paper."""
    paper = tab.locator("#paper").bounding_box()
    assert paper is not None
    corner = np.array([paper["x"], paper["y"]])
    points = stroke.points[:: max(1, len(stroke) // 30)] + corner
    pen.send("mousePressed", *points[0].tolist(), 0.5)
    for x, y in points[1:].tolist():
        pen.send("mouseMoved", x, y, 0.5)
    pen.send("mouseReleased", *points[-1].tolist(), 0.0, buttons=0)


def test_a_ring_is_told_to_be_a_circle_by_a_page_that_has_no_server(
    browser: Browser, host: str, tmp_path: Path
) -> None:
    tab, pen = shown(browser, host)
    draw(tab, pen, ring(300, 250, 80))
    tab.wait_for_selector("#overlay [data-kind=circle]")
    zigzag = np.column_stack([np.linspace(480, 700, 15), np.where(np.arange(15) % 2, 150.0, 190.0)])
    draw(tab, pen, dense(zigzag, start=4.0))
    tab.wait_for_selector("#overlay [data-kind=spring]")
    assert tab.locator("#side li").count() == 2
    with tab.expect_download() as saved:
        tab.click("#save")
    file = tmp_path / "ink.jsonl"
    saved.value.save_as(file)
    (row,) = jsonl.read(file).rows
    claims = Learned().recognize(Ink(row.ink.strokes))
    said = tab.locator("#overlay span").all_inner_texts()
    for text, claim in zip(said, claims, strict=True):
        found = re.fullmatch(r"(\w+) (\d+) %", text)
        assert found is not None and found[1] == claim.kind
        assert abs(int(found[2]) - 100 * claim.confidence) < 2  # times are rounded in the file
    tab.keyboard.press("Control+z")
    tab.wait_for_function("document.querySelectorAll('#overlay span').length === 1")


def test_the_studio_serves_that_page_under_its_own_rules_and_it_asks_the_studio_nothing(
    browser: Browser, studio: Served
) -> None:
    tab = browser.new_page()
    asked: list[str] = []
    tab.route("**/api/**", lambda route: route.abort())
    tab.on("request", lambda request: asked.append(request.url))
    tab.set_default_timeout(PATIENCE * 1000)
    tab.goto(f"{studio.url}/local/local.html")
    tab.wait_for_selector("text=says what each is")
    draw(tab, Pen(tab), ring(300, 250, 80))
    tab.wait_for_selector("#overlay [data-kind=circle]")
    assert all(url.startswith(f"{studio.url}/local/") for url in asked)
    tab.close()
