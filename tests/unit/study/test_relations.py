"""Relations between tables: time step, waves, bays, contact, mesh, sizes, unusual values."""

import math
import re

import numpy as np
import pytest

from contactstudy.dynamics.integrators import STEPS_A_PERIOD, average_acceleration
from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage import forecast
from contactstudy.study.kinds.passage.inputs import read_inputs
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.track.receptance import receptance

SHORT = {
    "track": {"length": "12 m"},
    "journey": {"from": "3 m", "to": "9 m", "fade_in": "1 m"},
    "runs": {"point": {"solver": "point", "k_r": "1e9 N/m"}},
}


def study_with(**tables: dict):
    merged = {name: SHORT.get(name, {}) | table for name, table in tables.items()}
    return parse_study("case", SHORT | merged)


def said(**tables: dict) -> str:
    """Warnings of a study, or the complaints with which it is refused."""
    try:
        return "\n".join(read_inputs(study_with(**tables)).warnings)
    except InputError as error:
        return "refused: " + "\n".join(error.problems)


def run(**keys: object) -> dict:
    return {"point": {"solver": "point", "k_r": "1e9 N/m", **keys}}


@pytest.mark.parametrize(
    ("tables", "refused", "parts"),
    [
        ({}, False, []),
        ({"journey": {"time_step": "5 ms"}}, True,
         ["irregularity.band: a wave of 0.314 m", "0.417 m a step", "track.spacing: a bay of 0.6"]),
        ({"journey": {"time_step": "0.5 ms"}}, False, ["irregularity.band", "at most 0.00047 s"]),
        ({"runs": run(time_step="1 ms")}, False, ["runs.point.time_step = 0.001 s"]),
        ({"runs": run(time_step="5 ms", irregularity="smooth")}, True, ["track.spacing"]),
        ({"irregularity": {"spectrum": "sinusoid", "wavelength": "1 cm"}, "journey":
          {"time_step": "50 us"}}, False, ["irregularity.wavelength: a wave of 0.01 m"]),
        ({"irregularity": {"rail_defect": "weld", "rail_defect_at": "6 m", "rail_defect_length":
          "5 mm"}}, True, ["irregularity.rail_defect: a wave of 0.005 m"]),
        ({"runs": run(elements_per_bay=400)}, False, ["past whole beam elements of 0.0015 m"]),
        ({"runs": run(k_r="1e20 N/m")}, True, ["runs.point.k_r", "chatters"]),
        ({"runs": run(k_r="1e13 N/m", integrator="generalised_alpha")}, False, []),
        ({"runs": run(k_r="3e11 N/m")}, False, ["may chatter", "generalised_alpha"]),
        ({"runs": run(k_r="1e6 x hertz_tangent")}, True, ["runs.point.k_r", "chatters"]),
        ({"runs": {"point": {"solver": "point", "law": "hertz"}}, "irregularity":
          {"spectrum": "smooth"}, "journey": {"time_step": "0.8 ms"}}, False,
         ["runs.point.law: the wheel vibrates"]),
        ({"journey": {"speed": 300}}, False, ["journey.speed = 300.0", '"300 km/h"']),
        ({"vehicle": {"wheel_radius": 430}}, False, ["vehicle.wheel_radius = 430.0: usual is"]),
        ({"vehicle": {"wheel_mass": "0.9 kg"}}, False, ["vehicle.wheel_mass = 0.9"]),
        ({"vehicle": {"type": "axle_loads", "axle_loads": [14e3, 14e3], "axle_distances": [3.0]},
          "track": {"length": "36 m"}, "journey": {"from": "9 m", "to": "12 m"},
          "runs": {"point": {"solver": "point", "law": "moving_force"}}}, False,
         ["vehicle.axle_loads = [14000.0, 14000.0]", "is it a mass in kg?"]),
        ({"vehicle": {"type": "axle_loads", "axle_loads": [14e4, 14e4], "axle_distances": [2.5e-3]},
          "track": {"length": "36 m"}, "journey": {"from": "9 m", "to": "12 m"},
          "runs": {"point": {"solver": "point", "law": "moving_force"}}}, False,
         ["vehicle.axle_distances = [0.0025]: usual is 0.5 to 100 m"]),
        ({"irregularity": {"roughness": 8e-2}}, False, ["irregularity.roughness = 0.08: usual"]),
        ({"irregularity": {"rail_defect": "weld", "rail_defect_at": "6 m", "rail_defect_height":
          0.3}}, False, ["irregularity.rail_defect_height = 0.3: usual is 1e-06 to 0.01 m"]),
        ({"irregularity": {"wheel_defect": "rounded_flat", "wheel_defect_at": "6 m",
          "wheel_defect_depth": 2.0}}, False, ["irregularity.wheel_defect_depth = 2.0: usual"]),
        ({"track": {"pad_stiffness": 65}}, False, ["track.pad_stiffness = 65.0"]),
        ({"track": {"length": "12.3 m"}}, True, ["12 m or 12.6 m"]),
        ({"track": {"length": "40 km"}}, True, ["at most 30000 m"]),
        ({"runs": run(elements_per_bay=30_000)}, True, ["elements_per_bay = 30000", "20000"]),
        ({"irregularity": {"terms": 200_000}}, True, ["irregularity.terms", "at most 100000"]),
    ],
)  # fmt: skip
def test_what_must_be_wrong_is_refused_and_what_may_be_is_said(tables, refused, parts):
    text = said(**tables)
    assert text.startswith("refused") == refused
    assert bool(text) == bool(parts)
    assert all(part in text for part in parts), text


def test_a_time_step_that_is_given_stays_also_where_it_is_the_default():
    table = {"spectrum": "sinusoid", "wavelength": "1 cm"}
    journey = {"time_step": "50 us"}
    assert study_with(irregularity=table, journey=journey).journey.time_step == 5e-5
    assert study_with(irregularity=table).journey.time_step == pytest.approx(3e-6)


@pytest.mark.parametrize(
    ("solid", "refused", "part"),
    [
        ({}, False, ""),
        ({"mesh_size": "4 mm"}, False, "elements across Hertz's patch"),
        ({"contact_half_length": "3 mm"}, True, "solid.contact_half_length = 0.003"),
        ({"contact_half_width": "3 mm"}, True, "solid.contact_half_width = 0.003"),
    ],
)
def test_the_mesh_against_the_patch(solid, refused, part):
    text = said(solid=solid, runs={"surface": {"solver": "surface"}})
    assert text.startswith("refused") == refused and part in text
    assert part or "Hertz" not in text


def test_more_memory_than_the_machine_has_is_refused_before_anything_is_computed(monkeypatch):
    study = study_with(solid={"mesh_size": "1 mm"}, runs={"surface": {"solver": "surface"}})
    monkeypatch.setattr(forecast, "machine_memory", lambda: 1e9)
    monkeypatch.setattr(forecast, "is_cached", lambda body: False)
    with pytest.raises(InputError, match=r"condensing the rail needs about .* has 1 GB"):
        forecast.admit(study, ["surface"], None)
    monkeypatch.setattr(forecast, "machine_memory", lambda: math.inf)
    forecast.admit(study, ["surface"], None)


def test_the_period_error_by_which_steps_are_judged():
    """An oscillator stepped with average acceleration, against the closed form in the message."""
    dt, omega = 1.0, 2.0 * np.pi / STEPS_A_PERIOD
    c0, c2, c3, d0, d2, d3 = average_acceleration().kinematics(dt)
    u, v, a = 1.0, 0.0, -(omega**2)
    signs = []
    for _ in range(4000):
        new = -(c2 * v + c3 * a - c0 * u) / (c0 + omega**2)
        u, v, a = new, d0 * (new - u) + d2 * v + d3 * a, c0 * (new - u) + c2 * v + c3 * a
        signs.append(u > 0)
    crossings = np.flatnonzero(np.diff(signs))
    period = 2.0 * (crossings[-1] - crossings[0]) / (len(crossings) - 1)
    assert period / STEPS_A_PERIOD - 1.0 == pytest.approx((omega * dt) ** 2 / 12, rel=0.12)


def test_the_stiffest_contact_of_a_beam_is_its_dynamic_stiffness_at_its_shortest_wave():
    track = Track()
    coarse, fine = BeamTrack(track), BeamTrack(track, elements_per_bay=32)
    rail = track.rail
    k = np.pi / coarse.element.length
    frequency = k**2 * np.sqrt(rail.bending_stiffness() / rail.mass_per_length) / (2.0 * np.pi)
    around = frequency * np.linspace(0.95, 1.05, 41)
    stiffness = 1.0 / np.abs(receptance(fine, 18.07, around))
    assert np.exp(np.log(stiffness).mean()) == pytest.approx(coarse.stiffest, rel=0.3)


@pytest.mark.parametrize("ends", ["clamped", "pinned", "free"])
@pytest.mark.parametrize("inner", [False, True])
@pytest.mark.parametrize("elements", [1, 3, 4])
def test_dofs_of_a_beam_are_known_before_it_is_assembled(ends, inner, elements):
    beam = BeamTrack(Track(length=3.0, ends=ends), "timoshenko", elements, inner)
    assert beam.n_dofs_forecast == beam.n_dofs


@pytest.mark.parametrize("wave", [0.301, 0.1337, 0.09, 0.0415])
def test_the_step_that_is_suggested_is_short_enough(wave):
    """Rounded to two digits it must not be the step that was found too long."""
    sinusoid = {"spectrum": "sinusoid", "wavelength": f"{wave} m", "amplitude": "1 um"}
    (step,) = re.findall(
        r"irregularity\.wavelength: .* use at most (\S+) s",
        said(irregularity=sinusoid, journey={"time_step": f"{wave / 83.4 / 7} s"}),
    )
    assert "irregularity.wavelength" not in said(
        irregularity=sinusoid, journey={"time_step": f"{step} s"}
    )
