"""Collect every impossible argument of one call before raising."""

import math
from collections.abc import Iterable

from contactstudy.exceptions import InputError


def positive(name: str, value: float, unit: str = "") -> list[str]:
    """Return the complaint (or nothing) about a value that must be finite and above zero."""
    if math.isfinite(value) and value > 0.0:
        return []
    return [f"{name} = {value:g} {unit}".rstrip() + ": must be a finite number above 0"]


def not_negative(name: str, value: float, unit: str = "") -> list[str]:
    """Return the complaint (or nothing) about a value that must be finite and at least zero."""
    if math.isfinite(value) and value >= 0.0:
        return []
    return [f"{name} = {value:g} {unit}".rstrip() + ": must be a finite number of at least 0"]


def raise_if(problems: Iterable[str]) -> None:
    """Raise one `InputError` that lists all problems, if there are any."""
    found = tuple(problems)
    if found:
        raise InputError(found)
