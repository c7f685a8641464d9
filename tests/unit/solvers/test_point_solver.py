import dataclasses

import numpy as np
import pytest

from contactstudy.contact.laws import HertzSpring, LinearSpring, MovingForce, RigidContact
from contactstudy.dynamics.stepper import average_acceleration, generalised_alpha
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.irregularity import HarmonicProfile, SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import ReportProgress
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Rail, Track
from contactstudy.vehicle import Vehicle, bare_wheel, train, wheel_column

TRACK = Track(length=9.0)
SHORT = Journey(3.0, 3.5, 80.0, 1e-4, fade_in=0.4)
ROUGH = HarmonicProfile(np.array([1e-4]), np.array([6.0]), np.array([0.2]))


def bogie():
    """Half a bogie: two wheels 2.5 m apart under a frame that bounces and pitches."""
    # wheel 1, wheel 2, frame bounce, frame pitch
    k, c, half = 0.59e6, 19.6e3, 1.25
    arms = np.array([[1, 0, -1, -half], [0, 1, -1, half]])
    return Vehicle(
        mass=np.diag([890.0, 890.0, 1520.0, 1965.0]),
        damping=c * arms.T @ arms,
        stiffness=k * arms.T @ arms,
        wheel_dofs=np.array([0, 1]),
        wheel_offsets=np.array([0.0, -2.5]),
        static_loads=np.array([6e4, 6e4]),
        dof_names=("wheel 1", "wheel 2", "bounce", "pitch"),
    )


def test_dataset_of_one_wheel():
    journey = dataclasses.replace(SHORT, stations=(2.0, 4.0))
    calls = []
    run = point_contact(
        TRACK,
        wheel_column(),
        ROUGH,
        journey,
        law=LinearSpring(1e9),
        observers=(ReportProgress(lambda done, total: calls.append((done, total))),),
    )
    n = journey.n_steps + 1
    assert dict(run.sizes) == {"time": n, "station": 2}
    np.testing.assert_allclose(run.position, 3.0 + 80.0 * run.time)
    for name in run.data_vars:
        assert run[name].attrs["units"] and run[name].attrs["long_name"]
    for key in ("solver", "rail", "law", "k_r", "dofs", "steps", "dt", "integrator"):
        assert key in run.attrs
    assert run.attrs["seconds_setup"] > 0 and run.attrs["seconds_stepping"] > 0
    assert calls[-1] == (n - 1, n - 1)
    # the law, sample by sample: F - k (z - u - r)
    gap = run.wheel_displacement - run.rail_displacement - run.irregularity
    np.testing.assert_allclose(
        run.contact_force, wheel_column().static_loads[0] - 1e9 * gap, rtol=1e-9
    )


def test_two_wheels_in_one_element_add_up():
    pair = train([bare_wheel(900.0, 4e4)] * 2, [0.0, -0.05])
    run = point_contact(TRACK, pair, SmoothRail(), SHORT, law=LinearSpring(1e9))
    single = point_contact(
        TRACK,
        bare_wheel(900.0, 8e4),
        SmoothRail(),
        dataclasses.replace(SHORT, start=2.975, end=3.475),
        law=LinearSpring(1e9),
    )
    assert run.contact_force.dims == ("wheel", "time")
    assert run.position.dims == ("wheel", "time")
    np.testing.assert_allclose(run.contact_force.isel(time=0), 4e4, rtol=1e-9)
    # the pair bends the rail as one wheel of twice the load does
    assert float(run.rail_displacement.isel(time=0).mean()) == pytest.approx(
        float(single.rail_displacement[0]), rel=5e-3
    )
    together = run.contact_force.sum("wheel").values
    np.testing.assert_allclose(together, 8e4, rtol=0.05)


@pytest.mark.parametrize("law", [LinearSpring(1e9), HertzSpring(9.25e10), RigidContact()])
def test_static_start_of_a_vehicle_with_several_wheels(law):
    # the wheels stand at different places of a bay; the frame's springs share the difference
    journey = Journey(5.55, 5.65, 80.0, 1e-4, fade_in=0.0)
    run = point_contact(
        BeamTrack(TRACK, element_compliance=True), bogie(), SmoothRail(), journey, law=law
    )
    forces = run.contact_force.isel(time=0).values
    assert forces.sum() == pytest.approx(1.2e5, rel=1e-10)
    assert abs(forces[0] - forces[1]) < 1e-6 * forces.sum()  # bounce and pitch follow freely
    rail = BeamTrack(TRACK, "euler", 4, True)
    assert run.attrs["dofs"] == rail.n_dofs + 4


def test_static_start_where_the_springs_are_strained():
    # a stiff frame without pitch makes the two wheels share the load by the track's stiffness
    k = 1e9
    frame = Vehicle(
        mass=np.diag([890.0, 890.0, 3000.0]),
        damping=np.zeros((3, 3)),
        stiffness=k * np.array([[1, 0, -1], [0, 1, -1], [-1, -1, 2.0]]),
        wheel_dofs=np.array([0, 1]),
        wheel_offsets=np.array([0.0, -2.7]),
        static_loads=np.array([6e4, 6e4]),
        dof_names=("wheel 1", "wheel 2", "frame"),
    )
    run = point_contact(
        TRACK, frame, SmoothRail(), Journey(5.4, 5.5, 80.0, 1e-4, fade_in=0.0), law=RigidContact()
    )
    force, z = run.contact_force.isel(time=0).values, run.wheel_displacement.isel(time=0).values
    assert force.sum() == pytest.approx(1.2e5, rel=1e-9)
    assert abs(force[0] - force[1]) > 100.0
    # frame in the middle: force - static load = spring force
    middle = z.mean()
    np.testing.assert_allclose(force - 6e4, k * (z - middle), rtol=1e-6)
    np.testing.assert_allclose(z, run.rail_displacement.isel(time=0).values, rtol=1e-9)


def test_lateral_direction_has_no_static_load_and_holds_in_tension():
    run = point_contact(
        BeamTrack(TRACK, direction="Y"),
        wheel_column(),
        ROUGH,
        Journey(3.0, 5.0, 80.0, 1e-4, fade_in=0.5),
        law=LinearSpring(1e8),
    )
    assert run.contact_force[0] == pytest.approx(0.0, abs=1e-6)
    assert run.contact_force.min() < 0.0 < run.contact_force.max()
    assert run.attrs["static_load"] == [0.0]


@pytest.mark.parametrize("stiffness", [7e8, 1.1e9, 3.3e9, 1e10])
def test_a_start_without_any_load_is_at_rest(stiffness):
    """A fade-in that begins at 1e-180 m leaves forces whose squares are beyond all floats."""
    faint = HarmonicProfile(np.array([1e-180]), np.array([6.0]), np.array([0.2]))
    journey = Journey(3.0, 3.1, 80.0, 1e-4, fade_in=0.0)
    lateral = BeamTrack(TRACK, direction="Y")
    run = point_contact(lateral, wheel_column(), faint, journey, law=LinearSpring(stiffness))
    assert np.abs(run.contact_force).max() < 1e-100


def test_profile_is_the_same_at_every_time_step_and_mesh():
    fine = point_contact(
        BeamTrack(TRACK, elements_per_bay=8),
        wheel_column(),
        ROUGH,
        dataclasses.replace(SHORT, time_step=5e-5),
        law=LinearSpring(1e9),
    )
    coarse = point_contact(TRACK, wheel_column(), ROUGH, SHORT, law=LinearSpring(1e9))
    np.testing.assert_allclose(fine.irregularity[::2], coarse.irregularity, atol=1e-15)


def test_moving_force_equals_the_limit_of_a_soft_contact_spring():
    soft = point_contact(TRACK, bare_wheel(900.0, 5e4), ROUGH, SHORT, law=LinearSpring(1.0))
    force = point_contact(TRACK, bare_wheel(900.0, 5e4), ROUGH, SHORT, law=MovingForce())
    np.testing.assert_allclose(soft.rail_displacement, force.rail_displacement, rtol=1e-6)


def test_rigid_contact_chooses_damping_openly_and_refuses_none():
    run = point_contact(TRACK, wheel_column(), SmoothRail(), SHORT, law=RigidContact())
    assert "generalised alpha" in run.attrs["integrator"]
    gap = run.wheel_displacement - run.rail_displacement
    assert np.abs(gap).max() < 1e-12
    for integrator in (average_acceleration(), generalised_alpha(1.0)):
        with pytest.raises(InputError, match="without numerical damping"):
            point_contact(
                TRACK,
                wheel_column(),
                SmoothRail(),
                SHORT,
                law=RigidContact(),
                integrator=integrator,
            )


def test_every_problem_of_a_call_is_reported_at_once():
    with pytest.raises(InputError) as caught:
        BeamTrack(TRACK, theory="rayleigh", elements_per_bay=0)
    for part in ("rayleigh", "elements_per_bay = 0"):
        assert part in str(caught.value)
    assert len(caught.value.problems) == 2
    with pytest.raises(InputError) as caught:
        point_contact(
            TRACK,
            wheel_column(),
            SmoothRail(),
            Journey(3.0, 12.0, stations=(9.5,)),
            law=RigidContact(),
            integrator=average_acceleration(),
        )
    text = str(caught.value)
    on_track = "must lie on the track, 0 to 9 m"
    for part in (f"end = 12.0: {on_track}", f"stations.0 = 9.5: {on_track}", "damping"):
        assert part in text
    assert len(caught.value.problems) == 3
    with pytest.raises(InputError, match="HertzSpring with direction = 'Y'"):
        point_contact(
            BeamTrack(TRACK, direction="Y"),
            wheel_column(),
            SmoothRail(),
            SHORT,
            law=HertzSpring(9e10),
        )
    with pytest.raises(InputError, match=r"law = 1000000000\.0: must be a LinearSpring"):
        point_contact(TRACK, wheel_column(), SmoothRail(), SHORT, law=1e9)
    # the trailing wheel counts too
    pair = train([wheel_column()] * 2, [0.0, -3.5])
    with pytest.raises(InputError, match=r"start = 3.0: must leave room .* 3.5 m behind"):
        point_contact(
            TRACK, pair, SmoothRail(), Journey(3.0, 5.0, fade_in=0.0), law=LinearSpring(1e9)
        )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"start": 5.0, "end": 5.0}, "must be beyond Journey.start"),
        ({"start": 30.0, "end": 6.0}, "must be beyond Journey.start"),
        ({"time_step": 0.0}, "time_step = 0.0: must be above 0 s"),
        ({"speed": -1.0}, "speed = -1.0: must be above 0 m/s"),
        ({"fade_in": -1.0}, "fade_in = -1.0: must be at least 0 m"),
        ({"time_step": 10.0}, "half the duration of the run"),
        ({"stations": (-1.0,)}, "stations.0 = -1.0: must be at least 0 m"),
    ],
)
def test_impossible_journeys(arguments, message):
    with pytest.raises(InputError, match=message):
        Journey(**arguments)


def test_an_irregularity_that_is_not_a_number_is_reported_with_its_place():
    class Broken(SmoothRail):
        def __call__(self, x, derivative=0):
            return np.where(np.asarray(x) > 3.2, np.nan, 0.0)

    with pytest.raises(NumericalError, match=r"not finite after step .* X = 3\.2"):
        point_contact(
            TRACK,
            wheel_column(),
            Broken(),
            dataclasses.replace(SHORT, fade_in=0.0),
            law=HertzSpring(9e10),
        )


def test_a_beam_that_nothing_holds_is_reported():
    track = Track(Rail(), None, 9.0, "pinned")
    point_contact(track, bare_wheel(1.0, 1.0), SmoothRail(), SHORT, law=LinearSpring(1e6))
    with pytest.raises(InputError, match="nothing holds"):
        Track(Rail(), None, 9.0, "free")


def test_a_vehicle_on_two_rails_is_refused_on_one():
    two = Vehicle(
        mass=np.diag([1800.0, 800.0]),
        damping=np.zeros((2, 2)),
        stiffness=np.zeros((2, 2)),
        wheel_dofs=np.zeros(0, dtype=int),
        wheel_offsets=np.zeros(2),
        static_loads=np.full(2, 7e4),
        dof_names=("heave", "roll"),
        contact_rows=np.array([[1.0, -0.75], [1.0, 0.75]]),
        contact_rails=np.array([0, 1]),
    )
    with pytest.raises(InputError, match="this track has one rail") as caught:
        point_contact(TRACK, two, ROUGH, SHORT, law=LinearSpring(1e9))
    assert len(caught.value.problems) == 1
