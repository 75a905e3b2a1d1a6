"""The report is one file that holds all it shows, and shows all that was compared."""

from __future__ import annotations

import re
from html.parser import HTMLParser

import pytest

from data_gen.problems import PROBLEMS
from evaluation.contest import contest_on_files, contest_on_generated
from evaluation.illustrations import ABOUT
from evaluation.report import report
from evaluation.summary import contest_summary
from sketch.page import STROKE_KINDS

VOID = {"meta", "br", "img", "hr", "input"}
MOST = 6_000_000
"""Bytes that a report may have: it must open at once and fit into a mail."""


class Structure(HTMLParser):
    """Checks that tags close in order; collects text, attributes and counts."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.references: list[str] = []
        self.ids: set[str] = set()
        self.text: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.references += [
            value or "" for name, value in attrs if name in ("src", "href", "xlink:href", "data")
        ]
        self.ids |= {value for name, value in attrs if name == "id"}
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def structure(html: str) -> Structure:
    parsed = Structure()
    parsed.feed(html)
    parsed.close()
    assert parsed.open == []
    return parsed


@pytest.fixture(scope="module")
def contest():
    return contest_on_generated(90, 6, 3, ("paper", "geometric"))


@pytest.fixture(scope="module")
def html(contest):
    return report(contest, "inklined compare <& co>")


def test_it_loads_nothing_from_anywhere(html):
    parsed = structure(html)
    assert all(reference.startswith("#") for reference in parsed.references)
    assert {"link", "script", "iframe", "img", "object"}.isdisjoint(parsed.tags)
    assert not re.search(r"url\(|@import", html)
    assert len(html.encode()) < MOST


def test_its_links_lead_somewhere_and_what_was_typed_is_escaped(html):
    parsed = structure(html)
    assert {reference[1:] for reference in parsed.references} <= parsed.ids
    assert "<& co>" in "".join(parsed.text)
    assert "<& co>" not in html


def test_every_diagram_is_shown_in_every_recognizers_hands_right_and_wrong(html):
    assert set(ABOUT) == set(PROBLEMS)
    html = re.sub(
        r'<section id="differ">.*?</section>', "", html, flags=re.DOTALL
    )  # shows some pages besides
    parsed = structure(html)
    words = " ".join(" ".join(parsed.text).split())
    assert set(PROBLEMS) <= parsed.ids
    for title, _ in ABOUT.values():
        assert title in words
    assert words.count("Too small") == words.count("Too great") == words.count("The right answer") == 2
    views = len(PROBLEMS) + 4
    strips = html.count("moments of the motion")
    assert strips == 3 * views  # truth, paper and geometric
    assert html.count("speed, m/s") >= views


def test_the_figures_of_the_summary_stand_in_it(contest, html):
    words = "".join(structure(html).text)
    summary = contest_summary(contest)
    for result in summary["recognizers"].values():
        assert f"{100 * result['balanced_accuracy']:.1f}" in words
    assert summary["pages"]["recognizers"].keys() == {"paper", "geometric", "oracle"}
    assert all(kind in words for kind in STROKE_KINDS)
    assert "Seed" in words


def test_the_oracle_reads_pages_at_least_as_well_as_anybody(contest):
    pages = contest_summary(contest)["pages"]["recognizers"]
    for name in ("paper", "geometric"):
        assert pages["oracle"]["strokes"] >= pages[name]["strokes"]
        assert pages["oracle"]["components"] >= pages[name]["components"]


def test_a_report_on_files_has_strokes_only(tmp_path):
    path = tmp_path / "rows.jsonl"
    path.write_text('{"label": "wire", "writer": null, "strokes": [[[0, 0, null], [90, 9, null]]]}\n' * 3)
    parsed = structure(report(contest_on_files([path], ("paper",)), "inklined compare --ink rows.jsonl"))
    assert "strokes" in parsed.ids
    assert "pages" not in parsed.ids
