"""Numbers as they stand in the report: SI prefixes, significant digits, typographic signs."""

from typing import Any

import numpy as np

from contactstudy.plot.text import exact, number, pretty_unit

# Unit -> whether its leading symbol takes a prefix, and which.
_LARGE = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
_PREFIXED = ("N", "Pa")


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
        return ", ".join(quantity(v)[0] for v in value), pretty_unit(unit)
    factor, prefix = 1.0, ""
    size = abs(float(value))
    if unit.startswith(_PREFIXED):
        for step, symbol in _LARGE:
            if size >= step * 0.9999999:
                factor, prefix = step, symbol
                break
    elif unit == "s" and 0 < size < 1e-3:
        factor, prefix = 1e-6, "µ"
    elif unit in ("s", "m") and 0 < size < 0.1:
        factor, prefix = 1e-3, "m"
    return _plain(float(value) / factor), prefix + pretty_unit(unit)


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
