"""Speed as ratios against a baseline measured in the same run.

    pytest benchmarks --benchmark-only

The baseline is one solution of a banded system of the solver's own size with LAPACK
(`scipy.linalg.cho_solve_banded`): it scales with the machine and with what else runs on it.
Targets of the project, on two cores of a 2020s server: 1.5 ms a step for surface contact on the
36 m track at 2 mm, 4 ms with S1002 on a whole section of inclined 60E1, 0.1 ms a step for point
contact at 4 elements a bay.
"""

import time
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.linalg import cho_solve_banded, cholesky_banded

from contactstudy.contact.laws import HertzSpring, LinearSpring
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import paper_spectrum, sample_profile
from contactstudy.solids.bodies import rail_body, wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.point import point_contact, point_contacts
from contactstudy.solvers.point_case import PointCase
from contactstudy.solvers.surface import surface_contact
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.loading import load_study
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column

RECIPE = CellRecipe()
JOURNEY = Journey(start=6.0, end=15.0)


@cache
def profile():
    return sample_profile(paper_spectrum(), seed=1)


@cache
def solid_track():
    return SolidTrack(Track(rail=solid_rail(RECIPE)), cached(rail_body(RECIPE)))


@cache
def wheel():
    return cached(wheel_body(WheelRecipe()))


def baseline(matrix) -> float:
    """Seconds of one LAPACK solution with the band of a track's matrix."""
    coo = matrix.tocoo()
    low = coo.row >= coo.col
    width = int((coo.row - coo.col).max())
    band = np.zeros((width + 1, matrix.shape[0]))
    band[(coo.row - coo.col)[low], coo.col[low]] = coo.data[low]
    factor, b = cholesky_banded(band, lower=True), np.ones(matrix.shape[0])
    times = []
    for _ in range(50):
        began = time.perf_counter()
        cho_solve_banded((factor, True), b, check_finite=False)
        times.append(time.perf_counter() - began)
    return float(np.median(times))


def report(benchmark, run, one_solution):
    """Median over the rounds of the time of a step, as the dataset tells it."""
    run()  # compiled kernels are loaded
    steps = []

    def timed():
        attrs = run().attrs
        steps.append(attrs["seconds_stepping"] / attrs["steps"])

    benchmark.pedantic(timed, rounds=5)
    step = float(np.median(steps))
    benchmark.extra_info["ms_per_step"] = round(1e3 * step, 4)
    benchmark.extra_info["LAPACK_solutions_per_step"] = round(step / one_solution, 2)
    print(
        f"\n{1e3 * step:.3f} ms a step (best {1e3 * min(steps):.3f}),"
        f" {step / one_solution:.1f} LAPACK solutions of the system"
    )


@pytest.mark.parametrize("law", [LinearSpring(1e11), HertzSpring(9.25e10)], ids=["k_r", "hertz"])
@pytest.mark.parametrize("local", [False, True], ids=["paper", "local compliance"])
def test_point_step(benchmark, law, local):
    def run():
        return point_contact(
            BeamTrack(Track(), element_compliance=local),
            wheel_column(),
            profile(),
            JOURNEY,
            law=law,
        )

    report(benchmark, run, baseline(BeamTrack(Track()).stiffness))


@pytest.mark.parametrize("law", [LinearSpring(1.2e9), HertzSpring(9.25e10)], ids=["k_r", "hertz"])
def test_point_step_of_1500_dofs(benchmark, law):
    track = BeamTrack(Track(length=99.6))

    def run():
        return point_contact(track, wheel_column(), profile(), JOURNEY, law=law)

    report(benchmark, run, baseline(track.stiffness))


@pytest.mark.parametrize("jitter", [False, True])
def test_profile(benchmark, jitter):
    """1e5 positions of a profile of 1000 terms, against the cosines of all its terms."""
    rail, x = (
        sample_profile(paper_spectrum(), seed=1, jitter=jitter),
        np.linspace(0.0, 2e3, 100_000),
    )
    rail(x[:2])
    began = time.perf_counter()
    np.cos(rail.wavenumbers[:10, None] * x)
    all_terms = 100.0 * (time.perf_counter() - began)
    benchmark.pedantic(rail, args=(x,), rounds=3)
    ratio = benchmark.stats.stats.median / all_terms
    benchmark.extra_info["of_all_cosines"] = round(ratio, 3)
    print(f"\n{1e3 * benchmark.stats.stats.median:.0f} ms, {ratio:.2f} of all its cosines")


def test_samples_side_by_side(benchmark):
    """64 samples of the irregularity at one go, against state by state one after another.

    Processor time, so that what else runs on the machine matters little.
    """
    track = BeamTrack(Track(), "timoshenko", element_compliance=True)
    cases = [
        PointCase(
            track,
            wheel_column(),
            sample_profile(paper_spectrum(), seed=seed),
            JOURNEY,
            LinearSpring(1.2e9),
        )
        for seed in range(64)
    ]

    def seconds(own):
        began = time.process_time()
        point_contacts(own)
        return (time.process_time() - began) / len(own)

    def one_by_one():
        return [seconds([one]) for one in cases[:8]]

    states = [replace(one, observers=[EachState(lambda state: None)]) for one in cases[:4]]
    point_contacts(cases[:9]), point_contacts(states[:1])  # compiled kernels are loaded
    by_states, alone = seconds(states), float(np.median(one_by_one()))
    times = []
    benchmark.pedantic(lambda: times.append(seconds(cases)), rounds=3)
    side_by_side = float(np.median(times))
    benchmark.extra_info["times_as_fast_as_state_by_state"] = round(by_states / side_by_side, 1)
    benchmark.extra_info["times_as_fast_as_alone"] = round(alone / side_by_side, 1)
    print(
        f"\nprocessor time of a run: {1e3 * by_states:.0f} ms state by state, {1e3 * alone:.0f} ms"
        f" alone, {1e3 * side_by_side:.0f} ms beside 63 others"
    )


def test_surface_step(benchmark):
    def run():
        return surface_contact(
            solid_track(), SurfaceContact(wheel()), wheel_column(), profile(), JOURNEY
        )

    report(benchmark, run, baseline(solid_track().stiffness))


def test_surface_step_of_a_whole_section(benchmark):
    study = load_study("s1002_inclined")
    track = build.solid_track(study, build.track(study))
    made, placed = build.wheel(study), geometry(study)

    def run():
        return surface_contact(
            track,
            SurfaceContact(made, geometry=placed, penalty=1e16),
            wheel_column(),
            profile(),
            JOURNEY,
        )

    report(benchmark, run, baseline(track.stiffness))


def test_condensation(benchmark):
    """One cell at 2 mm, against LAPACK's Cholesky factor of one plane's matrix."""
    from scipy.linalg import cholesky

    n = 600
    A = np.eye(n) * n + np.ones((n, n))
    began = time.perf_counter()
    for _ in range(20):
        cholesky(A, lower=True, check_finite=False)
    one = (time.perf_counter() - began) / 20
    benchmark.pedantic(condense, args=(RECIPE,), rounds=1)
    benchmark.extra_info["Cholesky_factors_of_a_plane"] = round(benchmark.stats["mean"] / one)
