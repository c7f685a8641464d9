"""The only place where "300 km/h" becomes 83.33: text with a unit to SI floats and back."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import lru_cache
from numbers import Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pint


class UnitError(ValueError):
    """A value that cannot be had in the wanted unit; the message says what is allowed."""


@lru_cache(maxsize=1)
def _registry() -> pint.UnitRegistry:
    import pint  # half a second that only a text with a unit is worth

    return pint.UnitRegistry(cache_folder=None)


# "65 MN/m", "-1.5e-3 kN·s/m", "5e-5": a number, then perhaps a unit. Nothing else is evaluated.
_TEXT = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(.*?)\s*")
# Names with perhaps one power of one digit each, multiplied or divided: nothing to compute.
_UNIT = re.compile(r"(?:[A-Za-zµμΩ°%]++(?:(?:\^|\*\*)-?[0-9](?![0-9.]))?+|1(?=/)|[*/·() ])*+")
_LONGEST = 200  # characters of a quantity


def to_si(value: Any, unit: str) -> float:
    """Value in the SI unit `unit`.

    A bare number, or text that is only a number, is in `unit` already, which is written in pint's
    notation, e.g. "N*s/m"; "" for a number without dimension.

    Raises
    ------
    UnitError
        When it is no number, not finite, or of another dimension.
    """
    example = f"a number in {unit} or text with a unit" if unit else "a number"
    if isinstance(value, bool) or not isinstance(value, Real | str):
        raise UnitError(f"must be {example}")
    if isinstance(value, str):
        number, text = _split(value, example)
        result = _short(number * _factor(text, unit)) if text else number
    else:
        try:
            result = float(value)
        except OverflowError:
            result = math.inf
    if not math.isfinite(result):
        raise UnitError(f"must be finite ({unit})" if unit else "must be finite")
    return result


def _split(value: str, example: str) -> tuple[float, str]:
    match = _TEXT.fullmatch(value) if len(value) <= _LONGEST else None
    if match is None or not _UNIT.fullmatch(match[2]):
        raise UnitError(f"must be {example}")
    return float(match[1]), match[2]


# The units that studies are written in: factor (numerator, denominator) and exponents of m, kg, s.
# They are known here because loading pint takes as long as a small run does.
_Known = tuple[int, int, tuple[int, int, int]]
_PREFIXES = {"": (1, 1), "k": (10**3, 1), "M": (10**6, 1), "G": (10**9, 1), "c": (1, 100)}
_PREFIXES |= {"m": (1, 10**3), "u": (1, 10**6), "µ": (1, 10**6), "n": (1, 10**9)}
_PLAIN = {"m": (1, 0, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Pa": (-1, 1, -2), "rad": (0, 0, 0)}
_KNOWN: dict[str, _Known] = {p + u: (*f, _PLAIN[u]) for p, f in _PREFIXES.items() for u in _PLAIN}
_KNOWN |= {"1": (1, 1, (0, 0, 0)), "kg": (1, 1, (0, 1, 0)), "g": (1, 10**3, (0, 1, 0))}
_KNOWN |= {"t": (10**3, 1, (0, 1, 0)), "h": (3600, 1, (0, 0, 1)), "min": (60, 1, (0, 0, 1))}
_KNOWN |= {"Hz": (1, 1, (0, 0, -1)), "kHz": (10**3, 1, (0, 0, -1))}
_POWER = re.compile(r"([A-Za-zµ]+|1)(?:\^(-?\d))?")


def _known(text: str) -> _Known | None:
    """Product of known units; None when there is anything else in the text."""
    text = text.strip().replace("**", "^").replace("·", "*").replace("μ", "µ")
    parts = re.split("([*/])", re.sub(r"\s*([*/^])\s*|\s+", lambda m: m[1] or "*", text))
    top, bottom, dimension = 1, 1, (0, 0, 0)
    for before, part in zip(["*", *parts[1::2]], parts[::2], strict=True):
        match = _POWER.fullmatch(part)
        if match is None or match[1] not in _KNOWN:
            return None
        numerator, denominator, own = _KNOWN[match[1]]
        power = int(match[2] or 1) * (1 if before == "*" else -1)
        if power < 0:
            numerator, denominator = denominator, numerator
        top, bottom = top * numerator ** abs(power), bottom * denominator ** abs(power)
        a, b, c = (d + power * o for d, o in zip(dimension, own, strict=True))
        dimension = a, b, c
    return top, bottom, dimension


def _factor(text: str, unit: str) -> float:
    known, target = _known(text), _known(unit or "1")
    if known is not None and target is not None and known[2] == target[2]:
        return known[0] * target[1] / (known[1] * target[0])
    # A blank between units is a product to people, "kN s/m"; pint reads it the same way.
    try:
        given = _registry().parse_units(text.replace("·", "*").replace("μ", "µ"))
    except Exception as error:  # pint raises many types for text that is no unit
        raise UnitError(f"has the unknown unit '{text}'; allowed: {_allowed(unit)}") from error
    wanted = _registry().parse_units(unit)
    if given.dimensionality != wanted.dimensionality:
        raise UnitError(f"has the wrong unit '{text}'; allowed: {_allowed(unit)}")
    return float(_registry().Quantity(1.0, given).to(wanted).magnitude)


def _short(value: float) -> float:
    """Undo the last-bit noise of a conversion: 50 µs is 5e-05 s, not 4.9999999999999996e-05 s."""
    rounded = float(f"{value:.15g}")
    return rounded if len(repr(rounded)) < len(repr(value)) - 2 else value


def _allowed(unit: str) -> str:
    return f"{unit} and its multiples" if unit else "a number without unit"


@dataclass(frozen=True)
class Limits:
    """Reads a quantity and holds it to its limits in its SI unit; `above` is exclusive."""

    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    whole: bool = False

    def __call__(self, value: Any) -> float | int:
        """SI value of `value`; `UnitError` (a ValueError) with what is allowed otherwise."""
        try:
            number = to_si(value, self.unit)
        except UnitError as error:
            if self.whole:
                raise UnitError(f"must be {self.description()}") from error
            raise
        low = self.above is not None and number <= self.above
        low = low or (self.at_least is not None and number < self.at_least)
        high = self.at_most is not None and number > self.at_most
        if low or high or (self.whole and number != int(number)):
            raise UnitError(f"must be {self.description()}")
        return int(number) if self.whole else number

    def description(self) -> str:
        """What is allowed, e.g. ``above 0 N/m``."""
        words = {"above": self.above, "at least": self.at_least, "at most": self.at_most}
        limits = [f"{word} {limit:g}" for word, limit in words.items() if limit is not None]
        kind = "a whole number" if self.whole else ("" if limits else "a number")
        unit = f"in {self.unit}" if self.unit and not limits else self.unit
        return " ".join(part for part in (kind, " and ".join(limits), unit) if part)
