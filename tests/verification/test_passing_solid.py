"""Sleeper passing of the solid rail on a smooth running surface, and what its cells add."""

import numpy as np

from contactstudy.compare.passing import passing_amplitude
from contactstudy.contact.laws import HertzSpring
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import SmoothRail
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column


def test_sleeper_passing_and_cell_passing_at_2_mm():
    recipe = CellRecipe()
    track = Track(rail=solid_rail(recipe), length=18.0)
    journey = Journey(3.0, 15.0)
    solid = surface_contact(
        SolidTrack(track, condense(recipe)),
        SurfaceContact(elastic_wheel(WheelRecipe())),
        wheel_column(),
        SmoothRail(),
        journey,
    )
    beams = {
        theory: point_contact(
            BeamTrack(track, theory=theory, element_compliance=True),
            wheel_column(),
            SmoothRail(),
            journey,
            law=HertzSpring(9.25e10),
        )
        for theory in ("timoshenko", "euler")
    }
    sleeper, cell = {}, {}
    for name, data in {"solid": solid, **beams}.items():
        x, force = data.position.values, data.contact_force.values
        settled = x > 8.0
        amplitude = passing_amplitude(x[settled], force[settled], 0.6, 12) / force[0]
        sleeper[name], cell[name] = amplitude[0], amplitude[5:].max()
        print(
            f"{name}: sleeper passing {100 * amplitude[0]:.3f} %, 0.1 m and shorter "
            f"{100 * cell[name]:.4f} % of the static load"
        )
    # 0.1 m is a cell of the solid and a sixth of a bay: all that has its period counts
    assert cell["solid"] < 1e-3
    # shear flexibility triples the sleeper passing; the solid has it, the Euler beam does not
    assert sleeper["euler"] < 0.5 * sleeper["solid"]
    assert np.isclose(sleeper["timoshenko"], sleeper["solid"], rtol=0.3)
