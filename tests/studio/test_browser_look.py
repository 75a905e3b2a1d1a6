"""For eyes and hands of every sort: dark and light paper with enough contrast, no motion where none is wanted, names for
all that can be pressed, and a list of the page's things to be walked."""

from __future__ import annotations

from collections.abc import Callable, Generator

import pytest
from playwright.sync_api import Browser, Page

from studio_workshop import PATIENCE, RAMP, Served, client, dense, ring

CONTRAST = """() => {
    const light = text => {
        const [r, g, b] = text.match(/[\\d.]+/g).map(Number).map(c => c / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const opaque = element => {
        for (let one = element; one; one = one.parentElement) {
            const found = getComputedStyle(one).backgroundColor;
            if (!/rgba\\(.*, 0\\)|transparent|color\\(/.test(found)) return found;
        }
        return 'rgb(255, 255, 255)';
    };
    const poor = [];
    for (const element of document.body.querySelectorAll('button, h2, p, li, span, label, select, output, footer')) {
        const own = [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
        if (!own || !element.checkVisibility({ opacityProperty: true, visibilityProperty: true }) || element.disabled) continue;
        const [a, b] = [light(getComputedStyle(element).color), light(opaque(element))].sort((x, y) => y - x);
        if ((a + 0.05) / (b + 0.05) < 4.5) poor.push(`${element.tagName} ${element.textContent.trim().slice(0, 30)}: ${((a + 0.05) / (b + 0.05)).toFixed(2)}`);
    }
    return poor;
}"""


@pytest.fixture
def look(browser: Browser, studio: Served, new_page: Callable[[], str]) -> Generator[Callable[..., Page]]:
    """Opens a page with a ramp and a ball, not read yet, in a browser with these settings."""
    made = []

    def opened(**settings: str) -> Page:
        page = new_page()
        with client(studio.url, page) as one:
            one.draw(dense(RAMP))
            one.draw(ring(330, 180, 34, 3.0))
        context = browser.new_context(viewport={"width": 1280, "height": 800}, bypass_csp=True, **settings)
        made.append(context)
        context.set_default_timeout(PATIENCE * 1000)
        context.add_init_script("localStorage.setItem('inklined-guided', 'done')")
        tab = context.new_page()
        tab.goto(f"{studio.url}/#page={page}")
        tab.wait_for_function("window.inklined && inklined.page.state.strokes.length === 2")
        return tab

    yield opened
    for context in made:
        context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stands_out_from_its_ground_whatever_the_system_prefers(look, scheme: str) -> None:
    tab = look(color_scheme=scheme, reduced_motion="reduce")
    assert tab.evaluate("document.documentElement.dataset.theme") == scheme
    tab.keyboard.press("a")
    tab.wait_for_function("inklined.page.state.components.length === 2")
    tab.keyboard.press("Enter")
    tab.wait_for_function("inklined.scene.run?.ended")
    assert tab.evaluate(CONTRAST) == []
    tab.click("#theme")
    other = "dark" if scheme == "light" else "light"
    assert tab.evaluate("document.documentElement.dataset.theme") == other
    assert tab.evaluate(CONTRAST) == []


@pytest.mark.parametrize(("motion", "moves"), [("reduce", False), ("no-preference", True)])
def test_ink_becomes_things_by_itself_only_where_motion_is_wanted(look, motion: str, moves: bool) -> None:
    tab = look(reduced_motion=motion)
    tab.evaluate(
        """() => {
            const { painter } = inklined.view, ink = painter.ink.bind(painter);
            window.moved = false;
            painter.ink = scene => { window.moved ||= painter.busy; ink(scene); };
        }"""
    )
    tab.keyboard.press("a")
    tab.wait_for_function("inklined.page.state.components.length === 2")
    tab.wait_for_timeout(200)
    assert tab.evaluate("window.moved") is moves


def test_what_is_on_the_page_is_a_list_and_what_is_drawn_is_not_read_out(look) -> None:
    tab = look(reduced_motion="reduce")
    tab.keyboard.press("a")
    tab.wait_for_function("inklined.page.state.components.length === 2")
    things = tab.get_by_role("list", name="What is on the page").get_by_role("listitem")
    assert things.count() == 2
    names = [
        tab.get_by_role("button", name=name).count()
        for name in ("block B", "ball A", "block A", "ball B", "Undo", "Redo")
    ]
    assert sum(names) >= 4
    assert tab.locator("canvas:not([aria-hidden=true])").count() <= tab.locator("[role=img] canvas").count()
    assert tab.locator("#mode[aria-live=polite]").inner_text()
    tab.keyboard.press("?")
    sheet = tab.locator("dialog.help")
    assert sheet.is_visible() and "Analyze" in sheet.inner_text()
    tab.keyboard.press("Escape")
    assert not sheet.is_visible()
