"""Area of a contact patch from the gap around it.

Between smooth bodies the pressure falls to zero at the edge like the square root of the distance
s, and outside the gap opens like s^(3/2) (K. L. Johnson, Contact Mechanics (1985), sec. 4.2). So
lines of equal ``t = g^(2/3)`` run parallel to the edge, at distances in proportion to t, and with
A(t) the area inside such a line

    rho(t) = sqrt(A(t)/pi) = rho_0 + c t

exactly for a circle and closely for other shapes; so several patches are taken one by one, each on
the points nearest to it. Points at the edge of a patch carry a force, or open, one by one, and
single ones inside open as well; at a spacing from it the gap no longer knows of them. The two
lines one and two spacings d of the contact points from the edge have ``rho(t) - rho(t/2) = d``,
and give ``rho_0 = 2 rho(t/2) - rho(t)``.
"""

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.compiled import compiled
from contactstudy.exceptions import NumericalError

_SETTLED = 0.01
"""Error of the lines' distance, of the spacing: rho_0 hardly depends on it."""


def patch_area(
    x: Array, y: Array, gap: Array, mirrored: bool, region: BoolArray | None = None
) -> float:
    """Area of a patch on a grid of contact points.

    Parameters
    ----------
    x, y : ndarray (nx,), (ny,)
        Grid lines in m, increasing.
    gap : ndarray (nx, ny)
        Gap of the deformed bodies in m; zero or negative in contact.
    mirrored : bool
        The surfaces continue symmetrically about y = 0, at or before ``y[0]``.
    region : ndarray of bool (nx, ny), optional
        Points of this patch's surroundings; all of them when not given.

    Returns
    -------
    float
        In m^2, of both halves if mirrored. A patch of less than half a spacing's radius is too
        small for the grid to tell; it gets about a point's area.

    Raises
    ------
    NumericalError
        If the patch reaches an outer line of the grid.
    """
    from scipy.ndimage import binary_dilation

    nearest = np.inf
    if region is not None:
        # no line may leave the region
        rim = region & binary_dilation(~region)
        nearest = float(gap[rim].min()) if rim.any() else np.inf
        gap = np.where(region, gap, 2.0 * gap.max())
    rho = _radius(x, y, gap, mirrored, float(np.cbrt(max(nearest, 0.0) ** 2)))
    if rho < 0.0:
        raise NumericalError("contact area: the patch reaches the edge of the contact points")
    return float(np.pi * rho**2)


@compiled
def _radius(x: Array, y: Array, gap: Array, mirrored: bool, limit: float) -> float:
    """rho_0 from lines up to a limit of t, or -1 for a patch that reaches an outer line."""
    nx, ny = gap.shape
    # between the plane of symmetry and the first line nothing changes across
    first = 1 if mirrored and y[0] > 0.0 else 0
    t, lines = np.empty((nx, ny + first)), np.zeros(ny + first)
    lines[first:] = y
    for i in range(nx):
        for j in range(ny):
            t[i, j + first] = np.cbrt(max(gap[i, j], 0.0) ** 2)
            if i == 0 or i == nx - 1 or j == ny - 1 or (j == 0 and not mirrored):
                limit = min(limit, t[i, j + first])
        t[i, 0] = t[i, first]
    if limit <= 0.0:
        return -1.0
    # Gauss points come in pairs: the wider of their two distances; of oblong cells the mean
    spacing = np.sqrt(np.diff(x).max() * np.diff(y).max())
    return _edge(t, np.diff(x), np.diff(lines), limit, spacing, 2.0 if mirrored else 1.0)


@compiled
def _edge(t: Array, dx: Array, dy: Array, limit: float, spacing: float, halves: float) -> float:
    """rho_0 from two lines of equal t; where the grid ends before, from the outermost."""
    low, high, level = 0.0, limit, limit
    outer = inner = 0.0
    for _ in range(60):
        outer = np.sqrt(halves * area_below(t, dx, dy, level) / np.pi)
        inner = np.sqrt(halves * area_below(t, dx, dy, 0.5 * level) / np.pi)
        apart = outer - inner
        if abs(apart - spacing) <= _SETTLED * spacing or (level == limit and apart < spacing):
            break
        if apart < spacing:
            low = level
        else:
            high = level
        # rho is nearly linear in t
        level = level * spacing / apart if apart > 0.0 else high
        if not low < level < high:
            level = 0.5 * (low + high)
    return max(2.0 * inner - outer, 0.0)


@compiled
def area_below(t: Array, dx: Array, dy: Array, level: float) -> float:
    """Area [m^2] where an interpolated function is below a level.

    The function is linear on the four triangles between the sides of a rectangle and its centre,
    where it has the mean of the corners.

    Parameters
    ----------
    t : ndarray (nx, ny)
        Values at the grid's points.
    dx, dy : ndarray (nx-1,), (ny-1,)
        Steps of the grid in m.
    """
    total = 0.0
    for i in range(len(dx)):
        for j in range(len(dy)):
            a, b, c, d = t[i, j], t[i + 1, j], t[i + 1, j + 1], t[i, j + 1]
            if min(a, b, c, d) >= level:
                continue
            share = 1.0
            if max(a, b, c, d) > level:
                m = 0.25 * (a + b + c + d)
                share = 0.25 * (
                    _part_below(a, b, m, level)
                    + _part_below(b, c, m, level)
                    + _part_below(c, d, m, level)
                    + _part_below(d, a, m, level)
                )
            total += share * dx[i] * dy[j]
    return total


@compiled
def _part_below(a: float, b: float, c: float, level: float) -> float:
    """Part of a triangle where the linear function with these corner values is below a level."""
    low, high = min(a, b, c), max(a, b, c)
    middle = max(min(a, b), min(max(a, b), c))
    if level <= low:
        return 0.0
    if level >= high:
        return 1.0
    # the line cuts off the lowest corner, or the highest one
    if level < middle:
        return (level - low) ** 2 / ((middle - low) * (high - low))
    return 1.0 - (high - level) ** 2 / ((high - middle) * (high - low))
