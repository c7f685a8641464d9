"""Where defects make wheel and rail touch, and contact stiffnesses that cannot be pressed."""

import math

import pytest

from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.inputs import read_inputs
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.touching import touched_beyond

RADIUS = 0.43
JOURNEY = {"from": "5.4 m", "to": "6 m", "fade_in": "0 m", "time_step": "20 us"}


def study_of(irregularity, zone="12 mm", **tables):
    table = {"spectrum": "smooth", **irregularity}
    runs = {"surface": {"solver": "surface"}}
    return parse_study(
        "touching",
        {
            "irregularity": table,
            "journey": JOURNEY,
            "track": {"length": "10.8 m"},
            "vehicle": {"wheel_radius": RADIUS},
            "solid": {"contact_half_length": zone},
            "runs": runs,
            **tables,
        },
    )


def flat(length):
    return {"wheel_defect": "flat", "wheel_defect_at": "5.6 m", "wheel_defect_length": length}


def _ahead(problem):
    return float(problem.partition("above ")[2].partition(" m")[0])


def test_a_wheel_rests_on_the_ends_of_its_flat():
    """Half the chord ahead: 15 mm of 30 mm, which a zone of 12 mm does not hold."""
    with pytest.raises(InputError) as caught:
        read_inputs(study_of(flat("30 mm")))
    (problem,) = caught.value.problems
    assert problem.startswith("solid.contact_half_length = 0.012: must be above ")
    assert _ahead(problem) == pytest.approx(0.015, rel=0.01)
    # the patch reaches 6 mm further
    (note,) = read_inputs(study_of(flat("30 mm"), "18 mm")).warnings
    assert "mm from the wheel's centre, and the patch reaches 6.1 mm further" in note
    assert not touched_beyond(study_of(flat("30 mm"), "24 mm"))


def test_a_wheel_climbs_a_step_from_afar():
    """Rolling on the low rail it touches the edge when that is sqrt(2 R h) ahead."""
    step = {"rail_defect": "step", "rail_defect_at": "5.7 m", "rail_defect_height": "0.5 mm"}
    with pytest.raises(InputError) as caught:
        read_inputs(study_of(step))
    (problem,) = caught.value.problems
    assert _ahead(problem) == pytest.approx(math.sqrt(2 * RADIUS * 0.5e-3), rel=0.03)


def test_what_touches_in_the_middle_and_point_runs_are_let_alone():
    weld = {"rail_defect": "weld", "rail_defect_at": "5.7 m", "rail_defect_length": "0.2 m"}
    assert not touched_beyond(study_of(weld))
    points = {"point": {"solver": "point", "k_r": "1e9 N/m"}}
    assert not touched_beyond(study_of(flat("30 mm"), runs=points))


def test_a_tangent_that_is_that_of_hertz_is_said_with_its_value():
    runs = {"point": {"solver": "point", "k_r": "2 x tangent"}}
    given = {
        "rail": "given",
        "bending_stiffness": 6.4e6,
        "mass_per_length": 60.0,
        "length": "10.8 m",
    }
    (note,) = (
        n for n in read_inputs(study_of({}, runs=runs, track=given)).warnings if "closed form" in n
    )
    assert note.startswith('runs.point.k_r = "2 x tangent": is that of Hertz')
    own = {"point": {"solver": "point", "k_r": "2 x hertz_tangent"}}
    warnings = read_inputs(study_of({}, runs=own, track=given)).warnings
    assert not any("closed form" in n for n in warnings)


@pytest.mark.parametrize(
    "run", [{"k_r": "tangent"}, {"law": "press"}, {"law": "hertz", "hertz_constant": "press"}]
)
def test_an_unsupported_rail_is_not_pressed(run):
    runs = {"point": {"solver": "point", **run}}
    track = {"support": "none", "length": "10.8 m"}
    with pytest.raises(InputError, match=r'runs.point: .* track.support = "none"'):
        study_of({}, runs=runs, track=track)
    hertz = {"point": {"solver": "point", "k_r": "hertz_tangent"}}
    assert study_of({}, runs=hertz, track=track)
