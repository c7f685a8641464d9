"""Who tells the user how far things are."""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Mapping
from typing import Protocol


class Reporter(Protocol):
    """Who tells the user how far things are; all methods are called in the main process."""

    def note(self, text: str) -> None:
        """Something worth knowing that is no error."""

    def begin(self, name: str, total: int) -> None:
        """A run that is going to be computed, with its number of steps."""

    def progress(self, name: str, done: int, total: int) -> None:
        """Steps done of a run."""

    def end(self, name: str, ok: bool) -> None:
        """A run has ended."""

    def stage(self, text: str) -> contextlib.AbstractContextManager[None]:
        """A stage of the work without steps, as a context."""


class Quiet:
    """A `Reporter` that says nothing."""

    def note(self, text: str) -> None:
        """Nothing."""

    def begin(self, name: str, total: int) -> None:
        """Nothing."""

    def progress(self, name: str, done: int, total: int) -> None:
        """Nothing."""

    def end(self, name: str, ok: bool) -> None:
        """Nothing."""

    def stage(self, text: str) -> contextlib.AbstractContextManager[None]:
        """Nothing."""
        return contextlib.nullcontext()


class Bars:
    """A `Reporter` whose tasks share bars: each moves by one as a task of it ends.

    `bars` names the bar of a task; one that is not there has a bar of its own, in its steps.
    """

    def __init__(self, reporter: Reporter, bars: Mapping[str, str]) -> None:
        self._reporter, self._bars = reporter, bars
        self._all, self._ended, self._failed = Counter(bars.values()), Counter[str](), set[str]()
        self.note, self.stage = reporter.note, reporter.stage

    def begin(self, name: str, total: int) -> None:
        """Show the bar of a task, once."""
        bar = self._bars.get(name)
        if bar is None:
            self._reporter.begin(name, total)
        elif bar not in self._ended:
            self._ended[bar] = 0
            self._reporter.begin(bar, self._all[bar])

    def progress(self, name: str, done: int, total: int) -> None:
        """Pass on the steps of a task with a bar of its own."""
        if name not in self._bars:
            self._reporter.progress(name, done, total)

    def end(self, name: str, ok: bool) -> None:
        """Move the bar of a task; end it with its last one."""
        bar = self._bars.get(name)
        if bar is None:
            self._reporter.end(name, ok)
            return
        self._ended[bar] += 1
        self._failed |= set() if ok else {bar}
        self._reporter.progress(bar, self._ended[bar], self._all[bar])
        if self._ended[bar] == self._all[bar]:
            self._reporter.end(bar, bar not in self._failed)


class NotedOnce:
    """A `Reporter` that passes on each note once."""

    def __init__(self, reporter: Reporter) -> None:
        self._reporter, self._noted = reporter, set[str]()
        self.begin, self.progress, self.end = reporter.begin, reporter.progress, reporter.end
        self.stage = reporter.stage

    def note(self, text: str) -> None:
        """Pass on what was not said before."""
        if text not in self._noted:
            self._noted.add(text)
            self._reporter.note(text)


class WithoutNotes(NotedOnce):
    """A `Reporter` that passes on all but notes."""

    def note(self, text: str) -> None:
        """Nothing."""
