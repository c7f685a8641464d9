"""Texts that users wrote: what they may hold, and how they are shown and stored as they are."""

from __future__ import annotations

import json
import unicodedata
from typing import Any

_DIRECTIONS = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"


def problem_of_text(text: str, lines: bool = False) -> str:
    """What is wrong with a text that shall be read by people, "" if nothing is.

    Control characters steer terminals; halves of surrogate pairs stand for bytes that are no UTF-8;
    embeddings and overrides of direction show a text in another order than it is read.
    Line feeds and tabs are allowed with `lines`.
    """
    allowed = "\n\t" if lines else ""
    wrong = [c for c in text if unicodedata.category(c) in ("Cc", "Cs") and c not in allowed]
    wrong += [c for c in text if c in _DIRECTIONS]
    wrong += [] if lines else [c for c in text if c in "\u2028\u2029"]
    if not wrong:
        return ""
    what = "text" if lines else "one line of text"
    return f"must be {what} without control characters (has U+{ord(wrong[0]):04X})"


def visible(text: str) -> str:
    r"""`text` for a terminal: control characters as one writes them, \x1b; lines stay lines."""
    return "".join(
        c if c in "\n\t" or unicodedata.category(c) not in ("Cc", "Cs") else repr(c)[1:-1]
        for c in text
    )


def json_text(value: Any, **options: Any) -> str:
    """Plain data as JSON in valid UTF-8, also with file names that are none."""
    text = json.dumps(value, ensure_ascii=False, **options)
    return text.encode("utf-8", "backslashreplace").decode()
