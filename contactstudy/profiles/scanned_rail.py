"""Smooth rail heads fitted to scanned surfaces: prisms along a direction near X."""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import fit_cloud
from contactstudy.profiles.scan_fit import (
    ROUNDS,
    SETTLED,
    STEEPEST,
    ScanFit,
    curve_of,
    part_of,
    regressed,
    scan_fit,
)

RAIL_DEPTH = 0.03
"""Depth below the top of the rail [m] down to which a scan is used."""


def fit_rail_head(
    points: Array, normals: Array, middle: float = 0.0, shortest: float = 1e-3, name: str = "rail"
) -> ScanFit:
    """Prism near X through points (n, 3) of a scanned rail head with outward unit normals.

    X along the rail, Y to the field side, Z up [m]; `middle` is Y of the rail's middle plane, half
    way along the scan, `shortest` the least distance of the curve's knots [m].

    Raises
    ------
    InputError
        If the points do not show a running surface around its middle plane.
    """
    p, n = np.asarray(points, dtype=float), np.asarray(normals, dtype=float)
    top = p[n[:, 2] > np.cos(STEEPEST), 2].max(initial=-np.inf)
    used = (n[:, 2] > np.cos(STEEPEST)) & (p[:, 2] > top - RAIL_DEPTH)
    p, n = p[used], n[used]
    if not len(p):
        raise InputError(f"{name}: no facet faces upwards; a rail head's running surface is needed")
    centre = np.array([0.5 * (p[:, 0].min() + p[:, 0].max()), middle, 0.0])
    # normals of a prism are square to its direction
    direction = np.linalg.eigh(n.T @ n)[1][:, 0]
    direction = direction * np.copysign(1.0, direction[0])
    if direction[0] < 0.9:
        raise InputError(
            f"{name}: the surface runs along ({direction[0]:.2f}, {direction[1]:.2f}, "
            f"{direction[2]:.2f}); a rail head must run along X"
        )
    angles = np.array([np.arctan2(direction[1], direction[0]), np.arcsin(direction[2])])
    part = part_of(len(p))
    for _ in range(ROUNDS):
        q = (p[part] - centre) @ _rail_axes(angles).T
        fit = fit_cloud(q[:, 1:], shortest, name, all_knots=True)
        # a turn d of the direction moves a point by -x (d_yaw, d_pitch), r by -x d.n
        change, _ = regressed(fit, q[:, :1] * fit.normal)
        angles = angles + change
        if np.abs(change).max() < SETTLED:
            break
    axes = _rail_axes(angles)
    fit = fit_cloud(((p - centre) @ axes.T)[:, 1:], shortest, name)
    curve, shift = curve_of(fit, True, name)
    origin = centre + shift @ axes
    turned = {"yaw": float(angles[0]), "pitch": float(angles[1])}
    return scan_fit(fit, curve, axes, origin, turned, np.inf, 0.0)


def _rail_axes(angles: Array) -> Array:
    """Rows: the direction (yaw, pitch), the horizontal across it, and up."""
    c, s = np.cos(angles), np.sin(angles)
    along = np.array([c[0] * c[1], s[0] * c[1], s[1]])
    across = np.array([-s[0], c[0], 0.0])
    return np.stack([along, across, np.cross(along, across)])
