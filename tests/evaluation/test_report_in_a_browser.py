"""The report as a browser shows it: opened in Chromium, where there is one."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from PIL import Image

from evaluation.contest import contest_on_generated
from evaluation.report import report

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))),
    None,
)
WIDTH, HEIGHT = 1280, 2400


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")
def test_chromium_shows_the_report_with_its_pictures(tmp_path: Path) -> None:
    html, shot = tmp_path / "report.html", tmp_path / "report.png"
    html.write_text(
        report(contest_on_generated(60, 0, 3, ("paper", "geometric")), "inklined compare"), encoding="utf-8"
    )
    shown = subprocess.run(
        [
            *(str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"),
            *(f"--user-data-dir={tmp_path / 'profile'}", f"--window-size={WIDTH},{HEIGHT}"),
            *(f"--screenshot={shot}", "--dump-dom", html.as_uri()),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert all(
        f'id="{part}"' in shown.stdout for part in ("standings", "strokes", "curves", "differ", "again")
    )
    with Image.open(shot) as picture:
        assert picture.size == (WIDTH, HEIGHT)
        colours = picture.convert("RGB").getcolors(1 << 24)
    assert colours is not None
    background = max(colours)[0] / (WIDTH * HEIGHT)
    assert 0.3 < background < 0.97  # neither an error page nor an empty one
    assert len(colours) > 100
