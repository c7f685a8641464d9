"""The condensed rail in motion: against every node with its inertia, and no cell to be felt.

Issue of both tests: the condensed cells must not be seen in the contact force.
"""

import numpy as np
import pytest

from contactstudy.compare.passing import passing_amplitude
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
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
    "support",
    [
        WinklerFoundation(100e6, 100e3),
        pytest.param(DiscreteSupports(pad_length=0.0), marks=pytest.mark.slow),
    ],
    ids=["winkler", "pads"],
)
def test_reduced_against_unreduced(support):
    """A wheel on the paper's roughness below 1 m crosses two cell borders of a 1.2 m rail.

    Longer waves cannot be faded in on so short a rail. Both rails have the mesh's own phase under
    the wheel (`mean_phase` is off). A step is one slice of the mesh long, so
    that the mesh's ripple stays out of the comparison. At the start the dent
    under the wheel sets off from rest to 83 m/s within one step; the condensed rail's residual
    flexibility has no inertia to feel that, so the first millisecond has a bound of its own.
    """
    recipe = CellRecipe(size=0.004)
    track = Track(rail=solid_rail(recipe), length=1.2, support=support)
    wheel = elastic_wheel(WheelRecipe(size=0.004))
    profile = sample_profile(paper_spectrum(), seed=1, band=(2 * np.pi, 20.0))
    speed, step = 300 / 3.6, recipe.length / recipe.n_slices
    journey = Journey(start=0.48, end=0.72, speed=speed, time_step=step / speed, fade_in=0.1)
    forces = []
    for rail in (UnreducedTrack(track, recipe), SolidTrack(track, condense(recipe), False)):
        data = surface_contact(rail, SurfaceContact(wheel), wheel_column(), profile, journey)
        print(f"{rail.n_dofs} dofs: contact force", data.contact_force.values[::12])
        forces.append(data.contact_force.values)
    difference = np.abs(forces[1] - forces[0]) / STATIC
    setting_off = data.time.values < 1e-3
    first, later = difference[setting_off].max(), difference[~setting_off].max()
    variation = np.ptp(forces[0]) / STATIC
    print(
        f"largest difference {later:.1e} of the static load, {first:.1e} in the first"
        f" millisecond; the force varies by {variation:.2f}"
    )
    assert variation > 0.05  # the run is dynamic enough to tell
    assert later < 1e-3
    assert first < 2e-3


def test_no_ripple_at_the_cell_length():
    """Uniform damped Winkler foundation, smooth rail: nothing has the period of a cell."""
    recipe = CellRecipe(size=0.004)
    track = Track(rail=solid_rail(recipe), length=6.0, support=WinklerFoundation(60e6, 120e3))
    ripples = []
    for internal in (recipe.internal_modes, 0):
        cell = condense(CellRecipe(size=0.004, internal_modes=internal))
        data = surface_contact(
            SolidTrack(track, cell),
            SurfaceContact(elastic_wheel(WheelRecipe(size=0.004))),
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
