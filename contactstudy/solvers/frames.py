"""The patch at many instants, for an animation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import IntArray
from contactstudy.contact.surface_coupling import SurfaceCoupling
from contactstudy.dynamics.stepper import Coupling, State
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer, Watch
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.patch_fields import node_coordinates, node_fields, surface_of
from contactstudy.track.discrete import DiscreteTrack

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Frames(Observer):
    """Keeps pressure and contact status at the steps nearest to positions of the wheel [m].

    Surface contact only; the dataset gets `frame_pressure` and `frame_contact_status`
    (frame, point).
    """

    at: tuple[float, ...]

    def problems_on(self, journey: Journey) -> list[str]:
        """Positions that the wheel does not pass."""
        return journey.not_passed("frames_at", self.at)

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return _Frames(passage, surface_of(coupling), passage.journey.steps_at(self.at))


class _Frames(Watch):
    def __init__(
        self, passage: Passage[DiscreteTrack], coupling: SurfaceCoupling, steps: IntArray
    ) -> None:
        self._passage, self._points = passage, coupling.wheel.points
        self._steps = set(steps.tolist())
        self._kept: list[tuple[int, float]] = []
        self._fields: list[dict[str, xr.Variable]] = []

    def see(self, state: State) -> None:
        """Keep the patch of the state if it is one of those wanted."""
        if state.step not in self._steps or state.contact is None:
            return
        patch = state.contact.state
        self._kept.append((state.step, state.time))
        self._fields.append(node_fields(self._points, [patch.forces], [patch.gap], "frame"))

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add the frames."""
        import xarray as xr

        if not self._fields:
            return data
        names = ("pressure", "contact_status")
        data = data.assign(
            {
                f"frame_{name}": xr.Variable.concat([f[name] for f in self._fields], "frame")
                for name in names
            }
        )
        steps, times = map(np.array, zip(*self._kept, strict=True))
        at = self._passage.positions[steps, 0]
        where = {"units": "m", "long_name": "position of the wheel"}
        return data.assign_coords(
            {
                "frame_time": ("frame", times, {"units": "s", "long_name": "time"}),
                "frame_position": ("frame", at, where),
                **node_coordinates(self._points),
            }
        )
