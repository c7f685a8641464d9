"""One error of a study file hides no other: faults of different tables are all named, and alone."""

from pathlib import Path
from random import Random

import pytest

from contactstudy.exceptions import InputError
from contactstudy.reporter import Quiet
from contactstudy.study.loading import load_study
from contactstudy.study.terminal import check_study

_BASE = {
    "": [],
    "irregularity": [],
    "track": [],
    "vehicle": [],
    "journey": [],
    "solid": [],
    "runs.whole": ['solver = "surface"'],
    "runs.point": ['solver = "point"'],
    "runs.other": ['solver = "point"'],
}
#: Table -> its faults: what stands in it, and a part of its message.
_FAULTS = {
    "": [
        ("title = 3", "title = 3"),
        ('companions = ["nowhere"]', "companion nowhere: study nowhere: no such file"),
        ("compares = 1", "compares: unknown key"),
    ],
    "irregularity": [
        ('file = "level.csv"', "irregularity.file: applies only with"),
        ("seed = -1", "irregularity.seed = -1"),
        ("band = [20, 3]", "irregularity.band = [20.0, 3.0]: must increase"),
        ('spectrum = "measured"\nlevel_column = "r"', "irregularity.file: is missing"),
        (
            'spectrum = "measured"\nfile = "level.csv"\nlevel_column = "r"',
            "{}/level.csv, line 3, column 'r' is 'x'",
        ),
        (
            'spectrum = "measured"\nfile = "none.csv"\nlevel_column = "r"',
            "{}/none.csv: there is no such file",
        ),
        ('rail_defect = "weld"\nrail_defect_at = "7 m"', "irregularity.rail_defect_at = 7"),
        ('spectrum = "papier"', 'irregularity.spectrum = "papier"'),
    ],
    "track": [
        ('pad_stiffnes = "65 MN/m"', "track.pad_stiffnes: unknown key"),
        ('pad_stiffness = "65 kN"', 'track.pad_stiffness = "65 kN"'),
        ('length = "36.1 m"', "track.length = 36.1"),
        ('pad_length = "0.7 m"', "track.pad_length = 0.7"),
        ('layer = "sand"', 'track.layer = "sand"'),
    ],
    "vehicle": [
        ("wheel_mass = -1", "vehicle.wheel_mass = -1"),
        ("wheel_radius = 0", "vehicle.wheel_radius = 0"),
        ("wheels = 3", "vehicle.wheels: unknown key"),
        ('type = "bike"', 'vehicle.type = "bike"'),
    ],
    "journey": [
        ('fade_in = "25 m"', "journey.fade_in = 25"),
        ('to = "36.5 m"', "journey.to = 36.5"),
        ("stations = [-1]", "journey.stations.0 = -1"),
        ("stations = [40]", "journey.stations.0 = 40"),
        ('speeds = "3 m/s"', "journey.speeds: unknown key"),
    ],
    "solid": [
        ("mesh_size = 0", "solid.mesh_size = 0"),
        ("cell_length = 0.07", "solid.cell_length = 0.07"),
        ("pressure_at = [1.0]", "solid.pressure_at.0 = 1"),
        ('wheel_section = "none.toml"', "solid.wheel_section: "),
        ("meshsize = 3", "solid.meshsize: unknown key"),
    ],
    "wheelset": [('lateral_shift = "1 mm"', "wheelset.lateral_shift: applies only with")],
    "measured": [
        ('file = "level.csv"\ntime_column = "x"', "measured.channels: is missing"),
        ('file = "none.csv"\nchannels = ["a = contact_force"]', "measured.file: {}/none.csv"),
        ("rate = 3", "measured.rate = 3"),
    ],
    "roughness": [
        ('file = "none.csv"', "{}/none.csv: there is no such file"),
        ('file = "roughness.csv"', "{}/roughness.csv, line 2, column 'level' is 'x'"),
        ('wavelength_unit = "km"', 'roughness.wavelength_unit = "km"'),
    ],
    "runs.other": [
        ('solver = "points"', 'runs.other.solver = "points"'),
        ('law = "herz"', 'runs.other.law = "herz"'),
        ("k_r = 1e20", "without numerical damping the force chatters"),
        ('travel = "backward"', 'runs.other.travel = "backward"'),
        ('law = "hertz"\nk_r = 1e9', "runs.other.k_r: applies only with"),
        ('time_step = "1 s"', "runs.other.time_step = 1"),
        ('elements_per_bay = 3\nrail = "solid"', "runs.other.elements_per_bay: applies only"),
    ],
    "runs.third": [
        ('law = "linear"', "runs.third.solver: is missing"),
        ("", "runs.third.solver: is missing"),
    ],
    "runs.3": [('solver = "point"', "runs.3: a run's name is")],
    "compare": [
        ('reference = "none"', 'compare.reference = "none"'),
        ("softer = 3", "compare.softer = 3"),
        ("rung = true", "compare.rung: unknown key"),
    ],
    "sweep": [
        ('"journey.sped" = [1, 2]', "sweep: journey.sped: unknown key"),
        ('"journey.speed" = ["3 kg"]', 'journey.speed = "3 kg": has the wrong unit'),
    ],
    "refine": [('"track.pad_length" = [1e-3]', "refine.track.pad_length = [0.001]")],
    "quick": [
        ('"track.lenght" = 3', "quick: track.lenght: unknown key"),
        ('"journey.time_step" = -3', "quick: journey.time_step = -3"),
    ],
}


def _study(folder: Path, faults: dict[str, str]) -> Path:
    (folder / "level.csv").write_text("x,r\n0,0\n0.01,x\n0.02,0\n0.03,0\n")
    (folder / "roughness.csv").write_text("wavelength,level\n1,x\n")
    tables = {name: list(lines) for name, lines in _BASE.items()}
    for table, fault in faults.items():
        known = tables.setdefault(table, [])
        given = {line.split(" =")[0] for line in fault.splitlines()}
        tables[table] = [line for line in known if line.split(" =")[0] not in given] + [fault]
    text = ["\n".join([f"[{name}]" if name else "", *lines, ""]) for name, lines in tables.items()]
    (folder / "study.toml").write_text("\n".join(text))
    return folder / "study.toml"


def _problems(study: Path) -> list[str]:
    try:
        check_study(load_study(study), Quiet())
    except InputError as error:
        return list(error.problems)
    return []


@pytest.mark.parametrize("seed", range(40))
def test_every_fault_is_named_and_no_other(tmp_path: Path, seed: int) -> None:
    random = Random(seed)
    tables = random.sample(list(_FAULTS), random.randint(2, len(_FAULTS)))
    chosen = {table: random.choice(_FAULTS[table]) for table in tables}
    found = _problems(_study(tmp_path, {table: text for table, (text, _) in chosen.items()}))
    expected = {part.format(tmp_path) for _, part in chosen.values()}
    missing = [part for part in expected if not any(part in p for p in found)]
    more = [p for p in found if not any(part in p for part in expected)]
    assert not missing and not more, "\n".join([*missing, "", *more, "", *found])


def _told(folder: Path, text: str) -> str:
    (folder / "study.toml").write_text(text)
    return "\n".join(_problems(folder / "study.toml"))


def test_a_bridge_of_which_nobody_knows_the_length_hides_nothing(tmp_path):
    found = _told(
        tmp_path,
        '[track]\nstructure = "bridge"\nspans = "3 x -32 m"\nends = "free"\n'
        '[vehicle]\ntype = "train"\ncars = ["s300_end", "none"]\nmodel = "spatial"\n'
        '[journey]\nspeed = "3 kg"\nto = "1000 km"\n[irregularity]\nspectrum = "measured"\n'
        'file = "none.csv"\nlevel_column = "r"\nwavelengths = [20, 3]\n'
        '[runs.a]\nsolver = "point"\nk_r = "3 m"\nlocal_compliance = true\n'
        '[runs.b]\nsolver = "surface"\nwheel = "soft"\n',
    )
    named = (
        "track.spans", "track.ends", "vehicle.cars.1", "vehicle.model", "journey.speed", "none.csv",
        "irregularity.wavelengths", "runs.a.k_r", "runs.a.local_compliance", "runs.b.wheel",
        "runs.b: needs a meshed rail",
    )  # fmt: skip
    assert [name for name in named if name not in found] == [], found
    assert len(found.split("\n")) == len(named) + 2  # three spans


def test_positions_with_a_wrong_value_are_held_to_their_other_rules(tmp_path):
    found = _told(
        tmp_path,
        '[positions]\nlateral = ["3 kg"]\nwheels = []\nload = -3\nwheel_profile = "none.csv"\n',
    )
    named = ("positions.lateral.0", "positions.wheels", "positions.load", "none.csv")
    assert [name for name in named if name not in found] == [], found
    assert len(found.split("\n")) == len(named)
