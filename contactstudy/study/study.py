"""What every study has, of whatever kind."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

from contactstudy.validation import Key, Lines, Naming, Parameters, parameters
from contactstudy.validation.base import check, flat

TEXTS = ("title", "description", "companions")
"""Keys that stand above all tables of a study file."""
NORMS = "norms"
"""Group of the results with how far each run is from the reference; so no run has this name."""


@dataclass(frozen=True)
class Study(Parameters):
    """A study that has been read and found possible; frozen and picklable.

    A kind adds what its tables describe.
    """

    kind: ClassVar[str]

    name: Annotated[str, Key(""), "stem of the file"]
    title: Annotated[str, "one line; the name if left out"] = ""
    description: Annotated[str, Lines(), "paragraphs"] = ""
    companions: Annotated[tuple[str, ...], "studies whose results stand in the same report"] = ()
    reference: Annotated[str | None, Key(""), "run that the others are compared with"] = None

    def __post_init__(self) -> None:
        """Refuse what is no text; the title is the name if it is left out."""
        super().__post_init__()
        object.__setattr__(self, "title", self.title or self.name)

    @abstractmethod
    def config(self) -> dict[str, Any]:
        """All values as nested plain data in SI, without keys that do not apply."""

    @abstractmethod
    def units(self) -> dict[str, str]:
        """Dotted key of `config` -> SI unit, for keys that have one."""

    def _naming(self) -> Naming:
        keys = {p.name: p.key or p.name for p in parameters(type(self))}
        return lambda name: keys[name]


def read_texts(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Texts above the tables of a study file of any kind, and what is wrong with them."""
    values, wrong = check(Study, {key: data[key] for key in TEXTS if key in data}, str)
    return values, flat(wrong)
