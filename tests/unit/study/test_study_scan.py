"""Scans in a study file: keys, paths, hashes, and the surfaces that the gap is taken from."""

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.loading import load_study
from contactstudy.study.plan import plan_study
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

STUDY = """
[solid]
section = "whole"
contact_half_length = "10 mm"
contact_half_width = "8 mm"
[vehicle]
wheel_radius = "0.46 m"
[scan]
rail = "rail.stl"
rail_unit = "mm"
wheel = "wheel.stl"
wheel_unit = "mm"
[runs.surface]
solver = "surface"
"""
MESHES = {
    "rail": synthetic_scan(rail_curve("60E1"), 0.03, step=2e-3),
    "wheel": synthetic_scan(wheel_curve("S1002"), 0.06, step=2e-3),
}


@pytest.fixture
def folder(tmp_path):
    for name, mesh in MESHES.items():
        trimesh.Trimesh(1e3 * np.asarray(mesh.vertices), mesh.faces, process=False).export(
            tmp_path / f"{name}.stl"
        )
    (tmp_path / "scanned.toml").write_text(STUDY)
    return tmp_path


def test_scans_take_the_place_of_the_drawn_surfaces(folder):
    study = load_study(folder / "scanned.toml")
    assert study.scan.rail == str(folder / "rail.stl")
    scanned = geometry(study)
    unscanned = ["scan.rail=", "scan.wheel=", "scan.rail_unit=", "scan.wheel_unit="]
    drawn = geometry(load_study(folder / "scanned.toml", unscanned))
    assert scanned.rail.residual > 1e-6 and drawn.rail.residual == 0.0
    assert scanned.pose == drawn.pose
    assert scanned.touch.arc == pytest.approx(drawn.touch.arc, abs=1e-3)
    assert scanned.touch.travel == pytest.approx(drawn.touch.travel, abs=3e-6)
    assert build.recipe(study).profile == "60E1"


def test_a_plan_holds_the_content_and_the_residuals(folder, tmp_path):
    study = load_study(folder / "scanned.toml")
    plan = plan_study(study, tmp_path / "out")
    assert {"rail.stl", "wheel.stl"} <= set(plan.inputs.files)
    assert plan.inputs.config["scan"]["rail"] == "rail.stl"
    assert plan.inputs.config["scan"]["rail_residual_rms"] == pytest.approx(2e-6, rel=0.2)
    assert sum("residual" in warning for warning in plan.warnings) == 2
    before = {piece.label: piece.key for piece in plan.pieces}
    mesh = MESHES["rail"]
    shifted = np.asarray(mesh.vertices) + np.array([0.0, 1e-5, 0.0])
    trimesh.Trimesh(1e3 * shifted, mesh.faces, process=False).export(folder / "rail.stl")
    after = {p.label: p.key for p in plan_study(study, tmp_path / "out").pieces}
    assert after["surface"] != before["surface"]


def test_a_hole_under_the_contact_stops_the_plan(folder, tmp_path):
    study = load_study(folder / "scanned.toml")
    s = geometry(study).touch.arc
    mesh = MESHES["rail"]
    y = rail_curve("60E1").point(s)[0]
    away = np.hypot(*(mesh.triangles_center[:, :2] - [0.0, y]).T) > 3e-3
    trimesh.Trimesh(1e3 * mesh.vertices, mesh.faces[away], process=False).export(
        folder / "rail.stl"
    )
    with pytest.raises(InputError, match=r"rail.stl: the contact zone, .* has a hole"):
        plan_study(study, tmp_path / "out")


def test_keys_that_do_not_fit_together():
    with pytest.raises(InputError) as caught:
        parse_study("bad", {"scan": {"rail": "a.stl", "wheel_unit": "mm", "rail_unit": "yard"}})
    assert any("scan.rail_unit" in p for p in caught.value.problems)
    with pytest.raises(InputError) as caught:
        parse_study("bad", {"scan": {"rail": "a.stl", "wheel_unit": "mm"}})
    texts = " ".join(caught.value.problems)
    assert "scan.rail_unit: is missing" in texts and "applies only with scan.wheel" in texts
    assert 'applies only with solid.section = "whole"' in texts


def test_a_file_that_is_not_there(tmp_path):
    study = parse_study(
        "scanned",
        {
            "solid": {"section": "whole"},
            "scan": {"rail": str(Path(tmp_path) / "none.stl"), "rail_unit": "mm"},
            "runs": {"surface": {"solver": "surface"}},
        },
    )
    assert study.wheelset.rail_inclination == pytest.approx(math.atan(1 / 40))
    with pytest.raises(InputError, match=r"scan.rail: .*none.stl: there is no such file"):
        plan_study(study, tmp_path)
