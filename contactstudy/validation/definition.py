"""One parameter of a class: type, default, unit, limits, meaning; reads what a caller gives."""

import dataclasses
import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from contactstudy.texts import problem_of_text
from contactstudy.units import Limits, UnitError
from contactstudy.validation import metadata as m
from contactstudy.validation.messages import any_of, did_you_mean

Problem = tuple[str, Any, str]
"""Place within the value ("" or ".0", ".1" of a list), what was given there, what is allowed."""


@dataclass(frozen=True)
class Parameter:
    """One parameter of a class.

    Attributes
    ----------
    name
        Field of the class.
    key
        Key in a study file, "" if it has none.
    type
        Type of the value, without metadata.
    limits
        Of a number, or of each number of a list; with the unit.
    variants
        The parameter is an object that a deciding key chooses.
    needed
        It has no default.
    lines
        A text of several lines.
    """

    name: str
    key: str
    type: Any
    default: Any
    limits: Limits
    meaning: str = ""
    when: tuple[m.When, ...] = ()
    by: m.By | None = None
    variants: m.Variants | None = None
    written: m.Written | None = None
    multiples: m.Multiples | None = None
    file: m.File | None = None
    needed: bool = False
    usual: m.Usual | None = None
    lines: bool = False

    @property
    def unit(self) -> str:
        """SI unit, "" for none."""
        return self.limits.unit

    @cached_property
    def _parts(self) -> tuple[Any, ...]:
        union = get_origin(self.type) in (Union, UnionType)
        return get_args(self.type) if union else (self.type,)

    @cached_property
    def choices(self) -> tuple[str, ...]:
        """Names that are allowed, of each item of a list too."""
        parts = [p for part in self._parts for p in (part, *get_args(part))]
        return tuple(name for p in parts if get_origin(p) is Literal for name in get_args(p))

    @cached_property
    def listed(self) -> tuple[Any, ...] | None:
        """Types in a tuple, (type, Ellipsis) for any number of them; None if it is no tuple."""
        return next((get_args(p) for p in self._parts if get_origin(p) is tuple), None)

    @cached_property
    def only_text(self) -> bool:
        """Whether nothing but text is allowed."""
        parts = [p for p in self._parts if p is not NoneType]
        return all(p is str or get_origin(p) is Literal for p in parts)

    def applies(self, owner: Any) -> bool:
        """Whether the parameter means anything with the owner's other values."""
        return all(getattr(owner, when.decider) in when.values for when in self.when)

    def read(self, value: Any) -> tuple[Any, list[Problem]]:
        """Value as the class holds it (SI, tuples), and what is wrong with it."""
        if value is None and NoneType in self._parts:
            return None, []
        list_of_choices = self.listed is not None and get_origin(self.listed[0]) is Literal
        if isinstance(value, str) and value in self.choices and not list_of_choices:
            return value, []
        if self.multiples and (multiple := self.multiples.read(value)):
            return multiple, []
        try:
            if self.written:
                value = self.written.convert(value, self.unit)
            if self.listed is None:
                return self._item(value, self._parts[0]), []
        except UnitError as error:
            return None, [("", value, str(error))]
        return self._items(value, self.listed)

    def _items(self, value: Any, kinds: tuple[Any, ...]) -> tuple[Any, list[Problem]]:
        given = as_list(value)
        if given is None:
            return None, [("", value, "must be a list")]
        if kinds[-1] is not Ellipsis and len(given) > len(kinds):
            return None, [("", given, f"must be a list of {len(kinds)} values")]
        found, problems = [], []
        for i, item in enumerate(given):
            try:
                found.append(self._item(item, kinds[0]))
            except UnitError as error:
                problems.append((f".{i}", item, str(error)))
        if kinds[-1] is not Ellipsis:
            missing = range(len(given), len(kinds))
            problems += [(f".{i}", None, "is missing") for i in missing]
        return tuple(found), problems

    def _item(self, value: Any, kind: Any) -> Any:
        if kind is bool:
            if not isinstance(value, bool):
                raise UnitError("must be true or false")
            return value
        if kind is str:
            if not isinstance(value, str | os.PathLike):
                raise UnitError("must be text")
            text = os.fspath(value)
            if self.file is None and (problem := problem_of_text(text, self.lines)):
                raise UnitError(problem)
            return text
        if kind in (int, float):
            try:
                return self.limits(value)
            except UnitError as error:
                others = [f'"{name}"' for name in self.choices]
                others += [
                    form.form for form in (self.written, self.multiples) if form and form.form
                ]
                if not others:
                    raise
                raise UnitError(f"{error}, or {' or '.join(others)}") from error
        if not (isinstance(value, str) and value in self.choices):
            hint = did_you_mean(value, self.choices) if isinstance(value, str) else ""
            raise UnitError(f"must be {any_of(self.choices)}{hint}")
        return value


def as_list(value: Any) -> list[Any] | None:
    """Items of a list, tuple, range or array of one dimension; None for anything else."""
    listed = isinstance(value, list | tuple | range) or getattr(value, "ndim", None) == 1
    return list(value) if listed and not isinstance(value, memoryview) else None


def listed(value: Any, unit: str = "") -> list[Any]:
    """Items of a list, as `as_list`, or of anything else that itself; as `Written` wants it."""
    items = as_list(value)
    return [value] if items is None else items


def _parameters(owner: type) -> tuple[Parameter, ...]:
    hints = get_type_hints(owner, include_extras=True)
    return tuple(
        _parameter(field, hints[field.name])
        for field in dataclasses.fields(owner)
        if get_origin(hints[field.name]) is Annotated
    )


parameters: Callable[[type], tuple[Parameter, ...]] = cache(_parameters)
"""Parameters of a dataclass: its fields that have metadata of ours."""


def parameter(owner: type, name: str) -> Parameter:
    """One parameter of a dataclass by its field's name."""
    return next(p for p in parameters(owner) if p.name == name)


def _parameter(field: "dataclasses.Field[Any]", hint: Any) -> Parameter:
    extras = hint.__metadata__
    found = {type(extra): extra for extra in extras}
    if m.Same in found:
        base = parameter(found[m.Same].owner, found[m.Same].name)
    else:
        limit = {kind: getattr(found.get(kind), "limit", None) for kind in _LIMITS}
        unit = found[m.Unit].symbol if m.Unit in found else ""
        whole = int in (hint.__origin__, *get_args(hint.__origin__))
        limits = Limits(unit, limit[m.Above], limit[m.AtLeast], limit[m.AtMost], whole)
        base = Parameter("", "", None, None, limits)
    return dataclasses.replace(
        base,
        name=field.name,
        key=found[m.Key].name if m.Key in found else field.name,
        type=hint.__origin__,
        default=field.default,
        meaning=found.get(str, base.meaning),
        when=tuple(extra for extra in extras if isinstance(extra, m.When)),
        by=found.get(m.By),
        variants=found.get(m.Variants),
        written=found.get(m.Written, base.written),
        multiples=found.get(m.Multiples, base.multiples),
        file=found.get(m.File, base.file),
        lines=m.Lines in found,
        needed=field.default is field.default_factory is dataclasses.MISSING,
        usual=found.get(m.Usual, base.usual),
    )


_LIMITS = (m.Above, m.AtLeast, m.AtMost)
