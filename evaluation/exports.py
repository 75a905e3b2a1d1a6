"""Tables as files that papers take: CSV for programs, LaTeX (booktabs) for print."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

from evaluation.table import Table
from sketch.files.store import write_text

_LATEX = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "–": "--", "±": r"$\pm$", "·": r"$\cdot$", "∞": r"$\infty$",
    "−": "$-$", "°": r"$^\circ$", "…": r"\dots{}", "≤": r"$\le$", "≥": r"$\ge$", "α": r"$\alpha$", "κ": r"$\kappa$",
}  # fmt: skip


def as_csv(table: Table) -> str:
    """The table with its head; what is best is not marked."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.head)
    writer.writerows([name, *(cell.text for cell in cells)] for name, *cells in table.rows)
    return text.getvalue()


def as_latex(table: Table) -> str:
    """The table in booktabs' style, what is best in bold, the caption beneath."""
    head = " & ".join(_escaped(name) for name in table.head)
    rows = "".join(
        " & ".join([_escaped(name), *(_cell(cell.text, cell.best) for cell in cells)]) + r" \\" + "\n"
        for name, *cells in table.rows
    )
    return (
        "\\begin{table}\n\\centering\n"
        f"\\begin{{tabular}}{{l{'r' * (len(table.head) - 1)}}}\n\\toprule\n{head} \\\\\n\\midrule\n{rows}"
        f"\\bottomrule\n\\end{{tabular}}\n\\caption{{{_escaped(table.caption)}}}\n\\end{{table}}\n"
    )


def save_tables(folder: Path, tables: Sequence[Table]) -> list[Path]:
    """Writes each table as CSV and LaTeX, numbered and named by its caption. Raises FileError, OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    places: list[Path] = []
    for number, table in enumerate(tables, start=1):
        for suffix, text in ((".csv", as_csv(table)), (".tex", as_latex(table))):
            place = folder / f"{number:02d}-{stem(table)}{suffix}"
            write_text(place, text)
            places.append(place)
    return places


def stem(table: Table) -> str:
    """The caption's first words as a file's name."""
    words = re.findall(r"[a-z]+|\d+", table.caption.lower())
    return "-".join(words[:6]) or "table"


def _cell(text: str, best: bool) -> str:
    return f"\\textbf{{{_escaped(text)}}}" if best else _escaped(text)


def _escaped(text: str) -> str:
    return "".join(_LATEX.get(letter, letter) for letter in text)
