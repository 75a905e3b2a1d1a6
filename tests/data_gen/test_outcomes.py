"""The truth moves as it was made to: with exact shapes and formulas every diagram and every answer comes
to the end that it was built for. What is expected follows from the diagram's making, not from a run."""

import numpy as np
import pytest

from data_gen.pages import meaning
from data_gen.problems import ANSWERS, PROBLEMS, problem
from physics.outcome import outcome
from physics.pipeline import move

DRAWS = 10


@pytest.mark.parametrize(
    ("name", "answer"), [(name, answer) for name in PROBLEMS for answer in ANSWERS[name]]
)
def test_every_diagram_comes_to_the_end_it_was_made_for(name, answer):
    for draw in range(DRAWS):
        made = problem(name, answer, np.random.default_rng([17, draw]))
        motion = move(meaning(made), made.seconds)
        seen = outcome(motion)
        assert motion.notices == ()
        assert set(seen.fates) == set(made.expected.fates)
        for label, fates in made.expected.fates.items():
            assert seen.fates[label] in fates, (draw, label, seen)
        if made.expected.breaks:
            assert seen.broken & made.expected.breaks
        else:
            assert not seen.broken


def test_the_ball_on_the_right_incline_gains_speed_as_g_sin_theta():
    """Closed form: a smooth incline, v = g sin(θ) t, as long as the diagram is watched."""
    for draw in range(DRAWS):
        made = problem("incline-and-ball", "right", np.random.default_rng([18, draw]))
        page = meaning(made)
        values = {line.text.split(" = ")[0]: line.tree.rhs for line in page.expressions}
        gravity = float(values.get("g", 9.81))
        trajectory = move(page, made.seconds).trajectory
        expected = gravity * np.sin(float(values["theta"])) * trajectory.times
        (ball,) = made.expected.fates
        np.testing.assert_allclose(trajectory.speed(ball), expected, atol=0.02 * expected[-1])


def test_nothing_leaves_its_floor_while_it_is_watched():
    """What is said of two balls holds for as long as both have the floor under them."""
    for draw in range(DRAWS):
        made = problem("two-balls", "right", np.random.default_rng([19, draw]))
        page = meaning(made)
        floor = next(part.shape.vertices for part in page.components if part.fixed)
        trajectory = move(page, made.seconds).trajectory
        for label in made.expected.fates:
            x = 100 * trajectory.path(label)[:, 0]
            assert floor[:, 0].min() < x.min()
            assert x.max() < floor[:, 0].max()
