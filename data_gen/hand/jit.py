"""The pen's kernels. One may call kernels, and take constants, from the modules beside its own alone."""

from __future__ import annotations

from sketch.jit import Kernels

_PEN = Kernels("the ink generator", "about a minute")
kernel, part = _PEN.kernel, _PEN.part
