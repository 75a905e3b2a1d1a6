"""Rivals ready to compete: those that are, and the published ones once they have been taught.

A published rival learns from generated ink unless samples are given, and is calibrated on generated ink of other
seeds. What it learnt from generated ink is kept in the user's cache folder under a digest of everything that it depends on, so that it
is taught once, in a few seconds, and again whenever the generator or the rival changes. Where nothing can be kept it is taught
in every process. The folder is $INKLINED_CACHE, or `inklined` in the system's place for caches.
"""

from __future__ import annotations

import logging
import os
import pickle
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evaluation import code
from recognizer.claims import Recognizer
from recognizer.published import PUBLISHED
from recognizer.roster import ROSTER, recognizer
from recognizer.samples import Sample
from sketch.ink import Ink
from sketch.page import StrokeKind

if TYPE_CHECKING:
    from recognizer.calibrated import Calibrated

KINDS: tuple[StrokeKind, ...] = ("circle", "polygon", "spring", "wire", "arrow", "scribble", "math")
"""What the published rivals are taught: all that a drawing can be by its own shape. A lasso is a circle but for what it
encloses, and a tap is a dot, which its size on the page tells."""


OWN = "@"
"""In the name of a rival that was taught from somebody's own samples."""
KEPT_OWN = 60
"""So many of them are kept, the latest."""


@dataclass(frozen=True, slots=True)
class TeachingRule:
    """Generated ink that rivals are taught and calibrated with; its seeds are used for nothing else."""

    seed: int = 51_001
    held_out_seed: int = 51_002
    strangers_seed: int = 51_003
    held_out: int = 60
    """Of each kind, for the temperature and for what is kept."""
    strangers: int = 300
    """Drawings of no kind, for what is rejected."""


RULE = TeachingRule()


def known() -> tuple[str, ...]:
    """The names of all rivals."""
    return (*ROSTER, *PUBLISHED)


def rival(name: str) -> Recognizer:
    """The rival of that name, ready to recognize; a published one is taught from generated ink at first. Raises
    ValueError as `recognizer.roster.recognizer` for a name that nobody bears."""
    if name in PUBLISHED:
        return _kept(name)
    if OWN in name and ":" not in name:
        return _own(name)
    if name not in ROSTER and ":" not in name:
        raise ValueError(
            f"no recognizer is called {name!r}; known are {', '.join(known())}, or module:Class for one of your own"
        )
    return recognizer(name)


def taught_by_samples(name: str, samples: Sequence[Sample], seed: int = 0) -> str:
    """Teaches the published rival of that name from these samples and keeps it under a name of its own, which is
    returned and which `rival` knows in every process. Raises ValueError as `taught`, OSError where it cannot be kept."""
    told = pickle.dumps((name, seed, [(sample.kind, sample.ink.strokes) for sample in samples], digest()))
    own = f"{name}{OWN}{sha256(told).hexdigest()[:8]}"
    place = _place(own)
    if not place.is_file():
        _write(place, taught(name, samples, seed))
        mine = sorted(cache_folder().glob(f"*{OWN}*.pickle"), key=lambda path: path.stat().st_mtime)
        for oldest in mine[:-KEPT_OWN]:
            oldest.unlink(missing_ok=True)
    return own


def taught(name: str, samples: Sequence[Sample], seed: int = 0) -> Calibrated:
    """The published rival of that name, taught from these samples and calibrated on generated ink. Raises ValueError for
    a name that is not in `PUBLISHED`, and for samples none of which is of a kind in `KINDS`."""
    if name not in PUBLISHED:
        raise ValueError(
            f"{name!r} is no published rival; those that can be taught are {', '.join(PUBLISHED)}"
        )
    usable = [sample for sample in samples if sample.kind in KINDS]
    if not usable:
        raise ValueError(
            f"none of the {len(samples)} samples is of a kind that can be taught: {', '.join(KINDS)}"
        )
    from recognizer.calibrated import Calibrated, calibrate

    scorer = PUBLISHED[name].trainer()(usable, np.random.default_rng(seed))
    return Calibrated(name, scorer, calibrate(scorer, _held_out(), _strangers()))


def generated_samples(per_kind: int, seed: int) -> list[Sample]:
    """`per_kind` generated samples of each of `KINDS`, each by a writer of its own. The first of a larger
    number are those of a smaller."""
    from data_gen.strokes import stream

    found: list[Sample] = []
    for kind in KINDS:
        mix: Mapping[StrokeKind, float] = {kind: 1.0}
        found += [
            Sample(Ink((item.stroke,)), kind) for item in islice(stream(per_kind, seed, mix=mix), per_kind)
        ]
    return found


@cache
def _held_out() -> tuple[Sample, ...]:
    return tuple(generated_samples(RULE.held_out, RULE.held_out_seed))


@cache
def _strangers() -> tuple[Ink, ...]:
    from evaluation.strangers import strangers

    return tuple(strangers(RULE.strangers, RULE.strangers_seed))


@cache
def _kept(name: str) -> Calibrated:
    """What is kept of the rival, or the rival taught anew and kept."""
    place = kept_at(name)
    found = _read(place)
    if found is not None:
        return found
    log = logging.getLogger("inklined")
    log.warning("Teaching %s from generated ink: once, for some seconds. Later runs start at once.", name)
    rival = taught(name, generated_samples(PUBLISHED[name].samples, RULE.seed), RULE.seed)
    try:
        _write(place, rival)
        for stale in place.parent.glob(f"{name}-{'[0-9a-f]' * 12}.pickle"):
            if stale != place:
                stale.unlink(missing_ok=True)
    except OSError as error:
        log.warning("%s could not be kept: %s", name, error)
    return rival


@cache
def _own(name: str) -> Calibrated:
    found = _read(_place(name))
    if found is None:
        raise ValueError(f"{name!r} is not kept any more; teach it again with --train")
    return found


def kept_at(name: str) -> Path:
    """Where the taught rival of that name is kept, by this version of the code."""
    return _place(name if OWN in name else f"{name}-{digest()}")


def _place(name: str) -> Path:
    return cache_folder() / f"{name}.pickle"


def _read(place: Path) -> Calibrated | None:
    """What is kept there; None when it is not there, cut short, or of another version of a library."""
    from recognizer.calibrated import Calibrated

    try:
        found = pickle.loads(place.read_bytes())
    except Exception:
        return None
    return found if isinstance(found, Calibrated) else None


def _write(place: Path, rival: Calibrated) -> None:
    """Writes the rival whole or not at all."""
    place.parent.mkdir(parents=True, exist_ok=True)
    handle, draft = tempfile.mkstemp(dir=place.parent)
    with os.fdopen(handle, "wb") as file:
        pickle.dump(rival, file)
    Path(draft).replace(place)


def cache_folder() -> Path:
    """Where taught rivals are kept. Whoever can write there can make inklined run anything: it is the user's own."""
    if named := os.environ.get("INKLINED_CACHE"):
        return Path(named)
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "inklined"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "inklined"


@cache
def resident(name: str) -> Recognizer:
    """This process's own rival of that name: loaded once. Raises as `rival`."""
    return rival(name)


def digest() -> str:
    """Of all that a taught rival depends on: the generator, the rivals, and the libraries they learn with."""
    return code.digest(*code.INK, "evaluation/rivals.py", "evaluation/strangers.py")
