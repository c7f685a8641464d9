"""From a template and data to a PDF or a page, by Typst without network and its own fonts."""

import json
from pathlib import Path
from typing import Any

import typst

from contactstudy.exceptions import ContactStudyError
from contactstudy.plot.fonts import font_folder, foreign, lacking
from contactstudy.resources import resource

_SHARED = ("blocks.typ", "style.typ")


def typeset(
    template: tuple[str, ...], data: dict[str, Any], out_dir: Path, screen: bool = False
) -> bytes:
    """Set a document; equal data and figures give equal bytes.

    The template's files, the main one first, insert `data`; nothing but the figures that these
    name by their paths in `out_dir` is read from there. For a `screen` it is HTML, formulas in
    MathML, with places for the figures.
    """
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    data = data | {"fonts": ["DejaVu Sans"] if foreign(text) else []}
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    files: Any = {name: resource("report", name).read_bytes() for name in (*template, *_SHARED)}
    files["main.typ"] = files.pop(template[0])
    files["data.json"] = text.encode("utf-8", "replace")
    try:
        made: bytes = typst.compile(
            files,
            root=out_dir,
            format="html" if screen else "pdf",
            sys_inputs={"target": "screen" if screen else "paper"},
            font_paths=[font_folder()] if foreign(text) else [],
            ignore_system_fonts=not lacking(text),
            timestamp=0,
        )
    except RuntimeError as error:
        raise ContactStudyError(
            f"{out_dir}: the report cannot be typeset; the results are written. Is a figure gone, "
            "or damaged? The same command draws and sets them again"
        ) from error
    return made
