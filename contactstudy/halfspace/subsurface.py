"""Stresses below a pressure on the surface of an elastic half-space.

The pressure is constant on each rectangle of a grid. A. E. H. Love, "The stress produced in a
semi-infinite solid by pressure on part of the boundary", Phil. Trans. R. Soc. A 228 (1929) 377:
with the distance rho from a loaded point and

    V = integral p/rho dA,    chi = integral p log(z + rho) dA    (z into the body)

    2 pi s_xx = 2 nu V_z - (1 - 2 nu) chi_xx - z V_xx        (s_yy likewise)
    2 pi s_zz = V_z - z V_zz
    2 pi s_xy = -(1 - 2 nu) chi_xy - z V_xy
    2 pi s_zx = -z V_zx                                      (s_yz likewise)

For a rectangle every derivative is a function of the four corners. What a real body has besides
the half-space's stresses, those of bending and support, is smooth over the patch and not here.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compiled import compiled
from contactstudy.exceptions import InputError
from contactstudy.halfspace.pressure_field import SurfacePressure
from contactstudy.solids.stress import maximum_shear, von_mises

SHALLOWEST = 0.02
"""Least depth at which a maximum is looked for, as a part of the patch's radius sqrt(A/pi)."""


@dataclass(frozen=True)
class StressMaximum:
    """Largest value of an invariant below the patch.

    Attributes
    ----------
    value : float
        In Pa.
    x, y, depth : float
        Where, in m.
    """

    value: float
    x: float
    y: float
    depth: float


def half_space_stress(load: SurfacePressure, points: Array, poisson_ratio: float = 0.3) -> Array:
    """Stresses (n, 6) [Pa] at points (n, 3): x, y, depth in m, the depth above 0, into the body.

    (xx, yy, zz, yz, zx, xy) in the axes (x, y, depth), tension positive.

    Raises
    ------
    InputError
        If a point is not inside the body.
    """
    points = np.ascontiguousarray(points, dtype=float)
    if len(points) and not points[:, 2].min() > 0:
        raise InputError(
            f"stress below the patch: every depth must be above 0 (least {points[:, 2].min()} m)"
        )
    # Rectangles that share a corner: the weight of a corner function is the pressure's double
    # difference across it.
    weight = np.diff(np.diff(np.pad(load.pressure, 1), axis=0), axis=1)
    i, j = np.nonzero(weight)
    stress = np.empty((len(points), 6))
    _sum_corners(
        points, load.x[i], load.y[j], np.ascontiguousarray(weight[i, j]), poisson_ratio, stress
    )
    return stress


@compiled
def _sum_corners(
    points: Array, cx: Array, cy: Array, weight: Array, nu: float, stress: Array
) -> None:
    for n in range(len(points)):
        z = points[n, 2]
        xx = yy = zz = yz = zx = xy = 0.0
        for k in range(len(weight)):
            u, v, q = points[n, 0] - cx[k], points[n, 1] - cy[k], weight[k]
            uu, vv, wz = u * u, v * v, z * z
            rho = np.sqrt(uu + vv + wz)
            # 1/(rho + v) without cancellation for v < 0: (rho - v)/(u^2 + z^2)
            by_v = 1 / (rho + v) if v > 0 else (rho - v) / (uu + wz)
            by_u = 1 / (rho + u) if u > 0 else (rho - u) / (vv + wz)
            # antiderivatives over u and v of the derivatives of 1/rho and of log(z + rho)
            V_z = -np.arctan2(u * v, z * rho)
            V_xx = u * by_v / rho
            V_yy = v * by_u / rho
            chi_xx = np.arctan2(u * v * (rho - z), uu * rho + z * vv)
            chi_yy = np.arctan2(u * v * (rho - z), vv * rho + z * uu)
            xx += q * (2 * nu * V_z - (1 - 2 * nu) * chi_xx - z * V_xx)
            yy += q * (2 * nu * V_z - (1 - 2 * nu) * chi_yy - z * V_yy)
            # V is harmonic: V_zz = -V_xx - V_yy
            zz += q * (V_z + z * (V_xx + V_yy))
            yz -= q * z * z * by_u / rho
            zx -= q * z * z * by_v / rho
            xy -= q * ((1 - 2 * nu) * np.log(z + rho) + z / rho)
        stress[n, 0], stress[n, 1], stress[n, 2] = xx, yy, zz
        stress[n, 3], stress[n, 4], stress[n, 5] = yz, zx, xy
        for c in range(6):
            stress[n, c] /= 2 * np.pi


def stress_maxima(
    load: SurfacePressure, poisson_ratio: float = 0.3
) -> tuple[StressMaximum, StressMaximum]:
    """Largest equivalent stress of von Mises and largest shear stress below the patch.

    Looked for on a grid below the loaded rectangles and then on ever finer ones about the best
    point, at depths from `SHALLOWEST` patch radii down to two. Zeros without pressure.
    """
    on = load.pressure > 0
    if not on.any():
        nothing = StressMaximum(0.0, 0.0, 0.0, 0.0)
        return nothing, nothing
    radius = float(np.sqrt(load.area / np.pi))
    i, j = np.flatnonzero(on.any(axis=1)), np.flatnonzero(on.any(axis=0))
    box = np.array(
        [
            [load.x[i[0]], load.x[i[-1] + 1]],
            [load.y[j[0]], load.y[j[-1] + 1]],
            [SHALLOWEST * radius, 2.0 * radius],
        ]
    )
    coarse = [
        np.linspace(low, high, 2 + int(np.ceil((high - low) / (0.25 * radius))))
        for low, high in box
    ]
    points = np.stack(np.meshgrid(*coarse, indexing="ij"), axis=-1).reshape(-1, 3)
    stress = half_space_stress(load, points, poisson_ratio)
    step = np.array([line[1] - line[0] for line in coarse])
    return tuple(  # type: ignore[return-value]
        _refined(load, of, points[np.argmax(of(stress))], step, box, poisson_ratio)
        for of in (von_mises, maximum_shear)
    )


def _refined(
    load: SurfacePressure,
    of: Callable[[Array], Array],
    centre: Array,
    step: Array,
    box: Array,
    poisson_ratio: float,
) -> StressMaximum:
    """Maximum near a point, on grids of 5^3 points whose step is halved each time."""
    offsets = np.stack(np.meshgrid(*[np.arange(-2, 3)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    for _ in range(6):
        step = 0.5 * step
        points = np.clip(centre + step * offsets, box[:, 0], box[:, 1])
        value = of(half_space_stress(load, points, poisson_ratio))
        best = int(np.argmax(value))
        centre = points[best]
    return StressMaximum(float(value[best]), *(float(c) for c in centre))
