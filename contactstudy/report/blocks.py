"""Pieces of the report as plain data, which the template sets."""

import re
from typing import Any

from contactstudy.study.results import FIGURES

Block = dict[str, Any]


def text(content: str) -> Block:
    """Return a paragraph of plain text, any characters."""
    return {"kind": "text", "parts": [{"text": content}]}


def cited(content: str) -> Block:
    """Return a paragraph in which {key} cites an entry of references.yml."""
    pieces = re.split(r"\{([a-z0-9]+)\}", content)
    parts = [{"cite": p} if i % 2 else {"text": p} for i, p in enumerate(pieces)]
    return {"kind": "text", "parts": parts}


def table(
    columns: list[str], rows: list[list[str]], caption: str, left: int = 1, note: str = ""
) -> Block:
    """Return a table whose first `left` columns are text and whose others are numbers."""
    made: Block = {
        "kind": "table",
        "columns": [
            {"title": c, "align": "left" if i < left else "right"} for i, c in enumerate(columns)
        ],
        "rows": rows,
        "caption": caption,
    }
    return made | ({"note": note} if note else {})


def figure(name: str, caption: str) -> Block:
    """Return the figure of a drawing."""
    return {"kind": "figure", "file": f"{FIGURES}/{name}.pdf", "caption": caption}


def bullets(items: list[str]) -> Block:
    """Return a list."""
    return {"kind": "list", "items": items}


def paragraphs(description: str) -> list[Block]:
    """Return the paragraphs of a study's description, their lines joined."""
    joined = [" ".join(p.split()) for p in re.split(r"\n\s*\n", description)]
    return [text(paragraph) for paragraph in joined if paragraph]
