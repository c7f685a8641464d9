"""What a kind of study is, and the one table of them.

A kind says what one study computes: a *passage* lets wheels run over a track, a set of *positions*
presses a wheelset on its rails. It owns its tables, its check, its pieces of work, what it
collects, its norms, drawings, report parts and terminal table. Everything else (command line,
reading of files, store, resume, progress, netCDF, JSON, figures' writer, PDF) knows only `Kind`.

A study file is of the kind whose name is one of its tables, else a passage.
"""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from contactstudy.exceptions import InputError
from contactstudy.executor import Task
from contactstudy.reporter import Reporter
from contactstudy.store import DATASET, Form
from contactstudy.study.overrides import Overrides
from contactstudy.study.results import StudyResults
from contactstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

DEFAULT = "passage"
#: Name -> "module:object". Adding a kind is one folder in study/kinds and one line here.
KINDS = {
    "passage": "contactstudy.study.kinds.passage.kind:PASSAGE",
    "positions": "contactstudy.study.kinds.positions.kind:POSITIONS",
}

Block = dict[str, Any]
"""A paragraph, list, table or figure of the report, see `contactstudy.report.blocks`."""
Part = dict[str, Any]
"""``title`` and ``blocks`` of a section of the report."""
Cost = Mapping[str, Any]
"""``seconds`` {``setup``, ``stepping``} and ``peak_memory_mb`` of a piece of work."""


@dataclass(frozen=True)
class Inputs:
    """What a study reads before anything is computed."""

    #: The resolved study; of paths only the file's name, because paths are the machine's.
    config: Mapping[str, Any]
    #: Name of each input file -> SHA-256 of its content.
    files: Mapping[str, str] = field(default_factory=dict)
    #: For the user.
    warnings: tuple[str, ...] = ()
    #: What belongs to the study and not to one run, by name; called when results are written.
    groups: Callable[[], Mapping[str, xr.Dataset]] = dict
    #: Of what is random.
    seed: int | None = None
    #: Recipe of the mesh for the provenance, or None; called as `groups` is.
    mesh: Callable[[], dict[str, Any] | None] = lambda: None


@dataclass(frozen=True)
class Work:
    """A piece of a study's work, computed at one go and kept by itself."""

    #: Letters, digits and _; distinct within the study.
    name: str
    #: Plain data: all that goes into it besides input files, code and packages.
    inputs: Any
    #: What messages call it; "run NAME" if empty.
    title: str = ""
    #: Progress bar that it shares with others, in pieces; its own, in steps, if empty.
    bar: str = ""
    #: Whether it takes long: such ones start first, so that the short ones fill the gaps.
    long: bool = False
    #: Whether it takes less time than a process takes to start, and little memory.
    light: bool = False
    #: Pieces with the same text here, of any variants, may be computed together; alone if empty.
    batch: str = ""


@dataclass(frozen=True)
class Quantity:
    """Something measured, as figures and tables of a study with axes show it."""

    #: Variable of `contactstudy.study.axes.measured`.
    variable: str
    #: Of axes and tables, with the unit; ``{part}`` is the label that was chosen of "part".
    title: str
    #: Dimension -> label that is chosen of it, the first of several that is there.
    labels: Mapping[str, Sequence[str]] = field(default_factory=dict)
    #: From the variable's unit to the title's.
    factor: float = 1.0


@dataclass(frozen=True)
class Marks:
    """Values of a key that mean something, marked where the key is an axis of a figure."""

    name: str
    #: In the key's SI unit.
    at: Sequence[float]
    #: Of the caption, before the values that lie within the figure.
    caption: str


@dataclass(frozen=True)
class Report:
    """What a kind has to say of a study in the report, as plain data."""

    #: Paragraphs.
    abstract: Sequence[str]
    #: Results; the ``file`` of a figure's block is its drawing's name and ".pdf".
    parts: Sequence[Part]
    #: What follows from the results, on the first page.
    conclusion: Sequence[Block] = ()
    #: What is computed, after the study's description.
    subject: Sequence[Block] = ()
    #: Paragraph above the tables of parameters.
    sources: Block | None = None
    #: Its parts in another study's report; `parts` if None.
    as_companion: Sequence[Part] | None = None
    #: What the template of `model` speaks of.
    topics: Sequence[str] = ()
    #: Template files with what holds for every study of the kind, before the parameters and
    #: after the results; none if empty.
    model: str = ""
    limits: str = ""


class Kind(ABC):
    """What one study computes; a kind overrides the methods that have no default."""

    name: str
    #: One sentence.
    about: ClassVar[str] = ""
    #: "module:function" of what does a piece of work in a worker process:
    #: ``function(study, name, progress)``. The module's code and all that it imports is part of
    #: what is computed, so it imports nothing that draws or prints.
    computing: str
    #: The same for pieces of one batch, which share what is dear:
    #: ``function([(study, name), ...], progress)`` gives a value, or the error, of each in order.
    #: Values do not depend on how many there are. One after another without it.
    batching: ClassVar[str] = ""
    #: "module:function" of what is measured of a variant of a study with axes:
    #: ``function(study, pieces by name)`` gives what `contactstudy.study.axes.measured` describes.
    measuring: ClassVar[str] = "contactstudy.study.axes.measured:extremes"
    #: The same against the finest variant of a refinement: ``function(study, pieces by name,
    #: pieces of the finest by name)``; nothing without it.
    refining: ClassVar[str] = ""
    #: What is shown of what is measured, in figures and tables; all that is measured if empty.
    #: Of refinements it has order and limit.
    shown: ClassVar[Sequence[Quantity]] = ()
    #: Files and folders that it writes beside those of every study.
    files: ClassVar[Sequence[str]] = ()
    #: How what it returns is kept: a dataset, or plain data (small ones are quicker so) for None.
    form: ClassVar[Form | None] = DATASET
    #: What its studies are.
    study: ClassVar[type[Study]]
    #: Table of the study file -> its model: for reading, ``--set`` and the reference of keys.
    tables: ClassVar[Mapping[str, Any]]
    #: The same for tables in tables: "runs" for ``[runs.NAME]``.
    inner_tables: ClassVar[Mapping[str, Any]] = {}
    #: Title -> tables of further files that a study names, for the reference of keys.
    file_tables: ClassVar[Mapping[str, Mapping[str, Any]]] = {}
    #: Keys of an inner table that say what it is, and are shown where they are defaults too.
    telling: ClassVar[Sequence[str]] = ()
    #: Table -> title of its parameters in the report, which shows no others.
    titles: ClassVar[Mapping[str, str]] = {}

    @abstractmethod
    def load(self, path: Path, data: dict[str, Any], overrides: Overrides, main: Any = None) -> Any:
        """Check the content of a study file; `main` is the study that it accompanies, if any."""

    def read_inputs(self, study: Any) -> Inputs:
        """Read what the study names, and refuse what cannot be used."""
        return Inputs(study.config())

    def check(self, study: Any, companions: Sequence[Any], reporter: Reporter) -> Sequence[Any]:
        """What it will need, or why it cannot be run; texts and rich tables to print."""
        return ()

    @abstractmethod
    def work(self, study: Any, inputs: Inputs) -> Sequence[Work]:
        """The pieces of work."""

    def left_out(self, study: Any) -> str:
        """Why a point of a grid means nothing, which is left out then; "" for one that does."""
        return ""

    def seconds(self, study: Any, name: str) -> float:
        """Time that a piece of work will take, about; 0 where nobody knows."""
        return 0.0

    def admit(  # noqa: B027
        self, study: Any, names: Sequence[str], reporter: Reporter
    ) -> None:
        """Refuse pieces of work that are known to be impossible, before any is computed."""

    def before(self, study: Any, name: str) -> Sequence[Task]:
        """Tasks that a piece of work waits for; equal names are one task."""
        return ()

    def histories(self, study: Any) -> Sequence[str] | None:
        """Names of what its runs hold along one dimension; None where nobody knows before."""
        return None

    def collect(self, study: Any, found: Mapping[str, Any]) -> Mapping[str, xr.Dataset]:
        """The runs of the results, from the finished pieces of work by name."""
        return found

    def metrics(
        self, study: Any, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Cost]
    ) -> dict[str, Any]:
        """Content of ``metrics.json``: ``runs``, ``reference``, ``comparisons``."""
        return {"runs": dict(costs), "reference": study.reference, "comparisons": {}}

    def drawings(self, results: StudyResults) -> Sequence[Any]:
        """Each a `contactstudy.plot.drawing.Drawing`, in the order of the report."""
        return ()

    def marks(self, results: StudyResults, key: str) -> Sequence[Marks]:
        """What is marked along a varied key."""
        return ()

    def draws_grid(self, results: StudyResults) -> bool:
        """Whether its own drawings show what is varied over three keys, which axes then do not."""
        return False

    def write_files(self, results: StudyResults, out_dir: Path) -> Sequence[Path]:
        """Write further files; equal results give equal bytes."""
        return ()

    @abstractmethod
    def report(self, results: StudyResults, timings: bool = False) -> Report:
        """Texts and tables; with `timings` also what depends on the machine."""

    def summary(self, results: StudyResults) -> Sequence[Any]:
        """What a command prints in the end: texts and rich tables."""
        return ()

    def doubts(self, results: StudyResults) -> Sequence[str]:
        """What a command warns of in the end, because of which results may mean nothing."""
        return ()

    def export(self, study: Any, out: Path, **options: str | None) -> str:
        """Write a static press for CalculiX; what to tell the user."""
        raise InputError(
            f"study {study.name}: is a study of {self.name} (table [{self.name}]); only "
            "'contactstudy check', 'run' and 'reproduce' take it"
        )


class _Later:
    def __init__(self, place: str) -> None:
        self._place = place

    def __get__(self, kind: Kind | None, owner: type) -> Any:
        return self if kind is None else imported(self._place)


def later(place: str) -> Any:
    """A method of a kind as a function elsewhere, "module:function", imported when asked for."""
    return _Later(place)


def find_kind(name: str) -> Kind:
    """The kind of a name in `KINDS`, imported when it is asked for."""
    found = imported(KINDS[name])
    assert isinstance(found, Kind)
    return found


def imported(place: str) -> Any:
    """What stands at "module:name"."""
    module, _, name = place.partition(":")
    return getattr(importlib.import_module(module), name)


def kind_of_file(data: Mapping[str, Any]) -> Kind:
    """The kind of a study file, given by its content as TOML gives it."""
    return find_kind(next((name for name in KINDS if name in data), DEFAULT))
