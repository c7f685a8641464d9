"""Static press at one place of the rail after the other: the mesh below must not be felt."""

import numpy as np

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail

RECIPE = CellRecipe(size=0.004, interface_modes=10, internal_modes=4)


def test_approach_is_the_same_everywhere_in_a_cell() -> None:
    cell, wheel = condense(RECIPE), elastic_wheel(WheelRecipe(size=0.004))
    track = Track(solid_rail(RECIPE), length=4.8)
    # around the middle of a bay: on both sides of an interface plane, and through a cell's middle
    places = 2.1 + 1e-3 * np.array([-50.5, -49.5, -31.0, -30.0, -8.0, -6.0, -4.0, -2.0, 0.0])
    ripple = {}
    for mean_phase in (False, True):
        on = SolidTrack(track, cell, mean_phase)
        found = np.array(
            [
                geometry_press(on, SurfaceContact(wheel), np.array([70e3]), x=x).approach[0]
                for x in places
            ]
        )
        ripple[mean_phase] = float(np.ptp(found) / found.mean())
    print(f"ripple of the approach: exact place {ripple[False]:.2%}, mean {ripple[True]:.2%}")
    assert ripple[True] < 0.2 * ripple[False]
    assert ripple[True] < 1e-3
