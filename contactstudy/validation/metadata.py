"""What stands beside the type of a parameter in ``Annotated``; a plain text is its meaning."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Unit:
    """SI unit in pint's notation."""

    symbol: str


@dataclass(frozen=True)
class Above:
    """Exclusive lower limit."""

    limit: float


@dataclass(frozen=True)
class AtLeast:
    """Inclusive lower limit."""

    limit: float


@dataclass(frozen=True)
class AtMost:
    """Inclusive upper limit."""

    limit: float


@dataclass(frozen=True)
class Usual:
    """Range that practice keeps to by far: beyond it a wrong unit is likely, which is warned of."""

    low: float
    high: float
    hint: str = "is the unit right?"


@dataclass(frozen=True)
class Key:
    """Key in a study file, where it is not the field's name; "" if it has none."""

    name: str


@dataclass(frozen=True)
class File:
    """The value is a file's name, relative to the study file that it stands in.

    With `or_name` it may also be the name of something shipped, which has no suffix. In a list each
    text names a file; `within` finds the name in a text with more, as its group "file".
    """

    or_name: bool = False
    within: re.Pattern[str] | None = None

    def relative_to(self, text: str, base: Path) -> str:
        """The text with its file's name, relative to a folder, relative to here."""
        match = self.within.fullmatch(text) if self.within else None
        name = match["file"] if match else text
        if not (Path(name).suffix if self.or_name else name):
            return text
        start, end = match.span("file") if match else (0, len(text))
        return text[:start] + str(base / name) + text[end:]


@dataclass(frozen=True)
class Lines:
    """The text may have several lines."""


@dataclass(frozen=True)
class Same:
    """The parameter `name` of another class: its unit, limits and meaning."""

    owner: type
    name: str


class When:
    """The parameter means something only with these values of a field of the same class.

    Where `decider` is a property, `key` is the key of a study file that decides.
    """

    def __init__(self, decider: str, *values: str, key: str = "") -> None:
        self.decider, self.values, self.key = decider, values, key or decider


@dataclass(frozen=True)
class Written:
    """Other ways to write a value, e.g. the ratio "1:40" of an angle.

    Attributes
    ----------
    convert : callable
        From what was given and the unit to what is read further; it gives back what it does not
        know, and raises `contactstudy.units.UnitError` where it knows better.
    form : str
        The end of the complaint, e.g. "a ratio like 1:40".
    """

    convert: Callable[[Any, str], Any]
    form: str = ""


@dataclass(frozen=True)
class Multiples:
    """Of these choices of a parameter a multiple may be given as well: "2 x tangent"."""

    names: tuple[str, ...]

    @property
    def form(self) -> str:
        """The end of a complaint."""
        return f'a multiple like "2 x {self.names[0]}"'

    def read(self, value: Any) -> str | None:
        """The multiple in its one form; None if the value is none."""
        factor, name = multiple(value) if isinstance(value, str) else (1.0, "")
        if not is_multiple(value) or name not in self.names or not 0.0 < factor < math.inf:
            return None
        return f"{factor:.15g} x {name}"


NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
"""A number without unit in a text."""
_MULTIPLE = re.compile(rf"\s*({NUMBER})\s*x\s*([A-Za-z_]\w*)\s*")


def is_multiple(value: Any) -> bool:
    """Whether a value is a text like "2 x tangent"."""
    return isinstance(value, str) and _MULTIPLE.fullmatch(value) is not None


def multiple(value: str) -> tuple[float, str]:
    """Factor and name of a choice that may be a multiple: "2 x tangent", "tangent"."""
    match = _MULTIPLE.fullmatch(value)
    return (float(match[1]), match[2]) if match else (1.0, value)


class By:
    """Defaults that depend on another field of the same class."""

    def __init__(self, decider: str, **defaults: Any) -> None:
        self.decider, self.defaults = decider, defaults


def by() -> Any:
    """Default of a field whose `By` says what it is, or whose owner fills it in."""
    return None


@dataclass(frozen=True)
class Variants:
    """A key of a study file whose value chooses a class; its parameters stand in the same table.

    The first of the classes, None for nothing, is the default.
    """

    key: str
    classes: Mapping[str, Any]
    meaning: str = ""

    @property
    def default(self) -> str:
        """The value that holds where the key is left out."""
        return next(iter(self.classes))

    def name(self, value: object) -> str:
        """Value of the key for an object of one of the classes."""
        wanted = None if value is None else type(value)
        return next(name for name, made in self.classes.items() if made is wanted)
