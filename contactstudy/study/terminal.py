"""Progress bars and the summary that a command prints."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

from rich.box import SIMPLE
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
from rich.table import Table

from contactstudy.study.results import StudyResults


class TerminalReporter:
    """A `Reporter` with one bar a run and the time left; only notes when not on a terminal."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._tasks: dict[str, TaskID] = {}
        self._bars = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
            console=console,
            disable=not console.is_terminal,
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
        self._console.print(text, markup=False, highlight=False, soft_wrap=True)

    def begin(self, name: str, total: int) -> None:
        """Add a bar that waits for its first step."""
        self._tasks[name] = self._bars.add_task(name, total=None, start=False)

    def progress(self, name: str, done: int, total: int) -> None:
        """Move a bar; its clock starts with the first step, so that the time left is right."""
        task = self._tasks[name]
        if not self._bars.tasks[self._bars.task_ids.index(task)].started:
            self._bars.start_task(task)
        self._bars.update(task, completed=done, total=total)

    def end(self, name: str, ok: bool) -> None:
        """Fill a bar, or mark it as failed."""
        task = self._tasks[name]
        if ok:
            self._bars.update(task, completed=1, total=1)
        else:
            self._bars.update(task, description=f"{name} (failed)")
        self._bars.stop_task(task)

    @contextlib.contextmanager
    def stage(self, text: str) -> Iterator[None]:
        """Show a stage without steps while it lasts."""
        task = self._bars.add_task(text, total=None)
        try:
            yield
        finally:
            self._bars.update(task, completed=1, total=1)


_CAPTION = "error: relative L2 of the contact force, of the total and of its dynamic part"


def print_summary(results: StudyResults, out_dir: Path, console: Console) -> None:
    """Print what each run cost, how far it is from the reference, and where everything is."""
    runs = results.metrics.get("runs", {})
    if runs:
        table = Table(title=results.title, box=SIMPLE, caption=_CAPTION, collapse_padding=True)
        table.add_column("run", no_wrap=True)
        for heading in ("dofs", "steps", "set-up s", "steps s", "MB", "error", "dynamic"):
            table.add_column(heading, justify="right", no_wrap=True)
        for name, run in runs.items():
            force = results.metrics["comparisons"].get(name, {}).get("contact_force", {})
            table.add_row(
                name,
                str(run["dofs"]),
                str(run["steps"]),
                f"{run['seconds']['setup']:.1f}",
                f"{run['seconds']['stepping']:.1f}",
                "" if run["peak_memory_mb"] is None else f"{run['peak_memory_mb']:.0f}",
                _percent(force.get("relative_l2"), name == results.reference),
                _percent(force.get("relative_l2_dynamic"), name == results.reference),
            )
        console.print(table)
    console.print(f"results, figures and report: {out_dir}", markup=False, soft_wrap=True)


def _percent(value: float | None, reference: bool) -> str:
    if reference:
        return "ref."
    return "" if value is None else f"{100 * value:.2f} %"
