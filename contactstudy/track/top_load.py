"""How a wheel's load on top of a meshed rail differs from the same load spread over the section.

A point law acts on the rail's centre line: the load B^T lambda is spread over the section, and
the displacement is the section's mean. The wheel's load comes in at the top. With q, the load on
top, as B plus the self-equilibrated pair p = q - B, the flexibility F of the supported rail gives

    F_qq = F_BB + 2 F_Bp + F_pp,    F_Bp = F_Bq - F_BB.

F_pp is local: it knows nothing of the supports and belongs to the contact spring. F_Bp does know
them: over a pad the web is compressed by the load on top and less so by the spread one. The spring
of a static press, measured to the centre line in mid-bay, stands for F_pp + F_Bp(mid) and whatever
the wheel gives. So a point on the rail at X has the flexibility

    F_BB(X) + 2 F_Bp(X) - F_Bp(mid),

which is that of surface contact less what the spring stands for.
"""

from collections.abc import Callable
from functools import cached_property
from typing import cast

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor
from contactstudy.track.discrete import AssembledTrack
from contactstudy.track.meshed import MeshedTrack
from contactstudy.track.model import DiscreteSupports, Track
from contactstudy.track.rail import Direction

_SAMPLES = 25
"""Places on half a bay; the pair's flexibility is even about supports and mid-bay."""


class AssembledMesh(AssembledTrack):
    """An assembled track with a meshed rail, a `MeshedTrack`, under vertical loads."""

    @property
    def direction(self) -> Direction:
        """Point contact on a meshed rail is vertical."""
        return "Z"

    @property
    def thickness(self) -> float:
        """Length of a slice of the mesh [m]."""
        recipe = cast(MeshedTrack, self).recipe
        return recipe.thickness

    def top_load_compliance(self, x: Array) -> Array:
        """See `DiscreteTrack`."""
        return self._top_load(x)

    @cached_property
    def _top_load(self) -> Callable[[Array], Array]:
        """2 F_Bp(X) - F_Bp(mid) as a function of X, that of the middle bay in all bays."""
        track = cast(MeshedTrack, self)
        factor, middle = Factor(track.stiffness), track.track.middle
        at_middle = _pair(track, factor, middle)
        if not isinstance(track.track.support, DiscreteSupports):
            return lambda x: np.full(np.shape(x), at_middle)
        offset = bay_planes(track.track, self.thickness)
        values = np.array([_pair(track, factor, middle - x) for x in offset])
        return even_over_bay(track.track, offset, 2 * values - at_middle)


def bay_planes(track: Track, thickness: float) -> Array:
    """Distances from mid-bay to a support on planes of the mesh, so that no phase of it matters."""
    half = 0.5 * track.bay_length
    planes = np.unique(np.round(np.linspace(0.0, half, _SAMPLES) / thickness))
    return np.minimum(planes * thickness, half)


def even_over_bay(track: Track, distance: Array, values: Array) -> Callable[[Array], Array]:
    """Function of X from values at distances (k,) from mid-bay [m], the same in all bays."""
    return repeated(track.middle, track.bay_length, distance, values)


def repeated(
    middle: float, period: float, distance: Array, values: Array
) -> Callable[[Array], Array]:
    """Periodic function of X, even about a middle, from values at distances (k,) from it [m]."""
    from scipy.interpolate import CubicSpline

    knots, first = np.unique(np.r_[-distance, distance].round(12), return_index=True)
    spline, half = CubicSpline(knots, np.r_[values, values][first]), 0.5 * period
    return lambda x: np.asarray(spline(np.mod(np.asarray(x) - middle + half, period) - half))


def static_flexibility(factor: Factor, rows: tuple[IntArray, Array]) -> Array:
    """Displacement (m,) of rows, dofs and weights (m, k), under a unit load on each [m/N]."""
    found = np.empty(len(rows[0]))
    for k, (dofs, weights) in enumerate(zip(*rows, strict=True)):
        row = np.zeros(factor.n)
        np.add.at(row, dofs, weights)
        found[k] = row @ factor.solve(row)
    return found


def _pair(track: MeshedTrack, factor: Factor, x: float) -> float:
    """F_Bp at X: mean motion of the section there for the load on top less for the spread one."""
    (dofs,), (weights,) = track.rail_rows(np.array([x]))
    spread = np.zeros(factor.n)
    np.add.at(spread, dofs, weights)
    u = factor.solve(spread)
    own = float(spread @ u + track.local_compliance(np.array([x]))[0])
    stretch = track.stretch(x, 2 * track.thickness)
    # by reciprocity the motion of a node on top under the spread load
    node = stretch.crown_node(x)
    top = stretch.map[node] @ u[stretch.dofs] + stretch.centre_residual[0, node]
    return float(top) - own
