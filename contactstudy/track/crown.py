"""A solid track under a load on top of its rail: the rows of the crown instead of the centre line.

A point on the centre line moves the section as one, and what the head moves on its web is left to
the contact spring, which has no inertia. From 2 kHz on the head vibrates against the rest of the
section. So the load, and the displacement that the gap sees, are taken at the crown, by the rows Q
that surface contact has there. The dofs then hold part of the give that the spring of a static
press stands for, measured from the press to the centre line. It is given back: with F(X) the
static flexibility that a point on the rail is to have (`track.top_load`),

    c(X) = F(X) - Q K^-1 Q^T,

negative where the dofs hold more, is added at the contact.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor
from contactstudy.track.model import DiscreteSupports
from contactstudy.track.rail import Direction
from contactstudy.track.solid import SolidTrack
from contactstudy.track.top_load import repeated, static_flexibility


@dataclass(frozen=True, eq=False)
class Crown:
    """Where a wheel stands on a solid track."""

    track: SolidTrack

    def contact_rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        """Q: dofs and weights (m, k) of the displacement of the crown at X (m,) [m]."""
        return self.track.crown_rows(x)

    def compliance(self, x: Array) -> Array:
        """c (m,) at X (m,) [m/N]."""
        return self._compliance(x)

    def residual(self, x: Array) -> Array:
        """What a load on the crown adds to the deflection of the centre line, (m,) [m/N].

        Beyond the dofs, at X (m,).
        """
        return self._residual(x)

    @cached_property
    def _period(self) -> float:
        """Length over which the rail repeats, even about the middle of the track [m]."""
        track = self.track.track
        discrete = isinstance(track.support, DiscreteSupports)
        return track.bay_length if discrete else self.track.recipe.length

    @cached_property
    def _distance(self) -> Array:
        """Of all planes of the mesh on half a period from the middle (k,) [m]."""
        half, h = 0.5 * self._period, self.track.thickness
        return np.minimum(h * np.arange(round(half / h) + 1), half)

    @cached_property
    def _compliance(self) -> Callable[[Array], Array]:
        track, x = self.track, self.track.track.middle - self._distance
        factor = Factor(track.stiffness)
        wanted = static_flexibility(factor, track.rail_rows(x))
        wanted += track.local_compliance(x) + track.top_load_compliance(x)
        held = static_flexibility(factor, self.track.crown_rows(x))
        return repeated(track.track.middle, self._period, self._distance, wanted - held)

    @cached_property
    def _residual(self) -> Callable[[Array], Array]:
        track, h, found = self.track, self.track.thickness, []
        for x in track.track.middle - self._distance:
            stretch = track.stretch(x, 2 * h)
            found.append(stretch.centre_residual[0, stretch.crown_node(x)])
        return repeated(track.track.middle, self._period, self._distance, np.array(found))
