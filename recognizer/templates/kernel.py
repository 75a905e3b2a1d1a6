"""Inner loops of the matchers, compiled by numba once and kept on disk.

A kernel calls kernels of its own module alone: numba looks at the file of a kernel, and at no other, to tell
whether the machine code on disk is stale.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., Any])


def kernel(function: F) -> F:
    """Compiles the function when it is first called. Where no directory can be written to, in every process."""
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
    try:
        return cast(F, numba.njit(cache=True, **options)(function))
    except RuntimeError:  # numba found no directory that it may write to
        return cast(F, numba.njit(**options)(function))
