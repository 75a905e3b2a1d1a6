"""Training end to end on a tiny corpus: reproducible, resumable, calibrated, exported without loss."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
import pytest
import torch

from recognizer.learned.recognizer import Learned
from sketch.ink import Ink, Stroke
from sketch.page import STROKE_KINDS
from training.__main__ import main
from training.calibrate import temperature
from training.dataset import Corpus, corpus_of, make_corpus
from training.drawings import NONE, UNASKED, Plan, drawings
from training.export import export
from training.features import CHANNELS, WHOLE, Features, backwards
from training.fit import FitRule, fit, say
from training.nets import NetSize, PageNet, parameters_of
from training.parity import parity
from training.reader import RawReader
from training.relations import own_frame

PLAN = Plan(alone=300, strewn=20, pages=6, doodles=30, arrows=10, signs=4)
QUICK = FitRule(epochs=3, both=1, batch=64)
SMALL = NetSize(width=8, stroke=16, message=8, heads=2)


@pytest.fixture(scope="module")
def corpus() -> Corpus:
    return make_corpus(PLAN, seed=3, jobs=1)


@pytest.fixture(scope="module")
def fitted(corpus: Corpus) -> PageNet:
    torch.set_num_threads(1)
    return fit(corpus, seed=5, rule=QUICK, size=SMALL)


def test_a_corpus_is_remade_from_its_seed_whatever_the_number_of_processes() -> None:
    plan, shard = Plan(alone=80, strewn=8, pages=4, doodles=8, arrows=4, signs=4), 25
    one, other = (make_corpus(plan, seed=3, jobs=jobs, shard=shard) for jobs in (1, 2))
    for name in ("paths", "distinct", "span", "timed", "kind", "thing", "first"):
        assert np.array_equal(getattr(one, name), getattr(other, name)), name


def test_the_corpus_holds_every_kind_alone_and_in_company_and_strokes_that_are_none(corpus: Corpus) -> None:
    assert set(np.unique(corpus.kind)) - {UNASKED} == {NONE, *range(len(STROKE_KINDS))}
    assert corpus.sizes.min() == 1 and corpus.sizes.max() > 8


def test_doodles_kept_for_measuring_are_not_learned_from() -> None:
    drawn = list(
        drawings(Plan(alone=0, strewn=0, pages=0, doodles=200, arrows=0, signs=0), seed=5, part=0, parts=1)
    )
    assert 80 < len(drawn) < 200
    assert all(set(one.kinds) == {NONE} for one in drawn)


def test_the_net_is_small() -> None:
    assert parameters_of(PageNet()) <= 300_000


def test_features_backwards_are_those_of_the_stroke_drawn_backwards(corpus: Corpus) -> None:
    paths, distinct = own_frame(torch.from_numpy(corpus.paths[:200])), torch.from_numpy(corpus.distinct[:200])
    forth, whole = Features()(paths, distinct)
    back, same = Features()(paths.flip(1), distinct)
    assert torch.allclose(backwards(forth), back, atol=1e-4)
    assert torch.allclose(whole, same, atol=1e-4)


def test_the_features_of_a_ring_are_those_of_a_ring() -> None:
    angle = torch.arange(64) * (2 * np.pi / 63)
    ring = 0.5**1.5 * torch.stack([torch.cos(angle), torch.sin(angle)], dim=1)  # its box has diagonal 1
    sequence, whole = Features()(ring[None], torch.tensor([60.0]))
    told = dict(zip(WHOLE, whole[0].tolist(), strict=True))
    assert told["gap of the ends over size"] == pytest.approx(0, abs=1e-5)
    assert told["log length over size"] == pytest.approx(np.log(2 * np.pi * 0.5**1.5), abs=2e-3)
    assert told["width of the lesser axis over the greater"] == pytest.approx(1, abs=0.05)
    assert told["turning, signed, turns"] == pytest.approx(1, abs=0.05)
    assert told["turning, absolute, turns"] == pytest.approx(1, abs=0.05)
    assert told["corners"] == told["log of the crossings"] == pytest.approx(0, abs=1e-6)
    assert told["compactness of the enclosed area"] == pytest.approx(
        1, abs=5e-3
    )  # 4 pi A over the square of the length
    assert told["length over the hull's perimeter"] == pytest.approx(1, abs=5e-3)
    assert told["spread of the radius about the centroid"] == pytest.approx(0, abs=0.02)
    assert sequence[0, CHANNELS.index("distance from the centroid")].tolist() == pytest.approx(
        [2 * 0.5**1.5] * 64, abs=0.03
    )


def test_a_line_that_crosses_itself_is_told() -> None:
    corners = torch.tensor([(-0.35, -0.35), (0.35, 0.35), (0.35, -0.35), (-0.35, 0.35)])
    places = torch.linspace(0, 2.9999, 64)
    low, share = places.long(), (places % 1)[:, None]
    path = corners[low] + share * (corners[low + 1] - corners[low])
    sequence, whole = Features()(path[None], torch.tensor([60.0]))
    assert whole[0, WHOLE.index("log of the crossings")].item() == pytest.approx(np.log(2), abs=0.05)
    crossings = sequence[0, CHANNELS.index("crossings here")]
    assert torch.nonzero(crossings > 0.1)[:, 0].tolist() == pytest.approx([10, 11, 52, 53], abs=1.5)


def test_the_same_seed_gives_the_same_weights_also_after_a_stop(
    corpus: Corpus, fitted: PageNet, tmp_path: Path
) -> None:
    again = fit(corpus, seed=5, rule=QUICK, size=SMALL)
    file = tmp_path / "checkpoint.pt"
    fit(corpus, seed=5, rule=QUICK, size=SMALL, checkpoint=file, until=1)
    resumed = fit(corpus, seed=5, rule=QUICK, size=SMALL, checkpoint=file)
    for name, value in fitted.state_dict().items():
        assert torch.equal(value, again.state_dict()[name]), name
        assert torch.equal(value, resumed.state_dict()[name]), name


def test_training_learns(corpus: Corpus) -> None:
    net = fit(corpus, seed=5, rule=FitRule(epochs=15, both=2, batch=64), size=SMALL)
    said = say(net, corpus)
    known = said.kind >= 0
    assert (said.logits.argmax(axis=1) == said.kind)[known].mean() > 0.6, (
        "nine kinds: chance is about a fifth"
    )


def test_temperature_recovers_the_heat_that_was_put_in() -> None:
    rng = np.random.default_rng(0)
    logits = 3 * rng.standard_normal((20_000, 5))
    shares = np.exp(logits) / np.exp(logits).sum(axis=1, keepdims=True)
    kind = (shares.cumsum(axis=1) > rng.random((20_000, 1))).argmax(axis=1)
    assert temperature((2.5 * logits).astype(np.float32), kind) == pytest.approx(2.5, rel=0.05)


@pytest.fixture(scope="module")
def exported(fitted: PageNet, tmp_path_factory: pytest.TempPathFactory) -> tuple[RawReader, Path]:
    reader = RawReader(fitted, 1.3).eval()
    file = tmp_path_factory.mktemp("onnx") / "net.onnx"
    export(reader, file, {"inklined": "{}"})
    return reader, file


def test_the_onnx_file_on_raw_ink_answers_as_the_python_path_does(exported: tuple[RawReader, Path]) -> None:
    reader, file = exported
    assert parity(reader, file, seed=9, strokes=600) < 1e-4


def test_the_onnx_file_stands_alone_and_takes_any_number(exported: tuple[RawReader, Path]) -> None:
    _, file = exported
    assert [path.name for path in file.parent.iterdir()] == ["net.onnx"], "no sidecar"
    model = onnx.load(file)
    assert all(value.type.tensor_type.shape.dim[0].dim_param for value in model.graph.input)
    assert str(Path.cwd()).encode() not in file.read_bytes(), "no machine path in what ships"


def test_a_page_that_is_too_long_is_learned_from_by_its_first_strokes() -> None:
    (page, *_) = drawings(
        Plan(alone=0, strewn=0, pages=1, doodles=0, arrows=0, signs=0), seed=3, part=0, parts=1
    )
    long = type(page)(page.strokes * 30, page.kinds * 30, page.things * 30)
    assert corpus_of([long], np.random.default_rng(0)).sizes.tolist() == [64]


def test_the_command_trains_a_net_that_the_recognizer_can_use_and_resumes(tmp_path: Path) -> None:
    file, work = tmp_path / "mine.onnx", tmp_path / "work"
    asked = ["--drawings", "300", "--epochs", "2", "--threads", "1", "--out", str(file), "--work", str(work)]
    assert main(asked) == 0
    card = json.loads(file.with_suffix(".json").read_text("utf-8"))
    assert card["seed"] == 1 and card["epochs"] == 2
    (claim,) = Learned(file).recognize(Ink((Stroke([(0, 0), (50, 2), (100, 0)]),)))
    assert claim.scores.sum() == pytest.approx(1)
    before = file.read_bytes()
    assert main([*asked, "--resume"]) == 0
    assert file.read_bytes() == before


def test_resuming_another_training_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="nothing to resume"):
        main(["--drawings", "300", "--work", str(tmp_path / "none"), "--resume"])


def test_a_senseless_number_of_drawings_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--drawings", "0"])
    assert "at least" in capsys.readouterr().err
