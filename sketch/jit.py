"""Kernels: plain functions that numba compiles to machine code once, and keeps on disk.

Numba looks only at the file of a function to tell whether machine code on disk is stale, not at the
files of the functions that it calls, which are compiled into it. So kernels are kept in a directory
that is named by a digest of every module whose code may be in them: change one, and all are compiled
anew. Directories of other digests are deleted when the first kernel is made.

A room makes its kernels with a `Kernels` of its own. A kernel may call and take constants from the modules
beside its own and from those that are said to be shared, and from no others.
"""

from __future__ import annotations

import logging
import shutil
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.event import Listener, register

PREFIX = "inklined-kernels-"
"""What the directories of compiled kernels are called, before the digest."""

OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False}

F = TypeVar("F", bound=Callable[..., Any])


class Kernels:
    """The kernels of a room. what: they are, for people who wait; minutes: for how long; shared: modules that any
    of them may be made of besides those beside its own."""

    def __init__(self, what: str, wait: str, shared: Iterable[Path] = ()) -> None:
        self.modules: set[str] = set()
        self._cache = _cache_of(frozenset(shared))
        register("numba:compile", _Announcer(self.modules, what, wait))

    def kernel(self, function: F) -> F:
        """Compiles the function when it is first called with new types of arguments; releases the GIL.

        Division by zero gives inf or NaN as in IEEE 754, nothing is reordered. Where no directory can be
        written to, it is compiled in every process.
        """
        self.modules.add(function.__module__)
        compiled: Any = numba.njit(**OPTIONS)(function)
        with suppress(RuntimeError):  # numba found no directory that it may write to
            compiled._cache = self._cache(function)  # what cache=True does, with numba's own class
            _delete_stale(Path(compiled._cache.cache_path))
        return cast(F, compiled)

    def part(self, function: F) -> F:
        """A kernel that kernels alone call. It has no entry from Python (a call from there would crash) and is kept
        on disk only within the kernels that it is compiled into: both take half the time to compile."""
        options: dict[str, Any] = {**OPTIONS, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        return cast(F, numba.njit(**options)(function))


@cache
def digest(room: Path, shared: frozenset[Path]) -> str:
    """Of the sources of all modules that a kernel in a directory may be made of, twelve hexadecimal digits."""
    hashed = sha256()
    for module in sorted({Path(__file__), *shared, *room.glob("*.py")}):
        hashed.update(module.name.encode() + b"\0" + module.read_bytes() + b"\0")
    return hashed.hexdigest()[:12]


def _cache_of(shared: frozenset[Path]) -> type[FunctionCache]:
    """Numba's cache, in directories that the digest names."""

    class Digested:
        """A cache locator of numba's, one directory deeper."""

        _py_file: str

        def get_cache_path(self) -> str:
            located = cast(Any, super())  # one of numba's, which this is mixed into
            room = Path(self._py_file).parent
            return str(Path(located.get_cache_path()) / f"{PREFIX}{digest(room, shared)}")

    # Numba's own choice: NUMBA_CACHE_DIR, else beside the source, else the user's cache directory.
    locators = [
        type(located.__name__, (Digested, located), {})
        for located in cast(Any, CompileResultCacheImpl)._locator_classes
    ]
    kept = type("KernelCacheImpl", (CompileResultCacheImpl,), {"_locator_classes": locators})
    return type("KernelCache", (FunctionCache,), {"_impl_class": kept})


@cache
def _delete_stale(kept: Path) -> None:
    """Another process may still use what is deleted here: it compiles anew then."""
    for directory in kept.parent.glob(f"{PREFIX}*"):
        if directory != kept:
            shutil.rmtree(directory, ignore_errors=True)


class _Announcer(Listener):
    """Says once in a process that kernels are being compiled: it takes long, and looks like a hang."""

    def __init__(self, modules: set[str], what: str, wait: str) -> None:
        self.modules, self.told = modules, False
        self.words = f"Compiling {what} for this machine: once, for {wait}. Later runs start at once."

    def on_start(self, event: Any) -> None:
        if not self.told and event.data["dispatcher"].py_func.__module__ in self.modules:
            self.told = True
            logging.getLogger("inklined").warning(self.words)

    def on_end(self, event: Any) -> None:
        pass
