"""What a track with a meshed rail offers to the contact, reduced or not."""

from typing import Protocol

from contactstudy.arrays import Array
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.stretch import RailStretch, SectionResponse


class MeshedTrack(DiscreteTrack, Protocol):
    """A discretised track whose rail is a three-dimensional solid."""

    @property
    def recipe(self) -> CellRecipe:
        """Mesh of the rail."""

    @property
    def thickness(self) -> float:
        """Length of a slice of the mesh [m]."""

    @property
    def residual_period(self) -> int | None:
        """Slices after which the mean residual flexibility repeats; None where no mean is taken."""

    @property
    def surface_arc(self) -> Array:
        """Arc lengths (ny,) of the running-surface nodes from the crown [m]."""

    def stretch(self, x: float, half_length: float) -> RailStretch:
        """Running surface from ``x - half_length`` to ``x + half_length`` at least [m]."""

    def section(self, x: float, half_length: float) -> SectionResponse:
        """Displacement of the section near X, with the nodal forces of the stretch there."""


def not_meshed(track: object) -> list[str]:
    """Return the complaint (or nothing) about a track without a meshed rail."""
    if hasattr(type(track), "stretch"):
        return []
    return [
        f"track: a {type(track).__name__} has no meshed rail; give a SolidTrack, such as"
        " contactstudy.meshed_track()"
    ]
