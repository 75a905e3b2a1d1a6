"""Machine code on disk: kept from one process to the next, and never older than its source.

Each test runs a small package of kernels with the real physics/jit.py and sketch/jit.py in processes of its own.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import physics.jit
import sketch.jit

INNER = "from physics.jit import kernel\n@kernel\ndef inner(x: float) -> float:\n    return {factor} * x\n"
OUTER = (
    "from physics.jit import kernel\nfrom physics.engine.inner import inner\n"
    "@kernel\ndef outer(x: float) -> float:\n    return inner(x) + 1\n"
)
STRANGER = "import numba\n@numba.njit(cache=True)\ndef strange(x):\n    return x + 1\n"
RUN = """
import json
from physics.engine.exact.outer import outer
from stranger import strange
value = outer(10.0)
strange(1.0)
print(json.dumps({"value": value, "kept": sum(outer.stats.cache_hits.values())}))
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A folder with a package named physics that has one kernel calling another in another file."""
    for folder in ("physics/formula", "physics/engine", "physics/engine/exact"):
        (tmp_path / folder).mkdir(parents=True)
    for folder in ("physics", "physics/formula", "physics/engine", "physics/engine/exact"):
        (tmp_path / folder / "__init__.py").touch()
    (tmp_path / "sketch").mkdir()
    (tmp_path / "sketch" / "__init__.py").touch()
    for module in (physics.jit, sketch.jit):
        room, name = module.__name__.split(".")
        shutil.copy(str(module.__file__), tmp_path / room / f"{name}.py")
    (tmp_path / "physics/engine/exact/outer.py").write_text(OUTER)
    (tmp_path / "physics/formula/kernel.py").touch()
    (tmp_path / "physics/engine/inner.py").write_text(INNER.format(factor=2))
    (tmp_path / "stranger.py").write_text(STRANGER)
    return tmp_path


def run(package: Path) -> tuple[float, int]:
    """(outer(10), how often its machine code was found on disk), in a new process."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("NUMBA")}
    environment |= {
        "PYTHONPATH": str(package),
        "XDG_CACHE_HOME": str(package / "cache"),
        "HOME": str(package),
    }
    done = subprocess.run(
        [sys.executable, "-c", RUN], cwd=package, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    return found["value"], found["kept"]


def kept_in(folder: Path) -> list[str]:
    """Directories of compiled kernels below a folder, each by name."""
    return sorted(found.name for found in folder.rglob(f"{sketch.jit.PREFIX}*"))


def test_machine_code_is_compiled_once_and_found_by_the_next_process(package: Path) -> None:
    assert run(package) == (21.0, 0)
    assert run(package) == (21.0, 1)


def test_a_change_in_a_called_file_compiles_the_callers_anew_and_leaves_nothing_stale(package: Path) -> None:
    assert run(package) == (21.0, 0)
    before = kept_in(package)
    (package / "physics/engine/inner.py").write_text(INNER.format(factor=3))
    assert run(package) == (31.0, 0)
    assert run(package) == (31.0, 1)
    after = kept_in(package)
    assert len(before) == len(after) == 2
    assert not set(before) & set(after)


def test_a_source_that_changes_back_changes_the_result_back(package: Path) -> None:
    for factor, value in ((2, 21.0), (3, 31.0), (2, 21.0)):
        (package / "physics/engine/inner.py").write_text(INNER.format(factor=factor))
        assert run(package)[0] == value


def test_where_the_package_cannot_be_written_to_the_user_s_cache_is_used(package: Path) -> None:
    for folder in ("engine", "engine/exact"):  # what root cannot write into either: a file
        shutil.rmtree(package / "physics" / folder / "__pycache__", ignore_errors=True)
        (package / "physics" / folder / "__pycache__").touch()
    assert run(package) == (21.0, 0)
    assert run(package) == (21.0, 1)
    assert len(kept_in(package / "cache")) == 2
    assert kept_in(package / "physics") == []


def test_where_nothing_can_be_written_to_kernels_still_run(package: Path) -> None:
    for place in ("physics/engine/__pycache__", "physics/engine/exact/__pycache__", "cache"):
        (package / place).touch()
    assert run(package) == (21.0, 0)
    assert run(package) == (21.0, 0)


def test_the_machine_code_of_other_people_stays_where_numba_puts_it(package: Path) -> None:
    run(package)
    indices = list((package / "__pycache__").glob("stranger.strange*.nbi"))
    assert len(indices) == 1
