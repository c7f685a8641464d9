"""Who tells the user how far things are."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
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

    @contextlib.contextmanager
    def stage(self, text: str) -> Iterator[None]:
        """Nothing."""
        yield
