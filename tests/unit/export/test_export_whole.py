"""The exported press of whole sections: placed as the pose says, the mesh the program's own."""

import re
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
import trimesh
from scipy.sparse.linalg import splu

from contactstudy import cli
from contactstudy.exceptions import InputError
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import FACES, press_mesh
from contactstudy.geometry.facing import surface_gap
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.profiles import rail_curve, wheel_curve
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import elastic_wheel
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solids.wheel_section import WheelDimensions
from contactstudy.track.model import Track
from contactstudy.track.solid import solid_rail
from contactstudy.track.unreduced import UnreducedTrack

POSE = Pose(rail_inclination=0.05, lateral=-0.002, roll=0.01, yaw=0.02)
GEOMETRY = Geometry(rail_curve("60E1"), wheel_curve("S1002"), 0.43, POSE)
CELL = CellRecipe(
    size=0.008,
    length=0.16,
    coarse=0.012,
    contact_half_width=0.024,
    symmetric=False,
    interface_modes=20,
)
# hardly a web: the brute force has every node of the ring
RING = WheelDimensions(hub_radius=0.36, bore_radius=0.34)
WHEEL = WheelRecipe(
    profile="S1002",
    symmetric=False,
    size=0.008,
    contact_half_width=0.016,
    far_step=np.pi / 6,
    dimensions=RING,
)
LENGTH = 0.16
LOADING = PressLoading(80e3, 1e16, 90e-6)


@pytest.fixture(scope="module")
def mesh():
    return press_mesh(CELL, WHEEL, LENGTH, GEOMETRY)


@pytest.fixture(scope="module")
def stiffness(mesh):
    K = hex_stiffness(mesh.nodes[mesh.elements], 210e9, 0.3)  # refuses inverted elements
    dofs = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    i, j = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
    return sp.coo_array((K.ravel(), (i.ravel(), j.ravel()))).tocsc()


def dofs_of(nodes):
    return (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel()


def test_rail_is_the_unreduced_track_turned(mesh, stiffness):
    track = UnreducedTrack(Track(rail=solid_rail(CELL), length=LENGTH, support=None), CELL)
    free = np.setdiff1d(dofs_of(np.unique(mesh.rail)), dofs_of(mesh.rail_ends))
    c, s = np.cos(0.05), np.sin(0.05)
    # track axes from the rail's: its top leans to -Y
    turn = sp.block_diag([np.array([[1, 0, 0], [0, c, -s], [0, s, c]])] * (len(free) // 3), "csc")
    ours = sp.csc_array(track.stiffness)
    written = turn.T @ stiffness[free][:, free] @ turn
    assert abs(written - ours).max() < 1e-9 * abs(ours).max()


def test_wheel_is_the_condensed_one_turned(mesh, stiffness):
    """The whole ring by brute force, its bore held, against elimination by symmetry."""
    wheel = elastic_wheel(WHEEL)
    tread = mesh.tread_nodes.ravel()
    # the wheel's own inward normal in its (y, z), turned by roll and yaw
    own = np.c_[np.zeros(len(wheel.y)), -wheel_curve("S1002").normal(wheel.y)]
    normal = np.tile(own @ POSE.to_track.T, (len(wheel.x), 1))
    loaded = [0, len(tread) // 2 + 1, len(tread) - 1]
    force = np.zeros((len(mesh.nodes), 3, len(loaded)))
    force[tread[loaded], :, range(len(loaded))] = normal[loaded]
    free = np.setdiff1d(dofs_of(np.unique(mesh.wheel)), dofs_of(mesh.bore))
    u = np.zeros((3 * len(mesh.nodes), len(loaded)))
    u[free] = splu(stiffness[free][:, free]).solve(force.reshape(-1, len(loaded))[free])
    moved = np.einsum("nc,nck->nk", normal, u.reshape(force.shape)[tread])
    expected = wheel.flexibility[:, loaded]
    np.testing.assert_allclose(moved, expected, atol=1e-8 * expected.max())


def distance(triangles, point):
    """Least distance of a point from triangles (n, 3, 3), by looking at all of them."""
    nearest = trimesh.triangles.closest_point(triangles, np.tile(point, (len(triangles), 1)))
    return np.linalg.norm(nearest - point, axis=1).min()


def test_written_nodes_lie_where_the_smooth_surfaces_are():
    """Gap of the tread's written nodes over the written faces, and over the smooth rail.

    The rail's faces are chords of arcs of 13 mm and more: they lie within it by h^2/8r at most.
    """
    fine, narrow = replace(CELL, size=0.002), replace(WHEEL, size=0.002)
    text = calculix_input(press_mesh(fine, narrow, LENGTH, GEOMETRY), LOADING, 210e9, 0.3)
    nodes, elements = read(text)
    upper = np.unique(faces(text, "TREAD", elements))
    lower = faces(text, "RUNNING", elements)
    triangles = nodes[lower[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)]
    points = nodes[upper]
    over_faces = np.array([distance(triangles, point) for point in points])
    # places on the smooth wheel, from the written points turned back
    own = (points - [0.0, POSE.lateral, -GEOMETRY.touch.travel]) @ POSE.to_track
    rho = np.hypot(own[:, 0], 0.43 - own[:, 2])
    s, off = GEOMETRY.wheel.project(np.c_[own[:, 1], 0.43 - rho])
    assert np.abs(off).max() < 1e-12
    placed = PlacedWheel(GEOMETRY.wheel, 0.43, POSE)
    smooth = surface_gap(placed, GEOMETRY.rail, GEOMETRY.touch.travel, own[:, 0], s).gap
    near = smooth < 1e-3
    assert near.sum() > 50
    sagitta = 0.002**2 / 8 / 0.013
    beyond = over_faces[near] - smooth[near]
    assert beyond.min() > -1e-9 and beyond.max() < 1.1 * sagitta
    assert smooth.min() < 5e-6


def test_text_is_sound(mesh):
    text = calculix_input(mesh, LOADING, 210e9, 0.3)
    nodes, elements = read(text)
    np.testing.assert_allclose(nodes, mesh.nodes, atol=1e-12)
    assert len(np.unique(elements)) == len(nodes)
    volume = volumes(nodes[elements - 1])
    assert volume.min() > 0.0
    area = solid_rail(CELL).section.area
    assert volume[: len(mesh.rail)].sum() == pytest.approx(area * LENGTH, rel=1e-9)
    assert "SYMMETRY" not in text and "half" not in text
    assert "HUB, 3, -80000\n" in text
    # hub and rail's ends are held as in the half model, the hub free along Z in the second step
    assert text.count("\nENDS, 1, 3\nBORE, 1, 2\n") == 2
    hub = mesh.bore[0] + 1
    assert text.count(f", 3, 1., {hub}, 3, -1.") == len(mesh.bore) - 1


def test_what_does_not_belong_together_is_refused():
    with pytest.raises(InputError, match="must be given for whole sections"):
        press_mesh(CELL, WHEEL, LENGTH)
    other = Geometry(rail_curve("UIC60-Manchester"), wheel_curve("cone"), 0.46, POSE)
    with pytest.raises(InputError) as caught:
        press_mesh(CELL, WHEEL, LENGTH, other)
    assert len(caught.value.problems) == 3


def test_command_writes_a_whole_section(tmp_path, capsys):
    out = tmp_path / "press.inp"
    changes = ("solid.mesh_size=4 mm", "wheelset.lateral_shift=2 mm", "wheelset.yaw=5 mrad")
    arguments = ["export", "s1002_inclined", "--out", str(out), "--load", "60 kN"]
    arguments += ["--rail-length", "0.1 m", *(w for text in changes for w in ("--set", text))]
    assert cli.main(arguments) == 0
    text = out.read_text()
    assert "** whole model in axes of the track" in text
    assert "by 0.0249948 rad" in text and "then about Z by 0.005 rad" in text
    assert "HUB, 3, -60000\n" in text
    assert "0.1 m of rail" in capsys.readouterr().out
    out.unlink()
    arguments[arguments.index("60 kN")] = "600 kN"
    assert cli.main(arguments) == 2
    assert "contact_half_length" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("shift", ["0 mm", "5.5 mm"])
def test_first_step_brings_faces_together(tmp_path, shift):
    """Somewhere the rail's flat faces, seen along Z, stand above the lowered flat tread."""
    out = tmp_path / "press.inp"
    arguments = ["export", "s1002_inclined", "--out", str(out), "--rail-length", "0.1 m"]
    arguments += ["--set", "solid.mesh_size=4 mm", "--set", f"wheelset.lateral_shift={shift}"]
    assert cli.main(arguments) == 0
    text = out.read_text()
    nodes, elements = read(text)
    start = -1e-3 * float(re.search(r"HUB, 3, 3, (\S+)", text)[1])
    corners = nodes[faces(text, "RUNNING", elements)]
    # the rail is prismatic: its faces are a polyline in (y, z)
    y, z = np.unique(np.round(corners[:, :, 1:].reshape(-1, 2), 10), axis=0).T
    middle = nodes[faces(text, "TREAD", elements)].mean(axis=1)
    gap = middle[:, 2] - start - np.interp(middle[:, 1], y, z)
    assert gap[(middle[:, 1] > y[0]) & (middle[:, 1] < y[-1])].min() < -20e-6


def volumes(corners):
    """Volumes (m,) of hexahedra (m, 8, 3): six tetrahedra about the diagonal from 0 to 6."""
    around = [1, 2, 3, 7, 4, 5]
    a, d = corners[:, 0], corners[:, 6]
    return sum(
        np.einsum("mi,mi->m", d - a, np.cross(corners[:, i] - a, corners[:, j] - a)) / 6
        for i, j in zip(around, around[1:] + around[:1], strict=True)
    )


def read(text):
    """Nodes (n, 3) in m and elements (m, 8), counted from 1, as they are written."""
    block = re.search(r"\*NODE, NSET=ALL\n(.*?)\n\*ELEMENT", text, re.S)[1].splitlines()
    nodes = np.array([line.split(",") for line in block], dtype=float)
    np.testing.assert_array_equal(nodes[:, 0], 1 + np.arange(len(nodes)))
    blocks = re.findall(r"\*ELEMENT, TYPE=C3D8I, ELSET=\w+\n(.*?)(?=\n\*)", text, re.S)
    rows = [line.split(",") for b in blocks for line in b.splitlines()]
    return 1e-3 * nodes[:, 1:], np.array(rows, dtype=int)[:, 1:]


def faces(text, name, elements):
    """Nodes (k, 4) of a surface, counted from 0."""
    block = re.search(rf"\*SURFACE, NAME={name}, TYPE=ELEMENT\n(.*?)\n\*", text, re.S)[1]
    found = [line.split(", S") for line in block.splitlines()]
    return np.array([elements[int(e) - 1, list(FACES[int(f) - 1])] - 1 for e, f in found])
