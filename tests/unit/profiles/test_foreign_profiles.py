"""Profiles in other axes and of other programs, and points that are off (seeded)."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.worn import worn_curve

SHARED = Path(__file__).parents[3].parent / "shared" / "data" / "profiles"


def points(body):
    curve, ends = (wheel_curve("S1002"), (-0.066, 0.055)) if body == "wheel" else (
        rail_curve("60E1"), (-0.04, 0.04))  # fmt: skip
    return curve.point(np.arange(*ends, 0.25e-3))


def write(path, p, head="y [mm],z [mm]", end="", separator=","):
    rows = [f"{1e3 * y:.5f}{separator}{1e3 * z:.5f}" for y, z in p]
    path.write_text("\n".join([head, *rows, end]), "utf-8")
    return path


@pytest.mark.parametrize(
    ("body", "y", "z", "named"),
    [
        ("wheel", -1, 1, ("y points",)),
        ("wheel", 1, -1, ("z points down",)),
        ("wheel", -1, -1, ("y points", "z points down")),
        ("rail", 1, -1, ("z points down",)),
    ],
)
def test_foreign_axes_are_refused_by_name(tmp_path, body, y, z, named):
    worn_curve(write(tmp_path / "sound.csv", points(body)), body)
    turned = points(body)[::y] * (y, z)
    with pytest.raises(InputError) as found:
        worn_curve(write(tmp_path / "turned.csv", turned), body)
    assert len(found.value.problems) == len(named)
    for part in named:
        assert part in str(found.value)


@pytest.mark.parametrize("body", ["wheel", "rail"])
@pytest.mark.parametrize("off", [0.05e-3, -0.2e-3])
def test_a_spike_anywhere_is_named_and_left_out(tmp_path, body, off):
    clean, p = worn_curve(write(tmp_path / "c.csv", points(body)), body), points(body)
    s = np.linspace(-0.03, 0.03, 200)
    for k in np.random.default_rng(7).integers(60, len(p) - 60, 5):
        spiked = p + np.eye(len(p))[k][:, None] * (0.0, off)
        curve = worn_curve(write(tmp_path / "s.csv", spiked), body)
        assert f"line {k + 2}:" in curve.notes[0] and "left out" in curve.notes[0]
        assert curve.point(s) == pytest.approx(clean.point(s), abs=3e-6)


MINIPROF = 'Filename=a\nXYPoints={}\nColumnDef=X,Y\n"RefPoint1="\n'
SIMPACK = "  type = {}\n units.len.f = +1.0e+03 ! factor\n point.begin\n ! y z\n"
OLD = "MINIPROF 101 148 1994 3 24\nCar Number..:\n32.58 37.11 14.71  (Sd/Sh/qR)\n"


def test_each_form_is_the_same_curve(tmp_path):
    s = np.linspace(-0.03, 0.03, 100)
    for body, forms in {
        "rail": ((".ban", MINIPROF, "", -1, -1), (".prr", SIMPACK.format(0), "point.end", 1, -1)),
        "wheel": ((".whl", OLD, "", 1, -1), (".prw", SIMPACK.format(1), "point.end", -1, -1)),
    }.items():
        p = points(body)
        expected = worn_curve(write(tmp_path / "c.csv", p), body)
        for suffix, head, end, y, z in forms:
            file = write(tmp_path / f"a{suffix}", p * (y, z), head.format(len(p)), end, " ")
            curve = worn_curve(file, body)
            assert curve.point(s) == pytest.approx(expected.point(s), abs=3e-6)
            assert any("turned" in note for note in curve.notes)
    file = write(tmp_path / "cut.ban", points("rail"), MINIPROF.format(9999), "", " ")
    with pytest.raises(InputError, match="its header counts 9999"):
        worn_curve(file, "rail")
    with pytest.raises(InputError, match="of a rail by its name"):
        worn_curve(file, "wheel")


def test_the_manchester_rail_is_one_in_both_forms():
    if not SHARED.is_dir():
        pytest.skip("sample profiles are not on this machine")
    s = np.linspace(-0.03, 0.02, 100)
    one, two = (rail_curve(str(SHARED / f"MBench_UIC60_v3{x}")) for x in (".ban", ".prr"))
    assert one.point(s) == pytest.approx(two.point(s), abs=1e-7)


@pytest.mark.parametrize(
    ("suffix", "head", "said"),
    [
        (".ban", "XOffset=12.5\nColumnDef=X,Y\n", "xoffset = 12.5, which is not applied"),
        (".ban", "Tilt=0.05\nXOffset=0.0000\nYOffset=\n", "tilt = 0.05, which is not applied"),
        (".prr", "bound.y.min = -20\nbound.y.max = 20\npoint.begin", "bound.y = -20 to 20, which"),
        (".prr", "bound.y.min = 1\nbound.y.max = 0\npoint.begin", ""),
        (".prr", "point.dist.min = 5 ! a remark\npoint.begin", "point.dist.min = 5, which is not"),
    ],
)
def test_what_a_header_states_and_nothing_is_done_of_is_said(tmp_path, suffix, head, said):
    end = "point.end" if suffix == ".prr" else ""
    file = write(tmp_path / f"a{suffix}", points("rail"), head, end, " ")
    notes = worn_curve(file, "rail").notes
    assert [said in note for note in notes if "not applied" in note] == [True] * bool(said)


@pytest.mark.parametrize("unit", ["'mm'", "nan", "1,0e3", "0", "-1000"])
def test_a_factor_of_length_that_is_none_is_shown(tmp_path, unit):
    head = f"units.len.f = {unit}\npoint.begin"
    file = write(tmp_path / "a.prr", points("rail"), head, "point.end", " ")
    with pytest.raises(InputError, match=rf"units\.len\.f = {unit}; allowed: a number above 0"):
        worn_curve(file, "rail")


def test_two_blocks_of_points_are_refused(tmp_path):
    file = write(tmp_path / "a.prr", points("rail"), "point.begin", "point.end", " ")
    file.write_text(2 * f"{file.read_text()}\n")
    with pytest.raises(InputError, match=r"2 lines 'point\.begin'; allowed: one block"):
        worn_curve(file, "rail")


@pytest.mark.parametrize("suffix", [".ban", ".prr", ".txt"])
@pytest.mark.parametrize("factor", [1e-3, 1 / 25.4])
def test_a_wrong_unit_is_told_by_the_width(tmp_path, suffix, factor):
    head, end = ("point.begin", "point.end") if suffix == ".prr" else ("a=b\n", "")
    head = "! plain" if suffix == ".txt" else head
    file = write(tmp_path / f"a{suffix}", factor * points("rail"), head, end, " ")
    with pytest.raises(InputError, match=r"mm wide with y in mm; allowed: 20 to 300 mm") as found:
        worn_curve(file, "rail")
    assert len(found.value.problems) == 1


def test_points_whose_curve_goes_back_are_named(tmp_path):
    file = write(tmp_path / "a.csv", rail_curve("60E1").point(np.arange(-0.0455, 0.0455, 2e-3)))
    with pytest.raises(InputError, match=r"goes back at y = 36\.\d+ mm, z = -15"):
        worn_curve(file, "rail").arc_of_y(0.0)


@pytest.mark.parametrize("separator", [";", " ", "\t", "; "])
def test_decimal_commas_are_named_and_not_read_as_two_numbers(tmp_path, separator):
    p = points("rail")
    sound = write(tmp_path / "a.txt", p, "!", separator=separator)
    assert worn_curve(sound, "rail").residual < 1e-6
    commas = tmp_path / "b.txt"
    commas.write_text(sound.read_text().replace(".", ","))
    with pytest.raises(InputError, match="line 2: does not begin with two numbers, which have dec"):
        worn_curve(commas, "rail")
