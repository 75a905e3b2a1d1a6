"""Laws of where mathematics stands."""

import numpy as np

from data_gen.layout import SHEET, place
from data_gen.problems import ANSWERS, PROBLEMS, problem
from sketch.geometry import resample
from sketch.page import Component
from sketch.shapes import Polygon, outline


def placed(name, seed, lines=4, size=(130.0, 30.0)):
    rng = np.random.default_rng([seed])
    made = problem(name, ANSWERS[name][0], rng)
    sizes = [size] * lines
    return (
        made,
        sizes,
        place(sizes, [None, (300.0, 200.0), (100.0, 300.0), (500.0, 100.0)], made.components, 20.0, rng),
    )


def test_lines_lie_over_no_shape():
    for name in PROBLEMS:
        for seed in range(6):
            made, sizes, centres = placed(name, seed)
            for component in made.components:
                ink = resample(outline(component.shape), 400)
                for centre, size in zip(centres, sizes, strict=True):
                    assert (np.abs(ink - centre) > np.asarray(size) / 2).any(axis=1).all()


def test_lines_keep_their_distance_from_one_another():
    for name in PROBLEMS:
        for seed in range(6):
            _, sizes, centres = placed(name, seed)
            for one in range(len(centres)):
                for other in range(one):
                    gap = np.abs(np.subtract(centres[one], centres[other])) - sizes[one]
                    assert gap[0] > 0.8 * 1.6 * 20 or gap[1] > 0.4 * 0.7 * 20


def test_a_line_stands_near_what_it_governs_when_there_is_room():
    rng = np.random.default_rng(3)
    block = Component(Polygon([(280, 200), (320, 200), (320, 240), (280, 240)]))
    ways = [place([(60.0, 25.0)], [(300.0, 220.0)], [block], 20.0, rng)[0] for _ in range(40)]
    away = [float(np.hypot(x - 300, y - 220)) for x, y in ways]
    assert max(away) < 150
    assert np.median(away) < 80


def test_what_finds_no_room_goes_below_everything():
    rng = np.random.default_rng(3)
    full = Component(
        Polygon([(1, 1), (SHEET.width - 1, 1), (SHEET.width - 1, SHEET.height - 1), (1, SHEET.height - 1)])
    )
    one, two = place([(200.0, 30.0)] * 2, [None, (10.0, 10.0)], [full], 20.0, rng)
    assert one[1] - 15 > SHEET.height - 1
    assert two[1] - 15 > one[1] + 15
