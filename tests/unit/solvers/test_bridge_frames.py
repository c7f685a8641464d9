"""Frames of a bridge and its train, and what ParaView gets of them."""

import meshio
import numpy as np
import pytest

from contactstudy.export.paraview import vtu
from contactstudy.solvers.bridge_frames import DECK, PIER, RAIL, running_surface
from contactstudy.study.kinds.passage.bridge_fields import (
    CAR,
    WHEEL,
    _rigid,
    frame_mesh,
    write_bridge,
)
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.results import StudyResults
from contactstudy.vehicle import Train
from contactstudy.vehicle.bodies import SPATIAL, Body

CARS = ["high_speed_trailer", "high_speed_trailer reversed"]


def study(model="three_dimensional", **track):
    return parse_study(
        "frames",
        {
            "track": {"structure": "bridge", "spans": ["2 x 7.2 m"], "approach_before": 12.0,
                      "approach_behind": 12.0, "piers": "column", "animation_frames": 9, **track},
            "vehicle": {"type": "train", "cars": CARS, "model": model},
            "journey": {"speed": 60.0, "time_step": 2e-3, "stations": [15.9], "to": 45.0},
            "irregularity": {"spectrum": "smooth"},
            "runs": {"one": {"solver": "point", "k_r": 1e9}},
        },
    )  # fmt: skip


@pytest.fixture(scope="module")
def made():
    return study()


@pytest.fixture(scope="module")
def run(made):
    return execute_run(made, "one")


def test_frames_hold_what_the_histories_hold(run):
    steps = np.searchsorted(run.time.values, run.frame_time.values - 1e-9)
    assert len(steps) == 9
    part, x, z = run.node_part.values, run.node_x.values, run.node_z.values
    deck = (part == DECK) & (np.abs(x - 15.9) < 1e-6)  # a seat, so a node
    top = (part == PIER) & (z == z[part == PIER].max())
    for nodes, names in (
        (deck, {"Z": "deck_displacement", "Y": "deck_lateral"}),
        (top, {"Z": "pier_displacement", "X": "pier_longitudinal"}),
    ):
        for axis, name in names.items():
            kept = run.frame_displacement.sel(axis=axis).values[:, nodes][:, 0]
            place = 0 if name.startswith("deck") else 1
            expected = run[name].values[place, steps]
            np.testing.assert_allclose(kept, expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(run.frame_position, run.position.values[0, steps])
    # both rails at their seats, 0.6 m apart
    assert np.isclose(np.median(np.diff(x[part == RAIL])), 0.6)


def test_no_frames_where_none_are_wanted():
    assert "frame_time" not in execute_run(study("planar", animation_frames=0), "one")


def test_outlines_fit_the_wheels_and_each_other():
    train = Train(cars=("s300_end", "s300", "s300_end reversed"), gaps=(0.4,))
    outlines, wheels = np.array(train.outlines), train.vehicle().wheel_offsets
    for k, (car, _) in enumerate(train.consist):
        own = wheels[4 * k : 4 * k + 4]
        pivots = [own[:2].mean(), own[2:].mean()]
        np.testing.assert_allclose(outlines[k, 1:3], pivots, atol=1e-12)
        assert outlines[k, 0] - outlines[k, 3] == pytest.approx(car.length)
    np.testing.assert_allclose(outlines[:-1, 3] - outlines[1:, 0], 0.4)
    # the last car is the first one turned round
    turned = outlines[0] - outlines[0, 0]
    np.testing.assert_allclose(outlines[2] - outlines[2, 3], -turned[::-1], atol=1e-12)


def test_bodies_move_as_those_of_the_vehicle():
    rng = np.random.default_rng(0)
    u, arm = rng.normal(size=5), rng.normal(size=(4, 3))
    body = Body("car", (0.0, 0.0, 0.0), 1.0, (1.0, 1.0, 1.0), SPATIAL)
    named = {f"car {dof} 2": value for dof, value in zip(SPATIAL, u, strict=True)}
    moved = _rigid(named, 2, *arm.T)
    for point, found in zip(arm, moved, strict=True):
        np.testing.assert_allclose(found, [body.row(point, axis) @ u for axis in "XYZ"])


def test_the_mesh_read_back_has_bridge_cars_and_wheels(made, run, tmp_path):
    bridge, k = made.track.structure, 4
    path = tmp_path / "frame.vtu"
    path.write_bytes(vtu(frame_mesh(run, bridge, k)))
    mesh = meshio.read(path)
    data, part = mesh.point_data, mesh.point_data["part"]
    step = int(np.argmin(np.abs(run.time.values - float(run.frame_time[k]))))
    wheels = part == WHEEL
    force = run.contact_force.values[:, step]
    np.testing.assert_allclose(data["contact_force"][wheels], force, rtol=1e-6)
    np.testing.assert_allclose(mesh.points[wheels][:, 0], run.position[:, step], rtol=1e-6)
    sides = np.tile(bridge.lateral_of_rails, len(force) // 2)
    np.testing.assert_allclose(mesh.points[wheels][:, 1], sides)
    boxes = [mesh.points[cell] for block in mesh.cells if block.type == "hexahedron"
             for cell in block.data]  # fmt: skip
    assert len(boxes) == len(CARS) == (part == CAR).sum() / 8
    length = np.ptp(boxes[0][:, 0])
    assert length == pytest.approx(made.vehicle.consist[0][0].length, rel=1e-6)
    # a right-handed hexahedron: its volume by the triple product at one corner is positive
    a, b, c = (boxes[0][i] - boxes[0][0] for i in (1, 3, 4))
    assert np.cross(a, b) @ c == pytest.approx(length * 2.9 * 2.7, rel=1e-5)
    assert mesh.points[wheels][0, 2] == pytest.approx(running_surface(bridge.track_height))
    lines = next(block.data for block in mesh.cells if block.type == "line")
    assert np.linalg.norm(np.diff(mesh.points[lines], axis=1), axis=2).max() < 10.1  # a pier


def test_files_are_written_alike_twice(made, run, tmp_path):
    results = StudyResults(
        "frames", "Frames", "", made.config(), made.units(), {"one": run}, "one", {}
    )
    first, second = (write_bridge(results, tmp_path / name) for name in "ab")
    assert [p.read_bytes() for p in first] == [p.read_bytes() for p in second]
    text = first[-1].read_text()
    assert first[-1].name == "bridge.pvd" and text.count("<DataSet") == 9
    assert f'timestep="{float(run.frame_time[3])!r}"' in text
