"""Worn profiles from CSV: the sampled drawing comes back, and faults are all named."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.worn import worn_curve

# arc lengths sampled: 60E1 down to the side faces, S1002 from the flange's face on
RANGES = {"60E1": (-0.0415, 0.0415), "S1002": (-0.0455, 0.055)}
STEP = 0.2e-3


def drawn(name):
    return rail_curve(name) if name == "60E1" else wheel_curve(name)


def body_of(name):
    return "rail" if name == "60E1" else "wheel"


def write(path, points, header="y [mm],z [mm]", scale=1e3):
    rows = [f"{scale * y:.9g},{scale * z:.9g}" for y, z in points]
    path.write_text("\n".join([header, *rows]) + "\n", "utf-8")
    return path


def sampled(name, noise=0.0):
    curve = drawn(name)
    s = np.arange(*RANGES[name], STEP)
    offset = noise * np.random.default_rng(3).standard_normal((len(s), 1))
    return curve.point(s) + offset * curve.normal(s)


@pytest.mark.parametrize(
    ("name", "noise", "off", "bend"), [("60E1", 0.0, 2e-6, 0.1), ("S1002", 5e-6, 4e-6, 0.3)]
)
def test_points_of_a_drawing_give_back_the_curve_and_its_curvature(
    tmp_path, name, noise, off, bend
):
    exact = drawn(name)
    file = write(tmp_path / "worn.csv", sampled(name, noise))
    curve = worn_curve(file, body_of(name))
    assert curve.name == "worn.csv"
    assert curve.point(0.0) == pytest.approx([0.0, 0.0], abs=1e-12)
    # the residual is the noise, less what the spline's freedom takes up of it
    assert 0.9 * noise < curve.residual < 1.05 * noise + 0.3e-6
    s = np.linspace(RANGES[name][0] + 1e-3, RANGES[name][1] - 1e-3, 400)
    foot, distance = exact.project(curve.point(s) + exact.point(0.0))
    # the origin is taken from the fit, so all points may be off by its error at s = 0 as well
    assert np.abs(distance).max() < 2 * off
    assert np.sqrt(np.mean(distance**2)) < off
    # curvature on crown or tread (the crown has 3.3 1/m), 2 mm and more away from the joints,
    # where the drawing's jumps and the spline's cannot: RMS error; with 5 um of noise a stray
    # knot costs several 1/m over a millimetre, so the largest error is no measure
    away = np.abs(foot[:, None] - exact.joints).min(axis=1) > 2e-3
    here = away & (np.abs(foot) < 0.02)
    error = (curve.curvature(s) - exact.curvature(foot))[here]
    assert np.sqrt(np.mean(error**2)) < bend


def test_rows_may_run_either_way_and_the_unit_may_stand_beside_the_file(tmp_path):
    points = sampled("60E1")
    there = worn_curve(write(tmp_path / "a.csv", points), "rail")
    back = worn_curve(write(tmp_path / "b.csv", points[::-1], "y,z", 1.0), "rail", unit="m")
    s = np.linspace(-0.03, 0.03, 50)
    assert back.point(s) == pytest.approx(there.point(s), abs=1e-9)


def test_curves_are_known_by_file_names_and_read_again_when_changed(tmp_path):
    file = write(tmp_path / "head.csv", sampled("60E1"))
    first = rail_curve(str(file))
    assert rail_curve(str(file)) is first
    file.write_text("y [mm],z [mm]\n", "utf-8")
    with pytest.raises(InputError, match="0 points; allowed: 20"):
        rail_curve(str(file))
    with pytest.raises(InputError, match="no such file"):
        wheel_curve(str(tmp_path / "none.csv"))


def test_every_fault_of_a_file_is_named_at_once(tmp_path):
    y = np.linspace(-30, 30, 61)
    rows = [f"{v:g},{-(v**2) / 600:g}" for v in y]
    rows[10] = "nan,0"
    rows[20] = rows[19]  # repeats
    rows[30] = "-25,0"  # goes back
    rows[40] = "12.5,"
    del rows[50:55]  # a gap
    file = tmp_path / "bad.csv"
    file.write_text("\n".join(["y [mm],z [mm]", *rows]), "utf-8")
    with pytest.raises(InputError) as found:
        worn_curve(file, "rail")
    text = "\n".join(found.value.problems)
    for fault in (
        "line 12, column 'y [mm]' is 'nan'",
        "line 42, column 'z [mm]' is empty",
        "line 22: y = -11 mm repeats line 21",
        "line 32: y = -25 mm goes back behind line 31 (-1 mm)",
        "between lines 51 and 52: 6.",
    ):
        assert fault in text


@pytest.mark.parametrize(
    ("header", "unit", "scale", "fault"),
    [
        ("y,z", None, 1e3, "the unit of y and z is not stated"),
        ("y [mm],z [mm]", "m", 1e3, "'m' and 'mm'"),
        ("y [in],z [in]", None, 1e3, "'in'; allowed: mm or m"),
        ("x,z [mm]", None, 1e3, "there is no column 'y'; the file has: x, z"),
        ("y [m],z [m]", None, 1e3, "is the unit right?"),
        ("y [mm],z [mm]", None, 1.0, "is the unit right?"),
    ],
)
def test_units_and_columns_must_be_clear(tmp_path, header, unit, scale, fault):
    file = write(tmp_path / "p.csv", sampled("60E1"), header, scale)
    with pytest.raises(InputError) as found:
        worn_curve(file, "rail", unit)
    assert fault in str(found.value)


def test_a_profile_must_reach_over_its_origin(tmp_path):
    points = sampled("60E1")
    file = write(tmp_path / "p.csv", points[points[:, 0] > 0.001])
    with pytest.raises(InputError, match="from below to above 0"):
        worn_curve(file, "rail")


@pytest.mark.parametrize("name", ["60E1", "S1002"])
@pytest.mark.parametrize("y_up", [1, -1])
@pytest.mark.parametrize("z_up", [1, -1])
@pytest.mark.parametrize("swapped", [False, True])
def test_stated_axes_are_turned(tmp_path, name, y_up, z_up, swapped):
    """Columns either way and in either order give the same curve; undeclared ones are refused."""
    body, points = body_of(name), sampled(name)
    exact = worn_curve(write(tmp_path / "plain.csv", points), body)
    columns = points * [y_up, z_up]
    file = write(tmp_path / "other.csv", columns[:, ::-1] if swapped else columns)
    ways = "to field" if y_up > 0 else "to flange", "up" if z_up > 0 else "down"
    curve = worn_curve(file, body, ways=ways[::-1] if swapped else ways)
    s = np.linspace(-0.015, 0.015, 31)
    assert curve.point(s) == pytest.approx(exact.point(s), abs=2e-9)
    if swapped or z_up < 0 or (y_up < 0 and body == "wheel"):
        with pytest.raises(InputError):
            worn_curve(file, body)


def test_a_wheel_measured_from_its_flange_back_is_refused(tmp_path):
    points = sampled("S1002") + np.array([0.03, 0.0])
    with pytest.raises(InputError, match=r"flange's tip is at y = .* from the tape circle"):
        worn_curve(write(tmp_path / "back.csv", points), "wheel")


@pytest.mark.parametrize("name", ["60E1", "S1002"])
def test_one_spike_hardly_changes_the_curve(tmp_path, name):
    """A point 0.2 mm off is named and left out, and the peak pressure of a press stays."""
    clean = sampled(name)
    off = clean.copy()
    off[len(off) // 2, 1] += 2e-4
    curves = [worn_curve(write(tmp_path / f"{k}.csv", p), body_of(name)) for k, p in
              enumerate((clean, off))]  # fmt: skip
    assert "left out" in curves[1].notes[0] and "line" in curves[1].notes[0]
    s = np.linspace(-0.007, 0.007, 141)  # between the joints of arcs
    assert curves[1].curvature(s) == pytest.approx(curves[0].curvature(s), abs=0.1)


@pytest.mark.parametrize("name", ["60E1", "S1002"])
def test_a_rail_is_no_wheel_and_a_wheel_no_rail(tmp_path, name):
    other = {"rail": "wheel", "wheel": "rail"}[body_of(name)]
    ends = (-0.0455, 0.0455 if name == "60E1" else 0.055)
    file = write(tmp_path / "wrong.csv", drawn(name).point(np.arange(*ends, STEP)))
    with pytest.raises(InputError, match=f"does not look like a {other}"):
        worn_curve(file, other)
