"""Scans in other axes: recognised, refused by the name of the axis, and turned where stated."""

from itertools import permutations, product

import numpy as np
import pytest
import trimesh

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.scans import read_mesh, read_scan
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

MESHES = {
    "rail": synthetic_scan(rail_curve("60E1"), 0.05, step=2e-3),
    "wheel": synthetic_scan(wheel_curve("S1002"), 0.12, step=2e-3),
}
WAYS = {"x": ("along", "back"), "y": ("to field", "to flange"), "z": ("up", "down")}
# (order of the file's axes, their signs)
AXES = [(o, s) for o in permutations(range(3)) for s in product((1, -1), repeat=3)]


def turned(body, order, signs, folder):
    """A scan whose column k is signs[k] times our axis order[k], outward normals kept."""
    mesh = MESHES[body]
    vertices = np.asarray(mesh.vertices)[:, order] * signs
    even = np.linalg.det(np.eye(3)[list(order)] * signs) > 0
    faces = mesh.faces if even else np.asarray(mesh.faces)[:, ::-1]
    path = folder / "scan.ply"
    trimesh.Trimesh(1e3 * vertices, faces, process=False).export(path)
    return path


def stated(order, signs):
    return tuple(
        WAYS["xyz"[axis]][0 if sign > 0 else 1] for axis, sign in zip(order, signs, strict=True)
    )


@pytest.mark.parametrize("body", ["rail", "wheel"])
@pytest.mark.parametrize(("order", "signs"), AXES)
def test_any_axes_are_refused_or_turned(body, order, signs, tmp_path):
    path = turned(body, order, signs, tmp_path)
    mesh = read_mesh(path, "mm", body, stated(order, signs))
    np.testing.assert_allclose(mesh.bounds, MESHES[body].bounds, atol=1e-6)
    # along and back, and the sides of a symmetric rail, cannot be told from each other
    told = (signs[2],) if body == "rail" else signs[1:]
    if order == (0, 1, 2) and all(sign > 0 for sign in told):
        read_mesh(path, "mm", body)
        return
    with pytest.raises(InputError) as caught:
        read_mesh(path, "mm", body)
    if order == (0, 1, 2):
        axis = "z" if signs[2] < 0 else "y"
        assert any(
            f"{axis} points" in p and f"{body}_{axis} = " in p for p in caught.value.problems
        )


def test_stated_axes_give_the_same_surface(tmp_path):
    path = turned("wheel", (1, 0, 2), (-1, 1, -1), tmp_path)
    found = read_scan(path, "mm", "wheel", ways=("to flange", "along", "down"))
    assert found.fit.radius == pytest.approx(0.46, abs=2e-3)
    assert found.fit.rms < 20e-6


def test_a_tape_circle_elsewhere_is_refused(tmp_path):
    path = turned("wheel", (0, 1, 2), (1, 1, 1), tmp_path)
    with pytest.raises(InputError, match=r"flange's tip is at y = .* from the tape circle"):
        read_mesh(path, "mm", "wheel", tape=-0.05)


@pytest.mark.parametrize("body", ["rail", "wheel"])
def test_the_place_of_a_scan_matters_only_by_its_rounding(body, tmp_path):
    """Single precision at 20 m still does; at 30 km points are off by millimetres."""
    mesh = MESHES[body]
    near = read_scan(turned(body, (0, 1, 2), (1, 1, 1), tmp_path), "mm", body)

    def moved(x):
        path = tmp_path / f"far{x}.stl"
        vertices = 1e3 * (np.asarray(mesh.vertices) + np.array([x, 0.0, 0.3 * x]))
        trimesh.Trimesh(vertices, mesh.faces, process=False).export(path)
        return path

    far = read_scan(moved(20.0), "mm", body)
    s = np.linspace(-0.01, 0.01, 21)
    assert far.curve.point(s) == pytest.approx(near.curve.point(s), abs=3e-6)
    with pytest.raises(InputError):
        read_scan(moved(30000.0), "mm", body)
