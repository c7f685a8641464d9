"""The patch at many instants, for an animation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from contactstudy.contact.surface_coupling import PatchState
from contactstudy.dynamics.stepper import State
from contactstudy.solvers.instants import AtPositions, KeptStates
from contactstudy.solvers.patch_fields import node_fields

if TYPE_CHECKING:
    import xarray as xr


class _Frames(KeptStates[dict[str, "xr.Variable"]]):
    dim = "frame"

    def keep(self, state: State, patch: PatchState, position: float) -> dict[str, xr.Variable]:
        """Pressure and contact status: forces and gaps at all points would be much larger."""
        return node_fields(self.coupling.wheel.points, [patch.forces], [patch.gap], self.dim)

    def add(self, data: xr.Dataset) -> xr.Dataset:
        """Add the frames."""
        import xarray as xr

        fields = [kept for _, _, kept in self.kept]
        return data.assign(
            {
                f"frame_{name}": xr.Variable.concat([f[name] for f in fields], self.dim)
                for name in ("pressure", "contact_status")
            }
        )


@dataclass(frozen=True)
class Frames(AtPositions):
    """Keeps pressure and contact status at the steps nearest to positions of the wheel [m].

    Surface contact only; the dataset gets `frame_pressure` and `frame_contact_status`
    (frame, point).
    """

    key: ClassVar = "frames_at"
    watching: ClassVar = _Frames
