"""A figure that moves, as a GIF."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import BinaryIO

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

DPI = 100
_SECONDS = 10.0  # of a loop, if no frame is longer or shorter than these bounds
_FRAMES_A_SECOND = (4.0, 20.0)


def write_gif(
    figure: Figure,
    moving: Sequence[Artist],
    count: int,
    show: Callable[[int], object],
    stream: BinaryIO,
) -> None:
    """Write `count` frames; `show` changes the artists `moving`, in their order, into frame k.

    All else is drawn once, below them. Equal figures give equal bytes.
    """
    figure.set_dpi(DPI)
    canvas, pictures = FigureCanvasAgg(figure), list[Image.Image]()
    # the layout is found once, so that nothing jumps
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for artist in moving:
        artist.set_animated(True)
    canvas.draw()
    still = canvas.copy_from_bbox(figure.bbox)
    for k in range(count):
        show(k)
        canvas.restore_region(still)
        for artist in moving:
            figure.draw_artist(artist)
        pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB"))
    rate = float(np.clip(len(pictures) / _SECONDS, *_FRAMES_A_SECOND))
    first, *others = pictures
    each = int(1000 / rate)  # ms
    first.save(stream, "gif", save_all=True, append_images=others, duration=each, loop=0)
