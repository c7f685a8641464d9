"""Fields of the patch on their grid in mm, both halves of a symmetric model."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.solvers.whole_patch import with_maps

X, Y = np.array([-0.002, 0.0, 0.002]), np.array([0.0, 0.001, 0.003])


def field(x, y):
    """Even in y, so that it is the same on both halves."""
    return 1e9 * (x + 0.005) * (1.0 - (y / 0.01) ** 2)


def a_run(y, symmetric):
    gx, gy = np.meshgrid(X, y, indexing="ij")
    at = field(gx, gy).ravel()
    run = xr.Dataset({"pressure": (("instant", "point"), [at, 2 * at], {"units": "Pa"})})
    return run.assign_coords(
        point_x=("point", gx.ravel()),
        point_y=("point", gy.ravel(), {"symmetric": int(symmetric)}),
    )


@pytest.mark.parametrize("half", [True, False])
def test_maps_have_the_field_at_their_coordinates(half):
    whole = np.r_[-Y[:0:-1], Y]
    run = with_maps(a_run(Y if half else whole, half))
    grid = run.pressure_map
    assert grid.dims == ("instant", "patch_x", "patch_y") and grid.units == "Pa"
    assert grid.patch_y.values.tolist() == pytest.approx([-3.0, -1.0, 0.0, 1.0, 3.0])
    assert grid.patch_x.units == grid.patch_y.units == "mm"
    found = grid.isel(instant=1).sel(patch_x=2.0, patch_y=[-3.0, 1.0], method="nearest")
    assert found.values == pytest.approx(2 * field(0.002, np.array([-0.003, 0.001])))
    assert run.pressure.equals(a_run(Y if half else whole, half).pressure)


def test_a_run_without_fields_stays_as_it_is():
    run = xr.Dataset({"contact_force": ("time", [1.0, 2.0])})
    assert with_maps(run) is run
