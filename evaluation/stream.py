"""Generated suites of any size: made, recognized and kept a shard at a time, so that memory does not grow with them.

A shard is so many consecutive strokes of a seed; whoever works on it generates them, lets every recognizer claim them and
gives back the claims as Parquet, which the one process that leads writes to `part-START.parquet`, whole or not at all. A run
that was stopped goes on with the parts that are missing; a part that is done twice is the same bytes and counts once. The
workers are processes of this machine (joblib) or of a Dask cluster; they share no file system with the leader.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from evaluation.metrics.strokes import IntArray, accuracy, balanced_accuracy
from evaluation.parallel import Progress, in_parallel, silent
from evaluation.rivals import digest, rival
from recognizer.claims import Recognizer
from sketch.files.errors import FileError
from sketch.files.store import drafted, read_text, write_text
from sketch.ink import Ink
from sketch.page import STROKE_KINDS

SHARD = 2000
"""Strokes of a shard: some seconds of work, so that little is lost with a worker."""
IN_FLIGHT = 4
"""Shards that each worker of a cluster has waiting: it never idles, and results do not pile up."""
RETRIES = 5
"""How often a shard may lose its worker before the run gives up on it."""


@dataclass(frozen=True, slots=True)
class Run:
    """What is evaluated. code: digest of the generator and the recognizers, which a run that goes on must share."""

    strokes: int
    seed: int
    names: tuple[str, ...]
    shard: int = SHARD
    code: str = ""


@dataclass(frozen=True, slots=True)
class Shard:
    """Strokes start … start + count − 1 of a seed, for recognizers of these names."""

    start: int
    count: int
    seed: int
    names: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Tally:
    """A recognizer over all parts: rows, and the confusion matrix as `metrics.strokes` has it."""

    name: str
    rows: int
    confusion: IntArray

    @property
    def accuracy(self) -> float | None:
        return accuracy(self.confusion)

    @property
    def balanced_accuracy(self) -> float | None:
        return balanced_accuracy(self.confusion)


Engine = Callable[[Sequence[Shard], Progress], Iterator[tuple[Shard, bytes]]]
"""Works on shards and gives each back with its part, in any order."""


def evaluate(run: Run, folder: Path, engine: Engine, progress: Progress = silent) -> list[Tally]:
    """Makes whatever parts of the run are missing in the folder, and draws all together. Raises FileError when the folder
    holds another run."""
    folder.mkdir(parents=True, exist_ok=True)
    _claim(folder, run)
    left = [shard for shard in shards(run) if not place(folder, shard).exists()]
    for shard, part in engine(left, progress):
        with drafted(place(folder, shard)) as file:
            file.write(part)
    return tallies(run, folder)


def shards(run: Run) -> list[Shard]:
    """All shards of the run, in order."""
    return [
        Shard(start, min(run.shard, run.strokes - start), run.seed, run.names)
        for start in range(0, run.strokes, run.shard)
    ]


def place(folder: Path, shard: Shard) -> Path:
    """Where the shard's part is kept."""
    return folder / f"part-{shard.start:012d}.parquet"


def work(shard: Shard) -> bytes:
    """The shard's claims as Parquet: `index` of the stroke, its `label`, and for each recognizer a row with its `name`, the kind
    it `claimed` and how `sure` it was. The same shard gives the same bytes."""
    import pyarrow as pa
    from pyarrow import parquet

    from data_gen.strokes import stream

    columns: dict[str, list[Any]] = {key: [] for key in ("index", "label", "name", "claimed", "sure")}
    for item in stream(shard.count, shard.seed, shard.start):
        ink = Ink((item.stroke,))
        for name in shard.names:
            (claim,) = _here(name).recognize(ink)
            values = (item.index, item.kind, name, claim.kind, claim.confidence)
            for column, value in zip(columns.values(), values, strict=True):
                column.append(value)
    table = pa.table({key: pa.array(values) for key, values in columns.items()})
    out = io.BytesIO()
    parquet.write_table(table, out, compression="zstd")
    return out.getvalue()


def on_this_machine(jobs: int) -> Engine:
    """So many processes here."""

    def engine(left: Sequence[Shard], progress: Progress) -> Iterator[tuple[Shard, bytes]]:
        return iter(zip(left, in_parallel(work, left, jobs, "Evaluating shards", progress), strict=True))

    return engine


def on_cluster(address: str) -> Engine:
    """The workers of the Dask cluster whose scheduler is at that address (the extra `cluster`). A shard whose worker is lost is
    worked on by another. Raises ValueError when Dask is not installed, OSError when nobody answers there."""
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise ValueError("--cluster needs Dask; pip install 'inklined[cluster]' adds it") from None

    def engine(left: Sequence[Shard], progress: Progress) -> Iterator[tuple[Shard, bytes]]:
        with Client(address, set_as_default=False) as client:
            waiting = iter(left)
            room = IN_FLIGHT * max(1, len(client.scheduler_info()["workers"]))
            asked: dict[str, Shard] = {}

            def ask(shard: Shard) -> Any:
                future = client.submit(work, shard, pure=False, retries=RETRIES)
                asked[str(future.key)] = shard
                return future

            running = as_completed([ask(shard) for shard in islice(waiting, room)], loop=client.loop)
            done = 0
            progress("Evaluating shards", done, len(left))
            for future in running:
                part = future.result()
                done += 1
                progress("Evaluating shards", done, len(left))
                yield asked.pop(str(future.key)), part
                after = next(waiting, None)
                if after is not None:
                    running.add(ask(after))

    return engine


def tallies(run: Run, folder: Path) -> list[Tally]:
    """Every recognizer over all parts, read one after another. Raises FileError for a part that is not of the run or cannot be
    read."""
    import pyarrow as pa
    from pyarrow import parquet

    kinds = {kind: k for k, kind in enumerate(STROKE_KINDS)}
    confusion = {name: np.zeros((len(kinds), len(kinds) + 1), dtype=np.int64) for name in run.names}
    for shard in shards(run):
        path = place(folder, shard)
        try:
            part = parquet.read_table(path, columns=["label", "name", "claimed"])
        except (OSError, pa.ArrowException) as error:
            raise FileError(path, f"is no part of a run: {error}; delete it and run again") from None
        if part.num_rows != shard.count * len(shard.names):
            raise FileError(path, f"has {part.num_rows} rows; needed are {shard.count * len(shard.names)}")
        for row in part.group_by(["name", "label", "claimed"]).aggregate([([], "count_all")]).to_pylist():
            confusion[row["name"]][kinds[row["label"]], kinds[row["claimed"]]] += row["count_all"]
    return [Tally(name, int(table.sum()), table) for name, table in confusion.items()]


def code_digest() -> str:
    """Of the generator and the recognizers, so that no run is made of two versions."""
    return digest()


def _claim(folder: Path, run: Run) -> None:
    """Marks the folder as this run's."""
    marker = folder / "run.json"
    said = json.dumps(asdict(run), indent=1, sort_keys=True) + "\n"
    if marker.exists():
        if read_text(marker) != said:
            raise FileError(
                marker,
                "is of another run (strokes, seed, recognizers, shards or code differ); use another folder",
            )
    else:
        write_text(marker, said)


@lru_cache
def _here(name: str) -> Recognizer:
    """This process's own recognizer of that name: loaded once."""
    return rival(name)
