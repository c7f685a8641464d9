"""The labelled result of one run, the same for both solvers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.solvers.journey import Journey

if TYPE_CHECKING:
    import xarray as xr

SIGNALS: dict[str, tuple[str, str]] = {
    "contact_force": ("N", "contact force, positive in compression"),
    "wheel_displacement": ("m", "vertical displacement of the wheel, up"),
    "wheel_acceleration": ("m/s^2", "vertical acceleration of the wheel, up"),
    "rail_displacement": ("m", "displacement of the rail's centre line at the wheel, up"),
    "rail_acceleration": (
        "m/s^2",
        "vertical acceleration of the point of the rail's centre line under the wheel, up",
    ),
    "rail_lateral": (
        "m",
        "lateral displacement of the rail under the wheel, of its section or its head",
    ),
    "rail_roll": ("rad", "roll of the rail's section under the wheel"),
    "irregularity": ("m", "irregularity under the wheel, faded in, up"),
    "lateral_force": ("N", "lateral force of the wheel on the rail, to the left of +X"),
    "wheel_lateral": ("m", "lateral displacement of the tread, to the left of +X"),
    "wheel_lateral_acceleration": ("m/s^2", "lateral acceleration of the tread"),
    "rail_lateral_acceleration": ("m/s^2", "lateral acceleration of the rail's head"),
    "lateral_irregularity": ("m", "lateral irregularity at the wheel, to the left of +X"),
    "contact_area": ("m^2", "contact area, from the gap around the patch"),
    "patch_count": ("1", "number of separate patches"),
    "largest_patch_share": ("1", "share of the normal forces on the patch that carries most"),
    "semi_axis_along": ("m", "semi-axis of that patch along the rail, from second moments"),
    "semi_axis_across": ("m", "semi-axis of that patch across the rail, from second moments"),
    "peak_pressure": ("Pa", "largest contact pressure"),
    "penetration": ("m", "largest penetration left by the penalty"),
}
"""Unit and description of every history that a solver may record."""

POINT_SIGNALS = (
    "contact_force", "wheel_displacement", "wheel_acceleration", "rail_displacement",
    "rail_acceleration", "irregularity",
)  # fmt: skip
"""Those of them that every run with one wheel records."""
SURFACE_SIGNALS = (
    "contact_area", "patch_count", "largest_patch_share", "semi_axis_along", "semi_axis_across",
    "peak_pressure", "penetration",
)  # fmt: skip
"""Those that surface contact records beside them."""
SECTION_SIGNALS = ("rail_lateral", "rail_roll")
"""Those that only a whole section has."""


def history_dataset(
    journey: Journey,
    positions: Array,
    histories: Mapping[str, Array],
    *,
    station_displacement: Array | None = None,
    attrs: Mapping[str, object] | None = None,
) -> xr.Dataset:
    """Label the histories of a run.

    Parameters
    ----------
    positions : ndarray
        (n_times, n_wheels) X of the wheels [m].
    histories : mapping
        Name in `SIGNALS` to (n_times,) or (n_times, n_wheels).
    station_displacement : ndarray, optional
        (n_times, n_stations) rail displacement at the journey's stations [m].

    Returns
    -------
    xarray.Dataset
        Dimension `time` [s] and, with several wheels, a leading `wheel`; coordinate `position`.
    """
    import xarray as xr

    one_wheel = positions.shape[1] == 1

    def variable(values: Array, unit: str, text: str) -> xr.Variable:
        attributes = {"units": unit, "long_name": text}
        values = np.asarray(values)
        if values.ndim == 1:
            return xr.Variable(("time",), values, attributes)
        if one_wheel:
            return xr.Variable(("time",), values[:, 0], attributes)
        return xr.Variable(("wheel", "time"), np.ascontiguousarray(values.T), attributes)

    data = {
        name: variable(values, *SIGNALS.get(name, ("", name.replace("_", " "))))
        for name, values in histories.items()
    }
    coords = {
        "time": xr.Variable(("time",), journey.times, {"units": "s", "long_name": "time"}),
        "position": variable(positions, "m", "position of the wheel along the rail"),
    }
    if not one_wheel:
        coords["wheel"] = xr.Variable(("wheel",), np.arange(positions.shape[1]))
    if station_displacement is not None and len(journey.stations):
        data["station_displacement"] = xr.Variable(
            ("station", "time"),
            np.ascontiguousarray(station_displacement.T),
            {"units": "m", "long_name": "displacement of the rail's centre line, up"},
        )
        coords["station"] = xr.Variable(
            ("station",),
            np.asarray(journey.stations),
            {"units": "m", "long_name": "position along the rail"},
        )
    return xr.Dataset(data, coords, dict(attrs or {}))
