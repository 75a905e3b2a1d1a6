"""Inner loops of the recognizers. A kernel may call kernels, and take constants, from the modules beside its own alone."""

from __future__ import annotations

from sketch.jit import Kernels

_RECOGNIZERS = Kernels("the geometric recognizer", "half a minute at most")
kernel, part = _RECOGNIZERS.kernel, _RECOGNIZERS.part
