"""Complaints in plain words: key, value given, what is allowed."""

import difflib
from collections.abc import Iterable, Sequence
from typing import Any

_SHOWN = 300  # characters of a value


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
    try:
        shown = f'"{value}"' if isinstance(value, str) else f"{value}"
    except ValueError:  # Python shows no integers of thousands of digits
        shown = "a number of thousands of digits"
    return f"{path} = {shown if len(shown) <= _SHOWN else shown[:_SHOWN] + '...'}: {allowed}"


def any_of(names: Iterable[str], last: str = " or ") -> str:
    """Names as in ``"a", "b" or "c"``."""
    quoted = [f'"{name}"' for name in names]
    return last.join([", ".join(quoted[:-1]), quoted[-1]] if len(quoted) > 1 else quoted)
