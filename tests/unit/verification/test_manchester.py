"""Manchester benchmark: positions of the wheels, and friction in the vertical balance."""

import math

import numpy as np
import pytest

from contactstudy.geometry.placement import Geometry
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.friction import vertical_friction
from contactstudy.verification.cases.manchester import (
    INCLINATION,
    MODULUS,
    RADIUS,
    RAIL,
    benchmark_pose,
    benchmark_wheelset,
    manchester_rows,
)

# points (y, z down) in mm of the benchmark's own rail file, far from its joints
FILE = (
    (-43.470625, 29.128119), (-41.591702, 9.4424756), (-38.170158, 5.3592530),
    (-29.111894, 1.9970324), (-22.124052, 0.89671738), (-13.102013, 0.28650154),
    (-4.9636765, 0.041164848),
    (8.2151997, 0.23683776), (13.622535, 0.82944449), (20.712565, 2.3504190),
    (26.938697, 7.5726169), (29.292845, 19.300711),
)  # fmt: skip


def test_rail_is_the_benchmarks():
    y, z = np.array(FILE).T * 1e-3
    top = 0.3 / math.cos(INCLINATION) - 0.3
    track = np.stack([y + 7.4917e-3, top - z], axis=-1)
    c, s = math.cos(INCLINATION), math.sin(INCLINATION)
    own = np.stack([c * track[:, 0] + s * track[:, 1], -s * track[:, 0] + c * track[:, 1]], axis=-1)
    _, distance = rail_curve(RAIL).project(own)
    assert np.abs(distance).max() < 0.05e-6


def test_wheels_stand_where_gauge_and_flange_backs_put_them():
    gauge_point = benchmark_wheelset().gauge_point()
    # 14 mm below the top of rail, 43.0326 mm to the gauge side of the file's origin
    assert gauge_point == pytest.approx(7.4917e-3 - 43.0326e-3, abs=1e-6)
    centred = benchmark_pose(1, "left")
    assert centred == benchmark_pose(1, "right")
    # tape circles 1500 mm apart, gauge faces 1435 mm
    assert centred.lateral - gauge_point == pytest.approx((1.500 - 1.435) / 2, abs=1e-12)
    left, right = benchmark_pose(11, "left"), benchmark_pose(11, "right")
    assert right.yaw == -left.yaw == pytest.approx(12e-3)
    assert right.roll == -left.roll == pytest.approx(3.554e-4)
    # both move 5 mm to the right, and the roll takes the treads r*roll farther; yaw brings them
    # together by 0.75 m * yaw^2/2 each
    assert right.lateral - centred.lateral == pytest.approx(
        5e-3 + RADIUS * 3.554e-4 - 0.75 * 12e-3**2 / 2, abs=2e-6
    )
    assert left.lateral - centred.lateral == pytest.approx(
        -5e-3 - RADIUS * 3.554e-4 - 0.75 * 12e-3**2 / 2, abs=2e-6
    )


def test_centred_wheels_are_mirror_images():
    left, right = manchester_rows((1,), side=0.4e-3)
    assert (left.wheel, right.wheel) == ("left", "right")
    assert right.y == pytest.approx(-left.y, rel=1e-9)
    assert right.found.peak_pressure == pytest.approx(left.found.peak_pressure, rel=1e-9)
    assert left.found.vertical_force == pytest.approx(10e3, rel=2e-4)


def test_friction_of_a_yawed_wheel_is_lateral_and_saturated():
    bodies = Geometry(rail_curve(RAIL), wheel_curve("S1002"), RADIUS, benchmark_pose(6, "right"))
    (patch,) = press_wheel(bodies, 10e3, MODULUS, cells=24).patches
    local = RADIUS - float(wheel_curve("S1002").point(patch.wheel_s)[1])
    lift = vertical_friction(patch, bodies.placed, 2.0, 2.0 / local, 0.3, 82e9)
    # no longitudinal slip; the wheel slides to the left, friction pushes it to the right, up the
    # rail's slope towards the field side
    assert lift == pytest.approx(0.3 * patch.normal_force * math.sin(patch.centre.angle), rel=2e-3)
    assert vertical_friction(patch, bodies.placed, 2.0, 2.0 / local, 0.0, 82e9) == 0.0
    # the smaller the yaw, the nearer to Kalker's straight line
    straight = Geometry(rail_curve(RAIL), wheel_curve("S1002"), RADIUS, benchmark_pose(1, "right"))
    (patch,) = press_wheel(straight, 10e3, MODULUS, cells=24).patches
    local = RADIUS - float(wheel_curve("S1002").point(patch.wheel_s)[1])
    assert abs(vertical_friction(patch, straight.placed, 2.0, 2.0 / local, 0.3, 82e9)) < 1e-6
