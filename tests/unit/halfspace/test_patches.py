"""Static press of wheel on rail, half-spaces: against Hertz and the dense active set method."""

import math
import re

import numpy as np
import pytest

from contactstudy.contact.complementarity import press
from contactstudy.exceptions import InputError
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.halfspace.patch_grid import Bodies
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.patch_filter import influence_matrix

RAIL, MODULUS = rail_curve(), contact_modulus(210e9, 0.3)
INCLINED = math.atan(1 / 40)


def wheel(name="S1002", radius=0.46, **pose):
    return Geometry(RAIL, wheel_curve(name), radius, Pose(**pose))


def test_cylinder_on_the_crown_is_hertz():
    found = press_wheel(wheel("cylinder", 0.43), 60e3, MODULUS)
    (patch,) = found.patches
    h = hertz_contact(60e3, MODULUS, 0.43, 0.30)
    assert patch.normal_force == pytest.approx(60e3, rel=3e-5)
    assert patch.vertical_force == pytest.approx(60e3, rel=1e-6)
    # Hertz's gap is a paraboloid, the bodies are round: relative a^2/R^2 = 2e-4
    assert patch.approach == pytest.approx(h.approach, rel=2e-4)
    assert patch.peak_pressure == pytest.approx(h.peak_pressure, rel=5e-4)
    assert patch.along == pytest.approx(h.semi_axis_x, rel=3e-4)
    assert patch.across == pytest.approx(h.semi_axis_y, rel=3e-4)
    # cells under pressure on the rim count whole: half a cell on each side
    assert patch.area == pytest.approx(h.area, rel=0.02)
    assert abs(patch.centre.arc) < 1e-7
    assert abs(patch.lateral_force) < 1e-7 * 60e3


def test_area_converges_on_hertz_with_the_cells():
    h = hertz_contact(60e3, MODULUS, 0.43, 0.30)
    off = [
        press_wheel(wheel("cylinder", 0.43), 60e3, MODULUS, cells=n).patches[0].area / h.area - 1
        for n in (16, 64)
    ]
    # the rim's share is of order h
    assert 0 < off[1] < 0.6 * off[0]


@pytest.mark.parametrize(
    "pose",
    [
        {"rail_inclination": INCLINED, "lateral": -8e-3},
        {"rail_inclination": INCLINED, "lateral": -8e-3, "roll": -2e-3, "yaw": 20e-3},
    ],
)
def test_press_is_that_of_the_dense_active_set_method(pose):
    placed = wheel(**pose)
    found = press_wheel(placed, 20e3, MODULUS, cells=20)
    bodies = Bodies(placed, MODULUS)
    (grid,) = bodies.regions(found.travel, 4e-3, 20)
    facing, love = bodies.facing(0.0, grid), grid.love
    i, j = (np.arange(n) for n in love.shape)
    x, y = np.meshgrid(i * love.width, j * love.breadth, indexing="ij")
    K = influence_matrix(x.ravel(), y.ravel(), love.width, love.breadth, MODULUS)
    # here the travel d closes the gap by d n_z only
    guess = facing.gap < 0.5 * found.travel * facing.normal_z
    twin = press(K / love.cell_area, facing.gap, facing.normal_z, 20e3, guess, found.travel)
    (patch,) = found.patches
    assert found.travel == pytest.approx(twin.approach, rel=2e-3)
    assert patch.normal_force == pytest.approx(twin.forces.sum(), rel=1e-4)
    assert patch.peak_pressure == pytest.approx(twin.forces.max() / love.cell_area, rel=1e-2)
    assert patch.centre.arc == pytest.approx(
        float(twin.forces @ facing.arc) / twin.forces.sum(), abs=2e-5
    )


def test_tread_and_flange_come_out_by_themselves_and_share_the_load():
    # flange root just about to touch: both carry
    placed = wheel(rail_inclination=INCLINED, lateral=2.26e-3, yaw=12e-3, roll=-3.5e-4)
    found = press_wheel(placed, 10e3, MODULUS, cells=32)
    assert len(found.patches) == 2
    assert {p.region for p in found.patches} == {0, 1}
    assert sum(p.vertical_force for p in found.patches) == pytest.approx(10e3, rel=1e-6)
    flange = min(found.patches, key=lambda p: p.centre.arc)
    tread = max(found.patches, key=lambda p: p.centre.arc)
    assert flange.centre.angle > 0.2 > tread.centre.angle
    # with yaw the flange touches ahead of the axle, by about r yaw tan(angle)
    assert flange.x == pytest.approx(0.48 * 12e-3 * math.tan(flange.centre.angle), rel=0.2)
    for p in found.patches:
        # a curved patch's resultant is a little less than its normal force
        assert math.hypot(p.vertical_force, p.lateral_force) <= p.normal_force
        assert p.approach < found.travel


def test_opposite_yaw_gives_the_same_patch():
    one, other = (
        press_wheel(
            wheel(rail_inclination=INCLINED, lateral=-1e-3, yaw=yaw), 60e3, MODULUS, cells=24
        )
        for yaw in (0.02, -0.02)
    )
    assert other.travel == pytest.approx(one.travel, rel=1e-9)
    assert other.patches[0].x == pytest.approx(-one.patches[0].x, rel=1e-3)
    assert other.patches[0].peak_pressure == pytest.approx(one.patches[0].peak_pressure, rel=1e-6)


def test_impossible_arguments_are_all_named():
    with pytest.raises(InputError) as found:
        press_wheel(wheel(), -1.0, 0.0, cells=4, side=0.0)
    assert len(found.value.problems) == 4


def test_cells_fit_into_a_small_patch():
    """Cells of a given side are made smaller where a patch has less than three across."""
    h = hertz_contact(20.0, MODULUS, 0.43, 0.3)
    (patch,) = press_wheel(wheel("cylinder", 0.43), 20.0, MODULUS, side=1e-3).patches
    assert 2 * min(h.semi_axis_x, h.semi_axis_y) < 1e-3  # one cell would cover it
    # Johnson (1985) eq. (4.22)
    assert patch.approach == pytest.approx(h.approach, rel=0.05)
    assert patch.area == pytest.approx(h.area, rel=0.25)


@pytest.mark.parametrize(("load", "why"), [(1e-9, "must be larger"), (1e8, "must be smaller")])
def test_loads_that_half_spaces_cannot_carry(load, why):
    with pytest.raises(InputError, match=re.escape(f"load = {load:g} N: ") + f".*{why}"):
        press_wheel(wheel("cylinder", 0.43), load, MODULUS)
