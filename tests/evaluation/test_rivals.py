"""How published rivals come to be taught: from generated ink once, or from people's, whose writers then stay out of the test."""

from __future__ import annotations

import numpy as np
import pytest

from data_gen.strokes import generate
from evaluation import rivals
from evaluation.lessons import lesson, writer_of
from evaluation.rivals import KINDS, cache_folder, generated_samples, known, rival, taught, taught_by_samples
from evaluation.strangers import FAMILIES, strangers
from evaluation.suites import strokes_from_files
from recognizer.published import PUBLISHED
from recognizer.roster import ROSTER
from sketch.files import jsonl
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.ink import Ink

QUICK = "penny-pincher"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("INKLINED_CACHE", str(tmp_path / "cache"))
    rivals._kept.cache_clear()
    rivals._own.cache_clear()
    yield tmp_path / "cache"
    rivals._kept.cache_clear()
    rivals._own.cache_clear()


def rows(count: int, writers: int, seed: int = 1) -> list[Row]:
    return [Row(item.kind, Ink((item.stroke,)), f"w{item.index % writers}") for item in generate(count, seed)]


def kinds(recognizer, inks):
    return [claim.kind for ink in inks for claim in recognizer.recognize(ink)]


def test_every_rival_has_a_name_of_its_own():
    assert set(known()) == {*ROSTER, *PUBLISHED}
    assert len(known()) == len(ROSTER) + len(PUBLISHED)


def test_what_was_taught_is_kept_and_said_again(folder, caplog):
    inks = [row.ink for row in rows(30, 3)]
    first = kinds(rival(QUICK), inks)
    assert "Teaching penny-pincher" in caplog.text
    assert [path.name for path in folder.iterdir()] == [f"{QUICK}-{rivals.digest()}.pickle"]
    caplog.clear()
    rivals._kept.cache_clear()
    assert kinds(rival(QUICK), inks) == first
    assert not caplog.text


def test_a_file_that_was_cut_short_is_taught_anew_and_one_of_another_version_deleted(folder, caplog):
    folder.mkdir()
    (folder / f"{QUICK}-{rivals.digest()}.pickle").write_bytes(b"\x80\x04half a pick")
    (folder / f"{QUICK}-0123456789ab.pickle").write_bytes(b"of long ago")
    (folder / "dollar-p-0123456789ab.pickle").write_bytes(b"another's")
    rival(QUICK)
    assert "Teaching" in caplog.text
    assert {path.name for path in folder.iterdir()} == {
        f"{QUICK}-{rivals.digest()}.pickle",
        "dollar-p-0123456789ab.pickle",
    }


@pytest.mark.usefixtures("folder")
def test_where_nothing_can_be_kept_it_is_taught_all_the_same(tmp_path, monkeypatch, caplog):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("INKLINED_CACHE", str(tmp_path / "file" / "cache"))
    assert kinds(rival(QUICK), [rows(1, 1)[0].ink])
    assert "could not be kept" in caplog.text


def test_the_cache_is_in_the_place_for_caches(monkeypatch):
    monkeypatch.delenv("INKLINED_CACHE", raising=False)
    assert cache_folder().name == "inklined"


def test_an_unknown_name_is_refused_with_all_that_are_known():
    with pytest.raises(ValueError, match=r"'psychic'; known are paper.*hbf49-forest"):
        rival("psychic")
    with pytest.raises(ValueError, match="'learned' is no published rival"):
        taught("learned", generated_samples(1, 1))


@pytest.mark.usefixtures("folder")
def test_a_rival_taught_by_somebody_has_a_name_of_its_own_that_other_processes_know():
    samples = generated_samples(3, 8)
    name = taught_by_samples(QUICK, samples)
    assert name.startswith(f"{QUICK}@")
    assert taught_by_samples(QUICK, samples) == name
    assert taught_by_samples(QUICK, samples[:-1]) != name
    inks = [sample.ink for sample in samples]
    assert kinds(rival(name), inks) == [sample.kind for sample in samples]
    with pytest.raises(ValueError, match="teach it again"):
        rival(f"{QUICK}@00000000")


def test_fewer_generated_samples_are_the_first_of_more():
    few, many = generated_samples(2, 5), generated_samples(4, 5)
    assert len(few) == 2 * len(KINDS)
    assert all(sample in many for sample in few)


def test_a_lesson_has_so_many_of_each_kind_and_no_writer_of_it_is_tested():
    every = rows(600, 40)
    learnt = lesson(every, 3, np.random.default_rng(2))
    assert learnt.counts() == dict.fromkeys(KINDS, 3)
    tested = [row for row in every if not learnt.taught_by(row)]
    assert not {sample.writer for sample in learnt.samples} & {row.writer for row in tested}
    assert len(tested) > 300
    other = lesson(every, 3, np.random.default_rng(3))
    assert other.writers != learnt.writers
    assert lesson(every, 3, np.random.default_rng(2)) == learnt


def test_a_lesson_takes_no_more_than_half_of_a_kind():
    few = rows(60, 60)
    there = {kind: sum(row.label == kind for row in few) for kind in KINDS}
    learnt = lesson(few, 100, np.random.default_rng(1))
    assert learnt.counts() == {kind: -(-count // 2) for kind, count in there.items()}


def test_rows_that_name_no_writer_are_writers_of_their_own():
    bare = [Row(row.label, row.ink) for row in rows(90, 1)]
    learnt = lesson(bare, 2, np.random.default_rng(1))
    assert sum(learnt.taught_by(row) for row in bare) == len(learnt.writers) == 2 * len(KINDS)
    assert writer_of(bare[0]) != writer_of(bare[1])


def test_nobody_learns_from_labels_that_nobody_knows():
    star = [Row("star", rows(1, 1)[0].ink, "w")]
    with pytest.raises(ValueError, match="labels are star"):
        lesson(star, 1, np.random.default_rng(1))


def test_a_suite_is_without_the_writers_that_were_learnt_from(tmp_path):
    every = rows(300, 20)
    jsonl.write(tmp_path / "ink.jsonl.gz", every)
    learnt = lesson(every, 2, np.random.default_rng(1))
    suite = strokes_from_files([tmp_path / "ink.jsonl.gz"], learnt)
    left_out = sum(learnt.taught_by(row) for row in every)
    assert suite.rows == 300 - left_out
    assert suite.notices[0] == f"{left_out} rows are left out: rivals learnt from their writers."
    jsonl.write(tmp_path / "taught.jsonl.gz", [row for row in every if learnt.taught_by(row)])
    with pytest.raises(FileError, match="fewer --templates"):
        strokes_from_files([tmp_path / "taught.jsonl.gz"], learnt)


def test_a_stranger_is_the_same_however_many_are_drawn_and_all_families_occur():
    few, many = strangers(3, 4), strangers(len(FAMILIES), 4)
    assert many[:3] == few
    assert len({ink[0].points.tobytes() for ink in many}) == len(FAMILIES)
