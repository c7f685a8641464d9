"""Fitted shapes of scans: recovered to the noise, whatever the triangulation and the position."""

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay

from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import fit_cloud
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.scanned_rail import fit_rail_head
from contactstudy.profiles.scanned_wheel import fit_wheel_tread
from contactstudy.scans import read_scan
from contactstudy.verification.cases.synthetic_scan import Standing, synthetic_scan

RAIL, S1002 = rail_curve("60E1"), wheel_curve("S1002")


def arc(rng, n, radius, noise, half=0.02):
    angle = rng.uniform(-half, half, n) / radius
    ring = radius * np.stack([np.sin(angle), np.cos(angle) - 1.0], axis=-1)
    return ring + noise * rng.standard_normal(ring.shape)


def test_circle_through_a_cloud():
    """The curvature of a noisy circle, and the error's fall with the number of points."""
    errors = {}
    for n in (1000, 16000):
        found = []
        for seed in range(4):
            fit = fit_cloud(arc(np.random.default_rng(seed), n, 0.3, 2e-6))
            p = fit.spline(np.linspace(0, fit.length, 200))
            found.append(np.hypot(p[:, 0], p[:, 1] + 0.3) - 0.3)
            assert fit.scatter == pytest.approx(2e-6, rel=0.1)
            assert fit.length == pytest.approx(0.04, abs=2e-4)
            second = fit.spline(np.linspace(0.004, fit.length - 0.004, 50), 2)
            assert np.abs(np.linalg.norm(second, axis=1) - 1 / 0.3).max() < 0.1 / 0.3
        errors[n] = np.sqrt(np.mean(np.square(found)))
    # 16 times the points: a quarter of the error of a least-squares fit
    assert errors[1000] / errors[16000] == pytest.approx(4.0, rel=0.5)
    assert errors[16000] < 0.2e-6


def test_knots_are_few_where_the_curve_is_smooth():
    rng = np.random.default_rng(0)
    straight = fit_cloud(arc(rng, 4000, 10.0, 2e-6))
    assert len(straight.knots) <= 4
    cornered = np.concatenate([arc(rng, 4000, 0.3, 2e-6), [[0.0, 0.0]]])
    right = cornered[:, 0] > 0.01
    cornered[right, 1] -= 25.0 * (cornered[right, 0] - 0.01) ** 2
    assert len(fit_cloud(cornered).knots) > len(straight.knots)


def test_curve_without_noise_in_single_precision():
    """CAD surfaces: nodes on two sections only, exact but for their single precision."""
    s = np.linspace(-0.035, 0.035, 141)
    points = np.repeat(RAIL.point(s), 2, axis=0).astype(np.float32).astype(float)
    fit = fit_cloud(points)
    assert fit.rms < 0.5e-6
    _, error = RAIL.project(fit.spline(np.linspace(0, fit.length, 500)))
    assert np.abs(error).max() < 3e-6


@pytest.mark.parametrize(
    ("yaw", "pitch", "shift", "seed"), [(0.02, 0.01, 0.05, 1), (-0.003, -0.02, -0.03, 2)]
)
def test_a_rail_in_any_position(yaw, pitch, shift, seed):
    at = (10 * shift, 0.3 * shift, shift)
    mesh = synthetic_scan(RAIL, 0.04, seed, step=2e-3, standing=Standing(yaw, pitch, at))
    fit = fit_rail_head(mesh.vertices, mesh.vertex_normals, middle=at[1])
    # 2 um over some 0.02 m and thousands of points
    assert fit.angles["yaw"] == pytest.approx(yaw, abs=1e-5)
    assert fit.angles["pitch"] == pytest.approx(pitch, abs=1e-5)
    assert fit.rms == pytest.approx(2e-6, rel=0.1)
    s = np.linspace(-0.03, 0.03, 121)
    # the middle plane was given half way along the scan, whose ends are a step uncertain
    beside = fit.origin[1] - at[1] - np.tan(yaw) * (fit.origin[0] - at[0])
    _, error = RAIL.project(fit.curve.point(s) + np.array([beside, 0.0]))
    assert np.sqrt(np.mean(error**2)) < 2e-6  # the noise
    assert fit.curve.point(0.0) == pytest.approx([0.0, 0.0], abs=1e-12)
    moved = fit.aligned(mesh.vertices)
    moved = moved[np.abs(moved[:, 1]) < 0.03]
    _, distance = fit.curve.project(moved[:, 1:])
    assert np.sqrt(np.mean(distance**2)) == pytest.approx(fit.rms, rel=0.1)


@pytest.mark.parametrize(("radius", "yaw", "half"), [(0.46, 4e-3, 0.06), (0.43, -0.01, 0.1)])
def test_a_wheel_in_any_position(radius, yaw, half):
    at = (0.3, -0.02, 0.1)
    mesh = synthetic_scan(S1002, half, 3, 2e-3, radius, Standing(yaw, at=at))
    fit = fit_wheel_tread(mesh.vertices, mesh.vertex_normals, tape=at[1])
    assert fit.radius_error < 5e-5
    assert abs(fit.radius - radius) < 4 * fit.radius_error
    assert fit.angles["yaw"] == pytest.approx(yaw, abs=2e-5)
    np.testing.assert_allclose(fit.origin, at, atol=2e-5)
    s = np.linspace(-0.05, 0.05, 201)
    _, error = S1002.project(fit.curve.point(s))
    assert np.sqrt(np.mean(error**2)) < 2e-6  # the noise
    assert not fit.curve.upper


def test_a_whole_wheel():
    """All round, with the tread's facets among others."""
    s = np.linspace(-0.05, 0.055, 50)
    ring = np.stack([S1002.point(s)[:, 0], 0.46 - S1002.point(s)[:, 1]], axis=-1)
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    y = np.tile(ring[:, 0], (len(angle), 1))
    points = np.stack(
        [ring[:, 1] * np.sin(angle)[:, None], y, -ring[:, 1] * np.cos(angle)[:, None]], axis=-1
    )
    n = S1002.normal(s)
    normals = np.stack(
        [-n[:, 1] * np.sin(angle)[:, None], 0 * y + n[:, 0], n[:, 1] * np.cos(angle)[:, None]], -1
    )
    fit = fit_wheel_tread(points.reshape(-1, 3), normals.reshape(-1, 3))
    assert fit.radius == pytest.approx(0.46, abs=1e-6)
    np.testing.assert_allclose(fit.origin, [0, 0, -0.46], atol=1e-6)


def test_irregular_and_decimated_triangulations(tmp_path):
    """A fine scan and every tenth of its vertices, triangulated anew, give the same curve."""
    rng = np.random.default_rng(5)
    fine = synthetic_scan(RAIL, 0.03, 7, step=1e-3)
    inner = np.abs(fine.vertices[:, 1]) < 0.03
    part = fine.vertices[inner][rng.permutation(inner.sum())[: inner.sum() // 10]]
    faces = Delaunay(part[:, :2]).simplices
    coarse = trimesh.Trimesh(part, faces, process=False)
    if coarse.face_normals[:, 2].mean() < 0:
        coarse.invert()
    s = np.linspace(-0.02, 0.02, 81)
    for mesh, bound in ((fine, 1e-6), (coarse, 3e-6)):
        mesh.export(tmp_path / "rail.ply")
        scan = read_scan(tmp_path / "rail.ply", "m", "rail", residual_limit=5e-6)
        _, error = RAIL.project(scan.curve.point(s))
        assert np.sqrt(np.mean(error**2)) < bound
        assert "residual" in scan.summary()


def test_what_is_not_prismatic_is_reported_or_refused(tmp_path):
    mesh = synthetic_scan(RAIL, 0.05, step=2e-3)
    vertices = np.array(mesh.vertices)
    # a wave of 0.2 mm along the rail: 141 um rms
    vertices[:, 2] += 2e-4 * np.sin(2 * np.pi * vertices[:, 0] / 0.05)
    trimesh.Trimesh(vertices, mesh.faces, process=False).export(tmp_path / "wavy.ply")
    with pytest.raises(InputError, match="not prismatic within 100 um: the residual") as caught:
        read_scan(tmp_path / "wavy.ply", "m", "rail")
    assert "scatter from point to point" in str(caught.value)
    scan = read_scan(tmp_path / "wavy.ply", "m", "rail", residual_limit=2e-4)
    assert 9e-5 < scan.fit.rms < 1.5e-4 and scan.fit.largest > 1.5e-4


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda v: v[:, [1, 0, 2]], "must run along X"),
        (lambda v: v + np.array([0, 0.2, 0]), r"middle plane is .* beyond"),
        (lambda v: v[200:212], "6 points on the running surface"),
        (lambda v: v[:5], "no facet faces upwards"),
    ],
)
def test_points_that_are_no_rail_head(change, message):
    mesh = synthetic_scan(RAIL, 0.05, step=4e-3)
    normals = np.array(mesh.vertex_normals)
    if "along X" in message:
        normals = normals[:, [1, 0, 2]]
    vertices = change(np.array(mesh.vertices))
    with pytest.raises(InputError, match=message):
        fit_rail_head(vertices, normals[: len(vertices)])


def test_points_that_are_no_tread():
    rail = synthetic_scan(RAIL, 0.05, step=4e-3)
    with pytest.raises(InputError, match=r"too little of its circumference|away from the axle"):
        fit_wheel_tread(rail.vertices, -rail.vertex_normals)
