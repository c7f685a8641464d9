"""What the forces of the wheels of a train say of its safety: unloading and Y/Q."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.solvers.observers import Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.structure import LEFT

if TYPE_CHECKING:
    import xarray as xr

    from contactstudy.dynamics.stepper import State

UNLOADING = "wheel_unloading"
QUOTIENT = "derailment_quotient"


class WheelForces(Watch):
    """Adds `wheel_unloading` and, with lateral contacts, `derailment_quotient` (wheel, time).

    ::

        wheel_unloading      (Q_0 - Q)/Q_0, Q the contact force and Q_0 its static value
        derailment_quotient  Y/Q, Y the lateral force towards the outside, where a flange climbs;
                             NaN where Q is 0
    """

    def __init__(self, passage: Passage[DiscreteTrack]) -> None:
        self._passage = passage

    def see(self, state: State) -> None:
        """All is in the histories."""

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add the variables."""
        passage = self._passage
        Q = data["contact_force"]
        static = passage.static_loads[~passage.lateral]
        still = static[:, None] if Q.ndim == 2 else static[0]
        if not np.all(static > 0.0):
            return data
        attrs = {"units": "1", "long_name": "unloading of the wheel, (Q_0 - Q)/Q_0"}
        data = data.assign({UNLOADING: (Q.dims, 1.0 - Q.values / still, attrs)})
        if "lateral_force" not in data:
            return data
        # the left wheel pushes its rail to +Y with its flange, the right one to -Y
        rails = passage.rails[passage.lateral]
        outside = np.where(rails == LEFT, 1.0, -1.0)[:, None]
        quotient = outside * data["lateral_force"].values / Q.where(Q > 0.0).values
        attrs = {"units": "1", "long_name": "Y/Q of the wheel, Y towards the outside"}
        side = {"long_name": "rail of the track under the wheel, 0 right and 1 left along +X"}
        data = data.assign({QUOTIENT: (Q.dims, quotient, attrs)})
        return data.assign_coords(rail=("wheel", rails, side))
