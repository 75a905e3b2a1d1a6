"""What was typed: the command line that is being run, for reports that say how to have them again."""

from __future__ import annotations

from contextvars import ContextVar

TYPED: ContextVar[tuple[str, ...]] = ContextVar("TYPED", default=("compare",))
"""The words after `inklined`."""
