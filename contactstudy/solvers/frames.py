"""The patch at many instants, for an animation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.contact.surface import SurfaceCoupling
from contactstudy.dynamics.stepper import State
from contactstudy.solvers.patch_fields import node_coordinates, node_fields

if TYPE_CHECKING:
    import xarray as xr


class Frames:
    """Keeps the nodal fields of the patch at the steps nearest to given positions.

    Parameters
    ----------
    coupling : SurfaceCoupling
        Of the run.
    at : sequence of float
        Positions of the wheel wanted in m.
    """

    def __init__(self, coupling: SurfaceCoupling, at: Sequence[float]) -> None:
        self._coupling = coupling
        self._steps = {int(np.argmin(np.abs(coupling.positions - x))) for x in at}
        self._steps_kept: list[int] = []
        self._times: list[float] = []
        self._fields: list[dict[str, xr.Variable]] = []

    def __call__(self, state: State) -> None:
        """See a state of the run; keep its patch if it is one of those wanted."""
        if state.step not in self._steps:
            return
        last = self._coupling.last
        self._steps_kept.append(state.step)
        self._times.append(state.time)
        self._fields.append(node_fields(self._coupling.points, [last.forces], [last.gap], "frame"))

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add `frame_pressure` and `frame_contact_status` (frame, point) to a dataset."""
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
        at = self._coupling.positions[self._steps_kept]
        return data.assign_coords(
            {
                "frame_time": ("frame", np.array(self._times), {"units": "s", "long_name": "time"}),
                "frame_position": (
                    "frame",
                    at,
                    {"units": "m", "long_name": "position of the wheel"},
                ),
                **node_coordinates(self._coupling.points),
            }
        )


def both(*observers: Callable[[State], None]) -> Callable[[State], None]:
    """Let several observers see every state of a run."""

    def see(state: State) -> None:
        for observer in observers:
            observer(state)

    return see
