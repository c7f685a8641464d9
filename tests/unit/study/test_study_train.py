"""Vehicles of more than one wheel in study files: read, refused, run."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.study.keys import key_reference
from contactstudy.study.kind import find_kind
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.inputs import read_inputs, work
from contactstudy.study.loading import load_study

FILE = """
[irregularity]
spectrum = "smooth"
[track]
length = "36 m"
[vehicle]
{vehicle}
[journey]
from = "{start} m"
to = "{end} m"
fade_in = "0.1 m"
time_step = "0.1 ms"
[runs.one]
solver = "point"
{run}
"""
OWN = """
source = "made up"
[car]
length = "12 m"
pivot_distance = "7 m"
wheelbase = "2 m"
axle_load = "{load}"
car_pitch_inertia = "2e5 kg*m**2"
bogie_mass = "2 t"
bogie_pitch_inertia = "1000 kg*m**2"
wheelset_mass = "1 t"
primary_vertical_stiffness = "1 MN/m"
primary_vertical_damping = "20 kN*s/m"
secondary_vertical_stiffness = "0.5 MN/m"
secondary_vertical_damping = "30 kN*s/m"
"""
G = 9.81


def study(folder, vehicle, run="", start=20, end=21):
    path = folder / "train.toml"
    path.write_text(FILE.format(vehicle=vehicle, run=run, start=start, end=end))
    return load_study(path)


def test_a_car_from_a_users_file_stands_on_its_weight(tmp_path):
    (tmp_path / "own.toml").write_text(OWN.format(load="10 t"))
    made = study(tmp_path, 'type = "train"\ncars = ["own.toml"]')
    data = execute_run(made, "one")
    assert data.contact_force.dims == ("wheel", "time")
    assert data.contact_force.isel(time=0).sum() == pytest.approx(4 * 10e3 * G / 2, rel=1e-6)
    np.testing.assert_allclose(data.position.isel(time=0), [20.0, 18.0, 13.0, 11.0])
    np.testing.assert_allclose(data.contact_force.mean("time"), 10e3 * G / 2, rtol=0.05)


def test_what_is_far_from_usual_in_a_cars_file_is_warned_of(tmp_path):
    """A mass in t without its unit is one in kg."""
    from contactstudy.study.kinds.passage.remarks import remarks

    text = OWN.format(load="10 t")
    mass = next(line for line in text.splitlines() if line.startswith("bogie_mass"))
    (tmp_path / "own.toml").write_text(text.replace(mass, "bogie_mass = 2.8"))
    told = "\n".join(remarks(study(tmp_path, 'type = "train"\ncars = ["own.toml"]')))
    assert "vehicle.cars.0: car.bogie_mass = 2.8: usual is 500 to 2e+04 kg" in told
    assert told.count("usual is") == 1


def test_the_content_of_a_cars_file_decides_its_results(tmp_path):
    own = tmp_path / "own.toml"
    keys = []
    for load in ("10 t", "11 t"):
        own.write_text(OWN.format(load=load))
        made = study(tmp_path, 'type = "train"\ncars = ["2 x own.toml reversed"]\ngaps = "1 m"',
                     start=30, end=31)  # fmt: skip
        inputs = read_inputs(made)
        assert inputs.config["vehicle"]["cars"] == ["2 x own.toml reversed"]
        assert "own.toml" in inputs.files
        keys.append(repr(work(made, inputs)[0].inputs))
    assert keys[0] != keys[1]


def test_moving_forces_are_the_static_loads_throughout(tmp_path):
    vehicle = 'type = "axle_loads"\naxle_loads = ["9.5 t", "100 kN"]\naxle_distances = ["2.5 m"]'
    data = execute_run(study(tmp_path, vehicle, 'law = "moving_force"'), "one")
    np.testing.assert_allclose(data.contact_force[0], 9.5e3 * G / 2, rtol=1e-9)
    np.testing.assert_allclose(data.contact_force[1], 50e3, rtol=1e-9)
    assert data.attrs["law"] == "moving force"
    # a light wheel on a stiff contact moves with the rail: the rail's motion is the same
    assert float(data.rail_displacement.min()) < -1e-4


@pytest.mark.parametrize(
    "vehicle, wheels",
    [
        ('type = "bogie"\ncar = "manchester"', 2),
        ('type = "hslm"\nhslm = "A10"', 36),
        ('type = "freight_wagons"\nwagons = 2', 8),
        ('type = "train"\ncars = ["china_star"]', 4),
    ],
)
def test_shipped_vehicles_are_read(tmp_path, vehicle, wheels):
    path = tmp_path / "train.toml"
    text = FILE.format(vehicle=vehicle, run="", start=400, end=410)
    path.write_text(text.replace("36 m", "420 m"))
    made = load_study(path)
    assert made.vehicle.vehicle().n_wheels == wheels
    assert made.config()["vehicle"]["type"] in vehicle


@pytest.mark.parametrize(
    "vehicle, run, message",
    [
        ('type = "train"', "", r"journey\.from = 20\.0: must leave room for the last wheel, 295 m"),
        ('type = "train"\ncars = ["s300", "s300"]\ngaps = "-1 m"', "",
         r"vehicle\.gaps\.0 = -1\.0: neighbouring cars overlap by 1 m"),
        ('type = "train"\ncars = []', "", r"vehicle\.cars: must name at least one car"),
        ('type = "train"\ncars = ["0 x s300"]', "", '"0 x s300": must be 1 to 999 of a car'),
        ('type = "train"\ncars = ["own.toml"]', "", r"own\.toml: there is no such file"),
        ('type = "train"\ncars = ["s300"]\nmodel = "three_dimensional"', "",
         r"vehicle\.model = \"three_dimensional\": car s300 lacks lateral data"),
        ('type = "train"\ncars = ["high_speed_motor"]\nmodel = "three_dimensional"', "",
         "this track has one rail"),
        ('type = "bogie"', 'wheel = "modal"\nlaw = "hertz"', r"needs a vehicle with one wheel"),
        ('type = "axle_loads"\naxle_loads = []', "", r"vehicle\.axle_loads: must have at least"),
        ("wheel_radius = 0.4", 'law = "moving_force"\ncontact_filter = "patch"',
         'must be "none" with law = "moving_force"'),
    ],
)  # fmt: skip
def test_impossible_vehicles_name_the_key(tmp_path, vehicle, run, message):
    with pytest.raises(InputError, match=message):
        study(tmp_path, vehicle, run)


def test_surface_runs_and_wheel_defects_need_one_wheel(tmp_path):
    text = FILE.format(vehicle='type = "bogie"', run="", start=20, end=30)
    text = text.replace('solver = "point"', 'solver = "surface"')
    defect = 'wheel_defect = "flat"\nwheel_defect_at = "25 m"\n[track]'
    path = tmp_path / "train.toml"
    path.write_text(text.replace("[track]", defect))
    with pytest.raises(InputError) as caught:
        load_study(path)
    text = "\n".join(caught.value.problems)
    assert 'runs.one.solver = "surface": needs a vehicle with one wheel (here 2)' in text
    assert "irregularity.wheel_defect: needs a vehicle with one wheel (here 2)" in text


def test_the_keys_of_vehicle_files_are_listed():
    tables = find_kind("passage").file_tables["Vehicle files"]
    listed = key_reference(tables)
    assert "| `axle_load` | N |" in listed and "| `secondary_above_bogie` | m |" in listed
