"""Profiles as curves by arc length: continuity, drawn dimensions, closest points."""

import itertools
import tomllib

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles import wheel_profile
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.resources import resource

NAMES = ("60E1", "S1002", "cone", "cylinder")


def curve_of(name):
    return rail_curve(name) if name == "60E1" else wheel_curve(name)


class Drawing:
    """S1002 in its sections, straight from the file's polynomials and arcs; the cone 1:20."""

    def __init__(self, name):
        self.sections, self.reference = [], {}
        if name == "S1002":
            data = tomllib.loads(resource("meshes", "profiles", "S1002.toml").read_text())
            self.sections, self.reference = data["section"], data["reference"]

    def __call__(self, y, derivative=0):
        """Height above the tape circle, slope or second derivative [m, 1, 1/m]."""
        if not self.sections:
            return [y / 20, 0 * y + 1 / 20, 0 * y][derivative]
        s = np.asarray(y, dtype=float) / 1e-3
        ends = np.array([section["to"] for section in self.sections])
        number = np.minimum(np.searchsorted(ends, s, side="right"), len(ends) - 1)
        values = [self.of(self.sections[k], v, derivative) for k, v in zip(number, s, strict=True)]
        return -np.array(values) * 1e-3 ** (1 - derivative)

    @staticmethod
    def of(section, s, derivative):
        if "coefficients" in section:
            return np.polynomial.Polynomial(section["coefficients"]).deriv(derivative)(s)
        (y, z), radius, sign = (section[key] for key in ("centre", "radius", "sign"))
        root = np.sqrt(max(radius**2 - (s - y) ** 2, 0.0))
        if derivative == 0:
            return z + sign * root
        return -sign * (s - y) / root if derivative == 1 else -sign * radius**2 / root**3


def heading(tangent):
    return np.arctan2(tangent[..., 1], tangent[..., 0])


@pytest.mark.parametrize(
    ("name", "step", "turn"), [("60E1", 1e-16, 1e-14), ("S1002", 0.12e-6, 5e-6)]
)
def test_joints_are_continuous_in_position_and_tangent(name, step, turn):
    pieces = curve_of(name).pieces
    for before, after in itertools.pairwise(pieces):
        end = before.frame(np.array([before.length]))
        start = after.frame(np.zeros(1))
        assert np.linalg.norm(end[0] - start[0]) <= step
        assert abs(heading(end[1]) - heading(start[1]))[0] <= turn


def test_s1002_has_the_dimensions_of_its_standard():
    wheel, drawing = wheel_curve("S1002"), Drawing("S1002")
    assert wheel.point(0.0) == pytest.approx([0.0, 0.0], abs=1e-15)
    # lateral radii on the tread (concave: negative) at s = 0, -10, +10 mm, known to 1 mm
    y = np.array([0.0, -0.01, 0.01])
    second = 1.0 / drawing(y, 2)
    assert -1e3 * second == pytest.approx([319, 191, 838], abs=1.0)
    curvature = -(second**-1) / (1 + drawing(y, 1) ** 2) ** 1.5
    assert -wheel.curvature(wheel.arc_of_y(y)) == pytest.approx(curvature, rel=1e-9)
    # flange: its tip 28 mm below the tape circle, 32.5 mm thick 10 mm below it, face at 70 degrees
    reference = dict(wheel_profile("S1002").reference)
    assert reference == drawing.reference
    s = np.linspace(*wheel.s_range, 20001)
    p, n = wheel.point(s), wheel.normal(s)
    assert -1e3 * p[:, 1].min() == pytest.approx(reference["flange_height"], abs=1e-6)
    face = np.interp(
        0.010, -p[:, 1][(s < -0.03) & (s > -0.05)][::-1], p[(s < -0.03) & (s > -0.05), 0][::-1]
    )
    assert 1e3 * (face + 0.070) == pytest.approx(reference["flange_thickness"], abs=0.02)
    steepest = np.degrees(np.arctan2(n[:, 0], -n[:, 1])).max()
    assert steepest == pytest.approx(reference["flange_angle"], abs=0.01)
    # field side falls away from the rail by 1:15
    assert drawing([0.04, 0.06], 1) == pytest.approx([1 / 15, 1 / 15], rel=1e-7)
    n = wheel.normal(wheel.arc_of_y([0.04, 0.06]))
    assert -n[:, 0] / n[:, 1] == pytest.approx([1 / 15, 1 / 15], rel=1e-7)
    radii = {-0.065: 20.5, -0.055: 12.0, -0.045: 20.0, -0.036: -13.0}
    for y, radius in radii.items():
        assert 1e-3 / wheel.curvature(wheel.arc_of_y(y)) * 1e6 == pytest.approx(radius, rel=1e-9)
    with pytest.raises(InputError, match="beyond its ends"):
        wheel.height(0.061)


def test_60e1_is_the_running_surface_on_both_sides():
    rail = rail_curve()
    radii = {0.005: 300, 0.020: 80, 0.033: 13, -0.005: 300, -0.020: 80, -0.033: 13}
    for y, radius in radii.items():
        assert 1e3 / rail.curvature(rail.arc_of_y(y)) == pytest.approx(radius, rel=1e-12)
    assert rail.curvature(rail.s_range[1] - 1e-3) == 0.0
    normal = rail.normal(rail.s_range[0] + 1e-3)
    assert normal == pytest.approx([-20 / np.hypot(20, 1), 1 / np.hypot(20, 1)], rel=1e-12)


@pytest.mark.parametrize("name", ["cone", "S1002"])
def test_curve_and_height_are_the_same_tread(name):
    drawing, wheel = Drawing(name), wheel_curve(name)
    y = np.linspace(-0.0699, 0.06, 501)
    p = wheel.point(wheel.arc_of_y(y))
    assert p[:, 0] == pytest.approx(y, abs=1e-15)
    assert p[:, 1] == pytest.approx(drawing(y), abs=1e-14)
    step = 1e-6
    middle = y[1:-1]
    slope = (wheel.height(middle + step) - wheel.height(middle - step)) / (2 * step)
    inside = np.abs(drawing(middle, 1)) < 5
    assert drawing(middle, 1)[inside] == pytest.approx(slope[inside], abs=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_arc_length_is_the_length_of_fine_chords(name):
    curve = curve_of(name)
    s = np.linspace(*curve.s_range, 40001)
    chords = np.linalg.norm(np.diff(curve.point(s), axis=0), axis=1)
    # a chord is short by k^2 h^3/24; joints of S1002 add their step of 0.12 um
    assert chords.sum() == pytest.approx(np.ptp(s), abs=0.15e-6)
    assert np.cumsum(chords) == pytest.approx(s[1:] - s[0], abs=0.2e-6)


@pytest.mark.parametrize("name", NAMES)
def test_projection_gives_back_arc_length_and_distance(name):
    curve = curve_of(name)
    s = np.linspace(*curve.s_range, 3001)[1:-1]
    distance = np.random.default_rng(1).uniform(-1e-3, 3e-3, len(s))
    found, gap = curve.project(curve.point(s) + distance[:, None] * curve.normal(s))
    # S1002's section C, given in powers of s up to 35 mm, is itself only exact to 3e-14 m
    assert gap == pytest.approx(distance, abs=1e-13)
    assert found == pytest.approx(s, abs=1e-12)


@pytest.mark.parametrize("name", ["60E1", "S1002"])
def test_the_nearest_of_several_closest_points_is_taken(name):
    curve = curve_of(name)
    y0, y1 = curve.point(np.array(curve.s_range))[:, 0]
    rng = np.random.default_rng(2)
    p = np.stack([rng.uniform(y0, y1, 200), rng.uniform(-0.06, 0.06, 200)], axis=-1)
    s, distance = curve.project(p)
    fine = curve.point(np.linspace(curve.s_range[0] - 0.08, curve.s_range[1] + 0.08, 100001))
    for k in range(len(p)):
        brute = np.hypot(*(fine - p[k]).T).min()
        # a sample lies within h/2 = 1.6 um of the foot
        assert abs(distance[k]) <= brute + 1e-15
        assert brute - abs(distance[k]) < 2e-6
    assert np.hypot(*(curve.point(s) - p).T) == pytest.approx(np.abs(distance), abs=2e-6)


def test_projection_beyond_the_ends_is_on_the_straight_continuation():
    rail = rail_curve()
    s, distance = rail.project(np.array([[0.060, -0.090]]))
    # side face 1:20 from (36.0, -14.3) mm; distance of a point to that line
    assert s[0] > rail.s_range[1]
    line = (0.060 - 0.036) * 20 / np.hypot(20, 1) + (-0.090 + 0.0143) / np.hypot(20, 1)
    assert distance[0] == pytest.approx(line, abs=1e-6)


def test_points_that_are_no_numbers_are_refused():
    with pytest.raises(InputError, match="finite"):
        rail_curve().project(np.array([[np.nan, 0.0]]))
    with pytest.raises(InputError, match="beyond its ends"):
        rail_curve().arc_of_y(0.05)
