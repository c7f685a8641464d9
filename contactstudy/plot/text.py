"""Names and numbers as they stand in captions, tables and on axes: plain typographic text."""

import re

import numpy as np


def label(name: str) -> str:
    """Name of a run or key as it is printed; symbols like k_r stay."""
    return re.sub(r"\bk r\b", "k_r", name.replace("_", " ")) if len(name) != 3 else name


def counted(number: int, word: str) -> str:
    """A number of things: "1 run", "3 runs"."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def capital(text: str) -> str:
    """`text` with its first letter as a capital, unless it is a symbol like k_r."""
    return text if text[1:2] == "_" else text[:1].upper() + text[1:]


def listing(parts: list[str]) -> str:
    """One sentence's enumeration: "a", "a and b", "a, b and c"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def number(value: float, digits: int = 3) -> str:
    """`value` to `digits` significant digits in plain text with a typographic minus.

    Powers of ten are written out only where the number would have more than six digits before
    the point or more than three zeros behind it.
    """
    if not np.isfinite(value):
        return "not finite"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power = int(exponent)
    if value == 0.0:
        return "0"
    if -4 <= power < 6:
        text = f"{float(f'{value:.{digits - 1}e}'):.{max(digits - 1 - power, 0)}f}"
    else:
        text = f"{mantissa}·10{_superscript(power)}"
    return text.replace("-", "\N{MINUS SIGN}", 1)


def resolved(value: float, step: float) -> str:
    """`value` with three significant digits, or as many up to six as tell differences of `step`."""
    digits = 3
    if np.isfinite(value * step) and value != 0.0 and step > 0.0:
        apart = np.floor(np.log10(abs(value))) - np.floor(np.log10(step))
        digits = int(np.clip(apart + 2, 3, 6))
    return number(value, digits)


def between(low: float, high: float, digits: int = 3) -> str:
    """The range of a quantity: "lies between 17.7 and 119", or "stays at 46.6" of a constant."""
    ends = number(low, digits), number(high, digits)
    return f"stays at {ends[0]}" if ends[0] == ends[1] else f"lies between {ends[0]} and {ends[1]}"


def exact(value: float, digits: int = 6) -> str:
    """Return a given (not a computed) value in plain text, without trailing zeros."""
    text = number(value, digits)
    if "·" in text:
        mantissa, power = text.split("·")
        return f"{_trimmed(mantissa)}·{power}"
    return _trimmed(text)


def tick(value: float) -> str:
    """A value beside a logarithmic axis: "20", and powers of ten beyond 0.001 and 10,000."""
    if 1e-3 <= abs(value) < 1e4:
        return exact(value)
    mantissa, exponent = f"{value:.5e}".split("e")
    power, short = f"10{_superscript(int(exponent))}", _trimmed(mantissa)
    return power if short == "1" else f"{short}·{power}"


def pretty_unit(unit: str) -> str:
    """Unit with raised dots and exponents."""
    raised = re.sub(r"\^(\d+)", lambda match: _superscript(int(match[1])), unit)
    return raised.replace("*", "·")


def _trimmed(text: str) -> str:
    return text.rstrip("0").rstrip(".") if "." in text else text


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _superscript(exponent: int) -> str:
    return str(exponent).translate(_SUPERSCRIPTS)
