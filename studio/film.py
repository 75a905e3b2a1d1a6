"""A motion as a film: MP4 with H.264, which browsers, slides and telephones play."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from io import BytesIO
from itertools import chain

from evaluation.pictures import LAYOUT, images_of
from physics.pipeline import Motion
from studio.limits import Refused


@dataclass(frozen=True, slots=True)
class FilmRule:
    """How a film is made."""

    rate: int = 30
    """Frames a second: smooth to the eye, and what every player takes."""
    pixels: int = 720
    """Width."""
    quality: int = 20
    """x264's constant rate factor: lines on paper show no blocks at it."""


RULE = FilmRule()


def film(motion: Motion, seconds: float, rule: FilmRule = RULE) -> bytes:
    """MP4 of the motion from the start to `seconds`, in real time. Raises Refused where there is no encoder."""
    try:
        import av
    except ImportError:
        raise Refused(
            "films need the library av: pip install 'inklined[studio]'; a GIF needs nothing"
        ) from None
    count = max(2, round(seconds * rule.rate) + 1)
    stream = BytesIO()
    with av.open(stream, "w", format="mp4") as file:
        video = file.add_stream("libx264", rate=Fraction(rule.rate), options={"crf": str(rule.quality)})
        video.pix_fmt = "yuv420p"  # the one that players without a computer behind them know
        video.codec_context.thread_count = 1
        images = images_of(motion, seconds, count, layout=replace(LAYOUT, pixels=rule.pixels))
        first = next(images)
        video.width, video.height = first.size
        for image in chain((first,), images):
            file.mux(video.encode(av.VideoFrame.from_image(image)))
        file.mux(video.encode())
    return stream.getvalue()
