"""A study with axes: the study as its file has it, and its variants."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.store import digest
from contactstudy.study.axes.design import Design
from contactstudy.study.kind import Kind
from contactstudy.study.study import Study

_SHOWN = 3  # variants that a complaint names


@dataclass(frozen=True)
class Source:
    """What a study was read from, so that it can be read again with other values."""

    kind: Kind
    path: Path
    #: Content of the file without the tables of axes.
    data: Mapping[str, Any]
    overrides: Mapping[str, Any] = field(default_factory=dict)
    main: Any = None

    def load(self, values: Mapping[str, Any]) -> Any:
        """The study with further values; ``InputError`` if that is impossible."""
        data = copy.deepcopy(dict(self.data))
        return self.kind.load(self.path, data, dict(self.overrides) | dict(values), self.main)


@dataclass(frozen=True)
class Variant:
    """One variant of a study."""

    #: Short, and the same whatever other variants there are; "" for a study without axes.
    name: str
    study: Any
    #: For the user: "seed = 2, speed = 300 km/h".
    title: str = ""


@dataclass(frozen=True, kw_only=True)
class Swept(Study):
    """A study and its axes; answers as the study does, and has variants."""

    study: Any
    designs: tuple[Design, ...]
    source: Source
    keep: tuple[str, ...] = ()

    @classmethod
    def of(
        cls, study: Study, designs: Sequence[Design], source: Source, keep: tuple[str, ...] = ()
    ) -> Swept:
        """A study with axes."""
        own = {f.name: getattr(study, f.name) for f in fields(Study)}
        return cls(**own, study=study, designs=tuple(designs), source=source, keep=keep)

    @property
    def kind(self) -> str:  # type: ignore[override]
        """That of the study."""
        return str(self.study.kind)

    def config(self) -> dict[str, Any]:
        """Values of the study, and the coordinates of each axis."""
        return self.study.config() | self.axes_config()

    def axes_config(self) -> dict[str, Any]:
        """Coordinates of the axes of each design, how they are combined, and what is kept."""
        designs = {
            d.name: {"combine": d.combine}
            | ({"expected": d.expected} if d.expected else {})
            | {key: list(s.coordinates) for key, s in d.series.items()}
            for d in self.designs
        }
        return {"axes": designs | ({"keep": list(self.keep)} if self.keep else {})}

    def units(self) -> dict[str, str]:
        """Units of the study's values and of the axes."""
        own = {
            f"axes.{d.name}.{key}": s.unit
            for d in self.designs
            for key, s in d.series.items()
            if s.unit
        }
        return self.study.units() | own

    @cached_property
    def variants(self) -> dict[str, Variant]:
        """All variants by name, each once.

        Raises
        ------
        InputError
            Listing every impossible one, with its values.
        """
        found, problems = dict[str, Variant](), dict[str, list[str]]()
        for _, name, values in self.named_points():
            if name in found:
                continue
            try:
                found[name] = Variant(name, self.source.load(values), told(values))
            except InputError as error:
                for problem in error.problems:
                    problems.setdefault(problem, []).append(told(values))
        raise_grouped(problems)
        return found

    def named_points(self) -> Iterator[tuple[tuple[Design, tuple[int, ...]], str, dict[str, Any]]]:
        """Design and index, name, and values of each point of all designs."""
        for design in self.designs:
            for index, values in design.points():
                yield (design, index), digest(values, 8), values


def finest_points(study: Swept) -> Iterator[tuple[str, str]]:
    """Names of each variant of a refinement and of its finest one."""
    names = {(d.name, index): name for (d, index), name, _ in study.named_points()}
    for design in study.designs:
        if design.refined:
            last = len(design.series[design.refined]) - 1
            for index, _ in design.points():
                yield names[design.name, index], names[design.name, (*index[:-1], last)]


def told(values: Mapping[str, Any]) -> str:
    """Values of a variant for the user; keys without their table where that is clear."""
    short = [key.rpartition(".")[2] for key in values]
    names = [s if short.count(s) == 1 else key for s, key in zip(short, values, strict=True)]
    return ", ".join(f"{n} = {_text(v)}" for n, v in zip(names, values.values(), strict=True))


def raise_grouped(problems: Mapping[str, list[str]]) -> None:
    """Raise an `InputError` with each problem once, and the variants that have it."""
    if problems:
        raise InputError(
            f"{'; '.join(at[:_SHOWN])}"
            f"{f' and {len(at) - _SHOWN} more variants' if len(at) > _SHOWN else ''}: {problem}"
            for problem, at in problems.items()
        )


def variants(study: Study | Swept) -> Mapping[str, Variant]:
    """Variants of a study by name; of one without axes the study itself, whose name is empty."""
    return study.variants if isinstance(study, Swept) else {"": Variant("", study)}


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
