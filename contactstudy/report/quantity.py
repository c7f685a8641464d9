"""Numbers as they stand in the report: SI prefixes, significant digits, typographic signs."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from contactstudy.plot.text import exact, number, pretty_unit

# Unit -> whether its leading symbol takes a prefix, and which.
_LARGE = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
_PREFIXED = ("N", "Pa")
_PLAIN = ("Pa/m",)
"""Units that stand as they are given: of penalties the power of ten is what is read."""


def quantity(value: Any, unit: str = "") -> tuple[str, str]:
    """Value and unit as texts, with an SI prefix where that makes the number readable.

    E.g. ("65", "MN/m") from an SI value (number, text, None or a list of these) and its SI unit.
    """
    if isinstance(value, bool):
        return ("yes" if value else "no"), ""
    if value is None or value in ("", [], ()):
        return "none", ""
    if isinstance(value, str):
        return value, ""
    if isinstance(value, list | tuple):
        return _listed(value, unit)
    factor, shown = _prefixed(abs(float(value)), unit)
    return _plain(float(value) / factor), shown


def _listed(values: Sequence[Any], unit: str) -> tuple[str, str]:
    """Numbers in the one unit that suits the largest; of anything else its texts."""
    if any(isinstance(v, bool) or not isinstance(v, int | float) for v in values):
        return ", ".join(quantity(v)[0] for v in values), pretty_unit(unit)
    factor, shown = _prefixed(max(abs(float(v)) for v in values), unit)
    return ", ".join(_plain(float(v) / factor) for v in values), shown


def _prefixed(size: float, unit: str) -> tuple[float, str]:
    """What an SI value of about `size` is divided by to be read, and the unit then."""
    if unit == "m/s":  # as studies give speeds
        return 1.0 / 3.6, "km/h"
    if unit.startswith(_PREFIXED) and unit not in _PLAIN:
        for step, symbol in _LARGE:
            if size >= step * 0.9999999:
                return step, symbol + pretty_unit(unit)
    elif unit == "s" and 0 < size < 1e-3:
        return 1e-6, "µ" + pretty_unit(unit)
    elif unit in ("s", "m", "rad") and 0 < size < 0.1:
        return 1e-3, "m" + pretty_unit(unit)
    return 1.0, pretty_unit(unit)


def _plain(value: float) -> str:
    """Up to six significant digits without trailing zeros; large whole numbers are grouped."""
    if float(value).is_integer() and 1e4 <= abs(value) < 1e7:
        return grouped(int(value))
    return exact(value)


def grouped(value: int) -> str:
    """Whole number with thin spaces between groups of three digits."""
    return f"{value:,}".replace(",", "\u2009")


def percent(fraction: float | None, digits: int = 2) -> str:
    """Return a fraction in per cent to `digits` significant digits; a dash where undefined."""
    return rounded(None if fraction is None else 100.0 * fraction, digits)


def fixed(value: float | None, decimals: int) -> str:
    """`value` with so many decimals and a typographic minus; a dash where undefined."""
    if value is None or not np.isfinite(value):
        return "–"
    text = f"{value:.{decimals}f}"
    return text.removeprefix("-") if float(text) == 0 else text.replace("-", "\N{MINUS SIGN}")


def rounded(value: float | None, digits: int = 3) -> str:
    """`value` to significant digits for a table; a dash where undefined."""
    if value is None or not np.isfinite(value):
        return "–"
    return number(value, digits)
