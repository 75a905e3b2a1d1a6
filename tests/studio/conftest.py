"""One studio and one Chromium for all tests here: both take seconds to start."""

from __future__ import annotations

import json
import urllib.request
from collections.abc import Callable, Generator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from studio.bundle import bundle
from studio_workshop import PATIENCE, Pen, Served, chromium, ready, served

NewPage = Callable[[], str]
Opened = Callable[[str], tuple[Page, Pen]]


@pytest.fixture(scope="session")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Generator[Served]:
    bundle()
    with served(tmp_path_factory.mktemp("studio"), warm=True) as made:
        ready(made)
        yield made


def asked(url: str, method: str = "GET", data: bytes | None = None) -> Any:
    request = urllib.request.Request(url, data, {"content-type": "application/json"}, method=method)
    with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
        return json.loads(answer.read() or b"null")


@pytest.fixture
def new_page(studio: Served) -> NewPage:
    return lambda: asked(f"{studio.url}/api/pages", "POST", b"{}")["id"]


@pytest.fixture(scope="session")
def browser() -> Generator[Browser]:
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture
def opened(browser: Browser, studio: Served) -> Generator[Opened]:
    """Opens a page of the notebook in a tab of its own; errors on it fail the test."""
    contexts: list[Any] = []
    errors: list[str] = []

    def open_page(page: str) -> tuple[Page, Pen]:
        context = browser.new_context(
            viewport={"width": 1280, "height": 800}, bypass_csp=True, reduced_motion="reduce"
        )
        contexts.append(context)
        context.set_default_timeout(PATIENCE * 1000)
        tab = context.new_page()
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.add_init_script("localStorage.setItem('inklined-guided', 'done')")
        tab.goto(f"{studio.url}/#page={page}")
        tab.wait_for_function("window.inklined && inklined.page.state.page !== ''")
        return tab, Pen(tab)

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []
