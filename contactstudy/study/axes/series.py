"""Series of values of one key: lists, ranges by steps, numbers of values or factors."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from contactstudy.units import Limits, UnitError, to_si
from contactstudy.validation import Parameter, as_list, is_multiple, listed, multiple
from contactstudy.validation.metadata import NUMBER

MOST = 20_000
"""Largest number of variants of a study."""

_RANGE = re.compile(
    rf"(?P<first>.+?)\s+to\s+(?P<last>.+?)(?:\s+by\s+(?P<by>.+)|\s+x\s+(?P<x>{NUMBER}))?"
)
_SPACED = re.compile(r"(.+?)\s*,\s*(linear|logarithmic)")
_FORM = (
    'must be a list, or text like "1 to 50", "0 m to 7 m by 0.5 m", '
    '"20 mm to 3 m by 14, logarithmic" or "2 to 32 x 2"'
)


@dataclass(frozen=True)
class Series:
    """Values of one key as in a study file, and where they stand on an axis."""

    values: tuple[Any, ...]
    #: Numbers in the key's SI unit (of "0.5 x tangent" 0.5), or texts.
    coordinates: tuple[Any, ...]
    #: SI unit of the coordinates, "" for none.
    unit: str = ""
    #: What the coordinates are factors of: "tangent".
    factor_of: str = ""

    def __len__(self) -> int:
        return len(self.values)

    @property
    def numeric(self) -> bool:
        """Whether the values stand on an axis of numbers."""
        return not isinstance(self.coordinates[0], str)


def series(given: Any, parameter: Parameter, distinct: bool = True) -> Series:
    """The values that a study file gives for a key, all different if `distinct`.

    Raises
    ------
    UnitError
        With what is allowed; before anything long is made.
    """
    if isinstance(given, str) and not parameter.only_text:
        made = _range(given, parameter)
        given = [given] if made is None else made
    values = listed(given)
    if not values:
        raise UnitError("must hold at least one value")
    if len(values) > MOST:
        raise UnitError(f"holds {len(values)} values; allowed are {MOST}")
    placed = _placed(tuple(map(_plain, values)), parameter)
    if distinct and len(set(placed.coordinates)) < len(placed):
        raise UnitError("must not hold a value twice")
    return placed


def _plain(value: Any) -> Any:
    """A value as a study file may hold it; that of numpy as Python's."""
    value = value.item() if getattr(value, "ndim", None) == 0 else value
    if isinstance(value, str | int | float):
        return value
    if (items := as_list(value)) is not None:
        return [_plain(item) for item in items]
    raise UnitError(f"holds a {type(value).__name__}; values are numbers, texts or lists of them")


def _placed(values: tuple[Any, ...], parameter: Parameter) -> Series:
    numbers, factors = [_number(v, parameter.limits) for v in values], set[str]()
    for k, value in enumerate(values):
        if numbers[k] is None and is_multiple(value):
            numbers[k], of = multiple(value)
            factors.add(of)
    texts = tuple(_text(v) for v in values)
    coordinates: tuple[Any, ...] = tuple(n for n in numbers if n is not None)
    mixed = bool(factors) and not (all(map(is_multiple, values)) and len(factors) == 1)
    if parameter.only_text or parameter.listed or len(coordinates) < len(values) or mixed:
        coordinates, factors = texts, set()
    unit = "" if factors or isinstance(coordinates[0], str) else parameter.unit
    return Series(values, coordinates, unit, "".join(factors))


def _number(value: Any, limits: Limits) -> float | int | None:
    if isinstance(value, bool):
        return None
    try:
        number = to_si(value, limits.unit)
    except UnitError:
        return None
    return int(number) if limits.whole and number == int(number) else number


def _text(value: Any) -> str:
    if isinstance(value, list | tuple):
        return f"[{', '.join(_text(v) for v in value)}]"
    return str(value).lower() if isinstance(value, bool) else str(value)


def _range(text: str, parameter: Parameter) -> list[Any] | None:
    """Values of "a to b ..."; None for a text that is no range."""
    match = _RANGE.fullmatch(text.strip())
    if match is None or text.strip() in parameter.choices:
        return None
    bare = [_is_bare(match[end]) for end in ("first", "last")]
    if parameter.unit and bare[0] != bare[1]:
        raise UnitError(
            f"has a unit at one end only; allowed: at both, or at neither (then in "
            f"{parameter.unit})"
        )
    ends, of = _ends(match["first"], match["last"], parameter)
    if match["x"]:
        numbers = _by_factor(*ends, _ratio(match["x"]))
    elif match["by"]:
        numbers = _by(*ends, match["by"], "" if of else parameter.unit)
    elif parameter.limits.whole:
        numbers = by_step(*ends, 1.0)
    else:
        raise UnitError(f"needs a step or a number of values; {_FORM}")
    rounded = [float(f"{n:.12g}") for n in numbers]
    if of:
        return [f"{n:.12g} x {of}" for n in rounded]
    if parameter.limits.whole:
        return list(dict.fromkeys(round(n) for n in rounded))
    return list(rounded)


def _is_bare(text: str) -> bool:
    """Whether a text is a number without unit."""
    return re.fullmatch(NUMBER, text.strip()) is not None


def _ends(first: str, last: str, parameter: Parameter) -> tuple[tuple[float, float], str]:
    """Ends of a range, and what they are factors of."""
    if is_multiple(first) and is_multiple(last):
        (a, of), (b, other) = multiple(first), multiple(last)
        if of == other:
            return (a, b), of
    return (_end(first, parameter), _end(last, parameter)), ""


def _end(text: str, parameter: Parameter) -> float:
    try:
        return to_si(text, parameter.unit)
    except UnitError as error:
        raise UnitError(f"“{text}” {error}; a series {_FORM}") from error


def _ratio(text: str) -> float:
    return to_si(text.strip(), "")


def _by(first: float, last: float, text: str, unit: str) -> list[float]:
    """Steps, which have the key's unit, or a number of values."""
    spaced = _SPACED.fullmatch(text.strip())
    bare = _number(spaced[1] if spaced else text, Limits(whole=True))
    if spaced or (unit and bare is not None):
        if not isinstance(bare, int) or not 2 <= bare <= MOST:
            raise UnitError(f"must have 2 to {MOST} values")
        if spaced is None or spaced[2] == "linear":
            return [first + (last - first) * k / (bare - 1) for k in range(bare)]
        if first * last <= 0.0:
            raise UnitError("must not reach zero where it is logarithmic")
        return [first * (last / first) ** (k / (bare - 1)) for k in range(bare)]
    return by_step(first, last, to_si(text, unit))


def by_step(first: float, last: float, step: float, most: int = MOST) -> list[float]:
    """Values from the first to the last, at most so many; ``UnitError`` for no whole steps."""
    count = (last - first) / step if step else math.inf
    if not 0 <= count <= most - 1 or abs(count - round(count)) > 1e-6:
        allowed = f"must lead from the first to the last value in whole steps, {most} at most"
        raise UnitError(allowed)
    return [first + k * step for k in range(round(count) + 1)]


def _by_factor(first: float, last: float, factor: float) -> list[float]:
    good = first * last > 0.0 and factor > 0.0 and factor != 1.0
    count = math.log(last / first) / math.log(factor) if good else math.inf
    if not 0 <= count <= MOST - 1 or abs(count - round(count)) > 1e-6:
        raise UnitError("must lead from the first to the last value in whole factors")
    return [first * factor**k for k in range(round(count) + 1)]
