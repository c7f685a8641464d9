"""From a template and data to a PDF, by Typst without network and with its own fonts."""

import json
import shutil
from pathlib import Path
from typing import Any

import typst

from contactstudy.resources import resource

_SHARED = ("blocks.typ", "style.typ")


def typeset(root: Path, template: tuple[str, ...], data: dict[str, Any]) -> bytes:
    """Set a document; equal data and figures give equal bytes.

    The template's files, the main one first, are put into the folder `root`, in which the figures
    are already; they insert `data`.
    """
    for name in (*template, *_SHARED):
        shutil.copyfile(resource("report", name), root / name)
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    (root / "data.json").write_text(text, "utf-8")
    pdf: bytes = typst.compile(
        str(root / template[0]), root=str(root), ignore_system_fonts=True, timestamp=0
    )
    return pdf
