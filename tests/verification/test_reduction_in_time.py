"""The condensed rail in motion: against every node with its inertia, and no cell to be felt.

Issue of both tests: the condensed cells must not be seen in the contact force.
"""

import numpy as np
import pytest

from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.passing import passing_amplitude
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import DiscreteSupports, Track, WinklerFoundation
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.vehicle import wheel_column

STATIC = 67.4e3


@pytest.mark.parametrize(
    ("size", "support"),
    [
        (0.006, WinklerFoundation(100e6, 100e3)),
        pytest.param(0.006, DiscreteSupports(spacing=0.3, pad_length=0.0), marks=pytest.mark.slow),
        pytest.param(0.004, WinklerFoundation(100e6, 100e3), marks=pytest.mark.slow),
    ],
    ids=["winkler", "pads", "finer"],
)
def test_reduced_against_unreduced(size, support):
    """A wheel on the paper's roughness below 1 m crosses two cell borders of a 0.9 m rail.

    Longer waves cannot be faded in on so short a rail.
    """
    recipe = CellRecipe(size=size)
    track = Track(rail=solid_rail(recipe), length=0.9, support=support)
    wheel = elastic_wheel(WheelRecipe(size=0.004))
    profile = sample_profile(paper_spectrum(), seed=1, band=(2 * np.pi, 20.0))
    journey = Journey(start=0.33, end=0.57, time_step=5e-5, fade_in=0.1)
    forces = []
    for rail in (UnreducedTrack(track, recipe), SolidTrack(track, condense(recipe))):
        data = surface_contact(rail, wheel, wheel_column(), profile, journey)
        print(f"{rail.n_dofs} dofs: contact force", data.contact_force.values[::12])
        forces.append(data.contact_force.values)
    difference = np.abs(forces[1] - forces[0]).max() / STATIC
    variation = np.ptp(forces[0]) / STATIC
    print(f"largest difference {difference:.2e} of the static load; it varies by {variation:.2f}")
    assert variation > 0.05  # the run is dynamic enough to tell
    assert difference < 1e-3


def test_no_ripple_at_the_cell_length():
    """Uniform damped Winkler foundation, smooth rail: nothing has the period of a cell."""
    recipe = CellRecipe(size=0.004)
    track = Track(rail=solid_rail(recipe), length=6.0, support=WinklerFoundation(60e6, 120e3))
    ripples = []
    for internal in (6, 0):
        cell = condense(CellRecipe(size=0.004, internal_modes=internal))
        data = surface_contact(
            SolidTrack(track, cell),
            elastic_wheel(WheelRecipe(size=0.004)),
            wheel_column(),
            SmoothRail(),
            # 3.67 mm a step. With 4.17 mm (5e-5 s) the ripple of this coarse test mesh, 4 mm,
            # would be seen once in 24 steps, which is 0.1 m as well.
            Journey(start=1.5, end=4.5, time_step=4.4e-5, fade_in=0.1),
        )
        x, force = data.position.values, data.contact_force.values
        settled = x > 3.0
        ripples.append(float(passing_amplitude(x[settled], force[settled], 0.1)[0]) / STATIC)
    print(
        f"ripple at 0.1 m: {ripples[0]:.1e} of the static load, without internal modes "
        f"{ripples[1]:.1e}"
    )
    assert ripples[0] < 3e-4
    assert ripples[1] > 3 * ripples[0]  # the modes are what removes it
