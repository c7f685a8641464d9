"""A study whose inputs have been read, with the hashes by which finished work is found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from contactstudy.provenance import provenance, versions
from contactstudy.store import Kept, Store, store_key
from contactstudy.study.kind import Inputs, Kind, Study, Work, find_kind
from contactstudy.study.results import StudyResults

RUNS = "runs"
"""Folder of the output in which finished pieces of work are kept."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A piece of work of one variant of a study; the study as it is, is the variant ""."""

    variant: str
    study: Study
    work: Work
    #: Hash of everything that goes into it, code included.
    key: str

    @property
    def label(self) -> str:
        """Distinct among all pieces of a study."""
        return run_label(self.variant, self.work.name)

    @property
    def entry(self) -> str:
        """Its name in the store."""
        return self.label.replace("/", "-")


@dataclass(frozen=True)
class Plan:
    """A study whose inputs have been read, and where its results go."""

    study: Study
    kind: Kind
    inputs: Inputs
    out_dir: Path
    pieces: tuple[Piece, ...]
    companions: tuple[Plan, ...] = ()

    @property
    def all(self) -> tuple[Plan, ...]:
        """This plan, then its companions'."""
        return (self, *(p for c in self.companions for p in c.all))

    @property
    def store(self) -> Store:
        """Where finished pieces of work are kept."""
        return Store(self.out_dir / RUNS, self.kind.form)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user should know, each once."""
        return tuple(dict.fromkeys(w for p in self.all for w in p.inputs.warnings))

    def kept(self, piece: Piece) -> Kept:
        """A finished piece of work."""
        return self.store.load(piece.entry, piece.key)

    def key(self) -> str:
        """Hash of everything that goes into the results, drawing and printing included."""
        texts = [self.study.name, self.study.title, self.study.description]
        own = [texts, self.inputs.config, dict(self.inputs.files), dict(versions())]
        return store_key([own, [companion.key() for companion in self.companions]], None)


def run_label(variant: str, run: str) -> str:
    """Name of a run of a variant among all results of a study."""
    return f"{variant}/{run}" if variant else run


def variants(study: Study) -> Iterator[tuple[str, Study]]:
    """Variants of a study, each a study of its kind: one as yet, the study as it is."""
    yield "", study


def plan_study(study: Study, out_dir: Path, companions: tuple[Study, ...] = ()) -> Plan:
    """Read a study's inputs and its companions'.

    Raises
    ------
    InputError
        When an input cannot be used.
    """
    kind = find_kind(study.kind)
    inputs = kind.read_inputs(study)
    pieces = []
    for variant, one in variants(study):
        read = inputs if one is study else kind.read_inputs(one)
        for work in kind.work(one, read):
            key = store_key(
                [work.name, work.inputs, dict(read.files)], kind.computing.partition(":")[0]
            )
            pieces.append(Piece(variant, one, work, key))
    others = tuple(plan_study(c, out_dir / c.name) for c in companions)
    return Plan(study, kind, inputs, out_dir, tuple(pieces), others)


def collect(plan: Plan, found: Mapping[Piece, Kept]) -> StudyResults:
    """Finished pieces of work, their comparison and everything else that the report needs."""
    study, kind, inputs = plan.study, plan.kind, plan.inputs
    runs, costs = dict[str, Any](), dict[str, Mapping[str, Any]]()
    for variant, one in variants(study):
        own = [p for p in plan.pieces if p.variant == variant]
        made = kind.collect(one, {p.work.name: found[p].value for p in own})
        runs |= {run_label(variant, name): data for name, data in made.items()}
        costs |= {p.label: found[p].about for p in own}
    return StudyResults(
        kind=kind.name,
        name=study.name,
        title=study.title,
        description=study.description,
        config=inputs.config,
        units=study.units(),
        runs=runs,
        reference=study.reference,
        metrics=kind.metrics(study, runs, costs),
        groups=inputs.groups(),
        provenance=provenance(inputs.seed, plan.key(), inputs.mesh(), dict(inputs.files)),
        companions=tuple(collect(companion, found) for companion in plan.companions),
    )
