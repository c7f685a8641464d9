"""Collect every impossible argument of one call before raising."""

import math
from collections.abc import Iterable

from contactstudy.exceptions import InputError


def positive(name: str, value: float, unit: str = "") -> list[str]:
    """Return the complaint (or nothing) about a value that must be finite and above zero."""
    if math.isfinite(value) and value > 0.0:
        return []
    return [f"{name} = {value:g}{_unit(unit)}: must be a finite number above 0"]


def not_negative(name: str, value: float, unit: str = "") -> list[str]:
    """Return the complaint (or nothing) about a value that must be finite and at least zero."""
    if math.isfinite(value) and value >= 0.0:
        return []
    return [f"{name} = {value:g}{_unit(unit)}: must be a finite number of at least 0"]


def one_of(name: str, value: object, allowed: Iterable[object]) -> list[str]:
    """Return the complaint (or nothing) about a value that must be one of a few."""
    choices = tuple(allowed)
    if value in choices:
        return []
    return [f"{name} = {value!r}: must be one of {', '.join(map(repr, choices))}"]


def raise_if(problems: Iterable[str]) -> None:
    """Raise one error that lists all problems, if there are any.

    Raises
    ------
    InputError
        With every problem given.
    """
    found = tuple(problems)
    if found:
        raise InputError(found)


def _unit(unit: str) -> str:
    return f" {unit}" if unit else ""
