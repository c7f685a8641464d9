"""What watches a run: observers of the states that the stepper yields.

An observer is frozen and may be given to many runs; for each it makes a watch, which sees every
state of that run, the start included, and may add what it has kept to the dataset.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from contactstudy.dynamics.stepper import Coupling, State
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack

if TYPE_CHECKING:
    import xarray as xr

STEPS_PER_REPORT = 100
"""How many steps pass between two reports of `ReportProgress`."""


class Watch:
    """Watches one run; by itself it does nothing."""

    def see(self, state: State) -> None:
        """See a state."""

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add what was kept to the dataset of the run."""
        return data


class Observer(ABC):
    """Something that can watch runs."""

    def problems_on(self, journey: Journey) -> list[str]:
        """Everything that makes watching that journey impossible."""
        return []

    @abstractmethod
    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """Watch a run."""


@dataclass(frozen=True)
class EachState(Observer):
    """Calls a function with every state."""

    function: Callable[[State], object]

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return _Calls(self.function)


@dataclass(frozen=True)
class ReportProgress(Observer):
    """Reports how far a run is, as (steps done, steps), now and then."""

    report: Callable[[int, int], object]

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        steps = passage.journey.n_steps

        def tell(state: State) -> None:
            if state.step and (state.step % STEPS_PER_REPORT == 0 or state.step == steps):
                self.report(state.step, steps)

        return _Calls(tell)


class _Calls(Watch):
    def __init__(self, function: Callable[[State], object]) -> None:
        self._function = function

    def see(self, state: State) -> None:
        self._function(state)
