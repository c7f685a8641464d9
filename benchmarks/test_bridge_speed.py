"""Speed of trains on bridges, as ratios against bare solutions of the same system.

One is LAPACK's with its Cholesky factor of the band (dpbtrs), the other the program's own, which is
faster and so the stricter measure.

    pytest benchmarks/test_bridge_speed.py --benchmark-only

Targets of the project, on two cores: with 12 cars on ten spans of 32 m and 50 m of track on each
side at most 2.5 bare solutions and 10 ms a step in space, 96 wheel elements in Y and Z; 48 wheels
on 500 m of track at most 3 bare solutions a step.
"""

import resource
import time

import numpy as np
import pytest
from scipy.linalg.lapack import dpbtrs

from contactstudy.contact.laws import HertzSpring, LinearSpring
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.irregularity import paper_spectrum, sample_profile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.bridge import Bridge
from contactstudy.track.model import Track
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import Train

SPEED, STEP, STEPS, NEW = 300 / 3.6, 5e-4, 800, 600
"""In the first NEW steps, 25 m, most bogies run where none has been, and columns are new."""


def seconds(solve) -> float:
    """Median CPU seconds."""
    times = []
    solve()
    for _ in range(40):
        began = time.process_time()
        solve()
        times.append(time.process_time() - began)
    return float(np.median(times))


def bare(track, vehicle) -> dict[str, float]:
    """CPU seconds of one solution with the system's factor, as each step has at least one."""
    system = LinearSystem.stacked(track, vehicle)
    factor = Factor(system.combine(4.0 / STEP**2, 2.0 / STEP, 1.0))
    b = np.ones(factor.n)
    return {
        "LAPACK's": seconds(lambda: dpbtrs(factor.band, b, lower=1)),
        "own": seconds(lambda: factor.solve(b)),
    }


def compare(benchmark, track, vehicle, law, start):
    """Median CPU time of a step; wall time tells more of what else runs on the machine."""
    ones, clock = bare(track, vehicle), []
    profile = sample_profile(paper_spectrum(), seed=1)
    journey = Journey(start=start, end=start + SPEED * STEP * STEPS, speed=SPEED, time_step=STEP)
    watch = EachState(lambda state: clock.append(time.process_time()))

    def run():
        clock.clear()
        point_contact(track, vehicle, profile, journey, law=law, observers=[watch])

    benchmark.pedantic(run, rounds=1, warmup_rounds=0)
    steps = np.diff(clock)[NEW:]
    step, mean = float(np.median(steps)), float(np.mean(steps))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    benchmark.extra_info["ms_per_step"] = round(1e3 * step, 3)
    told = []
    for name, one in ones.items():
        benchmark.extra_info[f"bare_solutions_per_step ({name})"] = round(step / one, 2)
        told.append(f"{step / one:.2f} {name} solutions of {1e3 * one:.2f} ms")
    print(
        f"\n{track.n_dofs} dofs, {vehicle.n_contacts} contacts: {1e3 * step:.2f} ms a step (mean "
        f"{1e3 * mean:.2f}), {', '.join(told)}; {memory:.2f} GB"
    )


@pytest.mark.parametrize("law", [LinearSpring(1.2e9), HertzSpring(9.2e10)], ids=["k_r", "hertz"])
@pytest.mark.parametrize("planar", [True, False], ids=["planar", "space"])
def test_train_on_ten_spans(benchmark, planar, law):
    car = "s300" if planar else "high_speed_trailer"
    model = "planar" if planar else "three_dimensional"
    train = Train(cars=(f"12 x {car}",), model=model).vehicle(2)
    structure = StructureTrack(Track(structure=Bridge()), planar=planar)
    compare(benchmark, structure, train, law, 340.0)


def test_48_wheels_on_500_m(benchmark):
    train = Train(cars=("12 x s300",)).vehicle()
    compare(benchmark, BeamTrack(Track(length=499.8)), train, LinearSpring(1.2e9), 330.0)
