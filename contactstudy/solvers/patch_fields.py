"""Fields on the wheel's tread nodes: pressure, gap, contact status, and the stress below them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.surface_coupling import SurfaceCoupling
from contactstudy.dynamics.stepper import Coupling
from contactstudy.exceptions import InputError
from contactstudy.geometry.points import ContactPoints
from contactstudy.halfspace.pressure_field import SurfacePressure, recovered_pressure
from contactstudy.halfspace.subsurface import StressMaximum, stress_maxima

if TYPE_CHECKING:
    import xarray as xr

_STATUS = "contact status: part of the node's area whose points are in contact, 0 open, 1 closed"
_INVARIANTS = {
    "von_mises": "largest equivalent stress of von Mises below the patch",
    "maximum_shear": "largest shear stress below the patch",
}


def surface_of(coupling: Coupling) -> SurfaceCoupling:
    """The coupling of a run whose patch is to be watched.

    Raises
    ------
    InputError
        If it is no surface contact.
    """
    if not isinstance(coupling, SurfaceCoupling):
        raise InputError("fields of the patch: only surface contact has them, point contact none")
    return coupling


def node_coordinates(points: ContactPoints) -> dict[str, xr.Variable]:
    """Positions and areas of the tread nodes, dimension `point`."""
    x, y = np.meshgrid(points.wheel_x, points.wheel_y, indexing="ij")
    tread = points.wheel_rows.matrix(x.size)
    halves = ", of both halves" if points.symmetric else ""
    along_tread = "position across, by arc length on the wheel's tread from the tape circle"
    text = "position across the rail" if points.symmetric else along_tread
    across = _variable(("point",), y.ravel(), "m", text)
    across.attrs["symmetric"] = int(points.symmetric)
    return {
        "point_x": _variable(("point",), x.ravel(), "m", "position relative to the wheel"),
        "point_y": across,
        "point_area": _variable(("point",), tread.T @ points.area, "m^2", f"area{halves}"),
    }


def node_fields(
    points: ContactPoints, forces: Sequence[Array], gaps: Sequence[Array], dim: str
) -> dict[str, xr.Variable]:
    """Pressure, gap and contact status at the tread nodes.

    Parameters
    ----------
    forces, gaps : sequence of ndarray (nx*ny,)
        Normal forces in N and gaps in m at the contact points, one entry an instant.

    Returns
    -------
    dict of str to xarray.Variable
        `pressure`, `gap`, `contact_status`, each (dim, point).
    """
    tread = points.wheel_rows.matrix(len(points.wheel_x) * len(points.wheel_y))
    weight = tread.T * points.area
    weight = weight / weight.sum(axis=1, keepdims=True)
    pressure = [points.nodal_pressure(f) for f in forces]
    return {
        "pressure": _variable(
            (dim, "point"), pressure, "Pa", "contact pressure at the wheel's tread nodes"
        ),
        "gap": _variable(
            (dim, "point"),
            [weight @ g for g in gaps],
            "m",
            "gap at the wheel's tread nodes, negative: penetration",
        ),
        "contact_status": _variable(
            (dim, "point"), [np.minimum(weight @ (f > 0), 1.0) for f in forces], "1", _STATUS
        ),
    }


def point_fields(
    points: ContactPoints, forces: Sequence[Array], dim: str
) -> dict[str, xr.Variable]:
    """Pressure at the contact points themselves, and where these are.

    Four Gauss points a facet cannot all follow the nodes, so single ones inside the patch are
    open: their pressures scatter about the nodes', and show which of them touch.

    Returns
    -------
    dict of str to xarray.Variable
        `contact_pressure` (dim, contact_point), `contact_x` and `contact_y` (contact_point,).
    """
    at, where = ("contact_point",), "of the contact points"
    x, y = np.meshgrid(points.wheel_x, points.wheel_y, indexing="ij")
    rows = points.wheel_rows.matrix(x.size)  # positions as those of the nodes are given
    return {
        "contact_x": _variable(at, rows @ x.ravel(), "m", f"point_x {where}"),
        "contact_y": _variable(at, rows @ y.ravel(), "m", f"point_y {where}"),
        "contact_pressure": _variable(
            (dim, *at), [f / points.area for f in forces], "Pa", f"pressure {where}"
        ),
    }


def pressure_below(x: Array, y: Array, nodal: Array, symmetric: bool) -> SurfacePressure:
    """Pressure on the whole patch, laid out flat, from values (mx*my,) [Pa] at tread nodes.

    Of a symmetric model only y >= 0 is given; the other half is put back.
    """
    grid = np.asarray(nodal).reshape(len(x), len(y))
    if symmetric:
        y, grid = np.r_[-y[:0:-1], y], np.hstack([grid[:, :0:-1], grid])
    return recovered_pressure(x, y, grid)


def instant_pressure(run: xr.Dataset, instant: int) -> SurfacePressure:
    """Pressure on the whole patch of a run with `pressure` at one of its instants."""
    x, y = (np.unique(np.asarray(run[name].values)) for name in ("point_x", "point_y"))
    nodal = np.asarray(run["pressure"].transpose("instant", "point").values)[instant]
    symmetric = bool(run["point_y"].attrs.get("symmetric", y[0] >= -1e-9))
    return pressure_below(x, y, nodal, symmetric)


def stress_variables(
    points: ContactPoints, pressure: Array, poisson_ratio: float, dim: str
) -> dict[str, xr.Variable]:
    """Largest stresses below the patch and where they are, for nodal pressures (k, nodes) [Pa].

    They are those of an elastic half-space under the pressure of the nodes, see
    `contactstudy.halfspace.subsurface`: the stresses of bending and support are left out. The
    position across the rail is counted along its surface.

    Returns
    -------
    dict of str to xarray.Variable
        `von_mises` and `maximum_shear` with `_depth`, `_x` and `_y`, each (dim,); NaN for the
        place where there is no contact.
    """
    found: dict[str, list[StressMaximum]] = {name: [] for name in _INVARIANTS}
    for nodal in pressure:
        load = pressure_below(points.wheel_x, points.wheel_y, nodal, points.symmetric)
        for name, one in zip(_INVARIANTS, stress_maxima(load, poisson_ratio), strict=True):
            found[name].append(one)
    made = {}
    for name, text in _INVARIANTS.items():
        some = found[name]
        made[name] = _variable((dim,), [m.value for m in some], "Pa", text)
        made[name].attrs["poisson_ratio"] = poisson_ratio
        for part, where in (("depth", "depth"), ("x", "x"), ("y", "y")):
            at = [getattr(m, part) if m.value > 0 else np.nan for m in some]
            made[f"{name}_{part}"] = _variable((dim,), at, "m", f"{where} of the {text}")
    return made


def _variable(dims: tuple[str, ...], values: object, unit: str, text: str) -> xr.Variable:
    import xarray as xr

    return xr.Variable(dims, np.asarray(values), {"units": unit, "long_name": text})
