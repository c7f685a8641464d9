"""Studies of trains on bridges: their keys, what is refused, and a whole run."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.contact import hertz
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.forecast import needs
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.loading import load_study
from contactstudy.track.deck import Antoing
from contactstudy.track.structure import StructureTrack

TRACK = {
    "structure": "bridge",
    "spans": ["2 x 8 m", "6 m"],
    "approach_before": 12.0,
    "approach_behind": 12.0,
}
TRAIN = {"type": "train", "cars": ["s300"]}
LATERAL = {"type": "train", "cars": ["high_speed_trailer"], "model": "three_dimensional"}
RUN = {"solver": "point", "k_r": 1e9}
SLOW = {"speed": 60.0, "time_step": 1e-3, "stations": [16.0, 5.0]}


def study(
    track=None,
    vehicle=None,
    run=None,
    journey=None,
    spectrum="german_low",
    base=RUN,
    rails=(),
    **runs,
):
    return parse_study(
        "bridge",
        {
            "track": TRACK | (track or {}),
            "vehicle": vehicle or TRAIN,
            "journey": journey or SLOW,
            "irregularity": {"spectrum": spectrum, **dict(rails)},
            "runs": {"one": base | (run or {}), **runs},
        },
    )


def refused(*texts, **given):
    with pytest.raises(InputError) as caught:
        study(**given)
    found = "\n".join(caught.value.problems)
    for text in texts:
        assert text in found, found
    return found


def test_a_train_enters_the_bridge_and_leaves_it():
    made = study()
    assert made.track.structure.spans == (8.0, 8.0, 6.0)
    assert made.track.length == 46.0
    behind = -build.vehicle(made).contact_offsets.min()
    assert (made.journey.start, made.journey.end) == (0.0, pytest.approx(46.0 + behind))
    assert made.config()["track"]["spans"] == [8.0, 8.0, 6.0]
    assert made.config()["track"]["deck"] == "box_32m"
    assert made.units()["track.spans"] == "m"
    # both rails are one in a planar run: a wheelset presses with two wheels
    assert build.vehicle(made).n_contacts == 8
    track = build.point_track(made, made.runs["one"], build.track(made))
    assert isinstance(track, StructureTrack)
    assert track.planar


def test_a_planar_run_of_one_car():
    data = execute_run(study(spectrum="smooth"), "one")
    assert (data.attrs["rail"], data.attrs["local_compliance"]) == ("euler", 0)
    assert data.contact_force.dims == ("wheel", "time")
    assert np.isfinite(data.contact_force).all()
    assert (data.deck_displacement.sel(station=16.0) < -1e-5).any()  # the middle of a span
    assert np.isnan(data.deck_acceleration.sel(station=5.0)).all()  # on the approach
    # of all supports together: the car, but for what it accelerates and the approaches carry
    weight = sum(data.attrs["static_load"])
    carried = data.bearing_force.sum("support")
    assert 0.8 * weight < float(carried.max()) < 1.1 * weight
    assert abs(float(carried[-1])) < 0.05 * weight
    assert data.support.values.tolist() == [12.0, 20.0, 28.0, 34.0]


def test_a_run_in_space_has_lateral_forces_and_travels_backward():
    made = study(vehicle=LATERAL, run={"travel": "backward"}, journey=SLOW | {"to": 30.0})
    data = execute_run(made, "one")
    assert data.lateral_force.shape == data.contact_force.shape == (8, data.attrs["steps"] + 1)
    assert np.abs(data.lateral_force).max() > 10.0
    assert (np.abs(data.deck_roll.sel(station=16.0)) > 1e-8).any()
    assert float(data.position[0, 0]) == 46.0
    assert float(data.position[0, -1]) == pytest.approx(16.0, abs=0.1)


def test_motion_may_be_chosen():
    made = study(
        {"motion": "space"},
        {"type": "axle_loads", "axle_loads": [100e3]},
        base={"solver": "point", "law": "moving_force"},
    )
    track = build.point_track(made, made.runs["one"], build.track(made))
    assert not track.planar
    refused(
        'track.motion = "planar": needs vehicle.model = "planar"',
        track={"motion": "planar"},
        vehicle=LATERAL,
    )
    refused(
        'track.motion = "space": needs a vehicle on two rails',
        track={"motion": "space"},
        vehicle={"type": "wheel_column"},
    )


def test_what_a_bridge_cannot_have_is_refused_at_once():
    found = refused(
        "runs.one.local_compliance = True: is not possible on a bridge",
        "runs.two: needs a meshed rail; the rails of a bridge are beams",
        run={"local_compliance": True},
        two={"solver": "surface"},
    )
    assert "runs.two.solver" in found  # and one wheel
    press = "runs.one: needs the static press of a meshed rail; the rails of a bridge are beams"
    refused(press, run={"k_r": "tangent"})
    refused(press, base={"solver": "point", "law": "press"})
    refused("track.spans.1 = ", "must be above 0", track={"spans": ["8 m", "-3 m"]})
    refused("track.spans_per_deck = [2]: must add up to the 3 spans", track={"spans_per_deck": 2})
    refused("track.deck_area", 'applies only with deck = "given"', track={"deck_area": 3.0})
    refused(
        "track.deck_torsion_constant: is missing; a run in space needs it",
        track={"deck": "antoing"},
        vehicle=LATERAL,
    )
    refused("track.support: must be discrete supports", track={"support": "winkler"})
    refused('track.spans: applies only with structure = "bridge"', track={"structure": "ground"})
    refused("journey.to = 900.0: must be at most", journey=SLOW | {"to": 900.0})
    refused(
        "journey.time_step = 1e-06: must be at least",
        track={"spans": "99 x 32 m"},
        journey=SLOW | {"time_step": 1e-6},
    )


def test_backward_needs_a_bridge():
    with pytest.raises(InputError, match=r'runs.one.travel = "backward": needs track.structure'):
        parse_study("ground", {"runs": {"one": RUN | {"travel": "backward"}}})


def test_rigid_wheels_on_both_rails_as_one_are_refused():
    refused("runs.one.k_r", "both wheels of a wheelset are one", run={"k_r": "rigid"})


def test_backward_over_a_defect_is_refused():
    with pytest.raises(InputError, match=r'must be "forward" with irregularity.rail_defect'):
        parse_study(
            "bridge",
            {
                "track": TRACK,
                "vehicle": TRAIN,
                "journey": SLOW,
                "irregularity": {"rail_defect": "weld", "rail_defect_at": 20.0},
                "runs": {"one": RUN | {"travel": "backward"}},
            },
        )


def test_each_rail_has_its_own_irregularity():
    data = execute_run(
        study(
            vehicle=LATERAL,
            journey=SLOW | {"to": 14.0, "stations": []},
            rails={"coherence": "decaying"},
        ),
        "one",
    )
    level, across = data.irregularity.values, data.lateral_irregularity.values
    assert np.abs(level[0] - level[1]).max() > 1e-5  # right and left of one wheelset
    assert np.abs(across[0] - level[0]).max() > 1e-5


def test_the_deck_that_is_named():
    assert study({"deck": "antoing", "spans": "50 m"}).track.structure.deck == Antoing()
    given = {"deck": "given", "deck_mass_per_length": "20 t/m", "deck_second_moment": "5 m^4"}
    deck = study(given).track.structure.deck
    assert (deck.mass_per_length, deck.second_moment) == (20e3, 5.0)


def test_the_shipped_study_is_forecast():
    made = load_study("train_bridge")
    assert len(made.track.structure.spans) == 10
    assert made.runs["backward"].travel == "backward"
    told = [str(one) for one in needs(made, [], None)]
    assert any("static wheel load" in one for one in told)
    # 5.11 Hz of the box alone; sqrt(34000/34538.8) of it with two rails and their sleepers
    assert any("at 5.11 Hz, with rails and sleepers (539 kg/m) at 5.07 Hz" in one for one in told)


def test_a_wheel_on_a_bridge_feels_the_mean_over_its_patch():
    """Of a short wave sin(ka)/(ka), a being Hertz's semi-axis along the rail, in a linear run."""
    runs = {"filtered": RUN | {"k_r": "hertz_tangent", "contact_filter": "patch"}}
    made = parse_study(
        "bridge",
        {
            "track": TRACK | {"spans": "8 m"},
            "vehicle": {"type": "axle_loads", "axle_loads": ["13 t"]},
            "irregularity": {"spectrum": "sinusoid", "wavelength": 0.03, "amplitude": 2e-6},
            "journey": {"from": 13.0, "to": 15.0, "speed": 30.0, "time_step": 4e-5, "fade_in": 0.5},
            "runs": {"one": RUN | {"k_r": "hertz_tangent"}, **runs},
        },
    )
    one, filtered = (
        execute_run(made, name).contact_force[0].values[600:] for name in ("one", "filtered")
    )
    smooth = execute_run(
        parse_study("bridge", made.config() | {"irregularity": {"spectrum": "smooth"}}), "one"
    )
    rest = smooth.contact_force[0].values[600:]
    ka = 2 * np.pi / 0.03 * hertz(made).semi_axis_x
    np.testing.assert_allclose(
        filtered - rest, np.sin(ka) / ka * (one - rest), atol=2e-3 * np.ptp(one - rest)
    )
    assert np.ptp(one - rest) > 1e3
