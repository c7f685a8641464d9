"""The shipped study of the patch, made tiny: every file it promises, and that they are kept."""

import meshio
import numpy as np
import pytest
import xarray as xr
from PIL import Image

from contactstudy import driver
from contactstudy.driver import run_study
from contactstudy.exceptions import InputError
from contactstudy.study.loading import load_study

TINY = (
    "solid.mesh_size=5 mm",
    "solid.coarse_mesh_size=20 mm",
    "solid.cell_length=50 mm",
    "solid.contact_half_length=15 mm",
    "solid.contact_half_width=10 mm",
    "solid.interface_modes=8",
    "solid.internal_modes=0",
    "solid.wheel=rigid",
    "track.length=3.6 m",
    "journey.from=1.8 m",
    "journey.to=1.85 m",
    "journey.time_step=1e-4",
    "journey.fade_in=0",
    "solid.pressure_at=[1.82]",
    "solid.animation_frames=3",
    "solid.animation_span=[1.81, 1.84]",
)


def render(results, out_dir, reporter):
    """Stands for figures and report, which have their own tests."""
    files = [out_dir / "report.pdf", out_dir / "report.html"]
    for file in files:
        file.write_bytes(b"%PDF")
    return files


@pytest.mark.slow
def test_all_files_are_written_and_found_again(tmp_path, monkeypatch):
    monkeypatch.setattr(driver, "render", render)
    study, out = load_study("patch_fields", TINY), tmp_path / "out"
    results = run_study(study, out, workers=1)
    names = ("surface_patch_0.vtu", "surface_below_0.vtu", "surface.pvd")
    files = [out / "fields" / name for name in names] + [out / "figures" / "patch.gif"]
    content = [path.read_bytes() for path in files]
    run = results.runs["surface"]
    below = meshio.read(files[1]).point_data
    assert below["von_mises"].max() == pytest.approx(float(run["von_mises"][0]), rel=0.03)
    status = meshio.read(files[0]).point_data["contact_status"]
    assert 0.9 < status.max() < 1.0 + 1e-9 and status.min() == 0.0
    nodes = meshio.read(files[0])
    x, y = (xr.DataArray(1e3 * at) for at in nodes.points[:, :2].T)
    mapped = run.pressure_map.isel(instant=0).sel(patch_x=x, patch_y=y, method="nearest")
    np.testing.assert_array_equal(mapped.values, nodes.point_data["pressure"])
    with Image.open(files[3]) as image:
        assert image.n_frames == 3
    stored = xr.load_dataset(out / "result.nc", engine="h5netcdf", group="surface")
    np.testing.assert_array_equal(stored["frame_position"], run["frame_position"])
    assert stored["frame_position"].values == pytest.approx([1.81, 1.825, 1.84], abs=5e-3)
    # a lost file is made again, from the stored run, with the same bytes
    files[1].unlink()
    run_study(study, out, workers=1)
    assert [path.read_bytes() for path in files] == content


def test_frames_must_lie_on_the_journey():
    with pytest.raises(InputError) as error:
        load_study("patch_fields", (*TINY[:-1], "solid.animation_span=[1.84, 1.0]"))
    text = str(error.value)
    assert "animation_span.1 = 1" in text and "two increasing positions" in text
