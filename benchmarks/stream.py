"""A suite of any size evaluated with flat memory: throughput, and the memory of all processes as the run goes on.

    python benchmarks/stream.py FOLDER --strokes 1000000 --recognizer geometric --jobs 2 --report benchmarks/results/million.txt

What is in the folder already is not made again, so that a run that was stopped goes on; then only what is made anew is timed. Memory
is resident memory by /proc, summed over this process and all that it started, every second: the greatest of each tenth of the run.
Processor time is told beside the clock's, since the machine may be shared.
"""

from __future__ import annotations

import argparse
import sys
import threading
from dataclasses import dataclass, field
from datetime import datetime
from os import getpid, sysconf
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from time import perf_counter

from evaluation.provenance import machine
from evaluation.rivals import rival
from evaluation.stream import Run, code_of, evaluate, missing
from evaluation.stream_tables import tally_table

EVERY = 1.0
"""Seconds between two looks at the memory."""
PAGE = sysconf("SC_PAGE_SIZE") / (1 << 20)


@dataclass(slots=True)
class Watch:
    """The greatest memory so far by tenths of the run, megabytes: of this process, and of it and all that it started."""

    share: float = 0.0
    own: dict[int, float] = field(default_factory=dict[int, float])
    all: dict[int, float] = field(default_factory=dict[int, float])
    over: threading.Event = field(default_factory=threading.Event)

    def look(self) -> None:
        """Looks until it is over."""
        while not self.over.wait(EVERY):
            tenth = min(9, int(10 * self.share))
            memory = {pid: resident(pid) for pid in family(getpid())}
            self.own[tenth] = max(self.own.get(tenth, 0.0), memory[getpid()])
            self.all[tenth] = max(self.all.get(tenth, 0.0), sum(memory.values()))


def family(pid: int) -> list[int]:
    """The process and all that it started, and these started."""
    found = [pid]
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += [one for child in task.read_text().split() for one in family(int(child))]
        except OSError:  # it has ended meanwhile
            continue
    return found


def resident(pid: int) -> float:
    """Megabytes in memory; nothing of a process that has ended."""
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError):
        return 0.0


def cpu() -> float:
    """Seconds of the processor, of this process and of those it started that have ended."""
    return sum(used.ru_utime + used.ru_stime for used in (getrusage(RUSAGE_SELF), getrusage(RUSAGE_CHILDREN)))


def main(arguments: list[str] | None = None) -> int:
    words = sys.argv[1:] if arguments is None else arguments
    options = _options(words)
    names = tuple(options.recognizer)
    for name in names:
        rival(name)
    run = Run(options.strokes, options.seed, names, "strokes", options.shard, code_of("strokes"))
    watch = Watch()
    fresh = len(missing(run, options.folder))
    looking = threading.Thread(target=watch.look, daemon=True)

    def tell(_stage: str, done: int, total: int) -> None:
        watch.share = done / max(1, total)
        if options.verbose:
            print(f"{datetime.now():%H:%M:%S} {done} of {total} shards", file=sys.stderr, flush=True)

    begun, used = perf_counter(), cpu()
    looking.start()
    found = evaluate(run, options.folder, options.jobs, tell)
    watch.over.set()
    looking.join()
    seconds = perf_counter() - begun
    _end_workers()
    spent = cpu() - used
    made = min(run.count, fresh * run.shard)
    size = sum(path.stat().st_size for path in options.folder.glob("part-*.parquet"))
    table = tally_table(f"{run.count:,} strokes", found)
    lines = [
        f"python benchmarks/stream.py {' '.join(words)}",
        f"{datetime.now():%Y-%m-%d}, {machine()}; made anew in this run: {made:,} of {run.count:,} strokes",
        "",
        f"by the clock   {seconds:.1f} s, {made / seconds:,.0f} strokes a second",
        f"processor      {spent:.1f} s, {1e3 * spent / max(1, made):.3f} ms a stroke",
        f"results        {size / 1e6:.1f} MB, {size / run.count / len(names):.1f} bytes a claim",
        "greatest resident memory in MB, by tenths of the run",
        f"    this process       {_by_tenths(watch.own)}",
        f"    with its workers   {_by_tenths(watch.all)}",
        "",
        table.caption,
        *(f"    {name:12} " + "   ".join(cell.text for cell in cells) for name, *cells in table.rows),
    ]
    text = "\n".join(lines) + "\n"
    if options.report:
        with options.report.open("a", encoding="utf-8") as file:
            file.write(text + "\n")
    print(text)
    return 0


def _by_tenths(memory: dict[int, float]) -> str:
    return " ".join(f"{memory[tenth]:5.0f}" if tenth in memory else "    –" for tenth in range(10))


def _end_workers() -> None:
    """Ends joblib's processes, so that what they used is counted."""
    from joblib.externals.loky import get_reusable_executor

    get_reusable_executor().shutdown(wait=True)


def _options(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--strokes", type=int, default=20_000)
    parser.add_argument("--recognizer", nargs="+", default=["geometric"])
    parser.add_argument("--shard", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--report", type=Path, help="add the figures to this file")
    parser.add_argument("--verbose", action="store_true", help="a line a shard on stderr")
    return parser.parse_args(words)


if __name__ == "__main__":
    sys.exit(main())
