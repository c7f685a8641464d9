"""VTU files of the patch and of the body below: content, orientation, equal bytes."""

import meshio
import numpy as np
import pytest
import xarray as xr

from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.solvers.patch_fields import node_coordinates, node_fields, stress_variables
from contactstudy.study.kinds.passage import fields
from contactstudy.study.kinds.passage.fields import body_mesh, patch_mesh, write_fields
from contactstudy.study.results import StudyResults

A, B, P0 = 6e-3, 5e-3, 1e9


@pytest.fixture(scope="module")
def run():
    """Hertz's pressure on the contact points of a centred wheel, then nothing."""
    x, y = 2e-3 * np.arange(-6, 7), 2e-3 * np.arange(5)
    bodies = Geometry(rail_curve("60E1"), wheel_curve("cylinder"), 0.43)
    points = contact_points(bodies, x, y, symmetric=True)
    inside = 1 - (points.x_of_points / A) ** 2 - (points.y_of_points / B) ** 2
    forces = P0 * np.sqrt(np.maximum(inside, 0)) * points.area
    both, gaps = [forces, 0 * forces], [-1e-8 * (forces > 0), 1e-5 + 0 * forces]
    kept = node_fields(points, both, gaps, "instant")
    stresses = stress_variables(points, kept["pressure"].values, 0.3, "instant")
    data = xr.Dataset(kept | stresses, attrs={"force": forces.sum()})
    return data.assign_coords(
        instant_time=("instant", [0.1, 0.2]),
        instant_position=("instant", [3.0, 4.0]),
        **node_coordinates(points),
    )


def study(run):
    return StudyResults("s", "", "", {}, {}, {"surface": run, "beam": xr.Dataset()}, None, {})


def test_stress_maxima_of_the_dataset(run):
    # b/a = 0.83: 0.316 p0 at about 0.53 b (Johnson, table 4.1); 2 mm mesh
    shear = run["maximum_shear"]
    assert float(shear[0]) == pytest.approx(0.316 * P0, rel=0.03)
    assert float(run["maximum_shear_depth"][0]) == pytest.approx(0.53 * B, rel=0.08)
    assert float(run["von_mises"][0]) == pytest.approx(2 * 0.316 * P0, rel=0.04)
    assert abs(float(run["maximum_shear_y"][0])) < 1e-3
    assert float(shear[1]) == 0.0 and np.isnan(run["maximum_shear_depth"][1])
    for name, variable in run.variables.items():
        if name.startswith(("von", "max", "pressure", "gap", "contact")):
            assert variable.attrs["units"] and variable.attrs["long_name"]


def test_patch(run):
    mesh = patch_mesh(run, 0)
    assert len(mesh.points) == 13 * 9 and len(mesh.cells[0].data) == 12 * 8
    x, y, z = mesh.points.T
    assert not z.any() and y.min() == -y.max()
    status = mesh.point_data["contact_status"]
    assert status[np.hypot(x, y) < 3e-3].min() == pytest.approx(1.0, abs=1e-15)
    assert not status[np.hypot(x, y) > 9e-3].any()
    assert mesh.point_data["penetration"].max() == pytest.approx(1e-8)
    total = run["point_area"].values @ run["pressure"].values[0]
    assert total == pytest.approx(run.attrs["force"], rel=1e-12)


def test_body(run):
    mesh = body_mesh(run, 0)
    X = mesh.points[mesh.cells[0].data]
    e = [X[:, k] - X[:, 0] for k in (1, 3, 4)]
    assert np.all(np.einsum("mi,mi->m", np.cross(e[0], e[1]), e[2]) > 0)
    assert mesh.points[:, 2].max() < 0
    data = mesh.point_data
    assert data["maximum_shear"].max() == pytest.approx(float(run["maximum_shear"][0]), rel=0.01)
    # below the load the material is in compression, and shear pulls towards the axis:
    # s_zx has the sign of x with z up, tau_xz = -3 P x z^2/(2 pi rho^5) with z down
    x, y, z = mesh.points.T
    s = data["stress"]
    near = (np.abs(y) < 1e-3) & (x > 3e-3) & (x < 6e-3) & (z < -3e-3) & (z > -8e-3)
    assert s[near, 2].max() < 0 and s[near, 5].min() > 0
    assert body_mesh(run, 1) is None


def test_files(run, tmp_path, monkeypatch):
    monkeypatch.setattr(fields, "_STEP", 0.3)
    files = write_fields(study(run), tmp_path / "a")
    again = write_fields(study(run), tmp_path / "b")
    names = [p.relative_to(tmp_path / "a").as_posix() for p in files]
    assert names == [
        "fields/surface_patch_0.vtu",
        "fields/surface_below_0.vtu",
        "fields/surface_patch_1.vtu",
        "fields/surface.pvd",
    ]
    assert [p.read_bytes() for p in files] == [p.read_bytes() for p in again]
    read = meshio.read(files[1])
    np.testing.assert_array_equal(read.point_data["stress"], body_mesh(run, 0).point_data["stress"])
    text = files[-1].read_text()
    assert text.count("<DataSet") == 3 and 'timestep="0.2"' in text
    assert sorted(p.name for p in (tmp_path / "a").rglob("*.*")) == sorted(p.name for p in files)
