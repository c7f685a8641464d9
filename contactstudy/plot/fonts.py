"""Fonts for what users write in scripts that the report's own fonts lack."""

from __future__ import annotations

import functools
from pathlib import Path

# Scripts up to Cyrillic; punctuation, arrows, mathematics: all that the program writes itself.
_OWN = (range(0x0530), range(0x2000, 0x2C00), range(0x1D400, 0x1D800))
_SHOWN = 8  # characters


def foreign(text: str) -> str:
    """Characters, each once, of scripts that the report's and the figures' fonts may lack."""
    found = dict.fromkeys(c for c in text if not any(ord(c) in one for one in _OWN))
    return "".join(found)


def font_folder() -> Path:
    """Fonts that matplotlib brings along, DejaVu Sans among them."""
    import matplotlib

    return Path(matplotlib.get_data_path()) / "fonts" / "ttf"


def lacking(text: str) -> str:
    """Characters, each once, that no font has which comes with the program."""
    left = foreign(text)
    known = _characters(str(font_folder() / "DejaVuSans.ttf")) if left else frozenset()
    return "".join(c for c in left if ord(c) not in known)


def families(text: str) -> list[str]:
    """Families in which figures draw a text beside their own, in the order of preference."""
    if not foreign(text):
        return []
    from matplotlib.font_manager import fontManager

    found, left = ["DejaVu Sans"], {ord(c) for c in lacking(text)}
    for font in sorted(fontManager.ttflist, key=lambda font: (font.name, font.fname)):
        if font.name.startswith("Last Resort") or not left:  # it has a box for each
            continue
        if font.style == "normal" and left & _characters(font.fname):
            found.append(font.name)
            left -= _characters(font.fname)
    return found


def remark(name: str, text: str) -> str:
    """What the user of a study should know of the fonts for its texts; "" for nothing."""
    left = lacking(text)
    if not left:
        return ""
    told = ", ".join(left[:_SHOWN]) + (" ..." if len(left) > _SHOWN else "")
    return (
        f"{name}: the fonts of report and figures lack {told}; these are drawn with a font of this "
        "machine, or as boxes where none has them"
    )


@functools.cache
def _characters(file: str) -> frozenset[int]:
    from matplotlib.ft2font import FT2Font

    try:
        return frozenset(FT2Font(file).get_charmap())
    except (OSError, RuntimeError):  # a font that is damaged or gone
        return frozenset()
