"""The reader of mathematics on everything that it is measured by; people's ink where a folder of it is named.

    python benchmarks/handwriting.py --ink FOLDER --pages 40 > benchmarks/results/handwriting.txt

Signs by themselves, expressions of people, generated expressions by writers of seeds that nothing was
trained or tuned on, the formulas of the six diagrams, single strokes added to a line, whole pages, and what goes wrong.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from datetime import date
from pathlib import Path

import numpy as np

from data_gen.pages import page
from data_gen.problems import ANSWERS, PROBLEMS, Problem, problem
from data_gen.textbook.roster import exercise, names
from data_gen.writers import sample_writer
from data_gen.writing.grammars import general, mixed, physics
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from evaluation.handwriting import Read, confusions, read_all, scores
from evaluation.handwriting_errors import TOLD, errors
from evaluation.handwritten_pages import judge_all, reads
from physics.formula.expected import expected
from recognizer.handwriting.line import line_of, spaced
from recognizer.handwriting.reader import Reader
from recognizer.handwriting.roster import READERS, reader_of
from recognizer.handwriting.session import Session
from sketch.files.jsonl import Row, read
from sketch.formula.parse import parse
from sketch.formula.print import latex as printed
from sketch.writing.rows import Row as Signs
from sketch.writing.rows import latex, nodes_of, row_of, sign_named
from sketch.writing.signs import MERGED, NUMBER, SIGNS

SEED = 770_001
"""Of generated suites: training uses small seeds."""


def main(arguments: list[str] | None = None) -> int:
    options = _options(arguments)
    print(
        f"python benchmarks/handwriting.py {' '.join(arguments if arguments is not None else sys.argv[1:])}, {date.today()}"
    )
    reader = reader_of(options.reader)
    if options.errors:
        table(reader, expressions(Path(options.ink))[: options.most])
        return 0
    if options.ink:
        folder = Path(options.ink)
        isolated(reader, folder / "symbols-dev.jsonl.gz")
        found = read_all(expressions(folder)[: options.most], reader)
        report("math-dev, crohme2013-test", found)
        for (truth, claim), count in confusions(found).most_common(25):
            print(f"    {truth} read as {claim or '(shared out otherwise)'}: {count}")
    for name, grammar in (("physics", physics), ("general", general), ("both", mixed)):
        report(f"generated, {name} grammar", read_all(generated(grammar, options.lines), reader))
    formulas(reader, options.writers)
    strokewise(reader, options.lines // 4)
    if options.pages:
        pages(reader, options.pages)
    return 0


def expressions(folder: Path) -> list[Row]:
    """The expressions of people that readers are measured by."""
    return [
        row for row in read(folder / "math-dev.jsonl.gz").rows if row.extra.get("set") == "crohme2013-test"
    ]


def table(reader: Reader, rows: Sequence[Row]) -> None:
    """What goes wrong with people's expressions, and whose fault it is."""
    found = errors(rows, reader)
    n = found.rows
    print(f"{n} expressions of people, set crohme2013-test of math-dev")
    for told in TOLD:
        print(
            f"    told of {told}: right {found.right[told] / n:.1%}, at most one mistake {found.nearly[told] / n:.1%}"
        )
    print("signs read as others (strokes right):")
    print("    " + ", ".join(f"{a} as {b} {k}" for (a, b), k in found.confused.most_common(40)))
    print(f"signs whose strokes were shared out otherwise, {found.shared.total()} of all:")
    print("    " + ", ".join(f"{a} {k}" for a, k in found.shared.most_common(25)))
    print("relations wrong, true signs told:")
    print("    " + ", ".join(f"{a} as {b} {k}" for (a, b), k in found.related.most_common(12)))
    print("rows with a construct, and the share whose layout is wrong, true signs told:")
    for name, count in found.constructs.most_common():
        print(f"    {name}: {count}, wrong {found.failed[name] / count:.1%}")


def isolated(reader: Reader, path: Path) -> None:
    """Signs alone: the share right at first, with twins merged, and among the first three merged."""
    first, merged, third, seen = 0, 0, 0, 0
    wrong = Counter[tuple[str, str]]()
    for row in read(path).rows:
        label = sign_named(row.label or "")
        if row.extra.get("set") != "crohme2013" or label not in NUMBER:
            continue
        line = line_of([spaced(stroke) for stroke in row.ink])
        odds = reader.signs.scores(line, [tuple(range(len(line)))], alone=True)[0, : len(SIGNS)]
        order = [SIGNS[k] for k in np.argsort(-odds)[:8]]
        classes = list(dict.fromkeys(MERGED.get(name, name) for name in order))
        own = MERGED.get(label, label)
        seen += 1
        first += order[0] == label
        merged += classes[0] == own
        third += own in classes[:3]
        if classes[0] != own:
            wrong[label, order[0]] += 1
    print(
        f"signs alone (n = {seen}): first {first / seen:.1%}, merged {merged / seen:.1%}, first three merged {third / seen:.1%}"
    )
    print("    " + ", ".join(f"{a} as {b} {n}" for (a, b), n in wrong.most_common(20)))


def generated(grammar: Callable[[np.random.Generator], Signs], count: int) -> list[Row]:
    """Expressions by writers of their own, as rows of a file."""
    rows: list[Row] = []
    for index in range(count):
        rng = np.random.default_rng([SEED, index])
        row = grammar(rng)
        while sum(1 for _ in nodes_of(row)) > 40:
            row = grammar(rng)
        found = written(row, habits(sample_writer(rng), rng))
        symbols = [{"label": node.name, "strokes": list(node.strokes)} for node in nodes_of(found.row)]
        rows.append(Row(latex(row), found.ink, None, {"symbols": symbols}))
    return rows


def formulas(reader: Reader, writers: int) -> None:
    """The formulas of all problems by writers each; right where the trees are equal, with the page's prior."""
    drawn = [
        problem(name, answer, np.random.default_rng([SEED, draw]))
        for name in PROBLEMS
        for answer in ANSWERS[name]
        for draw in range(30)
    ]
    asked = [exercise(family, name, np.random.default_rng([SEED, 0])) for family, name in names()]
    report_formulas("of the six diagrams", _texts(drawn), reader, writers)
    report_formulas(
        "of the textbook's problems",
        _texts([one.answered(one.answers[0]) for one in asked]),
        reader,
        writers,
    )


def _texts(problems: Sequence[Problem]) -> list[str]:
    """What is written on pages, each formula once."""
    return list(dict.fromkeys(remark.text for one in problems for remark in one.remarks))


def report_formulas(whose: str, texts: Sequence[str], reader: Reader, writers: int) -> None:
    wrong = Counter[str]()
    right, total = 0, 0
    for number, text in enumerate(texts):
        tree = parse(text)
        row = row_of(printed(tree))
        for writer in range(writers):
            rng = np.random.default_rng([SEED, number, writer])
            ink = written(row, habits(sample_writer(rng), rng)).ink
            good = reader.read(ink.strokes, expected).tree == tree
            right += good
            wrong[text] += not good
            total += 1
    print(f"{len(texts)} formulas {whose}, {writers} writers each: {right / total:.1%} right")
    print("    wrong most: " + ", ".join(f"{text} {n}" for text, n in wrong.most_common(8)))


def strokewise(reader: Reader, count: int) -> None:
    """Milliseconds after each stroke, and for lines of 20 to 30 signs from nothing."""
    each: list[float] = []
    whole: list[float] = []
    index = 0
    while len(whole) < count:
        index += 1
        rng = np.random.default_rng([SEED, 5, index])
        row = mixed(rng)
        if not 20 <= sum(1 for _ in nodes_of(row)) <= 30:
            continue
        ink = written(row, habits(sample_writer(rng), rng)).ink
        begun = time.process_time()
        reader.read(ink.strokes)
        whole.append(time.process_time() - begun)
        session = Session(reader)
        for key, stroke in enumerate(ink):
            begun = time.process_time()
            session = session.wrote({key: stroke})
            each.append(time.process_time() - begun)
    ms = [1e3 * np.quantile(times, 0.95) for times in (each, whole)]
    print(
        f"CPU time, one thread, p95: after each stroke {ms[0]:.0f} ms, 20 to 30 signs from nothing {ms[1]:.0f} ms (n = {len(whole)})"
    )


def pages(reader: Reader, count: int) -> None:
    """The two worked examples by writers each, from ink alone, through to the motion."""
    for name in PROBLEMS[:2]:
        drawn = [page(name, SEED, index) for index in range(count)]
        for recognizer in ("learned", "oracle"):
            found = judge_all(drawn, recognizer, reads(reader))
            lines = sum(one.lines for one in found)
            print(
                f"{name}, {count} writers, strokes told by {recognizer}: sorted {np.mean([one.sorted for one in found]):.1%}, "
                f"lines read {sum(one.read for one in found) / lines:.1%}, right motion {np.mean([one.moves for one in found]):.1%}"
            )


def report(name: str, found: Sequence[Read]) -> None:
    got = asdict(scores(found))
    print(f"{name}:")
    for key, value in got.items():
        print(f"    {key}: {f'{value:.4f}' if isinstance(value, float) else value}")


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ink", help="folder of people's ink")
    parser.add_argument("--errors", action="store_true", help="only the table of what goes wrong, and why")
    parser.add_argument("--reader", choices=READERS, default="net")
    parser.add_argument("--most", type=int, default=None, help="rows of people's expressions at most")
    parser.add_argument("--lines", type=int, default=200, help="generated lines of each grammar")
    parser.add_argument("--writers", type=int, default=20)
    parser.add_argument("--pages", type=int, default=0, help="writers of each worked example")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
