"""Where figures come from, and whether they come again: the command, the seed, versions, the machine and the data's hashes.

Timings and memory are what a second run may tell otherwise; everything else must be the same.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Sequence
from datetime import datetime
from importlib.metadata import version
from typing import Any, cast

from evaluation.code import ROOMS, digest
from evaluation.contest import Contest

LIBRARIES = ("inklined", "numpy", "scipy", "sympy", "scikit-learn", "onnxruntime", "numba")
TIMINGS = ("latency_ms", "memory_mb", "made", "machine", "seconds")
"""Keys, wherever they stand, whose values may differ from run to run."""


def provenance(contest: Contest, arguments: Sequence[str], made: datetime, seconds: float) -> dict[str, Any]:
    """What is needed to have the contest's figures again."""
    return {
        "arguments": list(arguments),
        "seed": contest.seed,
        "hashes": contest.hashes(),
        "code": digest(*ROOMS),
        "versions": versions(),
        "python": platform.python_version(),
        "machine": machine(),
        "made": made.isoformat(timespec="seconds"),
        "seconds": round(seconds, 1),
    }


def versions() -> dict[str, str]:
    """Of inklined and of the libraries that figures depend on."""
    return {name: version(name) for name in LIBRARIES}


def machine() -> str:
    """Cores, processor and system, in a line."""
    return f"{os.cpu_count()} cores, {platform.machine()}, {platform.system()}"


def without_timings(figures: Any) -> Any:
    """The figures but for what may differ from run to run."""
    if isinstance(figures, dict):
        named = cast("dict[str, Any]", figures)
        return {key: without_timings(value) for key, value in named.items() if key not in TIMINGS}
    if isinstance(figures, list):
        return [without_timings(value) for value in cast("list[Any]", figures)]
    return figures


def differences(first: Any, second: Any, place: str = "") -> list[str]:
    """Where two figures differ, by their places; nothing when all is the same to the last digit."""
    if isinstance(first, dict) and isinstance(second, dict):
        one, other = cast("dict[str, Any]", first), cast("dict[str, Any]", second)
        return [
            line
            for key in dict.fromkeys((*one, *other))
            for line in differences(one.get(key), other.get(key), f"{place}.{key}".lstrip("."))
        ]
    if isinstance(first, list) and isinstance(second, list):
        here, there = cast("list[Any]", first), cast("list[Any]", second)
        if len(here) == len(there):
            pairs = enumerate(zip(here, there, strict=True))
            return [line for k, (a, b) in pairs for line in differences(a, b, f"{place}[{k}]")]
    if json.dumps(first, sort_keys=True) == json.dumps(second, sort_keys=True):
        return []
    return [f"{place}: {_shown(first)}, then {_shown(second)}"]


def _shown(value: Any, most: int = 60) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= most else text[:most] + "…"
