"""Validation errors in plain words: key, value given, what is allowed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from typing import Any

from pydantic import ValidationError

from contactstudy.study.section import Section

_KINDS = {
    "bool_type": "must be true or false",
    "string_type": "must be text",
    "tuple_type": "must be a list",
    "list_type": "must be a list",
    "missing": "is missing",
}


def did_you_mean(given: str, allowed: Iterable[str]) -> str:
    """`` (did you mean 'x'?)`` for close matches among `allowed`, else an empty text."""
    close = difflib.get_close_matches(given, list(allowed), n=3, cutoff=0.6)
    return f" (did you mean {' or '.join(repr(c) for c in close)}?)" if close else ""


def unknown(path: str, key: str, allowed: Sequence[str]) -> str:
    """Complaint about the key `key` in the table `path` ("" for the top level)."""
    full = f"{path}.{key}" if path else key
    hint = did_you_mean(key, allowed)
    return f"{full}: unknown key{hint}" + ("" if hint else f"; allowed: {', '.join(allowed)}")


def complaint(path: str, value: Any, allowed: str) -> str:
    """``path = value: allowed``, the form of every complaint about a value."""
    shown = f'"{value}"' if isinstance(value, str) else f"{value}"
    return f"{path} = {shown}: {allowed}"


def from_validation(error: ValidationError, model: type[Section], path: str) -> list[str]:
    """All problems of one table as sentences with the dotted key."""
    keys = [f.alias or name for name, f in model.model_fields.items()]
    problems = []
    for item in error.errors():
        key = ".".join(str(part) for part in item["loc"])
        full, given, kind = f"{path}.{key}", item["input"], item["type"]
        if kind == "extra_forbidden":
            problems.append(unknown(path, key, keys))
        elif kind == "literal_error":
            expected = item["ctx"]["expected"].replace("'", '"')
            hint = did_you_mean(given, _names(expected)) if isinstance(given, str) else ""
            problems.append(complaint(full, given, f"must be {expected}{hint}"))
        elif kind == "value_error":
            problems.append(complaint(full, given, str(item["ctx"]["error"])))
        elif kind in ("too_short", "too_long"):
            problems.append(complaint(full, given, "must be a list of two values"))
        elif kind == "missing":  # the second of a pair
            problems.append(f"{full}: is missing")
        else:
            problems.append(complaint(full, given, _KINDS.get(kind, item["msg"].lower())))
    return problems


def _names(expected: str) -> list[str]:
    return expected.split('"')[1::2]
