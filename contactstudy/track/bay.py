"""A beam that gives way under the wheel, statically, as the meshed rail does all over a bay.

Over a pad the wheel's load compresses the web and tilts nothing; in mid-bay it does not. A beam,
whose section moves as one, has none of that, so that the stiffness under its wheel varies too much
from sleeper to mid-bay. With F the flexibility under the wheel of the meshed rail with the load on
top, less what the contact spring stands for (`track.top_load`), and F_beam that of the beam,

    c(X) = F(X) - F_beam(X) - [F(mid) - F_beam(mid)]

is added under the wheel. In mid-bay, where the press that gives the spring was made, it is zero.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from contactstudy.arrays import Array
from contactstudy.dynamics.banded import Factor
from contactstudy.solids.bodies import rail_body
from contactstudy.solids.cache import CachedBody, cached
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.beam import BeamTrack, RailTheory
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack
from contactstudy.track.top_load import bay_planes, even_over_bay, static_flexibility


@dataclass(frozen=True)
class BayRecipe:
    """A beam, and the cell of the meshed rail on the same track."""

    track: Track
    theory: RailTheory
    elements_per_bay: int
    cell: CellRecipe

    @property
    def beam(self) -> BeamTrack:
        """The beam without the correction."""
        return BeamTrack(self.track, self.theory, self.elements_per_bay, element_compliance=True)


@dataclass(frozen=True, eq=False)
class BayCompliance:
    """c(X) from mid-bay to a support: distances (k,) from mid-bay [m], compliances (k,) [m/N]."""

    recipe: Any
    distance: Array
    compliance: Array

    def over_bay(self) -> Callable[[Array], Array]:
        """The compliance (m,) at X (m,)."""
        return even_over_bay(self.recipe.track, self.distance, self.compliance)


def bay_body(recipe: BayRecipe) -> CachedBody[BayCompliance]:
    """The compliance as something that is made once and kept."""
    return CachedBody("bay", recipe, bay_compliance, BayCompliance)


def bay_compliance(recipe: BayRecipe) -> BayCompliance:
    """Compare the beam with the meshed rail in the middle bay."""
    meshed = SolidTrack(recipe.track, cached(rail_body(recipe.cell)))
    distance = bay_planes(recipe.track, meshed.thickness)
    x = recipe.track.middle - distance
    more = _under_wheel(meshed, x) - _under_wheel(recipe.beam, x)
    return BayCompliance(recipe, distance, more - more[0])


def corrected_beam(recipe: BayRecipe) -> BeamTrack:
    """The beam with the compliance, computed or taken from the cache."""
    return recipe.beam.with_top_load(cached(bay_body(recipe)).over_bay())


def _under_wheel(track: DiscreteTrack, x: Array) -> Array:
    """Static flexibility (m,) under a wheel at X (m,), but for what its spring stands for [m/N]."""
    found = static_flexibility(Factor(track.stiffness), track.rail_rows(x))
    return found + track.local_compliance(x) + track.top_load_compliance(x)
