"""Inner loops of the recognizers: plain functions that numba compiles once, and keeps on disk.

Numba looks only at the file of a function to tell whether machine code on disk is stale, not at the files of the
functions that are compiled into it. So kernels are kept in a directory that is named by a digest of all modules
beside their own: change one, and all of that folder are compiled anew. A kernel may therefore call kernels, and take
constants, from the modules beside its own alone. (`physics.jit` does the same for the engine, which recognizers
may not import; its digest covers other rooms.)
"""

from __future__ import annotations

import logging
import shutil
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, ClassVar, TypeVar, cast

import numba
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.event import Listener, register

PREFIX = "inklined-kernels-"
"""What the directories of compiled kernels are called, before the digest."""

OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False}

F = TypeVar("F", bound=Callable[..., Any])


def kernel(function: F) -> F:
    """Compiles the function when it is first called with new types of arguments; releases the GIL.

    Division by zero gives inf or NaN as in IEEE 754, nothing is reordered. Where no directory can be
    written to, it is compiled in every process.
    """
    compiled: Any = numba.njit(**OPTIONS)(function)
    with suppress(RuntimeError):  # numba found no directory that it may write to
        compiled._cache = _KernelCache(function)  # what cache=True does, with numba's own class
        _delete_stale(Path(compiled._cache.cache_path))
    return cast(F, compiled)


def part(function: F) -> F:
    """A kernel that kernels alone call. It has no entry from Python (a call from there would crash) and is kept
    on disk only within the kernels that it is compiled into: both take half the time to compile."""
    options: dict[str, Any] = {**OPTIONS, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return cast(F, numba.njit(**options)(function))


@cache
def digest(room: Path) -> str:
    """Of the sources of all modules that a kernel in a directory may be made of, twelve hexadecimal digits."""
    hashed = sha256()
    for module in sorted({Path(__file__), *room.glob("*.py")}):
        hashed.update(module.name.encode() + b"\0" + module.read_bytes() + b"\0")
    return hashed.hexdigest()[:12]


class _Digested:
    """A cache locator of numba's, one directory deeper."""

    _py_file: str

    def get_cache_path(self) -> str:
        located = cast(Any, super())  # one of numba's, which this is mixed into
        return str(Path(located.get_cache_path()) / f"{PREFIX}{digest(Path(self._py_file).parent)}")


class _KernelCacheImpl(CompileResultCacheImpl):
    # Numba's own choice: NUMBA_CACHE_DIR, else beside the source, else the user's cache directory.
    _locator_classes: ClassVar[list[type]] = [
        type(located.__name__, (_Digested, located), {})
        for located in CompileResultCacheImpl._locator_classes
    ]


class _KernelCache(FunctionCache):
    _impl_class = _KernelCacheImpl


@cache
def _delete_stale(kept: Path) -> None:
    """Another process may still use what is deleted here: it compiles anew then."""
    for directory in kept.parent.glob(f"{PREFIX}*"):
        if directory != kept:
            shutil.rmtree(directory, ignore_errors=True)


class _Announcer(Listener):
    """Says once in a process that kernels are being compiled: it looks like a hang."""

    told = False

    def on_start(self, event: Any) -> None:
        if not self.told and event.data["dispatcher"].py_func.__module__.startswith("recognizer.geometric."):
            self.told = True
            logging.getLogger("inklined").warning(
                "Compiling the geometric recognizer for this machine: once, for half a minute at most."
            )

    def on_end(self, event: Any) -> None:
        pass


register("numba:compile", _Announcer())
