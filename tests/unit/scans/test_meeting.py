"""Holes under the contact, first touch of scans, and the table [scan]."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.exceptions import InputError
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.smooth_touch import smooth_touch
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.scanned_rail import fit_rail_head
from contactstudy.profiles.scanned_wheel import fit_wheel_tread
from contactstudy.scans import Scan, meeting, uncovered
from contactstudy.scans.scan import developed
from contactstudy.study.kinds.passage.scan import ScanFiles
from contactstudy.validation import read
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

RAIL, S1002 = rail_curve("60E1"), wheel_curve("S1002")
RADIUS, POSE = 0.46, Pose(math.atan(1 / 40))


def as_scan(body, mesh):
    fit_body = fit_rail_head if body == "rail" else fit_wheel_tread
    fit = fit_body(mesh.vertices, mesh.vertex_normals)
    moved = trimesh.Trimesh(fit.aligned(mesh.vertices), mesh.faces, process=False)
    return Scan(f"{body}.stl", body, moved, fit)


MESHES = {
    "rail": synthetic_scan(RAIL, 0.03, step=2e-3),
    "wheel": synthetic_scan(S1002, 0.05, step=2e-3),
}
SCANS = {body: as_scan(body, mesh) for body, mesh in MESHES.items()}


def without(scan, faces):
    kept = np.delete(np.asarray(scan.mesh.faces), faces, axis=0)
    mesh = trimesh.Trimesh(scan.mesh.vertices, kept, process=False)
    return Scan(scan.name, scan.body, mesh, scan.fit)


@given(
    body=st.sampled_from(["rail", "wheel"]),
    seed=st.integers(0, 10**6),
    x=st.floats(-0.01, 0.01),
    s=st.floats(-0.02, 0.02),
    half=st.tuples(st.floats(2e-3, 8e-3), st.floats(2e-3, 8e-3)),
)
@settings(max_examples=15)
def test_holes_are_found_where_they_are(body, seed, x, s, half):
    """Against points of the zone, each looked for in every triangle."""
    rng = np.random.default_rng(seed)
    scan = SCANS[body]
    where = rng.integers(0, len(scan.mesh.faces), 40)
    holed = without(scan, where)
    u, v, _ = developed(scan, np.asarray(scan.mesh.vertices))
    plan = np.stack([u, v], axis=-1)[np.asarray(holed.mesh.faces)]
    points = np.array([x, s]) + np.array(half) * rng.uniform(-0.999, 0.999, (60, 2))
    edges = np.roll(plan, -1, axis=1) - plan
    off = points[:, None, None] - plan
    turn = edges[..., 0] * off[..., 1] - edges[..., 1] * off[..., 0]
    covered = (np.all(turn >= 0, axis=2) | np.all(turn <= 0, axis=2)).any(axis=1)
    message = uncovered(holed, x, s, *half)
    if not covered.all():
        assert "hole" in message and scan.name in message
    else:
        # a hole may reach into a corner of the zone that no point has hit
        gone = plan_of(scan, where, u, v)
        near = np.all(np.abs(gone - [x, s]) <= np.array(half) + 4e-3, axis=2).any()
        assert not message or near
    assert uncovered(scan, x, s, *half) == ""


def plan_of(scan, faces, u, v):
    return np.stack([u, v], axis=-1)[np.asarray(scan.mesh.faces)[faces]]


def test_a_zone_beyond_the_scan():
    assert "cut off by the scan's edge" in uncovered(SCANS["rail"], 0.028, 0.0, 5e-3, 5e-3)
    assert "is not covered" in uncovered(SCANS["rail"], 0.2, 0.0, 5e-3, 5e-3)


@pytest.mark.parametrize("scanned", [("rail",), ("wheel",), ("rail", "wheel")])
def test_scans_touch_where_the_profiles_do(scanned):
    exact = smooth_touch(PlacedWheel(S1002, RADIUS, POSE), RAIL)
    bodies = [SCANS[b] if b in scanned else c for b, c in (("rail", RAIL), ("wheel", S1002))]
    found = meeting(*bodies, RADIUS, POSE, 0.01, 0.006)
    assert found.smooth.travel == pytest.approx(exact.travel, abs=3e-6)
    assert found.smooth.arc == pytest.approx(exact.arc, abs=1e-3)
    # noise brings facets together sooner, sagittas of 2 mm later
    assert abs(found.difference) < 15e-6


def test_a_hole_under_the_contact_is_an_error():
    touch = smooth_touch(PlacedWheel(S1002, RADIUS, POSE), RAIL)
    for body, x, s in (("rail", touch.x, touch.arc), ("wheel", touch.wheel_x, touch.wheel_s)):
        scan = SCANS[body]
        u, v, d = developed(scan, np.asarray(scan.mesh.triangles_center))
        hole = (np.hypot(u - x, v - s) < 3e-3) & (np.abs(d) < 1e-3)
        bodies = {"rail": RAIL, "wheel": S1002} | {body: without(scan, np.flatnonzero(hole))}
        with pytest.raises(InputError, match=f"{body}.stl: .*has a hole in the scan"):
            meeting(bodies["rail"], bodies["wheel"], RADIUS, POSE, 0.01, 0.006)


def test_bodies_that_never_touch():
    beside = Pose(0.0, -0.0999)
    with pytest.raises(InputError, match="first touch"):
        meeting(SCANS["rail"], SCANS["wheel"], RADIUS, beside, 0.01, 0.006)


def test_table_of_the_study_file(tmp_path):
    for body, mesh in MESHES.items():
        mesh.export(tmp_path / f"{body}.ply")
    keys = {"rail": str(tmp_path / "rail.ply"), "wheel": str(tmp_path / "wheel.ply")}
    missing = read(ScanFiles, keys, "scan")[1]
    assert [p.split(":")[0] for p in missing] == ["scan.rail_unit", "scan.wheel_unit"]
    alone = {"wheel_unit": "mm", "rail_middle": 1.0, "smoothing": 1e-3}
    assert len(read(ScanFiles, alone, "scan")[1]) == 3
    table = ScanFiles(**keys, rail_unit="m", wheel_unit="m")
    assert table.used
    rail, wheel = table.curves(RAIL, S1002)
    assert rail.residual == pytest.approx(2e-6, rel=0.2) and rail.upper and not wheel.upper
    assert set(table.fitted()) >= {"rail_residual_rms", "wheel_residual_largest"}
    found = table.touch(RAIL, S1002, RADIUS, POSE, 0.01, 0.006)
    exact = smooth_touch(PlacedWheel(S1002, RADIUS, POSE), RAIL)
    assert found.smooth.travel == pytest.approx(exact.travel, abs=3e-6)
    with pytest.raises(InputError, match=r"wheel_radius = 0.43 m: the scan wheel.ply has 0.46"):
        table.touch(RAIL, S1002, 0.43, POSE, 0.01, 0.006)
    wrong = ScanFiles(**keys, rail_unit="mm", wheel_unit="in")
    with pytest.raises(InputError) as caught:
        wrong.surfaces()
    assert [p.split(":")[0] for p in caught.value.problems] == ["scan.rail", "scan.wheel"]
    assert ScanFiles().curves(RAIL, S1002) == (RAIL, S1002)
