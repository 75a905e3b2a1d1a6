"""Who may compete, and what somebody is told whose recognizer may not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from recognizer.roster import ROSTER, recognizer
from sketch.ink import Ink, Stroke

EXAMPLE = "examples.my_recognizer:Simple"


@pytest.mark.parametrize("name", ROSTER)
def test_a_rival_bears_the_name_it_is_called_by(name: str) -> None:
    assert recognizer(name).name == name


def test_the_readmes_example_competes_in_twenty_lines() -> None:
    simple = recognizer(EXAMPLE)
    ink = Ink((Stroke([(0, 0), (50, 0), (100, 1)]), Stroke([(0, 0), (50, 0), (50, 50), (0, 50), (0, 1)])))
    assert [claim.kind for claim in simple.recognize(ink)] == ["wire", "circle"]
    source = Path(__file__).parents[2].joinpath("examples", "my_recognizer.py").read_text("utf-8")
    code = [line for line in re.sub(r'""".*?"""', "", source, flags=re.S).splitlines() if line.strip()]
    assert len(code) <= 20


@pytest.mark.parametrize(
    "name, complaint",
    [
        ("geometrix", "known are paper, geometric, learned"),
        ("no_such_module:Thing", "cannot be imported"),
        ("recognizer.paper:Nobody", "no class or function 'Nobody'"),
        ("collections:OrderedDict", "has no 'name'"),
    ],
)
def test_a_wrong_name_is_explained(name: str, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        recognizer(name)
