"""The table ``[solid]``: how rail and wheel are meshed, and how their contact is enforced."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Literal

from contactstudy.contact.augmented import AugmentedLagrangian, Penalty
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.profiles.rail import NAMES
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.track.model import DiscreteSupports, Track, whole
from contactstudy.track.rail import RAILS
from contactstudy.validation import (
    Above,
    AtLeast,
    AtMost,
    By,
    File,
    Parameters,
    Same,
    Unit,
    When,
    any_of,
    by,
    complaint,
    entries,
    read,
)

WheelModel = Literal["rigid", "quasi-static", "modal"]


@dataclass(frozen=True)
class Solid(Parameters):
    """The meshed rail and wheel of surface contact.

    ``section = "half"``: a tread even in y, centred on an upright rail. ``"whole"``: any position
    of any profile, see ``[wheelset]``; other defaults then hold.

    The modes of a modal wheel go up to ``wheel_frequency``; their damping ratio is an assumption,
    see `contactstudy.contact.surface_contact`. A run may have another ``wheel``.
    """

    section: Annotated[
        Literal["half", "whole"], "half a section, mirrored, or a whole one in any position"
    ] = "half"
    mesh_size: Annotated[float, Same(CellRecipe, "size")] = CellRecipe.size
    coarse_mesh_size: Annotated[float, Same(CellRecipe, "coarse")] = CellRecipe.coarse
    cell_length: Annotated[float, Same(CellRecipe, "length")] = CellRecipe.length
    interface_modes: Annotated[
        int, Same(CellRecipe, "interface_modes"), By("section", half=14, whole=20)
    ] = by()
    internal_modes: Annotated[int, Same(CellRecipe, "internal_modes")] = CellRecipe.internal_modes
    contact_half_length: Annotated[
        float, Same(WheelRecipe, "contact_half_length"), By("section", half=0.012, whole=0.010)
    ] = by()
    contact_half_width: Annotated[
        float, Same(WheelRecipe, "contact_half_width"), By("section", half=0.008, whole=0.012)
    ] = by()
    contact_points: Annotated[Quadrature, Same(SurfaceContact, "quadrature")] = "gauss"
    penalty: Annotated[float, Same(Penalty, "penalty")] = Penalty.penalty
    enforcement: Annotated[
        Literal["penalty", "augmented"], "penalty alone, or augmented Lagrangian"
    ] = "penalty"
    penetration_tolerance: Annotated[
        float, Same(AugmentedLagrangian, "tolerance"), When("enforcement", "augmented")
    ] = AugmentedLagrangian.tolerance
    wheel: Annotated[WheelModel, "model of the meshed wheel"] = "quasi-static"
    wheel_section: Annotated[
        str, File(True), "shipped wheel, or a TOML file with its dimensions"
    ] = "straight_860"
    wheel_frequency: Annotated[
        float, Unit("Hz"), Above(0), AtMost(2e4), "highest mode of a modal wheel"
    ] = 5000.0
    wheel_damping: Annotated[float, Same(SurfaceContact, "wheel_damping")] = (
        SurfaceContact.wheel_damping
    )
    pressure_at: Annotated[
        tuple[float, ...], Unit("m"), "where the wheel is when pressure fields are kept"
    ] = ()
    animation_frames: Annotated[
        int, AtLeast(0), AtMost(1000), "frames of the animation of the patch"
    ] = 0
    animation_span: Annotated[
        tuple[float, ...], Unit("m"), "where the animation begins and ends; the journey if empty"
    ] = ()

    @property
    def tolerance(self) -> float | None:
        """Penetration in m that an augmented Lagrangian leaves; None: the penalty alone."""
        return self.penetration_tolerance if self.enforcement == "augmented" else None

    @property
    def half(self) -> bool:
        """Whether half a section is meshed."""
        return self.section == "half"

    def fitting(self, track: Track) -> Solid:
        """The same with cells of the nearest length that divides the support spacing."""
        length = spacing(track)
        cells = max(1, round(length / self.cell_length))
        if abs(length / cells - self.cell_length) < 1e-9 * length:
            return self
        return replace(self, cell_length=length / cells)

    def problems_on(self, track: Track, meshed: bool) -> list[str]:
        """What cannot be meshed on a track, by key.

        Unless a run needs a ``meshed`` rail, only a contact stiffness is taken from it.
        """
        problems = []
        if track.rail.profile_name is None:
            if not meshed:
                return []  # the stiffness then is Hertz's
            drawn = any_of(name for name in RAILS.classes if name in NAMES)
            allowed = f"what is meshed needs a rail with a profile: {drawn}"
            problems.append(complaint("track.rail", RAILS.name(track.rail), allowed))
        if not whole(spacing(track) / self.cell_length):
            allowed = f"must divide {spacing(track):g} m into whole cells (m)"
            problems.append(complaint("solid.cell_length", self.cell_length, allowed))
        for recipe in (CellRecipe, WheelRecipe):
            keys = entries(recipe)
            own = {key: value for key, value in self.resolved().items() if key in keys}
            problems += read(recipe, own, "solid", symmetric=self.half)[1]
        return problems


def spacing(track: Track) -> float:
    """Distance of the supports, or the whole length where the track lies on a foundation [m]."""
    return track.support.spacing if isinstance(track.support, DiscreteSupports) else track.length
