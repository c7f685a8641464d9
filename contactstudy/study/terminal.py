"""What commands print: progress bars, the resolved values of a study, and where results are."""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    SpinnerColumn,
    TaskID,
    TaskProgressColumn,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Column, Table
from rich.text import Text

from contactstudy.exceptions import gathered
from contactstudy.reporter import Reporter
from contactstudy.study.axes.swept import Swept
from contactstudy.study.axes.terminal import check_swept, expected_seconds, summary
from contactstudy.study.kind import find_kind
from contactstudy.study.loading import base_of, load_companions
from contactstudy.study.overrides import flat
from contactstudy.study.plan import Plan, of_texts, plan_study
from contactstudy.study.results import StudyResults
from contactstudy.study.study import Study
from contactstudy.texts import visible
from contactstudy.validation import raise_if

_LONG = 12  # values of a list


def console(stderr: bool = False, quiet: bool = False) -> Console:
    """What commands print on: texts are shown as they are, and nothing in them is markup."""
    made = Console(stderr=stderr, quiet=quiet, markup=False, emoji=False)
    if not stderr:  # a table that is folded by the terminal is whole, one squeezed into it is not
        made.width = max(made.width, 80)
    return made


class TerminalReporter:
    """A `Reporter` with one bar a run and the time left; only notes when not on a terminal.

    With `lines` it prints a line instead as each run and stage begins and ends.
    """

    def __init__(self, console: Console, lines: bool = False) -> None:
        self._console, self._lines = console, lines
        self._began: dict[str, float] = {}
        self._tasks: dict[str, TaskID] = {}
        self._bars = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TaskProgressColumn(),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
            console=console,
            disable=lines or not console.is_terminal,
        )

    def __enter__(self) -> TerminalReporter:
        self._bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._bars.stop()

    def note(self, text: str) -> None:
        """Print a line above the bars."""
        self._console.print(visible(text), highlight=False, soft_wrap=True)

    def begin(self, name: str, total: int) -> None:
        """Add a bar that waits for its first step."""
        self._line(f"{name}: begins")
        self._began[name] = time.monotonic()
        self._tasks[name] = self._bars.add_task(name, total=None, start=False)

    def progress(self, name: str, done: int, total: int) -> None:
        """Move a bar; its clock starts with the first step, so that the time left is right."""
        task = self._tasks[name]
        if not self._bars.tasks[self._bars.task_ids.index(task)].started:
            self._bars.start_task(task)
        self._bars.update(task, completed=done, total=total)

    def end(self, name: str, ok: bool) -> None:
        """Fill a bar, or mark it as failed."""
        took = time.monotonic() - self._began.pop(name, time.monotonic())
        self._line(f"{name}: {'done' if ok else 'failed'} after {took:.1f} s")
        task = self._tasks[name]
        if ok:
            self._bars.update(task, completed=1, total=1)
        else:
            self._bars.update(task, description=f"{name} (failed)")
        self._bars.stop_task(task)

    @contextlib.contextmanager
    def stage(self, text: str) -> Iterator[None]:
        """Show a stage without steps while it lasts."""
        self._line(text)
        task = self._bars.add_task(text, total=None)
        try:
            yield
        finally:
            self._bars.update(task, completed=1, total=1)

    def _line(self, text: str) -> None:
        if self._lines:
            self.note(text)


def print_results(results: StudyResults, out_dir: Path, console: Console) -> None:
    """Print what the kind of study shows of its results, or its axes, and where everything is."""
    shown = summary if results.swept else find_kind(results.kind).summary
    for item in shown(results):
        console.print(item)
    for doubt in doubts(results):
        console.print(visible(f"warning: {doubt}"), soft_wrap=True)
    console.print(visible(f"results, figures and report: {out_dir}"), soft_wrap=True)


def doubts(results: StudyResults) -> list[str]:
    """What is to be warned of in a study's results, and in its companions'."""
    own = [*find_kind(results.kind).doubts(results)]
    for companion in results.companions:
        own += [f"{companion.name}: {text}" for text in doubts(companion)]
    return own


def results_json(results: StudyResults, out_dir: Path) -> str:
    """The same as JSON: where it is, metrics, warnings, and what failed."""
    about = {name: getattr(results, name) for name in ("name", "title", "kind", "reference")}
    told = {"metrics": results.metrics, "warnings": doubts(results), "failures": results.failures}
    return _json(about | {"out": str(out_dir)} | told)


@dataclass(frozen=True)
class Checked:
    """A study that can be run: what is worth knowing of it, and texts and tables of its needs."""

    study: Study
    warnings: tuple[str, ...]
    needs: tuple[str | Table, ...]
    plan: Plan | None
    """Of a study with axes; that of another takes time, and is asked for as JSON only."""

    def print(self, console: Console) -> None:
        """Print resolved values and needs."""
        study = self.study
        console.print(Text(study.title, "bold"), f"({study.name})")
        if study.description:
            console.print(" ".join(study.description.split()))
        for warning in self.warnings:
            console.print(visible(f"warning: {warning}"), soft_wrap=True)
        units = study.units()
        values = Table(*(Column(name, overflow="fold") for name in ("key", "value", "SI unit")))
        for key, value in flat(study.config()).items():
            values.add_row(key, _text(value), units.get(key, ""))
        console.print(values)
        for item in self.needs:
            console.print(item, soft_wrap=isinstance(item, str))

    @property
    def json(self) -> str:
        """The same as JSON; each table as a list of its rows."""
        study = self.study
        about = {name: getattr(study, name) for name in ("name", "title", "description", "kind")}
        values = {"config": study.config(), "units": study.units()}
        seconds = expected_seconds(self.plan or plan_study(study, Path()))
        needs = [item if isinstance(item, str) else _rows(item) for item in self.needs]
        told = {"warnings": self.warnings, "expected_seconds": seconds, "needs": needs}
        return _json(about | values | told)


def check_study(study: Study, reporter: Reporter, quick: bool = False) -> Checked:
    """Refuse a study that cannot be run; what it will need. Runs nothing.

    Raises
    ------
    InputError
        When input files or companions' study files cannot be used.
    """
    problems, studies, inputs = list[str](), [base_of(study)], []
    with gathered(problems):
        companions = load_companions(study, quick)
        studies += map(base_of, companions)
        for companion in companions:
            with gathered(problems):
                studies += map(base_of, load_companions(companion, quick, last=True))
    for one in studies:
        with gathered(problems):
            inputs.append(find_kind(one.kind).read_inputs(one))
    raise_if(dict.fromkeys(problems))
    needs, plan = [*find_kind(study.kind).check(studies[0], studies[1:], reporter)], None
    if isinstance(study, Swept):
        plan = plan_study(study, Path())
        needs = ["the study as its file has it:", *needs, *check_swept(study, plan)]
    return Checked(study, (*inputs[0].warnings, *of_texts(study)), tuple(needs), plan)


def _json(told: Mapping[str, Any]) -> str:
    return json.dumps(told, indent=2, ensure_ascii=False, default=list)


def _rows(table: Table) -> list[dict[str, str]]:
    heads = [str(column.header) for column in table.columns]
    cells = zip(*(map(str, column.cells) for column in table.columns), strict=True)
    return [dict(zip(heads, row, strict=True)) for row in cells]


def _text(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.10g}"
    if isinstance(value, list) and len(value) > _LONG:
        return f"{_text(value[0])}, {_text(value[1])} ... {_text(value[-1])} ({len(value)} values)"
    if isinstance(value, list):
        return ", ".join(_text(item) for item in value)
    return visible(str(value))
