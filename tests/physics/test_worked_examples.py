"""The figures of the two worked examples are drawn, and say what the table of features says."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from examples import worked_examples


def test_the_incline_rolls_bounces_and_throws_off() -> None:
    drawn = worked_examples.incline()
    columns = np.array(drawn.axes).reshape(3, 3).T
    titles = [page.get_title() for page, _, _ in columns]
    assert titles == ["the right f_1: rolls", "0.9 of it: bounces", "1.1 of it: flies off"]
    speed, line = (one.get_ydata() for one in columns[0][1].get_lines())
    assert np.abs(np.subtract(speed, line)).max() < 1e-9
    right, low, high = (np.asarray(column[2].get_lines()[0].get_ydata()) for column in columns)
    assert np.abs(right).max() < 1e-9
    assert low.min() < -0.05
    assert high[-1] > 0.1


def test_the_box_stays_on_the_right_tensions_alone(tmp_path: Path) -> None:
    drawn = worked_examples.box()
    places, ways = np.array(drawn.axes).reshape(2, -1)
    assert places[0].get_title() == "5√2 and 5√2 N: stays"
    assert all("broke" in place.get_title() for place in places[1:])
    got = [np.asarray(graph.get_lines()[0].get_ydata()) for graph in ways]
    assert got[0].max() < 1e-9
    assert min(one.max() for one in got[1:]) > 0.5
    worked_examples.main(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"incline.svg", "box.svg"}
