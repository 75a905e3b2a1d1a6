"""The published rivals by name: what each is, and how it learns. They know no ink until they are taught.

Whoever wants one ready asks `evaluation.rivals`, which teaches it from generated ink, or from samples of one's own.
Each is imported when it is asked for.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass

from recognizer.samples import Trainer

TEMPLATES, LEARNERS = 40, 400
"""Samples of each kind that a rival learns from, unless told otherwise. What compares with every template takes as long as
there are templates; learners take as long however many samples they saw."""


@dataclass(frozen=True, slots=True)
class Published:
    """summary: one line; paper: whose; samples: of each kind that it learns from by default; turns: whether the paper's
    rule looks past how a drawing is turned; senses: past the order and sense of its strokes."""

    summary: str
    paper: str
    samples: int
    turns: bool
    senses: bool
    matcher: str = ""
    features: str = ""
    learner: str = ""

    def trainer(self) -> Trainer:
        """How it learns."""
        if self.matcher:
            from recognizer.templates.nearest import by_templates

            module, _, name = self.matcher.partition(":")
            return by_templates(getattr(importlib.import_module(f"recognizer.templates.{module}"), name))
        module, _, name = self.features.partition(":")
        features = getattr(importlib.import_module(f"recognizer.classical.{module}"), name)
        if self.learner == "rubine":
            from recognizer.classical.linear import by_rubine

            return by_rubine(features)
        from recognizer.classical import learners

        return learners.by_learner(features, getattr(learners, self.learner))


def _learnt(features: str, paper: str, learner: str, what: str) -> Published:
    title = "HBF49's 49 features" if features == "hbf49:hbf49" else "Rubine's features"
    return Published(f"{title} and {what}", paper, LEARNERS, False, False, features=features, learner=learner)


_RUBINE = ("rubine:shape", "Rubine, SIGGRAPH 1991")
_HBF49 = ("hbf49:hbf49", "Delaye and Anquetil, Pattern Recognition 2013")

PUBLISHED: dict[str, Published] = {
    "dollar-one": Published(
        "$1: one stroke, turned until it matches best",
        "Wobbrock, Wilson and Li, UIST 2007",
        TEMPLATES,
        True,
        False,
        matcher="dollar_one:DollarOne",
    ),
    "protractor": Published(
        "Protractor: $1's comparison in closed form",
        "Li, CHI 2010",
        TEMPLATES,
        True,
        False,
        matcher="protractor:Protractor",
    ),
    "dollar-n": Published(
        "$N: strokes in every order and sense, compared as Protractor does",
        "Anthony and Wobbrock, GI 2010 and GI 2012",
        TEMPLATES,
        True,
        True,
        matcher="dollar_n:DollarN",
    ),
    "dollar-p": Published(
        "$P: clouds of points, whatever the order of strokes",
        "Vatavu, Anthony and Wobbrock, ICMI 2012",
        TEMPLATES,
        False,
        True,
        matcher="dollar_p:DollarP",
    ),
    "dollar-q": Published(
        "$Q: $P with lower bounds from a look-up table",
        "Vatavu, Anthony and Wobbrock, MobileHCI 2018",
        TEMPLATES,
        False,
        True,
        matcher="dollar_q:DollarQ",
    ),
    "penny-pincher": Published(
        "Penny Pincher: directions compared one by one",
        "Taranta and LaViola, GI 2015",
        TEMPLATES,
        False,
        False,
        matcher="penny_pincher:PennyPincher",
    ),
    "jackknife": Published(
        "Dynamic time warping on directions, after Jackknife",
        "Taranta et al., CHI 2017",
        TEMPLATES,
        False,
        False,
        matcher="jackknife:Jackknife",
    ),
    "rubine": _learnt(*_RUBINE, "rubine", "his linear classifier"),
    "rubine-linear": _learnt(*_RUBINE, "logistic", "logistic regression"),
    "rubine-svm": _learnt(*_RUBINE, "machine", "a calibrated support vector machine"),
    "rubine-forest": _learnt(*_RUBINE, "forest", "a random forest"),
    "hbf49-linear": _learnt(*_HBF49, "logistic", "logistic regression"),
    "hbf49-svm": _learnt(*_HBF49, "machine", "a calibrated support vector machine"),
    "hbf49-forest": _learnt(*_HBF49, "forest", "a random forest"),
}
