"""InkML: our own to the bit and back, the W3C's examples by their published values, people's files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import inks

from sketch.files import inkml
from sketch.files.errors import FileError
from sketch.ink import Ink, Stroke

REAL = os.environ.get("INKLINED_REAL_INK")


@settings(max_examples=150, deadline=None)
@given(inks())
def test_reading_what_was_written_gives_the_same_ink_to_the_bit(ink: Ink) -> None:
    assert inkml.loads(inkml.dumps(ink)) == ink


def test_files_are_read_packed_or_not(tmp_path: Path) -> None:
    ink = Ink((Stroke([[0.1, 1e-300], [2, 3]], [0, 0.1], [0.5, 1]), Stroke([[1, 2]])))
    for name in ("page.inkml", "page.inkml.gz"):
        inkml.write(tmp_path / name, ink)
        assert inkml.read(tmp_path / name) == ink


def only(text: str) -> Stroke:
    (stroke,) = inkml.loads(text)
    return stroke


def test_differences_of_the_first_and_second_order_are_the_recommendation_s_example() -> None:
    """InkML 3.2.1: the trace of its table of interpretations."""
    stroke = only("<ink><trace>1125 18432,'23'43,\"7\"-8,3-5,7 -3,6 2,6 8,3 6,2 4,*5,2 4</trace></ink>")
    velocity = [
        (23, 43),
        (30, 35),
        (33, 30),
        (40, 27),
        (46, 29),
        (52, 37),
        (55, 43),
        (57, 47),
        (59, 52),
        (61, 56),
    ]
    assert stroke.points.tolist() == np.cumsum([(1125, 18432), *velocity], axis=0).tolist()


def test_an_exclamation_mark_ends_differences_and_a_star_repeats() -> None:
    assert only("<ink><trace>10 10, '1 '2, * *, !5 !6, * 7</trace></ink>").points.tolist() == [
        [10, 10], [11, 12], [12, 14], [5, 6], [5, 7],
    ]  # fmt: skip


CHANNELS = '<traceFormat xml:id="f"><channel name="F"/><channel name="Y"/><channel name="T" units="{unit}"/><channel name="X"/></traceFormat>'


@pytest.mark.parametrize(
    ("unit", "value", "seconds"), [("s", "0.5", 0.5), ("ms", "500", 0.5), ("us", "500", 0.0005)]
)
def test_channels_come_in_any_order_and_time_in_any_unit(unit: str, value: str, seconds: float) -> None:
    stroke = only(f"<ink>{CHANNELS.format(unit=unit)}<trace>0.7 2 {value} 1</trace></ink>")
    assert stroke == Stroke([[1, 2]], [seconds], [0.7])


def test_a_time_offset_is_added_in_milliseconds() -> None:
    timed = CHANNELS.format(unit="s")
    assert only(f'<ink>{timed}<trace timeOffset="250">1 2 1.5 3</trace></ink>').times == pytest.approx([1.75])
    assert only('<ink><trace timeOffset="250">1 2</trace></ink>').times is None


def test_formats_come_through_contexts_ink_sources_and_groups() -> None:
    definitions = f'<definitions><inkSource xml:id="pen">{CHANNELS.format(unit="s")}</inkSource><context xml:id="c" inkSourceRef="#pen"/></definitions>'
    trace = "<trace>0.7 2 0.5 1</trace>"
    expected = Stroke([[1, 2]], [0.5], [0.7])
    for body in (
        f'<trace contextRef="#c">{trace[7:]}',
        f'<traceGroup contextRef="#c"><traceGroup>{trace}</traceGroup></traceGroup>',
        f'<context contextRef="#c"/>{trace}',
        f'<context xml:id="d" traceFormatRef="#f"/>{trace}',
        f"<context><inkSource>{CHANNELS.format(unit='s').replace('xml:id', 'id2')}</inkSource></context>{trace}",
    ):
        assert only(f"<ink>{definitions}{body}</ink>") == expected


def test_traces_that_are_not_on_the_page_are_not_ink() -> None:
    text = '<ink><definitions><trace>1 1</trace></definitions><trace type="penUp">2 2</trace><trace>3 3</trace><traceView/></ink>'
    assert only(text) == Stroke([[3, 3]])


def test_intermittent_channels_are_passed_over() -> None:
    form = '<traceFormat><channel name="X"/><channel name="Y"/><intermittentChannels><channel name="F"/><channel name="S"/></intermittentChannels></traceFormat>'
    assert only(f"<ink>{form}<trace>1 2, 3 4 9, 5 6 ? T</trace></ink>") == Stroke([[1, 2], [3, 4], [5, 6]])


def test_namespaces_and_prefixes_do_not_matter() -> None:
    for text in (
        '<ink xmlns="http://www.w3.org/2003/InkML"><trace>1 2</trace></ink>',
        '<i:ink xmlns:i="http://www.w3.org/2003/InkML"><i:trace>1 2</i:trace></i:ink>',
        "<ink><undeclared:trace>1 2</undeclared:trace></ink>",
    ):
        assert only(text) == Stroke([[1, 2]])


def test_what_is_not_taken_as_it_stands_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "page.inkml"
    form = '<traceFormat><channel name="X"/><channel name="Y"/><channel name="T"/></traceFormat>'
    path.write_text(
        f"<ink>{form}<trace/>\n<trace>1 2 5, 1 2 4</trace>\n<trace>1 2 ?</trace></ink>", encoding="utf-8"
    )
    loaded = inkml.load(path)
    assert [stroke.times for stroke in loaded.ink] == [None, None]
    assert [(notice.line, notice.lost) for notice in loaded.notices] == [(1, True), (2, False), (3, False)]


BOMB = '<!DOCTYPE ink [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]><ink><trace>&b;</trace></ink>'
SPY = '<!DOCTYPE ink [<!ENTITY a SYSTEM "file:///etc/passwd">]><ink><trace>&a;</trace></ink>'


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "not well-formed XML"),
        ("<ink>", "not well-formed XML"),
        ("no ink", "line 1: is not well-formed XML"),
        ("<svg/>", "outermost element is <svg>; InkML has <ink>"),
        (BOMB, "XML entities"),
        (SPY, "XML entities"),
        ("<ink>" * 100 + "</ink>" * 100, "more than 64 deep"),
        ('<?xml version="1.0" encoding="nonsense"?><ink/>', "XML"),
        ("<ink><trace>1 2 3</trace></ink>", "line 1, <trace>: point 0 .* has 3 values; the format has 2"),
        ("<ink><trace>1 x</trace></ink>", "no number"),
        ("<ink><trace>1 NaN</trace></ink>", "no number"),
        ("<ink><trace>1 2,</trace></ink>", "point 1"),
        ("<ink><trace>1 ?</trace></ink>", "X or Y is unknown"),
        ("<ink><trace>1 2e10</trace></ink>", "beyond"),
        ("<ink><trace>1 1e999999999</trace></ink>", "too large to reckon with"),
        ('<ink><traceFormat><channel name="X"/></traceFormat></ink>', "X and Y are needed"),
        (f"<ink>{CHANNELS.format(unit='week')}</ink>", "gives T in 'week'"),
        ('<ink><trace contextRef="#none">1 2</trace></ink>', "'#none', which is not in the file"),
        ('<ink><context xml:id="a" contextRef="#a"/></ink>', "run in a circle"),
        (f'<ink>{CHANNELS.format(unit="s")}<trace timeOffset="x">1 2 3 4</trace></ink>', "timeOffset is 'x'"),
    ],
)  # fmt: skip
def test_a_broken_file_is_refused_with_the_place(text: str, says: str) -> None:
    with pytest.raises(FileError, match=says):
        inkml.loads(text, "page.inkml")


def test_ten_thousand_strokes_and_an_empty_page_are_ink() -> None:
    assert inkml.loads("<ink/>") == Ink()
    many = Ink(tuple(Stroke([[k, k], [k + 1, k]]) for k in range(10_000)))
    assert inkml.loads(inkml.dumps(many)) == many


@pytest.mark.skipif(REAL is None, reason="INKLINED_REAL_INK names no folder of people's ink")
def test_published_files_are_read_whole() -> None:
    files = sorted((Path(REAL or "") / "formats").glob("*.inkml"))
    assert len(files) == 12
    for file in files:
        loaded = inkml.load(file)
        assert len(loaded.ink) == file.read_text(encoding="utf-8").count("</trace>")
        assert not any(notice.lost for notice in loaded.notices)
