"""The closest point of a plane curve, for many points at once."""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.profiles.pieces import Frame

# largest spacing of the table of points among which the closest is looked for first [m]
_SPACING = 0.5e-3
# numbers in one block of the table of distances
_BLOCK = 4_000_000
_ITERATIONS = 100


class ClosestPoint:
    """Finds arc length and signed distance of the closest points of a curve.

    Every local minimum of the distance that can be the least one is refined by Newton's iteration
    on ``(c(s) - p) . t(s) = 0``, kept within its bracket; the nearest of all wins.

    The frame goes on straight beyond the curve's ends; between the joints, arc lengths with the
    ends among them [m], the curve is smooth. `side` is 1 if the body lies to the right of the walk
    (below it), -1 if to the left.
    """

    def __init__(
        self, name: str, frame: Callable[[Array], Frame], joints: Sequence[float], side: float
    ) -> None:
        self._name, self._frame, self._joints, self._side = name, frame, joints, side

    def __call__(self, points: Array) -> tuple[Array, Array]:
        """Arc lengths (n,) of the closest points of (n, 2), and signed distances (n,) [m].

        Raises
        ------
        InputError
            If points are not finite or not (n, 2).
        """
        p = np.asarray(points, dtype=float)
        if p.ndim != 2 or p.shape[1] != 2 or not np.all(np.isfinite(p)):
            raise InputError(
                f"projection on {self._name}: points must be finite (n, 2), got {p.shape}"
            )
        s, distance = np.empty(len(p)), np.empty(len(p))
        block = max(_BLOCK // len(self._table[0]), 1)
        for first in range(0, len(p), block):
            part = slice(first, first + block)
            s[part], distance[part] = self._project(p[part])
        return s, distance

    @property
    def samples(self) -> tuple[Array, Array]:
        """Arc lengths (m,) and points (m, 2) among which the closest is looked for first."""
        return self._table[:2]

    @cached_property
    def _table(self) -> tuple[Array, Array, float]:
        """The samples, and the greatest curvature."""
        rows = []
        for a, b in zip(self._joints[:-1], self._joints[1:], strict=True):
            rows.append(np.linspace(a, b, max(int(np.ceil((b - a) / _SPACING)), 4) + 1)[:-1])
        s = np.concatenate([*rows, self._joints[-1:]])
        point, _, turn = self._frame(s)
        return s, point, float(np.abs(turn).max())

    def _project(self, p: Array) -> tuple[Array, Array]:
        row, low, high, start = self._brackets(p)
        s = self._closest(p[row], low, high, start)
        c, d, _ = self._frame(s)
        off = p[row] - c
        distance = self._side * (d[:, 0] * off[:, 1] - d[:, 1] * off[:, 0])
        # the nearest candidate of every point; candidates come sorted by point
        order = np.lexsort((np.hypot(off[:, 0], off[:, 1]), row))
        first = order[np.searchsorted(row[order], np.arange(len(p)))]
        return s[first], distance[first]

    def _brackets(self, p: Array) -> tuple[NDArray[np.intp], Array, Array, Array]:
        """Candidates: number of the point, lower and upper end of the bracket, start."""
        s, table, bend = self._table
        square = (p[:, :1] - table[:, 0]) ** 2 + (p[:, 1:] - table[:, 1]) ** 2
        least = square.min(axis=1)
        # a foot lies within one spacing h of its sample: D <= d^2 + h^2 (1 + |k| d)
        slack = _SPACING**2 * (1.0 + bend * np.sqrt(least))
        near = square <= (least + slack)[:, None]
        near[:, 1:] &= square[:, 1:] <= square[:, :-1]
        near[:, :-1] &= square[:, :-1] <= square[:, 1:]
        # a point past an end has a foot on the straight continuation, however far away
        _, ahead, _ = self._frame(s[[0, -1]])
        near[:, 0] |= (p - table[0]) @ ahead[0] < 0
        near[:, -1] |= (p - table[-1]) @ ahead[1] > 0
        row, k = np.nonzero(near)
        # the straight continuations reach as far as any point can need
        far = np.sqrt(square[row, k]) + _SPACING
        low = np.where(k > 0, s[np.maximum(k - 1, 0)], s[0] - far)
        high = np.where(k < len(s) - 1, s[np.minimum(k + 1, len(s) - 1)], s[-1] + far)
        return row, low, high, s[k]

    def _closest(self, p: Array, low: Array, high: Array, start: Array) -> Array:
        """Newton on f(s) = (c - p) . t, f' = 1 + k (c - p) . n, bisecting where it leaves."""
        x, todo = start.copy(), np.arange(len(p))
        for _ in range(_ITERATIONS):
            c, d, turn = self._frame(x[todo])
            off = c - p[todo]
            f = off[:, 0] * d[:, 0] + off[:, 1] * d[:, 1]
            slope = 1.0 + turn * (off[:, 1] * d[:, 0] - off[:, 0] * d[:, 1])
            high[todo] = np.where(f > 0, x[todo], high[todo])
            low[todo] = np.where(f > 0, low[todo], x[todo])
            with np.errstate(divide="ignore", invalid="ignore"):
                new = x[todo] - f / slope
            good = (slope > 0) & (new >= low[todo]) & (new <= high[todo])
            new = np.where(good, new, 0.5 * (low[todo] + high[todo]))
            moved = np.abs(new - x[todo])
            x[todo] = new
            todo = todo[moved > 1e-15]
            if not len(todo):
                return x
        raise NumericalError(
            f"projection on {self._name}: {len(todo)} points do not settle, the first at "
            f"(y, z) = ({p[todo[0], 0]:.6g}, {p[todo[0], 1]:.6g}) m"
        )
