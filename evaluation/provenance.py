"""Where figures come from, and whether they come again: the command, the seed, versions, the machine and the data's hashes.

Timings are what a second run may tell otherwise; everything else must be the same.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Sequence
from datetime import datetime
from importlib.metadata import version
from typing import Any

from evaluation.contest import Contest

LIBRARIES = ("inklined", "numpy", "scipy", "sympy", "scikit-learn", "onnxruntime", "numba")
TIMINGS = ("latency_ms", "made", "machine", "seconds")
"""Keys, wherever they stand, whose values may differ from run to run."""


def provenance(contest: Contest, arguments: Sequence[str], made: datetime, seconds: float) -> dict[str, Any]:
    """What is needed to have the contest's figures again."""
    return {
        "arguments": list(arguments),
        "seed": contest.seed,
        "hashes": contest.hashes(),
        "versions": {name: version(name) for name in LIBRARIES},
        "python": platform.python_version(),
        "machine": machine(),
        "made": made.isoformat(timespec="seconds"),
        "seconds": round(seconds, 1),
    }


def machine() -> str:
    """Cores, processor and system, in a line."""
    return f"{os.cpu_count()} cores, {platform.machine()}, {platform.system()}"


def without_timings(figures: Any) -> Any:
    """The figures but for what may differ from run to run."""
    match figures:
        case dict():
            return {key: without_timings(value) for key, value in figures.items() if key not in TIMINGS}  # type: ignore[misc]
        case list():
            return [without_timings(value) for value in figures]  # type: ignore[misc]
        case _:
            return figures


def differences(first: Any, second: Any, place: str = "") -> list[str]:
    """Where two figures differ, by their places; nothing when all is the same to the last digit."""
    if isinstance(first, dict) and isinstance(second, dict):
        return [
            line
            for key in dict.fromkeys((*first, *second))  # type: ignore[misc]
            for line in differences(first.get(key), second.get(key), f"{place}.{key}".lstrip("."))  # type: ignore[misc]
        ]
    if isinstance(first, list) and isinstance(second, list) and len(first) == len(second):  # type: ignore[arg-type]
        return [
            line
            for k, (one, other) in enumerate(zip(first, second, strict=True))  # type: ignore[arg-type]
            for line in differences(one, other, f"{place}[{k}]")
        ]
    if json.dumps(first, sort_keys=True) == json.dumps(second, sort_keys=True):
        return []
    return [f"{place}: {_shown(first)}, then {_shown(second)}"]


def _shown(value: Any, most: int = 60) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= most else text[:most] + "…"
