"""Study files: defaults, overrides, and every kind of bad input with its message."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.positions.kind import POSITIONS
from contactstudy.study.loading import (
    find_study,
    load_companions,
    load_study,
    shipped_studies,
)


def problems_of(data: dict) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        parse_study("bad", data)
    return caught.value.problems


def point(**keys: object) -> dict:
    return {"runs": {"point": {"solver": "point", **keys}}}


def test_an_empty_file_is_the_papers_case():
    study = parse_study("empty", {})
    track, vehicle, journey = study.track, study.vehicle, study.journey
    assert (track.length, track.support.spacing, track.support.pad_stiffness) == (36.0, 0.6, 65e6)
    assert (track.support.sleeper_mass, track.support.layer.stiffness) == (125.5, 137.75e6)
    assert (vehicle.wheel_mass, vehicle.bogie_mass, vehicle.car_mass) == (890, 760, 5219)
    assert (vehicle.primary_stiffness, vehicle.secondary_damping) == (0.59e6, 22.55e3)
    assert (journey.start, journey.end, journey.speed) == (6.0, 30.0, 300 / 3.6)
    irregularity = study.irregularity
    assert (irregularity.roughness, irregularity.band) == (0.8e-7, (0.08, 20.0))
    assert (irregularity.terms, irregularity.seed) == (1000, 1)


def test_the_shipped_comparison_is_the_issues():
    study = load_study("point_vs_surface")
    assert study.reference == "surface"
    runs = {
        n: (r.solver, getattr(r, "rail", ""), getattr(r, "law", "")) for n, r in study.runs.items()
    }
    assert runs == {
        "surface": ("surface", "", ""),
        "point": ("point", "euler", "linear"),
        "point_tangent": ("point", "euler", "linear"),
        "hertz": ("point", "euler", "hertz"),
        "hertz_closed_form": ("point", "euler", "hertz"),
        "hertz_timoshenko": ("point", "timoshenko", "hertz"),
        "timoshenko_tangent": ("point", "timoshenko", "linear"),
    }
    assert study.runs["point"].k_r == 1e11 and study.runs["point"].elements_per_bay == 4
    assert study.runs["point_tangent"].k_r == "tangent"
    # the law is all that is changed: the stiffness stays that of the press
    assert study.runs["hertz"] == replace(study.runs["point_tangent"], law="hertz",
                                          k_r=1e11, hertz_constant="press")  # fmt: skip
    assert study.solid.mesh_size == 0.002
    assert study.companions == ("smooth_rail",)


def test_one_name_means_one_model_in_all_shipped_studies():
    found = {}
    for name in shipped_studies():
        measured = ["irregularity.file=level.csv"] if name == "measured_level" else []
        study = load_study(name, measured)
        study = getattr(study, "study", study)  # of one with axes
        for run in getattr(study, "runs", {}):
            table = {k: v for k, v in study.resolved_run(run).items() if k != "time_step"}
            if "wheel" in table and table.get("solver") != "surface" and table["wheel"] != "modal":
                del table["wheel"]  # of a press, which all point runs share
            found.setdefault(run, {})[name] = table
    for run, tables in found.items():
        models = {str(sorted(table.items())) for table in tables.values()}
        assert len(models) == 1, (run, tables)
    assert len(found["point"]) > 3


def test_every_shipped_study_loads():
    for name in shipped_studies():
        overrides = ["irregularity.file=level.csv"] if name == "measured_level" else []
        study = load_study(name, overrides)
        assert study.name == name and study.title
        assert len(load_companions(study)) == len(study.companions)


def test_overrides_take_toml_values_or_plain_text():
    study = load_study(
        "point_vs_surface",
        [
            "journey.speed=250 km/h",
            "irregularity.seed = 7",
            "runs.point.k_r=rigid",
            'journey.stations=["12 m", 15]',
            "irregularity.jitter=true",
            "companions=[]",
        ],
    )
    assert study.journey.speed == pytest.approx(250 / 3.6)
    assert study.irregularity.seed == 7 and study.irregularity.jitter is True
    assert study.runs["point"].k_r == "rigid"
    assert study.runs["point"].stepper == "generalised_alpha"
    assert study.journey.stations == (12.0, 15.0) and study.companions == ()


def test_a_path_in_a_file_is_relative_to_the_file(tmp_path):
    (tmp_path / "s.toml").write_text(
        '[irregularity]\nspectrum="measured"\nfile="a.csv"\nlevel_column="z"\n'
    )
    assert load_study(tmp_path / "s.toml").irregularity.file == str(tmp_path / "a.csv")
    study = load_study(tmp_path / "s.toml", ["irregularity.file=b.csv"])
    assert study.irregularity.file == "b.csv"


@pytest.mark.parametrize(
    ("data", "parts"),
    [
        ({"trak": {}}, ["trak: unknown key", "did you mean 'track'"]),
        ({"track": {"pad_stifness": 1}}, ["track.pad_stifness: unknown key", "'pad_stiffness'"]),
        ({"track": {"zzz": 1}}, ["track.zzz: unknown key; allowed: length, ends"]),
        ({"track": {"pad_stiffness": "-65 MN/m"}}, ['"-65 MN/m": must be above 0 N/m']),
        ({"track": {"pad_stiffness": "65 kg"}}, ["wrong unit 'kg'", "N/m and its multiples"]),
        ({"track": {"pad_stiffness": "65 MNm"}}, ["unit 'MNm'"]),
        ({"track": {"length": "inf m"}}, ["track.length", "must be a number in m"]),
        ({"track": {"length": math.inf}}, ["must be finite (m)"]),
        ({"track": {"poisson_ratio": 0.5}}, ["at least 0 and at most 0.49"]),
        ({"track": {"ends": "clampd"}}, ['must be "clamped", "pinned" or "free"', "'clamped'"]),
        ({"track": {"length": 36.1}}, ["whole number of support spacings of 0.6 m"]),
        ({"track": {"pad_length": "0.7 m"}}, ["below the support spacing, 0.6 m"]),
        ({"track": {"foundation_stiffness": 1}}, ['only with support = "winkler"']),
        ({"track": {"support": "none", "ends": "free"}}, ["nothing holds"]),
        ({"track": 36}, ["track = 36: must be a table"]),
        (point(elements_per_bay=0), ["runs.point.elements_per_bay = 0", "at least 1"]),
        (point(elements_per_bay=2.5), ["whole number at least 1"]),
        (point(elements_per_bay=True), ["whole number at least 1"]),
        (point(local_compliance="yes"), ["true or false"]),
        (point(k_r="stiff"), ['"tangent" or "secant" or', '"rigid" or a multiple like "2 x']),
        (point(k_r=-1), ["above 0 N/m"]),
        (point(k_r="0 x tangent"), ["runs.point.k_r", "multiple"]),
        (point(k_r="2 x rigid"), ["runs.point.k_r", "multiple"]),
        (point(patch_filter="following"), ["only with contact_filter"]),
        (point(bay_compliance=True), ["runs.point.local_compliance", "must be true"]),
        (point(rail="solid", bay_compliance=True), ["bay_compliance: applies only with"]),
        (point(contact_filter="bedding"), ["runs.point.law", '"hertz" with contact_filter']),
        (point(contact_filter="patch", patch_filter="following"), ["runs.point.law"]),
        ({"track": {"rail": "given"}} | point(law="press"), ["needs a rail with a profile"]),
        (point(hertz_constant="press"), ['hertz_constant: applies only with law = "hertz"']),
        (point(wheel="modal", direction="Y"), ["runs.point.direction", '"Z" with wheel']),
        (point(contact_filter="patch", direction="Y"), ["runs.point.direction", "contact_filter"]),
        ({"track": {"rail": "given"}} | point(wheel="modal"), ["needs a rail with a profile"]),
        (point(law="hertz", k_r=1), ['runs.point.k_r: applies only with law = "linear"']),
        (point(k_r="rigid", integrator="average_acceleration"), ["generalised_alpha"]),
        (point(direction="Y", law="hertz"), ['must be "Z"']),
        (point(direction="Y", rail="solid"), ['must be "Z" on the solid rail']),
        (point(time_step="1 s"), ["runs.point.time_step", "half the duration"]),
        (point(time_step="1 ps"), ["runs.point.time_step", "for 5000000 steps"]),
        ({"journey": {"time_step": "1 ps"}}, ["journey.time_step", "at least 5.76e-08 s"]),
        (
            {"irregularity": {"spectrum": "sinusoid", "wavelength": "8 mm"}}
            | {"journey": {"time_step": "50 us", "to": "12 m"}}
            | point(),
            ["irregularity.wavelength: a wave of 0.008 m", "in 1.9 time"],  # 83.3 m/s x 50 us
        ),
        (
            {"irregularity": {"band": [0.08, 300.0]}} | point(time_step="0.2 ms"),
            ["irregularity.band", "in 1.3 time steps at 83.3333 m/s"],
        ),
        (
            {"irregularity": {"rail_defect": "corrugation", "rail_defect_wavelength": "8 mm"}}
            | point(),
            ["irregularity.rail_defect_wavelength"],
        ),
        ({"runs": {"a": {}}}, ['runs.a.solver: is missing; must be "point" or "surface"']),
        ({"runs": {"a": {"solver": "poit"}}}, ["did you mean 'point'"]),
        ({"runs": {"a b": {"solver": "point"}}}, ["letters, digits and _"]),
        ({"runs": {"s": {"solver": "surface", "rail": "euler"}}}, ["runs.s.rail: applies only"]),
        ({"runs": 3}, ["one table a run"]),
        (point() | {"compare": {"reference": "surface"}}, ["must be a run of the study: point"]),
        (point() | {"compare": {"with": "point"}}, ["compare.with: unknown key"]),
        ({"journey": {"to": "60 m"}}, ["journey.to = 60.0: must lie on the track, 0 to 36 m"]),
        ({"journey": {"from": "31 m"}}, ["journey.to = 30.0: must be beyond journey.from, 31 m"]),
        ({"journey": {"from": "-1 m"}}, ["journey.from", "at least 0 m"]),
        ({"journey": {"fade_in": 24}}, ["below the distance run, 24 m"]),
        ({"journey": {"stations": [40.0]}}, ["journey.stations.0 = 40.0"]),
        ({"journey": {"time_step": "0 s"}}, ["above 0 s"]),
        ({"irregularity": {"band": [20, 0.08]}}, ["must increase"]),
        ({"irregularity": {"band": [20]}}, ["irregularity.band.1: is missing"]),
        ({"irregularity": {"spectrum": "german"}}, ["'german_low'"]),
        ({"irregularity": {"seed": -1}}, ["whole number at least 0"]),
        ({"irregularity": {"spectrum": "measured", "level_column": "a"}}, ["irregularity.file"]),
        ({"irregularity": {"file": "a.csv"}}, ['only with spectrum = "measured"']),
        ({"irregularity": {"measured_overlay": "a.csv"}}, ["level_column: is missing"]),
        ({"vehicle": {"type": "bare_wheel", "car_mass": 1}}, ['type = "wheel_column"']),
        ({"solid": {"mesh_size": "20 mm"}}, ["at most 0.008 m"]),
        ({"title": 3}, ["title = 3: must be text"]),
        ({"companions": "smooth_rail"}, ["must be a list"]),
        (
            {"solid": {"cell_length": 0.07}, "runs": {"s": {"solver": "surface"}}},
            ["must divide 0.6 m into whole cells"],
        ),
        (
            {
                "solid": {"cell_length": 0.01, "mesh_size": 0.005},
                "runs": {"s": {"solver": "surface"}},
            },
            ["at least 4 elements of solid.mesh_size"],
        ),
        (
            {
                "solid": {"mesh_size": "4 mm", "coarse_mesh_size": "3 mm"},
                "runs": {"s": {"solver": "surface"}},
            },
            ["solid.coarse_mesh_size", "at least solid.mesh_size"],
        ),
        ({"solid": {"contact_points": "corners"}}, ["solid.contact_points", "gauss", "nodes"]),
        ({"solid": {"penetration_tolerance": "1 nm"}}, ["penetration_tolerance", "augmented"]),
        (
            {"track": {"rail": "given"}, "runs": {"s": {"solver": "surface"}}},
            ["needs a rail with a profile"],
        ),
    ],
)  # fmt: skip
def test_one_problem_one_sentence(data, parts):
    problems = problems_of(data)
    assert len(problems) == 1, problems
    for part in parts:
        assert part in problems[0]


def test_everything_wrong_is_reported_at_once():
    problems = problems_of(
        {
            "foo": 1,
            "track": {"pad_stiffness": "-65 MN/m", "pad_dampng": 3},
            "journey": {"speed": "300 kg"},
            "irregularity": {"terms": 0},
            "runs": {"point": {"solver": "point", "elements_per_bay": 0}, "b": {"solver": 1}},
        }
    )
    for key in ("foo", "track.pad_stiffness", "track.pad_dampng", "journey.speed",
                "irregularity.terms", "runs.point.elements_per_bay", "runs.b.solver"):  # fmt: skip
        assert sum(p.startswith(key) for p in problems) == 1, (key, problems)
    assert len(problems) == 7


def test_a_companion_shares_track_and_journey_of_its_study(tmp_path):
    main = load_study("point_vs_surface", ["track.pad_stiffness=200 MN/m", "journey.to=24 m"])
    (companion,) = load_companions(main)
    assert companion.name == "smooth_rail" and companion.irregularity.spectrum == "smooth"
    assert companion.track.support.pad_stiffness == 200e6 and companion.journey.end == 24.0
    assert load_study("smooth_rail").journey.end == 30.0
    own = tmp_path / "own.toml"
    own.write_text('[journey]\nto = "40 m"\n')
    with pytest.raises(InputError, match=r"companion .*own.toml: journey.to = 40.0"):
        load_companions(load_study("point_vs_surface", [f'companions=["{own}"]']))


def test_a_misspelt_run_in_an_override_names_the_run_that_is_meant():
    with pytest.raises(
        InputError, match=r"runs\.pont\.solver: is missing.*name misspelt.*did you mean 'point'"
    ):
        load_study("point_vs_surface", ["runs.pont.k_r=1e9"])


def test_misspelt_study_names_get_close_matches(tmp_path):
    with pytest.raises(InputError, match="did you mean 'smooth_rail'"):
        find_study("smoth_rail")
    with pytest.raises(InputError, match=r"shipped: .*gauge_corner, .*manchester, measured_level"):
        find_study(tmp_path / "nowhere.toml")


def test_what_is_no_toml(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text("[track\nlength = 3")
    with pytest.raises(InputError, match=r"is not a TOML file .*line 1"):
        load_study(path)
    path.write_bytes(b"\xff\xfa")
    with pytest.raises(InputError, match="is not a TOML file"):
        load_study(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("journey.speed", "must be KEY=VALUE"),
        ("=3", "must be KEY=VALUE"),
        ("journey..speed=3", "must be KEY=VALUE"),
        ("title.x=3", "goes through a value that is no table"),
        ("journey.sped=3", "journey.sped: unknown key"),
    ],
)
def test_bad_overrides(text, message):
    with pytest.raises(InputError, match=message):
        load_study("paper_irregularity", [text])


def test_penetration_tolerance_is_that_of_the_augmented_lagrangian():
    runs = {"s": {"solver": "surface"}}
    study = parse_study("s", {"runs": runs})
    assert study.solid.tolerance is None
    assert "penetration_tolerance" not in study.config()["solid"]
    study = parse_study("s", {"runs": runs, "solid": {"enforcement": "augmented"}})
    assert study.solid.tolerance == study.config()["solid"]["penetration_tolerance"] == 1e-9


def test_config_and_units_are_plain_and_complete():
    study = load_study("point_vs_surface")
    config, units = study.config(), study.units()
    assert config["journey"]["from"] == 6.0 and units["journey.from"] == "m"
    assert units["runs.point.k_r"] == "N/m" and units["irregularity.band"] == "rad/m"
    assert "foundation_stiffness" not in config["track"]
    assert config["runs"]["surface"]["time_step"] == 5e-5
    for key in units:
        table: object = config
        for part in key.split("."):
            table = table[part]  # type: ignore[index]
    assert "pad_stiffness" in config["track"] and units["track.pad_stiffness"] == "N/m"


def test_shipped_files_are_found_by_path_too():
    path = shipped_studies()["smooth_rail"]
    assert find_study(path) == path and isinstance(path, Path)


def test_a_run_cannot_take_the_name_of_another_group():
    with pytest.raises(InputError, match=r"runs\.irregularity: .*its own group"):
        parse_study("s", {"runs": {"irregularity": {"solver": "point"}}})


def test_an_override_leaves_out_what_no_longer_applies():
    study = load_study("point_vs_surface", ["irregularity.spectrum=smooth", "runs.point.law=hertz"])
    assert study.irregularity.spectrum == "smooth" and study.runs["point"].law == "hertz"
    with pytest.raises(InputError, match=r"irregularity\.seed: applies only with"):
        load_study("point_vs_surface", ["irregularity.spectrum=smooth", "irregularity.seed=2"])


@pytest.mark.parametrize(
    ("track", "length"),
    [
        ({"spacing": 0.65, "length": 39.0}, 0.65 / 6),
        ({}, 0.1),
        ({"support": "winkler", "length": 12.05, "foundation_stiffness": 1e8}, 12.05 / 120),
    ],
)
def test_cells_fit_the_supports_unless_their_length_is_given(track, length):
    runs = {"s": {"solver": "surface"}}
    journey = {"from": 3.0, "to": 9.0}
    study = parse_study("s", {"track": track, "journey": journey, "runs": runs})
    assert study.solid.cell_length == pytest.approx(length, rel=1e-12)
    if track:
        with pytest.raises(InputError, match=r"solid\.cell_length"):
            solid = {"cell_length": 0.1}
            parse_study("s", {"track": track, "journey": journey, "runs": runs, "solid": solid})


def test_a_name_that_looks_like_a_number_stays_a_name():
    study = load_study("s1002_inclined", ["wheelset.rail_profile=60E1", "track.rail=60E1"])
    assert (study.wheelset.rail_profile, study.track.rail.profile_name) == ("60E1", "60E1")
    positions = load_study("manchester", ["positions.rail_profile=60E1"])
    assert positions.table.rail_profile == "60E1"


def test_a_study_of_positions_is_named_where_none_is_meant():
    with pytest.raises(InputError, match=r"is a study of positions \(table \[positions\]\)"):
        POSITIONS.export(load_study("manchester"), Path("press.inp"))


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("mesh_size=1 um", "must be at least 0.0002 and at most 0.008 m"),
        ("wheel_frequency=1 MHz", "must be above 0 and at most 20000 Hz"),
        ("animation_frames=100000", "at most 1000"),
        (
            "contact_half_width=30 mm",
            "must be at least solid.mesh_size, 0.002 m, and at most 0.023 m",
        ),
        (
            "contact_half_length=1 mm",
            "must be at least solid.mesh_size, 0.002 m, and at most 0.04 m",
        ),
    ],
)
def test_sizes_that_cannot_be_meshed_are_refused_by_key(setting, message):
    with pytest.raises(InputError) as error:
        load_study("point_vs_surface", [f"solid.{setting}"])
    (problem,) = error.value.problems
    assert problem.startswith("solid.") and message in problem
