"""The base of frozen dataclasses whose fields are parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import MISSING, dataclass, replace
from typing import Any, ClassVar, Self, cast

from contactstudy.validation.checks import raise_if
from contactstudy.validation.definition import Parameter, parameter, parameters
from contactstudy.validation.messages import any_of, complaint
from contactstudy.validation.metadata import Variants
from contactstudy.validation.unread import UnreadError, asked

Naming = Callable[[str], str]
"""From a field to how the caller knows it: "track.length" in a file, "Track.length" in Python."""


@dataclass(frozen=True)
class Place:
    """The table of a study file that an object was read from, and its fields that stand in it."""

    path: str
    given: frozenset[str]


class Parameters:
    """Reads and checks its annotated fields when it is made; all problems in one error.

    Raises
    ------
    InputError
        From a derived class: with every value that is not allowed; with every rule over several
        values that is broken, once each alone is allowed.
    """

    settled: ClassVar[tuple[str, ...]] = ()
    """Fields that `settle` sets."""

    def __post_init__(self) -> None:
        key = self._naming()
        values, wrong = check(type(self), vars(self), key)
        for name, value in values.items():
            object.__setattr__(self, name, value)
        problems = flat(wrong) or self.broken(key)
        if not wrong:
            self.settle()
        raise_if(problems)

    def broken(self, key: Naming) -> list[str]:
        """Complaints of all rules over several values, as far as these could be read."""
        return asked(self._inapplicable, key) + asked(self.problems, key)

    def settle(self) -> None:
        """Set what follows from the values; also where rules are broken, for those of others."""

    def problems(self, key: Naming) -> Iterable[str]:
        """Complaints about values that are fine alone; `key` gives a field's name to the caller."""
        return ()

    def given(self, name: str) -> bool:
        """Whether the caller chose a field's value: in Python, whether it is not the default."""
        place: Place | None = vars(self).get("_place")
        if place is not None:
            return name in place.given
        default = parameter(type(self), name).default
        return default is not MISSING and getattr(self, name) != default

    def changed(self, **values: Any) -> Self:
        """Copy with other values; what the caller chose here counts as chosen there."""
        made = replace(cast(Any, self), **values)
        if "_place" in vars(self):
            object.__setattr__(made, "_place", vars(self)["_place"])
        return cast(Self, made)

    def unusual(self, key: Naming | None = None) -> list[str]:
        """Warnings of values that apply and are far from what is usual, those of variants too."""
        key, found = key or self._naming(), list[str]()
        for p in parameters(type(self)):
            value = getattr(self, p.name)
            if p.variants is not None and isinstance(value, Parameters):
                found += value.unusual()
            if p.usual is None or not p.applies(self):
                continue
            low, high = p.usual.low, p.usual.high
            several = isinstance(value, tuple)
            odd = [
                one
                for one in (value if several else (value,))
                if isinstance(one, float | int) and one and not low <= abs(one) <= high
            ]
            if odd:
                allowed = f"usual is {low:.4g} to {high:.4g} {p.unit}".rstrip()
                shown = odd if several else value
                found.append(complaint(key(p.name), shown, f"{allowed}; {p.usual.hint}"))
        return found

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, as plain data."""
        own = parameters(type(self))
        found = {
            p.key: list(value) if isinstance(value := getattr(self, p.name), tuple) else value
            for p in own
            if p.key and p.variants is None and p.applies(self)
        }
        for p in own:
            if p.variants is not None:
                found |= of_variant(p.variants, getattr(self, p.name))
        return found

    def _naming(self) -> Naming:
        place: Place | None = vars(self).get("_place")
        if place is None:
            return lambda name: f"{type(self).__name__}.{name}"
        return naming(type(self), place.path)

    def _inapplicable(self, key: Naming) -> Iterator[str]:
        for p in parameters(type(self)):
            with suppress(UnreadError):
                if not p.applies(self) and self.given(p.name):
                    when = next(w for w in p.when if getattr(self, w.decider) not in w.values)
                    here = getattr(self, when.decider)
                    yield only_with(key(p.name), when.key, when.values, here)


def only_with(key: str, decider: str, values: Iterable[str], here: str) -> str:
    """Complaint about a key that means nothing beside the value of a deciding one."""
    return f'{key}: applies only with {decider} = {any_of(values)} (here "{here}")'


def naming(owner: type, path: str) -> Naming:
    """How the fields of a class are called in the table `path` of a study file."""
    keys = {p.name: p.key for p in parameters(owner)}
    return lambda name: f"{path}.{keys.get(name) or name}"


def check(
    owner: type, given: Mapping[str, Any], key: Naming
) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """Values of the fields of a class as it holds them, and what is wrong with fields by name.

    Fields that are not `given` are not looked at.
    """
    values: dict[str, Any] = {}
    wrong: dict[str, list[str]] = {}
    for p in parameters(owner):
        if p.name not in given:
            continue
        value = given[p.name]
        if value is None and p.by is not None:
            decided = given.get(p.by.decider)
            value = p.by.defaults.get(decided) if isinstance(decided, str) else None
        if value is None and p.default is None:
            continue  # its owner fills it in
        if p.variants is not None:
            problems = _wrong_variant(p, value, key)
        else:
            values[p.name], problems = read_one(p, value, key(p.name))
        if problems:
            wrong[p.name] = problems
    return values, wrong


def flat(wrong: Mapping[str, Iterable[str]]) -> list[str]:
    """Complaints of all fields."""
    return [problem for problems in wrong.values() for problem in problems]


def read_one(p: Parameter, value: Any, name: str) -> tuple[Any, list[str]]:
    """Value of one parameter as its class holds it, and complaints; `name` is the caller's."""
    held, wrong = p.read(value)
    return held, [
        f"{name}{place}: {text}" if item is None else complaint(f"{name}{place}", item, text)
        for place, item, text in wrong
    ]


def _wrong_variant(p: Parameter, value: Any, key: Naming) -> list[str]:
    assert p.variants is not None
    classes = list(p.variants.classes.values())
    if None in classes if value is None else isinstance(value, tuple(c for c in classes if c)):
        return []
    return [wrong_type(key(p.name), value, classes)]


def wrong_type(key: str, value: object, classes: Iterable[type | None]) -> str:
    """Complaint about an object that is of none of the classes; None stands for None itself."""
    allowed = " or ".join("None" if made is None else made.__name__ for made in classes)
    return f"{key}: is a {type(value).__name__}; must be of type {allowed}"


def of_variant(variants: Variants, made: Parameters | None) -> dict[str, Any]:
    """Deciding key and the values of the object that it chose."""
    return {variants.key: variants.name(made)} | (made.resolved() if made is not None else {})
