"""The engine's kernels. One may call and take constants from physics/jit.py, physics/formula/kernel.py,
physics/engine/*.py and the modules beside its own alone: engine/exact and engine/robust know nothing of each other.
"""

from __future__ import annotations

from pathlib import Path

from sketch.jit import Kernels

_HERE = Path(__file__).parent
_ENGINE = Kernels(
    "the engine",
    "about a minute",
    [Path(__file__), _HERE / "formula" / "kernel.py", *(_HERE / "engine").glob("*.py")],
)
kernel, part = _ENGINE.kernel, _ENGINE.part
