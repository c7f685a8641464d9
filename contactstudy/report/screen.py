"""The report as one page for the screen: the template's text, figures that can be zoomed and read.

Nothing is loaded from elsewhere: BokehJS, the figures' data and the pictures stand in the page.
"""

from __future__ import annotations

import base64
import importlib.util
import io
import re
from collections.abc import Mapping
from pathlib import Path

from contactstudy.plot.gif import DPI as GIF_DPI
from contactstudy.plot.packed import packed
from contactstudy.plot.panels import Panels
from contactstudy.plot.style import PNG_DPI
from contactstudy.resources import resource

LARGEST = 4.9e6
"""Bytes of the page."""
LARGEST_ANIMATION = 1.5e6
"""Bytes of an animation that stands in the page in its picture's place."""
_SCRIPTS = ("bokeh.min.js", "bokeh-api.min.js")
_PLACE = re.compile(r'<div data-figure="([^"]*)"></div>')
_TOLD = (
    "Figures can be zoomed, and tell the values under the pointer; a name above a figure hides its "
    "curves."
)
_THINNED = (
    " Of a curve with more than {} points, the extremes of each stretch are shown; result.nc has "
    "all of them."
)
_CSS_INCH = 128.0
"""Pixels of a page for an inch of a picture, whose letters are as small as on paper."""


def screen_page(text: str, figures: Mapping[str, Panels], out_dir: Path) -> str:
    """Put the figures into the page that the template made of the report.

    Parameters
    ----------
    text : str
        With ``<div data-figure="FILE">`` where a figure belongs, FILE as in the report's data.
    figures : mapping
        File -> what it shows; figures that are not there are pictures.
    out_dir : Path
        Where the files are; of ``x.pdf`` the picture is ``x.png``.
    """
    files = _PLACE.findall(text)
    drawn = {file: figures[file] for file in files if file in figures}
    moving = sum((out_dir / file).with_suffix(".gif").is_file() for file in files)
    most = LARGEST_ANIMATION / max(moving, 1)
    text = _PLACE.sub(lambda m: m[0] if m[1] in drawn else _picture(out_dir / m[1], most), text)
    head, foot = f"<style>{_template('screen.css')}</style>", ""
    if drawn:
        scripts = [*map(_bokeh, _SCRIPTS), _template("screen.js")]
        room = LARGEST - sum(len(part.encode()) for part in (text, head, *scripts))
        data, points = packed(drawn, room)
        told = _TOLD + (_THINNED.format(points) if points else "")
        text = text.replace("<h2", f'<p class="note">{told}</p><h2', 1)
        inert = data.replace("<", "\\u003c")  # no text ends the element
        foot = f'<script id="figures" type="application/json">{inert}</script>'
        foot += "".join(f"<script>{script}</script>" for script in scripts)
    return text.replace("</head>", f"{head}</head>", 1).replace("</body>", f"{foot}</body>")


def _picture(file: Path, largest: float) -> str:
    """An image of 256 colours, which a drawing does with, or its animation if that is no larger."""
    from PIL import Image

    animation = file.with_suffix(".gif")
    if animation.is_file() and animation.stat().st_size <= largest:
        with Image.open(animation) as picture:
            width = round(picture.width * _CSS_INCH / GIF_DPI)
        return _image("gif", animation.read_bytes(), width)
    stream = io.BytesIO()
    with Image.open(file.with_suffix(".png")) as picture:
        picture.convert("RGB").quantize(256).save(stream, "PNG", optimize=True)
        width = round(picture.width * _CSS_INCH / PNG_DPI)
    return _image("png", stream.getvalue(), width)


def _image(kind: str, content: bytes, width: int) -> str:
    data = base64.b64encode(content).decode("ascii")
    return f'<img class="picture" width="{width}" src="data:image/{kind};base64,{data}" alt="">'


def _bokeh(name: str) -> str:
    """A script of Bokeh's, whose Python code, slow to load, is not needed."""
    found = importlib.util.find_spec("bokeh")
    assert found is not None and found.origin is not None
    text = (Path(found.origin).parent / "server" / "static" / "js" / name).read_text("utf-8")
    return text.replace("</script", "<\\/script")


def _template(name: str) -> str:
    return resource("report", name).read_text("utf-8")
