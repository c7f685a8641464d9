"""Defects of rail and wheel against their closed forms, and where they may lie."""

import re

import numpy as np
import pytest

from contactstudy import irregularity as irr
from contactstudy.contact.filters import Trajectory
from contactstudy.exceptions import InputError
from contactstudy.irregularity.depth_doubts import doubtful

R = 0.43


def test_a_dipped_joint_meets_in_the_cusp_of_the_p1_formula():
    joint = irr.DippedJoint(at=10.0, length=1.2, depth=3e-3)
    h = 1e-6
    level = joint(np.array([9.4, 9.4 + h, 10.0 - h, 10.0, 10.0 + h, 10.6]))
    slope = [(level[1] - level[0]) / h, (level[3] - level[2]) / h, (level[4] - level[3]) / h]
    assert slope[0] == pytest.approx(0.0, abs=1e-7)
    assert slope[2] - slope[1] == pytest.approx(2 * np.pi * 3e-3 / 1.2, rel=1e-5)
    assert joint.angle == pytest.approx(2 * np.pi * 3e-3 / 1.2)
    np.testing.assert_allclose(level[[0, 3, 5]], [0.0, -3e-3, 0.0], atol=1e-18)


def test_weld_step_and_corrugation():
    x = np.linspace(9.0, 11.0, 2001)
    weld = irr.Weld(at=10.0, length=0.4, height=0.2e-3)(x)
    assert weld.max() == weld[1000] == 0.2e-3 and not weld[np.abs(x - 10.0) > 0.2].any()
    assert irr.Step(at=10.0, height=-0.3e-3)(np.array([9.9999, 10.0, 30.0])).tolist() == [
        0.0,
        -0.3e-3,
        -0.3e-3,
    ]
    waves = irr.Corrugation(at=10.0, length=1.0, wavelength=0.1, amplitude=2e-5)(x)
    inner = np.abs(x - 10.0) < 0.4
    np.testing.assert_allclose(
        waves[inner], 2e-5 * np.cos(2 * np.pi * (x[inner] - 10) / 0.1), atol=1e-18
    )
    assert not waves[np.abs(x - 10.0) >= 0.5].any()


def test_a_fresh_flat_is_the_chord_and_comes_back_with_every_revolution():
    profile = irr.with_defects(irr.SmoothRail(), None, irr.Flat(at=10.0, length=0.05), R)
    turn = 2 * np.pi * R
    middle = R - np.sqrt(R**2 - 0.025**2)
    np.testing.assert_allclose(profile(10.0 + turn * np.arange(4)), -middle, rtol=1e-12)
    assert profile(10.0 - turn) == 0.0 and profile(10.0 + 0.5 * turn) == 0.0
    # a point of the chord at the angle psi is (R - d)/cos(psi) from the axle
    s = np.linspace(-0.024, 0.024, 25)
    chord = np.stack([(R - middle) * np.tan(s / R), np.full(25, R - middle)])
    np.testing.assert_allclose(profile(10.0 + s), np.hypot(*chord) - R, atol=1e-15)


def test_a_rigid_wheel_turns_about_the_ends_of_its_flat():
    """M. Steenbergen, Veh. Syst. Dyn. 46 (2008) 143: the centre falls by (l/2 - |s|)^2/2R."""
    profile = irr.with_defects(irr.SmoothRail(), None, irr.Flat(at=10.0, length=0.05), R)
    s = np.linspace(-0.04, 0.04, 81)
    expected = -(np.maximum(0.025 - np.abs(s), 0.0) ** 2) / (2 * R)
    found = Trajectory(R)(profile, 10.0 + s)
    print(f"trajectory: largest difference {1e6 * np.abs(found - expected).max():.3f} um")
    np.testing.assert_allclose(found, expected, atol=0.01 * 0.025**2 / (2 * R))


def test_a_flat_on_a_curved_tread_ends_where_the_plane_leaves_the_wheel():
    """Of radius 0.3 m across the outline is the ellipse x^2/2R + y^2/0.6 = d."""
    y = np.linspace(-0.03, 0.03, 61)
    lines = irr.TreadLines(y, 0.3 - np.sqrt(0.09 - y**2))
    s = np.linspace(-0.03, 0.03, 61)
    cut = irr.Flat(length=0.04).depth(s, R, lines) > 0
    inside = s[:, None] ** 2 / (2 * R) + y**2 / 0.6
    d = 0.04**2 / (8 * R)
    assert cut[inside < 0.99 * d].all() and not cut[inside > 1.01 * d].any()


def test_a_worn_flat_is_a_haversine_of_the_depth_given():
    s = np.array([-0.02, -0.01, 0.0, 0.01, 0.02, 0.5])
    lines = irr.TreadLines.touch()
    worn = irr.RoundedFlat(length=0.04, middle=0.3e-3).depth(s, R, lines)[:, 0]
    np.testing.assert_allclose(worn, [0, 0.15e-3, 0.3e-3, 0.15e-3, 0, 0], atol=1e-18)
    as_chord = irr.RoundedFlat(length=0.04).depth(s, R, lines)[2, 0]
    assert as_chord == pytest.approx(0.04**2 / (8 * R))


def test_a_wheel_that_is_not_round_has_its_orders_and_fades_in():
    wheel = irr.OutOfRound(at=1.0, orders=(1, 20), amplitudes=(2e-4, 1e-5), phases=(0.0, 0.5))
    profile, x = irr.with_defects(irr.SmoothRail(), None, wheel, R), np.linspace(0, 9, 200)
    angle = (x - 1.0) / R
    expected = 2e-4 * np.cos(angle) + 1e-5 * np.cos(20 * angle + 0.5)
    np.testing.assert_allclose(profile(x), expected, atol=1e-15)
    assert irr.faded(profile, 0.0, 3.0)(0.0) == 0.0


@pytest.mark.parametrize(("along", "scale"), [("s", 1e-3), ("angle", np.pi / 180 * R)])
@pytest.mark.parametrize(("interpolation", "exact"), [("cubic", 1e-9), ("linear", 1e-6)])
def test_a_depth_map_is_read_and_interpolated(tmp_path, along, scale, interpolation, exact):
    """A map of a cubic is met to rounding by splines, and by straight lines at its places."""
    places, y = np.linspace(-3.0, 3.0, 13), np.linspace(-20.0, 20.0, 9)

    def depth(p, q):
        return 0.01 * (9.0 - p**2) * (1.0 + 0.01 * q)

    rows = [f"{q},{float(depth(p, q))!r},{p}" for q in y for p in places]  # any order
    file = tmp_path / "map.csv"
    file.write_text("\n".join([f"y,depth,{along}", *rows]))
    worn = irr.DepthMap(file=str(file), interpolation=interpolation)
    p, q = np.array([2.5, -1.3, 0.2, 4.0]), np.array([7.0, -3.3, 25.0])
    found = worn.depth(p * scale, R, irr.TreadLines(1e-3 * q, np.zeros(3)))
    expected = 1e-3 * depth(p[:, None], q)
    expected[3], expected[:, 2] = 0.0, 0.0
    np.testing.assert_allclose(found, expected, atol=exact)
    assert worn.half_length(R) == pytest.approx(3.0 * scale)
    assert not worn.read.mirrored


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x,y,depth\n0,0,0", "no column 'angle'"),
        ("s,y,depth\n0,0,0\n1,0,0\n0,1,0", "a full grid"),
        ("s,y,depth\n0,0,0\n1,0,0\n0,1,0\n0,1,0", "a full grid"),
        ("s,y,depth\n0,0,0\n1,0,nan\n0,1,\n1,1,0", "line 3, column 'depth' is 'nan'"),
        ("s,y,depth\n0,0,0\n1,0,-999\n0,1,0\n1,1,0", "line 3, .* looks like a placeholder"),
        ("s,y,depth\n0,0,0\n1,0,0\n0,1,200\n1,1,0", "line 4, .* is 200 mm; allowed: -10 to 10"),
    ],
)
def test_what_is_no_depth_map_is_refused(tmp_path, text, message):
    (tmp_path / "map.csv").write_text(text)
    with pytest.raises(InputError, match=message):
        irr.DepthMap(file=str(tmp_path / "map.csv")).half_length(R)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda s, y, d: (s, y, d), ""),
        (lambda s, y, d: (s, y, 0.0), "the depth is zero throughout"),
        (
            lambda s, y, d: (s, y, 1e-3 * d),
            r"the largest depth is 0\.2 um; column 'depth' is in mm",
        ),
        (lambda s, y, d: (s, y, -d), r"no depth is above 0: the tread stands up by 0\.2 mm"),
        (
            lambda s, y, d: (s, y + 100.0, d),
            "y goes from 80 to 120 mm; the tape circle, y = 0, has",
        ),
        (lambda s, y, d: (s, y, d + 0.1), r"ends along the wheel 0\.1 mm of depth are left"),
        (lambda s, y, d: (s, y, d + 5.0 * (s == y == 0)), r"s = -5 and 0 mm, y = 0 mm, .* by 5\."),
    ],
)
def test_maps_that_may_be_none_are_warned_of(tmp_path, change, said):
    places = [(s, y) for s in range(-30, 31, 5) for y in (-20, 0, 20)]
    rows = [change(s, y, 0.2 * np.cos(np.pi * s / 60) ** 2) for s, y in places]
    file = tmp_path / "map.csv"
    file.write_text("\n".join(["s,y,depth", *(f"{s},{y},{d:.9f}" for s, y, d in rows)]))
    found = doubtful(file, irr.DepthMap(file=str(file)).read, R)
    assert len(found) == bool(said)
    assert not said or re.search(said, found[0])


def test_a_map_of_the_whole_wheel_has_no_ends(tmp_path):
    file = tmp_path / "map.csv"
    rows = [f"{angle},{y},0.1" for angle in range(-180, 181, 5) for y in (-20, 20)]
    file.write_text("\n".join(["angle,y,depth", *rows]))
    assert not doubtful(file, irr.DepthMap(file=str(file)).read, R)


def test_defects_are_not_faded_and_must_lie_behind_the_fade_in():
    roughness = irr.sample_profile(irr.paper_spectrum(), 1)
    joint, flat = irr.DippedJoint(at=10.0), irr.Flat(at=12.0)
    both = irr.faded(irr.with_defects(roughness, joint, flat, R), 6.0, 3.0)
    x = np.linspace(6.0, 13.0, 500)
    alone = irr.faded(roughness, 6.0, 3.0)(x)
    expected = joint(x) + irr.with_defects(irr.SmoothRail(), None, flat, R)(x)
    np.testing.assert_allclose(both(x) - alone, expected, atol=1e-15)
    with pytest.raises(InputError) as caught:
        irr.faded(irr.with_defects(roughness, joint, flat, R), 9.0, 3.0)
    assert [p.partition("'")[0] for p in caught.value.problems] == [
        "irregularity: the rail",
        "irregularity: the wheel",
    ]
    with pytest.raises(InputError, match="no derivatives"):
        both(x, 1)
