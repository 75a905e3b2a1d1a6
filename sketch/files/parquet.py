"""Rows in Parquet, a column a quantity, packed with zstandard: for suites too large for JSON Lines.

Columns: `label`, `writer` (text or null), `extra` (the row's other keys as JSON), and for each point of the row `stroke`
(number of its stroke), `x`, `y` (page units, y down), `t` (seconds, null where a stroke has no times) and `p` (pressure, null
where a stroke has none), each a list. Reading gives the rows to the bit. Files are written and read a batch of rows at a
time, so that memory does not grow with the suite.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice, pairwise
from pathlib import Path
from typing import Any, BinaryIO, cast

import numpy as np

from sketch.files.errors import FileError, Notice
from sketch.files.jsonl import Loaded, Row, RowError
from sketch.files.store import drafted
from sketch.ink import LIMITS, FloatArray, Ink, InkError, Stroke

ROWS = 1024
"""Rows of a batch as they are written."""
READ = 128
"""Rows of a batch as they are read: with the longest pages still within memory."""
LISTS = ("stroke", "x", "y", "t", "p")


def write(path: str | Path, rows: Iterable[Row], metadata: Mapping[str, str] | None = None) -> int:
    """Saves the rows, whole or not at all, and returns how many there were. Raises FileError when the folder cannot be
    written to or a row's `extra` holds what JSON has not."""
    with drafted(path) as draft:
        return pour(draft, rows, metadata, path)


def pour(
    file: BinaryIO,
    rows: Iterable[Row],
    metadata: Mapping[str, str] | None = None,
    path: str | Path = "rows",
) -> int:
    """The same into an open file; path: what errors call it. The same rows give the same bytes."""
    import pyarrow as pa
    from pyarrow import parquet

    schema = _schema().with_metadata(dict(metadata or {}))
    count = 0
    everything = iter(rows)
    with parquet.ParquetWriter(file, schema, compression="zstd") as writer:
        while batch := list(islice(everything, ROWS)):
            columns = _columns(batch, path)
            writer.write_batch(
                pa.record_batch(
                    [pa.array(columns[name], schema.field(name).type) for name in schema.names], schema=schema
                )
            )
            count += len(batch)
    return count


def read(path: str | Path) -> Loaded:
    """Every row that can be read, and a notice for every other, by its number from 1. Raises FileError when the file
    cannot be opened or no row of it can be read."""
    notices: list[Notice] = []
    rows = tuple(stream(path, notices))
    if not rows:
        raise FileError(path, f"no row of it can be read; {notices[0] if notices else 'it is empty'}")
    return Loaded(rows, tuple(notices))


def stream(path: str | Path, notices: list[Notice]) -> Iterator[Row]:
    """The same, a row at a time, notices added as they come. Raises FileError when the file cannot be opened."""
    number = 0
    for batch in _batches(path):
        columns = {name: batch.column(name) for name in batch.schema.names}
        for k in range(batch.num_rows):
            number += 1
            try:
                yield _row(columns, k)
            except (InkError, RowError) as error:
                notices.append(Notice(number, f"the row is left out: {error}", lost=True))


def _batches(path: str | Path) -> Iterator[Any]:
    import pyarrow as pa
    from pyarrow import parquet

    try:
        with parquet.ParquetFile(path) as file:
            missing = [name for name in LISTS if name not in file.schema_arrow.names]
            if missing:
                raise FileError(path, f"lacks the columns {', '.join(missing)}")
            for name in LISTS:
                if not pa.types.is_list(file.schema_arrow.field(name).type):
                    raise FileError(
                        path, f"its column {name} is {file.schema_arrow.field(name).type}, not a list"
                    )
            yield from file.iter_batches(batch_size=READ)
    except FileNotFoundError:
        raise FileError(path, "there is no such file") from None
    except (pa.ArrowException, OSError) as error:
        raise FileError(
            path, f"is not Parquet that can be read: {' '.join(str(error).split())[:200]}"
        ) from None


def _schema() -> Any:
    import pyarrow as pa

    text, number = pa.string(), pa.list_(pa.float64())
    return pa.schema(
        [
            ("label", text),
            ("writer", text),
            ("extra", text),
            ("stroke", pa.list_(pa.int32())),
            *((name, number) for name in LISTS[1:]),
        ]
    )


def _columns(rows: list[Row], path: str | Path) -> dict[str, list[Any]]:
    columns: dict[str, list[Any]] = {name: [] for name in ("label", "writer", "extra", *LISTS)}
    for row in rows:
        columns["label"].append(row.label)
        columns["writer"].append(row.writer)
        try:
            columns["extra"].append(json.dumps(row.extra, allow_nan=False) if row.extra else None)
        except (TypeError, ValueError) as error:
            raise FileError(path, f"a row's extra keys cannot be written as JSON: {error}") from None
        strokes = row.ink.strokes
        columns["stroke"].append(
            np.repeat(np.arange(len(strokes), dtype=np.int32), [len(s) for s in strokes])
        )
        for axis, name in enumerate("xy"):
            columns[name].append(_joined([stroke.points[:, axis] for stroke in strokes]))
        columns["t"].append(_nullable([(stroke.times, len(stroke)) for stroke in strokes]))
        columns["p"].append(_nullable([(stroke.pressure, len(stroke)) for stroke in strokes]))
    return columns


def _joined(parts: list[FloatArray]) -> FloatArray:
    return np.concatenate(parts) if parts else np.empty(0)


def _nullable(channels: list[tuple[FloatArray | None, int]]) -> Any:
    """Values, or nulls where a stroke has none."""
    if all(channel is not None for channel, _ in channels):
        return _joined([channel for channel, _ in channels if channel is not None])
    values: list[float | None] = []
    for channel, count in channels:
        values += [None] * count if channel is None else channel.tolist()
    return values


def _row(columns: Mapping[str, Any], k: int) -> Row:
    lists = {name: columns[name][k].values for name in LISTS}
    if any(values is None for values in lists.values()):
        raise RowError("a list of its points is null")
    counts = {len(values) for values in lists.values()}
    if len(counts) != 1:
        raise RowError("its columns are of different lengths")
    if max(counts) > LIMITS.total_points:
        raise RowError(f"{max(counts)} points; at most {LIMITS.total_points} are accepted")
    try:
        number, x, y = (
            np.asarray(lists[name].to_numpy(zero_copy_only=False), dtype=float) for name in LISTS[:3]
        )
        t, p = (_channel(lists[name]) for name in LISTS[3:])
    except (TypeError, ValueError) as error:
        raise RowError(f"its points are no numbers: {error}") from None
    if len(number) and (not np.isfinite(number).all() or (np.diff(number) < 0).any()):
        raise RowError("the numbers of its strokes do not grow")
    starts = [0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(number)] if len(number) else [0]
    strokes: list[Stroke] = []
    for first, last in pairwise(starts):
        part = slice(first, last)
        strokes.append(Stroke(np.column_stack([x[part], y[part]]), _part(t, part), _part(p, part)))
    return Row(
        _text(columns, "label", k), Ink(tuple(strokes)), _text(columns, "writer", k), _extra(columns, k)
    )


def _channel(values: Any) -> tuple[FloatArray, Any]:
    return np.asarray(values.to_numpy(zero_copy_only=False), dtype=float), np.asarray(
        values.is_null().to_numpy(zero_copy_only=False), dtype=bool
    )


def _part(channel: tuple[FloatArray, Any], part: slice) -> FloatArray | None:
    values, unknown = channel
    if unknown[part].all():
        return None
    if unknown[part].any():
        raise RowError("a stroke's times or pressure are known at some points only")
    return values[part]


def _text(columns: Mapping[str, Any], name: str, k: int) -> str | None:
    value = columns[name][k].as_py() if name in columns else None
    if value is not None and not isinstance(value, str):
        raise RowError(f"{name} must be text or null")
    return value


def _extra(columns: Mapping[str, Any], k: int) -> dict[str, Any]:
    text = _text(columns, "extra", k)
    if not text:
        return {}
    try:
        value: object = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise RowError(f"its extra is no JSON: {error}") from None
    if not isinstance(value, dict):
        raise RowError("its extra is no JSON object")
    return cast(dict[str, Any], value)
