"""Every kind of impossible record is refused with its line, wherever it stands (seeded)."""

import random
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.exceptions import InputError
from contactstudy.irregularity import measured_profile
from contactstudy.irregularity.doubtful import doubtful

ROWS = 400


def record(seed):
    """Positions and levels [mm] of a plausible record."""
    rng = np.random.default_rng(seed)
    x = 0.25 * np.arange(ROWS)
    waves = rng.uniform(3.0, 40.0, 8)
    return x, sum(rng.normal() * np.sin(2 * np.pi * x / w) for w in waves) * 0.3


def cells(seed):
    x, level = record(seed)
    return [["x", "level"], *([f"{a:.2f}", f"{b:.3f}"] for a, b in zip(x, level, strict=True))]


def read(folder, rows, level="level", unit="mm", wavelengths=(2.5, 42.0), **more):
    file = folder / "record.csv"
    file.write_text("\n".join(",".join(row) for row in rows) + "\n", "utf-8")
    return measured_profile(file, level, unit, wavelengths=wavelengths, **more)


def wide(rows, at, random):
    rows[at] = [*rows[at], str(random.randrange(10, 999))]
    return f"line {at + 1} has 3 cells, the header 2"


def gap(rows, at, random):
    at = min(at, ROWS - 12)
    del rows[at + 1 : at + 1 + random.randrange(6, 10)]
    return f"lines {at + 1} to {at + 2}: "


def placeholder(rows, at, random):
    rows[at][1] = random.choice(["-999", "999", "9999", "-9999.0", "999.99", "-99999", "32767"])
    return f"line {at + 1}, column 'level' is {float(rows[at][1]):g}, which looks like"


def too_large(rows, at, random):
    rows[at][1] = f"{random.choice([-1, 1]) * random.uniform(101, 9000):.2f}"
    return f"line {at + 1}, column 'level' is {float(rows[at][1]):g} mm; allowed: at most 100 mm"


def no_number(rows, at, random):
    column = random.randrange(2)
    rows[at][column] = random.choice(["1_0", "１.5", "٣", "nan", "inf", "0x1p3", "1e999", "--1"])
    return f"line {at + 1}, column '{['x', 'level'][column]}' is '{rows[at][column]}'"


def twice(rows, at, random):
    for row in rows:
        row.append(row[1])
    return "there is more than one column 'level'"


def dead(rows, at, random):
    for row in rows[1:]:
        row[1] = "0.375"
    return "column 'level' is 0.375 in all rows: a dead channel"


FAULTS = (wide, gap, placeholder, too_large, no_number, twice, dead)


@pytest.mark.parametrize("fault", FAULTS)
@settings(max_examples=15, deadline=None)
@given(at=st.integers(2, ROWS - 2), seed=st.integers(0, 99))
def test_a_fault_anywhere_is_refused_with_its_line(tmp_path_factory, fault, at, seed):
    folder, rows = tmp_path_factory.mktemp("f"), cells(seed)
    read(folder, rows)  # sound
    expected = fault(rows, at, random.Random(seed))
    with pytest.raises(InputError) as found:
        read(folder, rows)
    assert expected in str(found.value)


def test_what_is_allowed(tmp_path):
    rows = cells(1)
    rows = [[*row, " "] for row in rows]  # an empty cell behind the last column
    del rows[50:53]  # 1 m without a row, less than half of 2.5 m
    assert read(tmp_path, rows).wavelengths == (2.5, 42.0)
    nines = [["x", "level"], *([f"{k}", f"{9.99 * np.sin(k):.2f}"] for k in range(ROWS))]
    nines[7][1] = "9.99"
    assert read(tmp_path, nines, wavelengths=None).levels.size == ROWS
    zero = [["x", "level"], *([f"{k}", "0.0"] for k in range(ROWS))]
    assert not read(tmp_path, zero, wavelengths=None).levels.any()


def test_without_wavelengths_a_few_rows_may_be_missing(tmp_path):
    rows = cells(1)
    del rows[50:53]
    read(tmp_path, rows, wavelengths=None)
    del rows[50:53]
    with pytest.raises(InputError, match=r"lines 50 to 51: 1\.75 m .* at most 1 m, a few rows"):
        read(tmp_path, rows, wavelengths=None)


def test_position_and_level_are_different_columns(tmp_path):
    with pytest.raises(InputError, match="'x' is named as the position and as the level"):
        read(tmp_path, cells(1), level="x")


def test_the_band_pass_is_sound_a_longest_wavelength_from_the_ends(tmp_path):
    """A record cut out of a longer one against the longer one: the bound of `sound`."""
    rng, errors = np.random.default_rng(4), []
    for _ in range(30):
        n = 6000
        f = np.fft.rfftfreq(n, 0.25)
        shape = 1.0 / np.maximum(f, 1 / 150) ** 1.5
        level = np.fft.irfft(np.fft.rfft(rng.standard_normal(n)) * shape, n)
        level *= 0.8 / level.std()
        rows = [["x", "level"], *([f"{0.25 * k}", f"{v:.6f}"] for k, v in enumerate(level))]
        whole = read(tmp_path, rows)
        part = read(tmp_path, [rows[0], *rows[2000:4000]])
        low, high = part.sound
        assert low - part.domain[0] == 42.0
        at = np.array([low, high])
        errors.append((part(at) - whole(at)) / whole.levels.std())
    rms = float(np.sqrt(np.mean(np.square(errors))))
    print(f"error a longest wavelength from an end: {rms:.3f} of the level's own size (1/12)")
    assert rms < 0.12


def waves(lengths, rms, spacing, long):
    """Sinusoids of equal power with a given standard deviation, over so many metres."""
    x = np.arange(0.0, long, spacing)
    level = sum(np.sin(2 * np.pi * x / w + k) for k, w in enumerate(lengths))
    return x, level * rms / level.std()


TRACK, SHORT_WAVES = (4.0, 7.0, 13.0, 31.0, 57.0), (0.013, 0.03, 0.05, 0.1, 0.21)
SIZES = [  # waves [m], rms [m], spacing and length [m]
    (TRACK, 1e-4, 0.25, 200.0),  # the smoothest slab track
    (TRACK, 1e-2, 0.25, 200.0),  # a siding
    (SHORT_WAVES, 1.5e-7, 0.005, 50.0),  # ground rail
    (SHORT_WAVES, 1e-6, 0.005, 100.0),
    (SHORT_WAVES, 1e-4, 0.005, 20.0),  # corrugation
    ((*SHORT_WAVES, 0.6, 1.3), 1e-6, 0.005, 100.0),
    ((*TRACK, *SHORT_WAVES), 1e-3, 0.005, 100.0),
    (TRACK, 1e-7, 0.25, 20.0),  # too short to tell
]


@pytest.mark.parametrize(("lengths", "rms", "spacing", "long"), SIZES)
@pytest.mark.parametrize(("unit", "metre"), [("m", 1.0), ("mm", 1e-3), ("um", 1e-6)])
def test_small_and_large_levels_are_read_in_every_unit(
    tmp_path, lengths, rms, spacing, long, unit, metre
):
    x, level = waves(lengths, max(rms, 1.2e-7), spacing, long)
    rows = [
        ["x", "level"],
        *([f"{a:.4f}", f"{b / metre:.12g}"] for a, b in zip(x, level, strict=True)),
    ]
    read(tmp_path, rows, unit=unit, wavelengths=None)


@pytest.mark.parametrize(
    ("lengths", "rms", "spacing", "band", "right", "stated"),
    [
        (TRACK, 1e-3, 0.25, "longer than 3 m of .* um rms", "m", "mm"),
        (TRACK, 3e-3, 0.25, "longer than 3 m of .* um rms", "mm", "um"),
        ((*TRACK, *SHORT_WAVES), 5e-4, 0.005, "longer than 3 m of .* um rms", "m", "mm"),
        (SHORT_WAVES, 5e-6, 0.005, "shorter than 0.3 m of .* mm rms", "um", "mm"),
        (SHORT_WAVES, 2e-5, 0.005, "shorter than 0.3 m of .* mm rms", "mm", "m"),
    ],
)
def test_a_wrong_unit_is_told_by_the_waves(tmp_path, lengths, rms, spacing, band, right, stated):
    metre = {"m": 1.0, "mm": 1e-3, "um": 1e-6}[right]
    x, level = waves(lengths, rms, spacing, 100.0)
    rows = [
        ["x", "level"],
        *([f"{a:.4f}", f"{b / metre:.12g}"] for a, b in zip(x, level, strict=True)),
    ]
    with pytest.raises(InputError, match=rf"read in {stated}, has waves {band}.*unit {right}\b"):
        read(tmp_path, rows, unit=stated, wavelengths=None)


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_a_level_of_next_to_nothing_has_the_wrong_unit(tmp_path, unit):
    """Metres that are called micrometres, and whatever else leaves less than a polished rail."""
    rows = cells(1)
    factor = 1e-6 if unit == "mm" else 1e-9
    rows = [rows[0], *([x, f"{factor * float(level):.15f}"] for x, level in rows[1:])]
    with pytest.raises(InputError, match=r"standard deviation of .* um .*is the unit right"):
        read(tmp_path, rows, unit=unit)


@pytest.mark.parametrize(("mark", "name"), [(";", "semicolons"), ("\t", "tabs")])
def test_other_separators_are_named(tmp_path, mark, name):
    file = tmp_path / "record.csv"
    file.write_text("\n".join(mark.join(row) for row in cells(2)) + "\n", "utf-8")
    with pytest.raises(InputError, match=f"parted by {name}"):
        measured_profile(file, "level", "mm")


@pytest.mark.parametrize(
    ("name", "unit"),
    [("level (m)", "mm"), ("left_um", "mm"), ("z [ft]", "m"), ("level mm", "m"), ("z_µm", "mm")],
)
def test_a_unit_in_the_columns_name_is_not_contradicted(tmp_path, name, unit):
    rows = cells(3)
    if unit == "um":
        rows[1:] = [[x, f"{1e3 * float(level):g}"] for x, level in rows[1:]]
    rows[0][1] = name
    with pytest.raises(InputError, match=r"says .* and is to be read in"):
        read(tmp_path, rows, level=name, unit=unit)


@pytest.mark.parametrize(("name", "unit"), [("left_mm", "mm"), ("z (µm)", "um"), ("film", "mm")])
def test_a_unit_in_the_columns_name_may_be_the_one_stated(tmp_path, name, unit):
    rows = cells(3)
    if unit == "um":
        rows[1:] = [[x, f"{1e3 * float(level):g}"] for x, level in rows[1:]]
    rows[0][1] = name
    assert read(tmp_path, rows, level=name, unit=unit).levels.size == ROWS


def test_positions_are_in_metres(tmp_path):
    rows = cells(3)
    rows[0][0] = "x (km)"
    with pytest.raises(InputError, match=r"'x \(km\)' says km, and is to be read in m"):
        read(tmp_path, rows, x_column="x (km)")


def test_columns_that_are_missing_and_units_that_differ_are_named_together(tmp_path):
    with pytest.raises(InputError) as caught:
        read(tmp_path, cells(3), x_column="x_km", level="left_um")
    told = str(caught.value)
    assert all(f"there is no column '{name}'" in told for name in ("x_km", "left_um"))
    assert "'x_km' says km" in told and "'left_um' says um" in told


def test_a_record_that_runs_backwards_is_one_fault(tmp_path):
    rows = cells(4)
    with pytest.raises(InputError, match=r"positions fall from 99\.75 to 0; .*turn the rows round"):
        read(tmp_path, [rows[0], *rows[:0:-1]])


@settings(max_examples=25, deadline=None)
@given(at=st.integers(3, ROWS - 3), seed=st.integers(0, 99), up=st.booleans())
def test_a_spike_anywhere_is_warned_of_with_its_place_and_height(tmp_path_factory, at, seed, up):
    folder, rows = tmp_path_factory.mktemp("s"), cells(seed)
    assert not doubtful(read(folder, rows, wavelengths=None), (2.5, 42.0))
    rows[at][1] = f"{float(rows[at][1]) + (20.0 if up else -20.0):.3f}"
    (text,) = doubtful(read(folder, rows, wavelengths=None), (2.5, 42.0))
    where, high = re.search(r"at X = (\S+) m the level stands (\S+) mm off", text).groups()
    assert float(where) == float(rows[at][0])
    assert abs(float(high) - 20.0) < 0.5


def test_where_rounding_is_most_of_the_level_is_where_its_noise_meets_the_spectrum(tmp_path):
    """A record of density A/k^4, rounded to q: q^2/12 dx/(2 pi) = A/k^4 gives the wavelength."""
    rng, dx, n, quantum = np.random.default_rng(8), 0.25, 8192, 0.5
    omega = 2.0 * np.pi * np.fft.rfftfreq(n, dx)
    amplitude = 1.0 / np.maximum(omega, 2.0 * np.pi / 60.0) ** 2
    phases = np.exp(2j * np.pi * rng.random(omega.size))
    level = np.fft.irfft(amplitude * phases * np.sqrt(n / dx * 2.0 * np.pi * 0.02), n)  # mm
    meets = (0.02 / (quantum**2 / 12.0 * dx / (2.0 * np.pi))) ** 0.25
    rows = [["x", "level"], *([f"{dx * k}", f"{v:.6f}"] for k, v in enumerate(level))]
    assert not doubtful(read(tmp_path, rows, wavelengths=None), (0.6, 42.0))
    rounded = quantum * np.rint(level / quantum)
    rows = [["x", "level"], *([f"{dx * k}", f"{v:.6f}"] for k, v in enumerate(rounded))]
    (text,) = doubtful(read(tmp_path, rows, wavelengths=None), (0.6, 42.0))
    assert "in steps of 0.5 mm" in text
    below = float(re.search(r"shorter than (\S+) m", text)[1])
    assert below == pytest.approx(2.0 * np.pi / meets, rel=0.15)
    assert not doubtful(read(tmp_path, rows, wavelengths=None), (2.0 * below, 42.0))


@settings(max_examples=25, deadline=None)
@given(at=st.integers(3, ROWS - 60), length=st.integers(12, 50), seed=st.integers(0, 99))
def test_a_stretch_of_one_value_is_warned_of_with_its_ends(tmp_path_factory, at, length, seed):
    folder, rows = tmp_path_factory.mktemp("s"), cells(seed)
    for k in range(at, at + length):
        rows[k][1] = rows[at][1]
    found = doubtful(read(folder, rows, wavelengths=None), (2.5, 42.0))
    first, last = float(rows[at][0]), float(rows[at + length - 1][0])
    (text,) = [text for text in found if "a dead channel?" in text]
    low, high = (float(v) for v in re.search(r"from X = (\S+) to (\S+) m", text).groups())
    assert low <= first and last <= high and high - low < last - first + 3 * 0.25
    assert not any("cut off" in text for text in found)


@pytest.mark.parametrize("share", [0.5, 0.8])
def test_a_level_cut_off_at_a_limit_is_warned_of(tmp_path, share):
    rows = cells(5)
    level = np.array([float(row[1]) for row in rows[1:]])
    for row, value in zip(rows[1:], np.minimum(level, share * level.max()), strict=True):
        row[1] = f"{value:.3f}"
    found = doubtful(read(tmp_path, rows, wavelengths=None), (2.5, 42.0))
    assert sum("none is beyond: cut off" in text for text in found) == 1
