"""Ink that knows physics: pages of pen strokes are read, corrected and set in motion.

    import inklined

    page = inklined.analyze("incline.inklined", recognizer="geometric")  # a sketch.page.Sketch
    motion = inklined.move(page, seconds=2.0)                            # a physics.pipeline.Motion
    verdicts = inklined.judge(page)                                      # one for every answer on it
    results = inklined.compare(["strokes.jsonl.gz"])                     # scores of every recognizer

Importing this costs nothing; what a function needs is imported when it is called.
"""

from inklined.api import analyze, compare, judge, move

__all__ = ["analyze", "compare", "judge", "move"]
