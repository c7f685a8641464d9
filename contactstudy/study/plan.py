"""A study whose inputs have been read, with the hashes by which finished work is found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.plot.fonts import remark
from contactstudy.provenance import provenance, versions
from contactstudy.store import Kept, Store, store_key
from contactstudy.study.axes.swept import Swept, raise_grouped, variants
from contactstudy.study.kind import Inputs, Kind, Work, find_kind
from contactstudy.study.results import RUNS, StudyResults
from contactstudy.study.study import Study
from contactstudy.texts import json_text

FAILED = "failed"
"""Entry of a piece of work that failed."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A piece of work; variants to which the same goes in share it."""

    study: Study
    work: Work
    #: Hash of everything that goes into it, code included.
    key: str
    #: The first variant that needs it, for the user; "" for a study without axes.
    title: str = ""

    @property
    def label(self) -> str:
        """For messages; distinct among all pieces of a study."""
        return f"{self.work.name} ({self.title})" if self.title else self.work.name


@dataclass(frozen=True, eq=False)
class Planned:
    """A variant of a study and its pieces of work."""

    name: str
    title: str
    study: Study
    #: By the name of the work.
    pieces: Mapping[str, Piece]
    #: Hash of all that goes into what is measured of it; "" for a study without axes.
    key: str = ""

    @property
    def keys(self) -> dict[str, str]:
        """Name of each piece of work -> its key."""
        return {name: piece.key for name, piece in self.pieces.items()}


@dataclass(frozen=True)
class Plan:
    """A study whose inputs have been read, and where its results go."""

    study: Study
    kind: Kind
    inputs: Inputs
    out_dir: Path
    variants: Mapping[str, Planned]
    #: Name of a variant that means nothing -> why; it is no failure.
    left_out: Mapping[str, str] = field(default_factory=dict)
    companions: tuple[Plan, ...] = ()

    @property
    def swept(self) -> bool:
        """Whether the study has axes."""
        return isinstance(self.study, Swept)

    @property
    def pieces(self) -> list[Piece]:
        """All pieces of work, each once."""
        return list(dict.fromkeys(p for v in self.variants.values() for p in v.pieces.values()))

    @property
    def all(self) -> tuple[Plan, ...]:
        """This plan, then its companions'."""
        return (self, *(p for c in self.companions for p in c.all))

    @property
    def store(self) -> Store:
        """Where finished pieces of work are kept."""
        return Store(self.out_dir / RUNS, self.kind.form)

    @property
    def measures(self) -> Store:
        """Where is kept what was measured of variants, and why pieces failed."""
        return Store(self.out_dir / RUNS)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user should know, each once."""
        told = (w for p in self.all for w in (*p.inputs.warnings, *of_texts(p.study)))
        return tuple(dict.fromkeys(told))

    def kept(self, piece: Piece) -> Kept:
        """A finished piece of work."""
        return self.store.load(piece.work.name, piece.key)

    def whole(self, piece: Piece) -> Kept:
        """Whether a piece of work is finished; its value is not read."""
        return self.store.whole(piece.work.name, piece.key)

    def key(self) -> str:
        """Hash of everything that goes into the results, drawing and printing included."""
        texts = [self.study.name, self.study.title, self.study.description]
        own = [texts, self.inputs.config, dict(self.inputs.files), dict(versions())]
        if self.swept:
            own.append(sorted(v.key for v in self.variants.values()))
        return store_key([own, [companion.key() for companion in self.companions]], None)


def plan_study(study: Study, out_dir: Path, companions: tuple[Plan, ...] = ()) -> Plan:
    """Read a study's inputs, and those of its variants; `companions` are planned already.

    Raises
    ------
    InputError
        When an input cannot be used.
    """
    kind = find_kind(study.kind)
    swept = isinstance(study, Swept)
    inputs = _read(kind, study)
    found, shared = dict[str, Planned](), dict[tuple[str, str], Piece]()
    left_out = dict[str, str]()
    problems = dict[str, list[str]]()
    for name, variant in variants(study).items():
        if swept and (reason := kind.left_out(variant.study)):
            left_out[name] = reason
            continue
        try:
            read = kind.read_inputs(variant.study) if swept else inputs
        except InputError as error:
            for problem in error.problems:
                problems.setdefault(problem, []).append(variant.title)
            continue
        pieces = {}
        for work in kind.work(variant.study, read):
            key = store_key([work.name, work.inputs, dict(read.files)], _module(kind.computing))
            made = Piece(variant.study, work, key, variant.title)
            pieces[work.name] = shared.setdefault((work.name, key), made)
        key = ""
        if swept:
            keys = {n: p.key for n, p in pieces.items()}
            key = store_key([read.config, keys], _module(kind.measuring))
        found[name] = Planned(name, variant.title, variant.study, pieces, key)
    raise_grouped(problems)
    if left_out and not found:
        raise InputError(dict.fromkeys(left_out.values()))
    return Plan(study, kind, inputs, out_dir, found, left_out, companions)


def _read(kind: Kind, study: Study | Swept) -> Inputs:
    """Inputs of a study; of one with axes those of the study as its file has it."""
    if not isinstance(study, Swept):
        return kind.read_inputs(study)
    read = kind.read_inputs(study.study)
    config = dict(read.config) | study.axes_config()
    return Inputs(config, read.files, read.warnings, seed=read.seed, mesh=read.mesh)


def _module(place: str) -> str:
    return place.partition(":")[0]


def of_texts(study: Study) -> tuple[str, ...]:
    """What the user of a study should know of its texts."""
    told = remark(study.name, json_text([study.title, study.description, study.config()]))
    return (told,) if told else ()


def refined_key(kind: Kind, variant: Planned, finest: Planned) -> str:
    """Hash of all that goes into what is measured of a variant against the finest one."""
    return store_key([variant.key, finest.key], _module(kind.refining))


def collect(plan: Plan, found: Mapping[Piece, Kept]) -> StudyResults:
    """Finished pieces of work of a study without axes, compared, with all that is reported."""
    from contactstudy.study.tree import norms

    (variant,) = plan.variants.values()
    values = {name: found[piece].value for name, piece in variant.pieces.items()}
    costs = {name: found[piece].about for name, piece in variant.pieces.items()}
    runs = plan.kind.collect(variant.study, values)
    metrics = plan.kind.metrics(plan.study, runs, costs)
    groups = {**plan.inputs.groups(), **norms(metrics["comparisons"], runs)}
    return made_results(plan, runs=runs, metrics=metrics, groups=groups)


def made_results(
    plan: Plan, runs: Mapping[str, Any], metrics: Mapping[str, Any], groups: Mapping[str, Any]
) -> StudyResults:
    """Results of a plan without those of its companions."""
    study, inputs = plan.study, plan.inputs
    return StudyResults(
        kind=plan.kind.name,
        name=study.name,
        title=study.title,
        description=study.description,
        config=inputs.config,
        units=study.units(),
        runs=runs,
        reference=study.reference,
        metrics=metrics,
        groups=groups,
        provenance=provenance(inputs.seed, plan.key(), inputs.mesh(), dict(inputs.files)),
    )
