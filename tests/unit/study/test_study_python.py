"""A study built in Python is checked exactly as a file is, and gets the same defaults."""

from dataclasses import replace

import pytest

from contactstudy.exceptions import InputError
from contactstudy.solvers.journey import Journey
from contactstudy.study.axes.design import COMBINATIONS
from contactstudy.study.axes.keys import TABLES
from contactstudy.study.keys import AXES, key_reference
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.runs import SOLVERS, PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import SECTIONS, Study
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.kinds.positions.table import Positions, PositionsStudy
from contactstudy.study.loading import load_study
from contactstudy.track.model import DiscreteSupports, Slab, Track, WinklerFoundation
from contactstudy.validation import entries
from contactstudy.vehicle import BareWheel, WheelColumn

RUNS = {"surface": SurfaceRun()}


def built(**parts):
    return Study(**{"name": "s", "title": "S"} | parts)


@pytest.mark.parametrize(
    ("parts", "data"),
    [
        (
            lambda: {"track": Track(length=12.0)},
            {"track": {"length": 12.0}},
        ),
        (
            lambda: {"solid": Solid(cell_length=0.07), "runs": RUNS},
            {"solid": {"cell_length": 0.07}, "runs": {"surface": {"solver": "surface"}}},
        ),
        (
            lambda: {"solid": Solid(pressure_at=(40.0,)), "runs": RUNS},
            {"solid": {"pressure_at": [40.0]}, "runs": {"surface": {"solver": "surface"}}},
        ),
        (
            lambda: {"vehicle": BareWheel(wheel_radius=0.1), "runs": RUNS},
            {
                "vehicle": {"type": "bare_wheel", "wheel_radius": 0.1},
                "runs": {"surface": {"solver": "surface"}},
            },
        ),
        (
            lambda: {"runs": {"p": PointRun(time_step=1.0)}},
            {"runs": {"p": {"solver": "point", "time_step": 1.0}}},
        ),
        (
            lambda: {"runs": RUNS, "reference": "point"},
            {"runs": {"surface": {"solver": "surface"}}, "compare": {"reference": "point"}},
        ),
    ],
)
def test_what_is_impossible_in_combination(parts, data):
    with pytest.raises(InputError) as in_python:
        built(**parts())
    with pytest.raises(InputError) as in_a_file:
        parse_study("s", data)
    assert in_python.value.problems == in_a_file.value.problems


def test_a_journey_beyond_the_track():
    with pytest.raises(InputError, match=r"journey\.to = 30\.0: must lie on the track, 0 to 12 m"):
        built(track=Track(length=12.0), journey=Journey(6.0, 30.0))


def test_rules_of_a_run():
    with pytest.raises(InputError, match=r'direction = "Y": must be "Z" with law = "hertz"'):
        PointRun(law="hertz", direction="Y")
    with pytest.raises(InputError, match=r"rho_inf: applies only with integrator = "):
        PointRun(rho_inf=0.5)


def test_a_whole_section_has_its_own_defaults():
    solid = Solid(section="whole")
    assert solid.interface_modes == 20
    assert (solid.contact_half_length, solid.contact_half_width) == (0.010, 0.012)
    file = parse_study(
        "s", {"solid": {"section": "whole"}, "runs": {"surface": {"solver": "surface"}}}
    )
    assert built(solid=solid, runs=RUNS).config() == file.config()
    assert Solid(section="whole", interface_modes=14).interface_modes == 14


def test_cells_fit_the_supports():
    track = Track(support=DiscreteSupports(spacing=0.65), length=39.0)
    assert built(track=track, runs=RUNS).solid.cell_length == pytest.approx(0.65 / 6)


def test_a_part_of_another_type_is_refused():
    with pytest.raises(InputError, match=r"vehicle: is a Vehicle; must be of type WheelColumn or"):
        built(vehicle=WheelColumn().vehicle(), track=3)
    with pytest.raises(InputError, match=r"Track\.support: is a str; must be of type Discrete"):
        Track(support="discrete")


def test_runs_are_checked():
    with pytest.raises(InputError, match=r"runs\.irregularity: .*its own group"):
        built(runs={"irregularity": PointRun()})
    with pytest.raises(InputError, match=r"runs\.p: is a Journey; must be of type PointRun or Sur"):
        built(runs={"p": Journey()})


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ({"runs": None}, "runs: is a NoneType; must be of type dict"),
        ({"runs": [PointRun()]}, "runs: is a list; must be of type dict"),
        ({"runs": {3: PointRun()}}, r"runs\.3: a run's name is letters"),
        ({"runs": {"p": PointRun()}, "reference": []}, r"compare\.reference = \[\]: must be text"),
        ({"runs": None, "track": 3}, "track: is a int"),
        ({"name": 3}, "name = 3: must be text"),
        ({"title": 3}, "title = 3: must be text"),
        ({"description": ["a"]}, r"description = \['a'\]: must be text"),
        ({"companions": "smooth_rail"}, 'companions = "smooth_rail": must be a list'),
        ({"companions": [3]}, r"companions\.0 = 3: must be text"),
        ({"smooth": "yes"}, r'compare\.smooth = "yes": must be true or false'),
    ],
)
def test_parts_of_a_wrong_type_are_refused(parts, said):
    with pytest.raises(InputError, match=said):
        built(**parts)


def test_positions_have_defaults():
    study = PositionsStudy("s")
    assert (study.title, study.description, study.table) == ("s", "", Positions())
    for wrong in ({"title": 3}, {"description": None}, {"companions": None}):
        with pytest.raises(InputError, match=rf"{next(iter(wrong))}( = 3)?: must be"):
            PositionsStudy("s", **wrong)


def test_texts_have_no_unit():
    assert "positions.roll" not in load_study("manchester", ["positions.roll=rest"]).units()
    assert load_study("manchester").units()["positions.roll"] == "rad"
    units = load_study("point_vs_surface").units()
    assert "runs.point.k_r" in units and "runs.point_tangent.k_r" not in units


def test_every_variant_comes_back_from_its_own_values():
    tracks = (
        Track(support=DiscreteSupports(layer=Slab())),
        Track(support=WinklerFoundation(1e8)),
        Track(support=None),
    )
    for track in tracks:
        study = built(track=track, vehicle=BareWheel(), runs={"p": PointRun()})
        assert parse_study("s", study.config()).config() == study.config()


def test_a_shipped_study_refined():
    study = load_study("point_vs_surface")
    finer = replace(study, solid=replace(study.solid, mesh_size=0.001))
    assert finer.config()["solid"]["mesh_size"] == 0.001
    with pytest.raises(InputError, match=r"solid\.contact_half_width"):
        replace(study, solid=replace(study.solid, contact_half_width=0.001))


def test_key_reference_has_every_key():
    tables = SECTIONS | {"runs.NAME": SOLVERS, "positions": Positions}
    text = key_reference(tables, Study)
    for row in ("`companions` |  | [] | a list, each text |", "`compare.reference` |  |  | text |"):
        assert row in text.partition("## [")[0]
    assert "l, where it is 1/e; only with coherence = decaying |" in text
    for key in (*COMBINATIONS, "combine", "samples", "seed", "keep", "expected", *TABLES):
        assert key in AXES
    for name, table in tables.items():
        assert f"## [{name}]" in text
        for key, entry in entries(table).items():
            (row,) = [
                line
                for line in text.partition(f"## [{name}]")[2].split("\n## ")[0].splitlines()
                if line.startswith(f"| `{key}` |")
            ]
            assert entry.parameter.meaning and entry.parameter.meaning in row
    assert (
        "| `pad_stiffness` | N/m | 6.5e+07 | above 0 N/m | of a rail pad; only with support" in text
    )
    assert (
        "14 (half), 20 (whole)" in text
        and "not with spectrum = sinusoid or measured or smooth" in text
    )
