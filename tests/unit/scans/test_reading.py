"""Scan files: formats, units, and every fault with its message, all at once."""

import builtins
import io

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.scans import read_mesh, read_scan
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

RAIL = synthetic_scan(rail_curve("60E1"), 0.02, step=2e-3)
WHEEL = synthetic_scan(wheel_curve("S1002"), 0.04, step=2e-3)


def written(tmp_path, mesh, unit=1e-3, name="scan.stl"):
    copy = trimesh.Trimesh(np.asarray(mesh.vertices) / unit, mesh.faces, process=False)
    copy.export(tmp_path / name)
    return tmp_path / name


def changed(mesh, faces=None, vertices=None):
    return trimesh.Trimesh(
        mesh.vertices if vertices is None else vertices,
        mesh.faces if faces is None else faces,
        process=False,
    )


def problems_of(call, *arguments):
    with pytest.raises(InputError) as caught:
        call(*arguments)
    return caught.value.problems


@pytest.mark.parametrize("suffix", ["stl", "ply", "obj"])
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_formats_and_units(tmp_path, suffix, unit):
    factor = {"mm": 1e-3, "m": 1.0}[unit]
    path = written(tmp_path, RAIL, factor, f"rail.{suffix}")
    mesh = read_mesh(path, unit, "rail")
    assert mesh.faces.shape == RAIL.faces.shape and len(mesh.vertices) == len(RAIL.vertices)
    # single precision, or the digits of a text
    np.testing.assert_allclose(mesh.bounds, RAIL.bounds, atol=1e-8)
    assert mesh.area == pytest.approx(RAIL.area, rel=1e-6)


def test_text_stl_and_several_parts(tmp_path):
    first, second = RAIL.faces[:500], RAIL.faces[500:]
    scene = trimesh.Scene([changed(RAIL, f) for f in (first, second)])
    scene.export(tmp_path / "parts.obj")
    whole = read_mesh(tmp_path / "parts.obj", "m", "rail")
    assert len(whole.faces) == len(RAIL.faces) and len(whole.vertices) == len(RAIL.vertices)
    RAIL.export(tmp_path / "text.stl", file_type="stl_ascii")
    text = read_mesh(tmp_path / "text.stl", "m", "rail")
    assert len(text.faces) == len(RAIL.faces) and len(text.vertices) == len(RAIL.vertices)


def test_files_that_cannot_be_read(tmp_path):
    (tmp_path / "broken.stl").write_bytes(b"solid nothing\n facet normal 0 0\n")
    (tmp_path / "broken.ply").write_bytes(b"plx\n\x00\xff")
    (tmp_path / "empty.obj").write_text("")
    trimesh.PointCloud(np.random.default_rng(0).random((50, 3))).export(tmp_path / "cloud.ply")
    expected = {
        "none.stl": "there is no such file",
        "scan.step": "allowed: .stl, .ply, .obj",
        "broken.stl": "",
        "broken.ply": "cannot be read as PLY",
        "empty.obj": "",
        "cloud.ply": "no triangles",
    }
    for name, text in expected.items():
        (problem,) = problems_of(read_mesh, tmp_path / name, "mm", "rail")
        assert name in problem and text in problem


@pytest.mark.parametrize(
    ("mesh", "body", "written_in", "read_as"),
    [
        (RAIL, "rail", "mm", "m"),
        (RAIL, "rail", "m", "mm"),
        (RAIL, "rail", "mm", "in"),
        (WHEEL, "wheel", "mm", "cm"),
        (WHEEL, "wheel", "m", "mm"),
    ],
)
def test_a_wrong_unit_says_what_would_fit(tmp_path, mesh, body, written_in, read_as):
    factor = {"mm": 1e-3, "m": 1.0}[written_in]
    path = written(tmp_path, mesh, factor)
    (problem,) = problems_of(read_mesh, path, read_as, body)
    assert f"with the unit {read_as} it is" in problem
    assert f"it would fit in {written_in}" in problem
    (problem,) = problems_of(read_mesh, path, "furlong", body)
    assert "allowed: mm, m, cm, um, in" in problem


def test_vertices_that_are_not_numbers(tmp_path):
    vertices = np.array(RAIL.vertices)
    vertices[7, 1], vertices[90, 0] = np.nan, np.inf
    with np.errstate(invalid="ignore"):
        path = written(tmp_path, changed(RAIL, vertices=vertices))
    (problem,) = problems_of(read_mesh, path, "mm", "rail")
    assert "not finite numbers" in problem and "triangles" in problem


@pytest.mark.parametrize(("mesh", "body"), [(RAIL, "rail"), (WHEEL, "wheel")])
def test_all_faults_at_once_with_their_places(tmp_path, mesh, body):
    faces = np.array(mesh.faces)
    centre = mesh.triangles_center[30]
    faces[[30, 41]] = faces[[30, 41]][:, ::-1]
    doubled = np.concatenate([faces, faces[100:101], [[3, 4, 4]], [[5, 5, 5]]])
    path = written(tmp_path, changed(mesh, doubled))
    problems = problems_of(read_mesh, path, "mm", body)
    assert len(problems) == 3
    degenerate, many, flipped = problems
    assert "2 degenerate triangles" in degenerate and f"triangle {len(faces) + 1} at" in degenerate
    assert "edges that more than two share" in many and "triangle 100 at" in many
    place = ", ".join(f"{c:.4g}" for c in 1e3 * centre)
    assert "2 flipped triangles" in flipped and f"triangle 30 at ({place}) mm" in flipped


def test_a_thin_triangle_is_degenerate_and_a_slender_one_not(tmp_path):
    extra = np.array([[0, 0, 0.1], [1e-3, 0, 0.1], [0.5e-3, 5e-9, 0.1], [0.5e-3, 1e-4, 0.1]])
    n = len(RAIL.vertices)
    lifted = extra - [0, 0, 0.1]
    vertices = np.concatenate([RAIL.vertices, lifted])
    for corner, bad in ((2, True), (3, False)):
        faces = np.concatenate([RAIL.faces, [[n, n + 1, n + corner]]])
        path = written(tmp_path, changed(RAIL, faces, vertices), 1.0, "thin.ply")
        if bad:
            (problem,) = problems_of(read_mesh, path, "m", "rail")
            assert "1 degenerate" in problem
        else:
            read_mesh(path, "m", "rail")


@pytest.mark.parametrize(
    ("mesh", "body", "where"), [(RAIL, "rail", "up"), (WHEEL, "wheel", "down")]
)
def test_inside_out(tmp_path, mesh, body, where):
    path = written(tmp_path, changed(mesh, np.array(mesh.faces)[:, ::-1]))
    (problem,) = problems_of(read_mesh, path, "mm", body)
    assert f"{len(mesh.faces)} triangles turned inside out" in problem and f"({where})" in problem


def test_a_closed_body_is_read_too(tmp_path):
    box = trimesh.creation.box((0.1, 0.07, 0.03))
    read_mesh(written(tmp_path, box), "mm", "rail")
    box.invert()
    assert "inside out" in problems_of(read_mesh, written(tmp_path, box), "mm", "rail")[0]


def test_loose_flipped_triangles_are_found_on_the_fitted_surface(tmp_path):
    """Without a common edge only the fitted shape tells which way round they are."""
    faces = np.array(RAIL.faces)
    centres = RAIL.triangles_center
    near = np.flatnonzero((np.abs(centres[:, 0]) < 5e-3) & (np.abs(centres[:, 2] + 7e-3) < 1e-3))
    loose = np.arange(len(RAIL.vertices), len(RAIL.vertices) + 3)
    vertices = np.concatenate([RAIL.vertices, RAIL.vertices[faces[near[0]]] + 1e-7])
    faces = np.concatenate([np.delete(faces, near[0], axis=0), [loose[::-1]]])
    path = written(tmp_path, changed(RAIL, faces, vertices), 1.0, "loose.ply")
    (problem,) = problems_of(read_scan, path, "m", "rail")
    assert "1 flipped triangle on the running surface" in problem


@settings(max_examples=60, deadline=None)
@given(at=st.integers(0, 10**7), padded=st.booleans(), text=st.booleans())
def test_a_cut_or_padded_stl_is_named_as_such(tmp_path_factory, at, padded, text):
    path = tmp_path_factory.mktemp("stl") / "scan.stl"
    whole = RAIL.export(file_type="stl_ascii" if text else "stl")
    whole = whole.encode() if text else whole
    cut = whole + b"\0" * (1 + at % 999) if padded and not text else whole[: at % (len(whole) - 10)]
    path.write_bytes(cut)
    (problem,) = problems_of(read_mesh, path, "m", "rail")
    if text:
        assert "text STL without 'endsolid'" in problem or "are no STL" in problem, problem
        return
    if len(cut) < 84:
        assert f"{len(cut)} bytes are no STL" in problem
        return
    reason = "bytes behind the last triangle?" if len(cut) > len(whole) else "cut short?"
    assert problem.endswith(
        f"binary STL of {len(cut)} bytes; its header asks for {len(whole)}, of {len(RAIL.faces)} "
        f"triangles ({reason})"
    )


def test_an_obj_opens_no_other_file(tmp_path, monkeypatch):
    path = written(tmp_path, RAIL, 1.0, "rail.obj")
    secret = tmp_path / "m.mtl"
    secret.write_text("newmtl a\nmap_Kd ../../../etc/passwd\n", "utf-8")
    path.write_text(f"mtllib m.mtl\nusemtl a\n{path.read_text('utf-8')}", "utf-8")
    opened = []
    real = io.open

    def watched(name, *arguments, **keywords):
        opened.append(str(name))
        return real(name, *arguments, **keywords)

    monkeypatch.setattr(io, "open", watched)
    monkeypatch.setattr(builtins, "open", watched)
    assert len(read_mesh(path, "m", "rail").faces) == len(RAIL.faces)
    assert not [name for name in opened if "mtl" in name or "passwd" in name]
