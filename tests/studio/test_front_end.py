"""The front end in TypeScript: its types fit, and its own unit tests pass."""

from __future__ import annotations

import re

from studio.bundle import DIST, bundle, check, current


def test_the_front_end_is_type_checked_and_its_unit_tests_pass() -> None:
    check()


def test_the_bundle_is_small_whole_and_loads_nothing_from_elsewhere() -> None:
    bundle()
    assert current()
    served = [path for path in DIST.iterdir() if path.suffix in (".js", ".css", ".html", ".svg")]
    assert sum(path.stat().st_size for path in served) < 1_000_000
    for path in served:
        for link in re.findall(
            r"""(?:src|href|url|import)\s*[=(]?\s*["'](https?://[^"']+)""", path.read_text(encoding="utf-8")
        ):
            raise AssertionError(f"{path.name} loads {link}")
