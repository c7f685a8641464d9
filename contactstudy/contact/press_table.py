"""The static press of two meshed bodies as a point law sees it: a smooth table of few rows.

As the patch grows points enter it one after the other, so that the computed approach is a polygon
over the load whose slope jumps by a few percent. Loads are taken densely, and each row of the
table is a local straight line through ``approach / F^(2/3)`` over ``F^(1/3)``, which for Hertz's
law is constant; the weights of the patch are smoothed in the same way.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.augmented import Enforcement
from contactstudy.contact.complementarity import PressedForces
from contactstudy.contact.press import PRESS_LOADS, press_curve, press_stiffness
from contactstudy.exceptions import InputError
from contactstudy.geometry.points import EDGE_KEYS, ContactPoints, EdgeReachedError

LARGEST = 3.0
"""Largest load of a table, in static loads."""
_ROWS = 16
_LOADS = 144
_SMALLEST = 0.2, 0.3  # cube roots of the first load and of the first row's, over the static load's
_LEAST = 1.1  # cube root of the load that a table must reach, in the same measure
_WINDOW = 0.2  # half width of a local line, in the same measure


@dataclass(frozen=True, eq=False)
class PressTable:
    """Rows of a press, by growing load.

    Attributes
    ----------
    recipe
        What it was made from.
    force, approach : ndarray (k,)
        Loads in N and approaches in m, as in `contact.press.PressCurve`.
    offsets : ndarray (p,)
        Places of the contact points along the rail, relative to the wheel, in m.
    weights : ndarray (k, p)
        Share of a small added load that acts at each place; each row adds up to 1.
    shares : ndarray (n,)
        Share of a small load that is added to the static one at each of the contact points.
    tangent, secant : ndarray ()
        Stiffness at the static load in N/m, see `contact.press.press_stiffness`.
    zone : ndarray (2,)
        Half length and half width of the wheel's finely meshed zone in m; nan if unknown.
    """

    recipe: Any
    force: Array
    approach: Array
    offsets: Array
    weights: Array
    shares: Array
    tangent: Array
    secant: Array
    zone: Array = field(default_factory=lambda: np.full(2, np.nan))

    def without(self, give: float) -> "PressTable":
        """The table of bodies that are stiffer by a linear give [m/N], as that of wheel modes."""
        tangent, secant = (1.0 / (1.0 / k - give) for k in (self.tangent, self.secant))
        return replace(
            self,
            approach=self.approach - give * self.force,
            tangent=np.asarray(tangent),
            secant=np.asarray(secant),
        )

    def weights_at(self, load: float) -> Array:
        """Weights (p,) at a load [N] within the table."""
        return np.array([np.interp(load, self.force, column) for column in self.weights.T])


def press_table(
    points: ContactPoints, flexibility: Array, load: float, law: Enforcement, reference: Array
) -> PressTable:
    """Press two bodies up to `LARGEST` times the static load [N]; arguments of `press_curve`.

    It ends before that where the patch reaches the edge of the points.

    Raises
    ------
    EdgeReachedError
        If it does so at the static load.
    """
    unit, width = load ** (1 / 3), _WINDOW * load ** (1 / 3)
    root = unit * np.linspace(_SMALLEST[0], LARGEST ** (1 / 3), _LOADS)
    curve = press_curve(points, flexibility, root**3, law, reference)
    edges = [points.edge_reached(solution.active) for solution in curve.solutions]
    n = next((k for k, edge in enumerate(edges) if edge), len(root))
    if n < len(root) and root[n] < _LEAST * unit:
        raise EdgeReachedError(
            f"static press: the patch reaches the edge of the finely meshed zone {edges[n]} the "
            f"rail at {1e-3 * root[n] ** 3:.4g} kN ({EDGE_KEYS[edges[n]]} is too small)",
            edges[n],
        )
    root, solutions = root[:n], curve.solutions[:n]
    rows = np.linspace(_SMALLEST[1] * unit, root[-1], _ROWS)
    M = flexibility + np.diag(law.compliance(points.area))
    shares = np.stack([load_weights(M, points.normal_z, s) for s in solutions])
    along = shares.reshape(n, len(points.x), -1).sum(axis=2)
    smooth = _local_lines(root, rows, width)
    stiffness = press_curve(points, flexibility, load * PRESS_LOADS, law, reference)
    tangent, secant = press_stiffness(stiffness, load)
    at_load = _local_lines(root, np.array([unit]), width)[0]
    return PressTable(
        recipe=None,
        force=rows**3,
        approach=smooth @ (curve.approach[:n] / root**2) * rows**2,
        offsets=points.x,
        weights=smooth @ along,
        shares=at_load @ shares,
        tangent=np.array(tangent),
        secant=np.array(secant),
    )


def _local_lines(s: Array, at: Array, width: float) -> Array:
    """Matrix (k, n) from values at s (n,) to local straight lines' at k places.

    Least squares with tricube weights (W. S. Cleveland, J. Am. Stat. Assoc. 74 (1979) 829).
    """
    found = np.empty((len(at), len(s)))
    for row, place in zip(found, at, strict=True):
        u = (s - place) / width
        w = np.maximum(1 - np.abs(u) ** 3, 0) ** 3
        A = np.stack([np.ones_like(u), u], axis=1)
        row[:] = np.linalg.solve(A.T @ (w[:, None] * A), (w[:, None] * A).T)[0]
    return found


def load_weights(M: Array, normal: Array, solution: PressedForces) -> Array:
    """Weights of the irregularity at the points in the movement of the wheel, (n,), sum 1.

    Parameters
    ----------
    M : ndarray (n, n)
        Flexibility of both bodies and the penalty, as in `contact.surface_coupling`, m/N.
    normal : ndarray (n,)
        Component of the contact normal along the approach.
    solution : PressedForces
        Of the smooth bodies under the load.
    """
    weights = np.zeros(len(normal))
    index = np.flatnonzero(solution.active)
    if not len(index):
        raise InputError("weights of a patch: no point is in contact")
    weights[index] = normal[index] * np.linalg.solve(M[np.ix_(index, index)], normal[index])
    return weights / weights.sum()
