import time

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.irregularity import MeasuredProfile, faded, measured_profile


def _write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def _wave(path, x, level, name="level_mm"):
    lines = [f"{a:.6f},{b:.9f}" for a, b in zip(x, level, strict=True)]
    return _write(path, "\n".join([f"x,{name}", *lines]) + "\n")


# levels of hundredths in m and mm, of tens in um
@pytest.mark.parametrize(
    ("unit", "digits", "scale"), [("m", ".0", 1.0), ("mm", ".0", 1e-3), ("um", "", 1e-4)]
)
def test_unit_and_origin(tmp_path, unit, digits, scale):
    rows = [f"{x},{digits}{level}" for x, level in zip(range(98000, 98004), "1325", strict=True)]
    file = _write(tmp_path / "a.csv", "\n".join(["km,z", *rows]) + "\n")
    profile = measured_profile(
        file, "z", unit, x_column="km", origin=98000.0, interpolation="linear"
    )
    assert profile.domain == (0.0, 3.0)
    np.testing.assert_allclose(profile([0.0, 0.5, 3.0]), np.array([0.01, 0.02, 0.05]) * scale)
    np.testing.assert_allclose(profile([0.5, 1.5], 1), np.array([0.02, -0.01]) * scale)
    with pytest.raises(InputError, match="no second derivative"):
        profile(1.0, 2)


def test_cubic_interpolation_of_a_sine_with_derivatives(tmp_path):
    x = np.arange(0.0, 40.001, 0.25)
    file = _wave(tmp_path / "sine.csv", x, 2.0 * np.sin(x))
    profile = measured_profile(file, "level_mm", "mm")
    at = np.linspace(3.0, 37.0, 500)
    np.testing.assert_allclose(profile(at), 2e-3 * np.sin(at), atol=2e-7)
    np.testing.assert_allclose(profile(at, 1), 2e-3 * np.cos(at), atol=5e-6)
    np.testing.assert_allclose(profile(at, 2), -2e-3 * np.sin(at), atol=2e-5)


def test_band_pass_keeps_what_lies_inside_without_phase(tmp_path):
    x = np.arange(0.0, 1000.0, 0.25)
    inside = np.sin(2 * np.pi * x / 10.0)
    outside = np.sin(2 * np.pi * x / 0.9) + np.sin(2 * np.pi * x / 200.0) + 4.0
    file = _wave(tmp_path / "two.csv", x, inside + outside)
    profile = measured_profile(file, "level_mm", "mm", wavelengths=(2.5, 42.0))
    middle = x[(x > 100) & (x < 900)]
    expected = 1e-3 * np.sin(2 * np.pi * middle / 10.0)
    np.testing.assert_allclose(profile(middle), expected, atol=2e-5)
    edge = measured_profile(
        _wave(tmp_path / "edge.csv", x, np.sin(2 * np.pi * x / 2.5)),
        "level_mm", "mm", wavelengths=(2.5, 42.0),
    )  # fmt: skip
    ratio = edge(middle).std() / (1e-3 / np.sqrt(2))
    assert 20 * np.log10(ratio) == pytest.approx(-6.02, abs=0.1)


def test_uneven_rows_are_resampled_before_the_filter(tmp_path):
    rng = np.random.default_rng(1)
    x = np.arange(0.0, 400.0, 0.25) + rng.uniform(-0.05, 0.05, 1600)
    file = _wave(tmp_path / "uneven.csv", x, np.sin(2 * np.pi * x / 10.0))
    profile = measured_profile(file, "level_mm", "mm", wavelengths=(2.5, 42.0))
    at = np.linspace(100.0, 300.0, 777)
    np.testing.assert_allclose(profile(at), 1e-3 * np.sin(2 * np.pi * at / 10.0), atol=2e-5)


def test_rows_too_uneven_for_equal_spacing_are_refused(tmp_path):
    """Three rows a micrometre apart each quarter of a metre: 400 million equally spaced ones."""
    x = (np.arange(0.0, 400.0, 0.25)[:, None] + 1e-6 * np.arange(3)).ravel()
    file = _wave(tmp_path / "clusters.csv", x, np.sin(2 * np.pi * x / 10.0))
    with pytest.raises(InputError, match=r"clusters\.csv: half of the rows .*1e-06 m.*up to 20"):
        measured_profile(file, "level_mm", "mm", wavelengths=(2.5, 42.0))


def test_positions_that_are_not_covered(tmp_path):
    file = _wave(tmp_path / "short.csv", 98000.0 + np.arange(50.0), np.zeros(50))
    with pytest.raises(InputError, match=r"short\.csv: .*6 m to 30 m.*98000 m to 98049 m.*origin"):
        measured_profile(file, "level_mm", "mm", required=(6.0, 30.0))
    profile = measured_profile(file, "level_mm", "mm", origin=98000.0, required=(6.0, 30.0))
    with pytest.raises(InputError, match="covers 0 m to 49 m"):
        profile([1.0, 50.0])
    # before the fade-in nothing is asked of the measurement
    assert faded(profile, 10.0, 3.0)(-5.0) == 0.0


def test_every_fault_of_a_file_is_reported_at_once(tmp_path):
    text = "x,level_mm\n0,1\n1,abc\n2,NaN\n2,3\n1.5,4\n,5\n6\n7,inf\n"
    file = _write(tmp_path / "bad.csv", text)
    with pytest.raises(InputError) as caught:
        measured_profile(file, "level_mm", "inch", interpolation="quadratic")  # type: ignore[arg-type]
    message = str(caught.value)
    print(message)
    for part in (
        "bad.csv, line 3, column 'level_mm' is 'abc'; allowed: finite numbers",
        "line 4, column 'level_mm' is 'NaN'",
        "line 5, column 'x': 2 repeats the position before it (2)",
        "line 6, column 'x': 1.5 falls below the position before it (2)",
        "line 7, column 'x' is empty",
        "line 8, column 'level_mm' is empty",
        "line 9, column 'level_mm' is 'inf'",
        "level unit is 'inch'; allowed: m, mm, um",
        "interpolation is 'quadratic'; allowed: cubic, linear",
    ):
        assert part in message
    assert caught.value.exit_status == 2


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "is empty"),
        ("x,level_mm\n0,1\n1,2\n", "2 rows of numbers; allowed: 4 or more"),
        ("x,level\n0,1\n1,2\n2,3\n3,4\n", "no column 'level_mm'; the file has: x, level"),
    ],
)
def test_files_without_the_data(tmp_path, text, expected):
    with pytest.raises(InputError, match=expected):
        measured_profile(_write(tmp_path / "none.csv", text), "level_mm", "mm")


def test_first_lines_that_are_no_header_are_shown(tmp_path):
    file = tmp_path / "level.csv"
    for line in ("# measured in May", "sep=,", "Filename=a"):
        file.write_text(line + "\nx,level\n0,1\n1,2\n")
        with pytest.raises(
            InputError, match=f"line 1 is '{line.strip(',')}'; allowed: names of columns"
        ) as e:
            measured_profile(file, "level", "mm")
        assert len(e.value.problems) == 1


def test_a_header_of_very_many_columns_is_read_at_once(tmp_path):
    """Names are counted in one pass: pairwise, these would take a minute."""
    file = tmp_path / "level.csv"
    names = ",".join(f"c{k}" for k in range(100_000))
    file.write_text(f"x,level,{names}\n0,1\n1,2\n2,1\n3,3\n4,1\n")
    start = time.process_time()
    measured_profile(file, "level", "mm")
    assert time.process_time() - start < 5.0


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"absent\.csv: there is no such file"):
        measured_profile(tmp_path / "absent.csv", "level_mm", "mm")
    with pytest.raises(InputError, match="cannot be read"):
        measured_profile(tmp_path, "level_mm", "mm")
    (tmp_path / "binary.csv").write_bytes(b"\x89PNG\r\n\xff\xfe\x00")
    with pytest.raises(InputError, match="not a CSV file"):
        measured_profile(tmp_path / "binary.csv", "level_mm", "mm")


def test_arguments_and_coverage_are_reported_together(tmp_path):
    file = _wave(tmp_path / "short.csv", np.arange(50.0), np.zeros(50))
    with pytest.raises(InputError) as caught:
        measured_profile(file, "level_mm", "feet", required=(6.0, 60.0))
    assert len(caught.value.problems) == 2


def test_a_long_list_of_faults_is_cut(tmp_path):
    rows = "\n".join(f"{i},x" for i in range(50))
    with pytest.raises(InputError, match="and 40 more faults of this kind"):
        measured_profile(_write(tmp_path / "text.csv", "x,level_mm\n" + rows), "level_mm", "mm")


@pytest.mark.parametrize(
    ("wavelengths", "expected"),
    [
        ((0.4, 42.0), "allowed: above 0.5 m"),
        ((2.5, 500.0), "allowed: up to 99.75 m"),
        ((42.0, 2.5), "shortest < longest"),
    ],
)
def test_impossible_filters(tmp_path, wavelengths, expected):
    x = np.arange(0.0, 100.0, 0.25)
    file = _wave(tmp_path / "f.csv", x, np.zeros_like(x))
    with pytest.raises(InputError, match=expected):
        measured_profile(file, "level_mm", "mm", wavelengths=wavelengths)


def test_a_profile_from_arrays():
    x = np.linspace(0.0, 10.0, 41)
    profile = MeasuredProfile(x, x**3)
    assert profile([2.1, 3.3]) == pytest.approx([2.1**3, 3.3**3])
    assert profile(2.0, 2) == pytest.approx(12.0)
