"""Generated suites of any size: made, recognized and kept a shard at a time, so that memory does not grow with them.

A shard is so many consecutive items of a seed (strokes, pages, or textbook problems drawn by a pen); whoever works on it
generates them, lets every recognizer read them and gives back the claims or scores as Parquet, which the one process that leads
writes to `part-START.parquet`, whole or not at all. A run that was stopped goes on with the parts that are missing; a part that
is done twice is the same bytes and counts once. The workers are processes of this machine (joblib) or of a Dask cluster; they
share no file system with the leader. What a shard of each suite holds, and what it comes to, is `stream_suites`'.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from evaluation.code import INK, ROOMS, digest
from evaluation.parallel import Progress, Workers, as_done, silent
from evaluation.stream_suites import SUITES, Shard, SuiteName, Tally, part_of
from sketch.files.errors import FileError
from sketch.files.store import drafted, read_text, write_text


@dataclass(frozen=True, slots=True)
class Run:
    """What is evaluated: `count` items of a suite by recognizers of these names; ink alone is made for nobody. shard: items of a
    shard; code: digest of the code, which a run that goes on must share."""

    count: int
    seed: int
    names: tuple[str, ...] = ()
    suite: SuiteName = "strokes"
    shard: int = 2000
    code: str = ""


def evaluate(run: Run, folder: Path, workers: Workers, progress: Progress = silent) -> list[Tally]:
    """Makes whatever parts of the run are missing in the folder, and draws all together. Raises FileError when the folder
    holds another run, and as `evaluation.parallel.as_done`."""
    folder.mkdir(parents=True, exist_ok=True)
    _claim(folder, run)
    left = missing(run, folder)
    for number, part in as_done(part_of, left, workers, "Working on shards", progress):
        with drafted(place(folder, left[number])) as file:
            file.write(part)
    return tallies(run, folder)


def shards(run: Run) -> list[Shard]:
    """All shards of the run, in order."""
    return [
        Shard(run.suite, start, min(run.shard, run.count - start), run.seed, run.names)
        for start in range(0, run.count, run.shard)
    ]


def missing(run: Run, folder: Path) -> list[Shard]:
    """The shards whose parts are not there yet."""
    return [shard for shard in shards(run) if not place(folder, shard).exists()]


def place(folder: Path, shard: Shard) -> Path:
    """Where the shard's part is kept."""
    return folder / f"part-{shard.start:012d}.parquet"


def tallies(run: Run, folder: Path) -> list[Tally]:
    """Every recognizer over all parts, read one after another. Raises FileError for a part that is not of the run or cannot be
    read."""
    import pyarrow as pa
    from pyarrow import parquet

    suite = SUITES[run.suite]
    sums = suite.sums(run.names)
    for shard in shards(run):
        path = place(folder, shard)
        try:
            part = parquet.read_table(path, columns=list(suite.summed))
        except (OSError, pa.ArrowException) as error:
            raise FileError(path, f"is no part of a run: {error}; delete it and run again") from None
        rows = shard.count * max(1, len(shard.names))
        if part.num_rows != rows:
            raise FileError(path, f"has {part.num_rows} rows; needed are {rows}")
        sums.add(part)
    return sums.tallies()


def code_of(suite: SuiteName) -> str:
    """Digest of what the suite's parts depend on, so that no run is made of two versions."""
    return digest(*(INK if suite in ("ink", "strokes") else ROOMS))


def _claim(folder: Path, run: Run) -> None:
    """Marks the folder as this run's."""
    marker = folder / "run.json"
    said = json.dumps(asdict(run), indent=1, sort_keys=True) + "\n"
    if marker.exists():
        if read_text(marker) != said:
            raise FileError(
                marker,
                "is of another run (suite, count, seed, recognizers, shards or code differ); use another folder",
            )
    else:
        write_text(marker, said)
