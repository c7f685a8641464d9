"""Wheelset on its rails: poses, and the roll at rest against the benchmark's."""

import math

import pytest
from scipy.optimize import brentq

from contactstudy.exceptions import InputError
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.wheelset import SIDES, Wheelset
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases import manchester as m


@pytest.fixture(scope="module")
def wheelset():
    return Wheelset(wheel=wheel_curve("S1002"), rail=rail_curve(m.RAIL), radius=m.RADIUS)


def gauge_point():
    """Y of the rail 14 mm below its top, from the crown, for a crown that is one arc."""
    rail, pose = rail_curve(m.RAIL), Pose(m.INCLINATION)
    # the highest point lies on the crown's arc where its normal is vertical
    top = float(pose.track_of_rail(rail.point(m.INCLINATION / float(rail.curvature(0.0))))[1])

    def height(s):
        return float(pose.track_of_rail(rail.point(s))[1]) - top + m.GAUGE_DEPTH

    s = brentq(height, rail.s_range[0], -0.03, xtol=1e-15)
    return float(pose.track_of_rail(rail.point(s))[0])


def pose_by_hand(case, wheel):
    """Lateral position, roll and yaw of the benchmark's wheel, from its own dimensions."""
    shift, yaw, roll = 0.5e-3 * (case - 1), 1.2e-3 * (case - 1), m.ROLL[case - 1]
    side = 1.0 if wheel == "right" else -1.0
    y = side * (m.FLANGE_BACKS / 2 + m.TAPE_LINE) * math.cos(roll) - m.RADIUS * math.sin(roll)
    lateral = side * (shift + y * math.cos(yaw)) - m.GAUGE / 2 + gauge_point()
    return Pose(m.INCLINATION, lateral, -side * roll, side * yaw)


def test_poses_are_the_benchmarks(wheelset):
    assert wheelset.gauge_point() == pytest.approx(gauge_point(), abs=1e-12)
    for case in (1, 11, 21):
        for side in SIDES:
            mine = wheelset.pose(side, 0.5e-3 * (case - 1), 1.2e-3 * (case - 1), m.ROLL[case - 1])
            theirs = pose_by_hand(case, side)
            assert mine.lateral == pytest.approx(theirs.lateral, abs=1e-12)
            assert (mine.roll, mine.yaw) == (theirs.roll, theirs.yaw)


def test_centred_wheelset_rests_level(wheelset):
    assert wheelset.rest_roll(0.0, 0.0) == pytest.approx(0.0, abs=1e-9)


def test_rest_roll_is_contacts_less_the_approaches(wheelset):
    """CONTACT's wheelset has sunk by its approaches: they turn it by their difference."""
    case, shift, yaw = 6, 2.5e-3, 6e-3
    found = wheelset.rest_roll(shift, yaw)
    sunk = {}
    for side in SIDES:
        placed = wheelset.geometry(side, shift, yaw, m.ROLL[case - 1])
        sunk[side] = press_wheel(placed, m.LOAD, m.MODULUS, side=0.5e-3).travel
        sunk[side] -= press_wheel(placed, 1.0, m.MODULUS).travel
    expected = m.ROLL[case - 1] + (sunk["left"] - sunk["right"]) / (2 * wheelset.half)
    print(f"roll at rest {found:.5e}; CONTACT's without its approaches {expected:.5e}")
    assert found == pytest.approx(expected, abs=2e-7)


def test_impossible_wheelsets():
    with pytest.raises(InputError) as error:
        Wheelset(wheel=wheel_curve("S1002"), rail=rail_curve(), radius=-0.4, gauge=0.0)
    assert len(error.value.problems) == 2
    with pytest.raises(InputError, match="does not reach so far"):
        standard("S1002", gauge_depth=0.5).gauge_point()
    assert math.isclose(standard("cone").half, 0.75)


def standard(profile, **dimensions):
    return Wheelset(wheel=wheel_curve(profile), rail=rail_curve(), radius=0.43, **dimensions)


def test_wheelsets_of_equal_dimensions_keep_their_own_profiles():
    """A cone of 1:20: the radii differ by 2 y/20 when it is shifted by y, whatever ran before."""
    rail, y = rail_curve("60E1"), 2e-3
    differences = []
    for profile in ("S1002", "cone"):
        wheelset = Wheelset(wheel=wheel_curve(profile), rail=rail, radius=0.46)
        roll = wheelset.rest_roll(y, 0.0)
        down = [
            wheelset.wheel.point(wheelset.geometry(side, y, 0.0, roll).touch.wheel_s)[1]
            for side in ("right", "left")
        ]
        differences.append(down[1] - down[0])
    assert differences[1] == pytest.approx(2 * y / 20, rel=0.06)  # roll moves the touch a little
    assert differences[0] > 2 * differences[1]
