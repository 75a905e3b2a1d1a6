"""Which code made a result: a digest of the rooms that it depends on, so that results of two versions are never mixed."""

from __future__ import annotations

from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

LIBRARIES = ("numpy", "scipy", "scikit-learn")
"""Whose version may change a claim in its last digits."""
INK = ("sketch", "data_gen", "recognizer")
"""What generated ink and claims depend on,"""
ROOMS = (*INK, "physics", "evaluation")
"""and what everything that is evaluated does."""


@cache
def digest(*parts: str) -> str:
    """Of all sources and data of these rooms, or single files of them ("evaluation/rivals.py"): twelve hexadecimal digits."""
    root = Path(__file__).parents[1]
    hashed = sha256(" ".join(version(name) for name in LIBRARIES).encode())
    for part in parts:
        place = root / part
        files = [place] if place.is_file() else [*place.glob("**/*.py"), *place.glob("**/*.json")]
        for path in sorted(files):
            hashed.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return hashed.hexdigest()[:12]
