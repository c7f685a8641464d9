"""The exported press: the very mesh that the program computes with, its text, results read."""

import re

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from contactstudy import cli
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import FACES, press_mesh
from contactstudy.profiles import rail_curve
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import elastic_wheel
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solids.wheel_section import WheelDimensions
from contactstudy.track.model import Track
from contactstudy.track.solid import solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.verification.cases import run_calculix as runner
from contactstudy.verification.cases.calculix_results import read_presses

CELL = CellRecipe(size=0.008, length=0.128, coarse=0.012, contact_half_width=0.018)
# hardly a web: the brute force has every node of the ring
RING = WheelDimensions(hub_radius=0.36, bore_radius=0.34)
WHEEL = WheelRecipe(size=0.008, contact_half_width=0.016, far_step=np.pi / 6, dimensions=RING)
LENGTH = 0.128


@pytest.fixture(scope="module")
def mesh():
    return press_mesh(CELL, WHEEL, LENGTH)


@pytest.fixture(scope="module")
def stiffness(mesh):
    """Of both bodies apart, for both halves, on the dofs 3*node + component."""
    K = 2 * hex_stiffness(mesh.nodes[mesh.elements], 210e9, 0.3)  # refuses inverted elements
    dofs = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    i, j = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
    return sp.coo_array((K.ravel(), (i.ravel(), j.ravel()))).tocsc()


def dofs_of(nodes):
    return (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel()


def test_rail_is_the_unreduced_track(mesh, stiffness):
    track = UnreducedTrack(Track(rail=solid_rail(CELL), length=LENGTH, support=None), CELL)
    held = np.r_[dofs_of(mesh.rail_ends), 3 * mesh.symmetry + 1]
    free = np.setdiff1d(dofs_of(np.unique(mesh.rail)), held)
    ours = sp.csc_array(track.stiffness)
    # both are ordered by plane, node and component
    assert abs(stiffness[free][:, free] - ours).max() < 1e-9 * abs(ours).max()


def test_wheel_is_the_condensed_one(mesh, stiffness):
    """The whole ring by brute force, its bore held, against elimination by symmetry."""
    wheel = elastic_wheel(WHEEL)
    tread = np.unique(mesh.elements[mesh.tread[:, :1], np.array(FACES)[mesh.tread[:, 1]]])
    x, y, _ = mesh.nodes[tread].T  # numbered by plane, then by y, as the wheel's nodes
    np.testing.assert_allclose(x.reshape(len(wheel.x), -1)[:, 0], wheel.x, atol=1e-12)
    rail = rail_curve("60E1")
    normal = np.column_stack([0 * y, rail.normal(rail.arc_of_y(y))])
    loaded = [0, len(tread) // 2, len(tread) - 1]
    force = np.zeros((len(mesh.nodes), 3, len(loaded)))
    force[tread[loaded], :, range(len(loaded))] = normal[loaded]
    held = np.r_[dofs_of(mesh.bore), 3 * mesh.symmetry + 1]
    free = np.setdiff1d(dofs_of(np.unique(mesh.wheel)), held)
    u = np.zeros((3 * len(mesh.nodes), len(loaded)))
    u[free] = splu(stiffness[free][:, free]).solve(force.reshape(-1, len(loaded))[free])
    moved = np.einsum("nc,nck->nk", normal, u.reshape(force.shape)[tread])
    expected = wheel.flexibility[:, loaded]
    np.testing.assert_allclose(moved, expected, atol=1e-8 * expected.max())


def test_bodies_touch_at_the_origin(mesh):
    running, tread = mesh.corners(mesh.running_surface), mesh.corners(mesh.tread)
    assert running[..., 2].max() == 0.0
    assert tread[..., 2].min() == pytest.approx(0.0, abs=1e-15)
    assert np.abs(running[..., 0]).max() > np.abs(tread[..., 0]).max()
    # corners of CalculiX's faces turn counter-clockwise about the inward normal
    for corners, sign in ((running, -1), (tread, 1)):
        normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        assert np.all(sign * normal[:, 2] > 0)


def test_input_file_says_what_was_asked_for(mesh):
    text = calculix_input(mesh, PressLoading(80e3, 1e16, 90e-6), 210e9, 0.3, ["study x"])
    assert text.startswith("** study x\n** units: mm, N, MPa\n")
    nodes = re.search(r"\*NODE, NSET=ALL\n(.*?)\n\*ELEMENT", text, re.S)[1].splitlines()
    read = np.array([line.split(",") for line in nodes], dtype=float)
    np.testing.assert_array_equal(read[:, 0], 1 + np.arange(len(mesh.nodes)))
    np.testing.assert_allclose(1e-3 * read[:, 1:], mesh.nodes, atol=1e-12)
    assert text.count("*ELEMENT, TYPE=C3D8I") == 2
    hub = mesh.bore[0] + 1
    assert text.count("*EQUATION") == text.count(f", 3, 1., {hub}, 3, -1.") == len(mesh.bore) - 1
    assert "*ELASTIC\n210000, 0.3\n" in text
    assert "PRESSURE-OVERCLOSURE=LINEAR\n10000000\n" in text
    assert "HUB, 3, 3, -0.09\n" in text and text.count("HUB, 3, -40000\n") == 1
    again = calculix_input(mesh, PressLoading(80e3, 1e16, 90e-6, repeats=2), 210e9, 0.3)
    assert again.count("HUB, 3, -40000\n") == 3 and again.count("*END STEP") == 4


def test_impossible_models_are_refused(mesh):
    with pytest.raises(InputError) as caught:
        press_mesh(CellRecipe(symmetric=False), WheelRecipe(rail_profile="x"), 0.0333)
    assert [p.split(" ")[0] for p in caught.value.problems] == [
        "symmetric:",
        "wheel",
        "rail",
        "rail",
    ]
    with pytest.raises(InputError) as caught:
        PressLoading(-1.0, 0.0, np.nan)
    assert len(caught.value.problems) == 3


RESULTS = """
 contact print energy (slave element+face,energy)for all contact elements and time 0.1000000E+01

         7          5  9.000000E+09

 displacements (vx,vy,vz) for set HUB and time  0.2000000E+01

         3  0.000000E+00  0.000000E+00 -1.250000E-01

 contact stress (slave element+face,press,tang1,tang2) for all contact elements and time 0.2E+01

         7          5  1.000000E+03  0.000000E+00  0.000000E+00
         8          5  5.000000E+02  0.000000E+00  0.000000E+00

 contact print energy (slave element+face,energy)for all contact elements and time 0.2000000E+01

         7          5  1.000000E-01
         8          5  1.250000E-02

 statistics for slave set TREAD, master set RUNNING and time  0.2000000E+01

   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)

    1.000000E+00  2.000000E+00  2.500000E+03  0.000000E+00  0.000000E+00  0.000000E+00

   center of gravity and mean normal

    0.000000E+00  1.500000E+00 -5.000000E-02  0.000000E+00 -6.000000E-03 -9.999000E-01

   moment about the center of gravity(mx,my,mz)

    0.000000E+00  0.000000E+00  0.000000E+00

   area,  normal force (+ = tension) and shear force (size)

    3.000000E+00 -2.500000E+03  0.000000E+00
"""


def test_results_of_the_last_step_are_read(tmp_path):
    path = tmp_path / "press.dat"
    path.write_text(RESULTS)
    (press,) = read_presses(path, 1e16)
    assert press.approach == pytest.approx(125e-6)
    assert press.force == pytest.approx(5e3)
    assert press.area == pytest.approx(6e-6)
    np.testing.assert_array_equal(press.element, [6, 7])
    # E = p^2 A/(2 eps) with eps = 1e7 MPa/mm: A = 2 mm^2 and 1 mm^2, twice for both halves
    np.testing.assert_allclose(press.point_area, [4e-6, 2e-6])
    assert press.point_area @ press.pressure == pytest.approx(5e3)
    np.testing.assert_allclose(
        press.face_pressure(np.array([6, 7, 9]), np.full(3, 4e-6)), [1e9, 0.25e9, 0.0]
    )
    path.write_text(RESULTS + RESULTS.replace("-1.250000E-01", "-1.260000E-01"))
    assert [p.approach for p in read_presses(path, 1e16)] == pytest.approx([125e-6, 126e-6])
    path.write_text(RESULTS.partition(" statistics")[0])
    with pytest.raises(NumericalError, match="statistics"):
        read_presses(path, 1e16)


def test_calculix_that_is_absent_or_stops(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="calculix-ccx"):
        runner.run_calculix("", 1e16)
    program = tmp_path / "ccx"
    program.write_text(
        '#!/bin/sh\ncase "$1" in -v) echo "This is Version 9.9";; *) echo diverged; exit 201;; esac'
    )
    program.chmod(0o755)
    assert runner.calculix_version() == "9.9"
    with pytest.raises(NumericalError, match=r"status 201.*diverged"):
        runner.run_calculix("", 1e16)


COARSE = ("--set", "solid.mesh_size=8 mm", "--set", "solid.contact_half_width=16 mm")


def test_command_writes_the_file(tmp_path, capsys):
    out = tmp_path / "new" / "press.inp"
    status = cli.main(["export", "point_vs_surface", "--out", str(out), "--load", "40 kN", *COARSE])
    assert status == 0
    text = out.read_text()
    assert "** study point_vs_surface: " in text and "; run surface\n" in text
    assert "HUB, 3, -20000\n" in text
    assert str(tmp_path) not in text
    assert "0.4 m of rail" in capsys.readouterr().out
    assert list(out.parent.iterdir()) == [out]


def test_command_names_everything_that_is_wrong(tmp_path, capsys):
    wrong = ["--run", "point", "--load", "8 kg", "--rail-length", "0"]
    status = cli.main(["export", "point_vs_surface", "--out", str(tmp_path), *wrong])
    assert status == 2
    said = capsys.readouterr().err
    for part in ("--run", "--load", "--rail-length", "is a folder"):
        assert part in said
    assert cli.main(["export", "paper_irregularity", "--out", str(tmp_path / "a.inp")]) == 2
    assert list(tmp_path.iterdir()) == []


def test_load_that_the_fine_tread_cannot_carry(tmp_path, capsys):
    arguments = ["export", "point_vs_surface", "--out", str(tmp_path / "a.inp")]
    assert cli.main([*arguments, "--load", "1 MN"]) == 2
    assert "contact_half_width" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("override", "said"),
    [
        (("solid.wheel=rigid",), "elastic wheel"),
        (("solid.section=whole", "wheelset.rail_profile=UIC60-Manchester"), "those of 60E1"),
    ],
)
def test_models_that_cannot_be_exported(tmp_path, capsys, override, said):
    out = tmp_path / "a.inp"
    changes = [word for text in override for word in ("--set", text)]
    status = cli.main(["export", "point_vs_surface", "--out", str(out), "--load", "8 kg", *changes])
    error = capsys.readouterr().err
    assert status == 2 and said in error and "--load" in error
    assert not out.exists()
