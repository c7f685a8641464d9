"""A defect of the wheel against the same dip in the rail, in both solvers."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.filters import Trajectory
from contactstudy.contact.laws import HertzSpring
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import Flat, RoundedFlat, SmoothRail, with_defects
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column

COARSE = CellRecipe(size=0.004, interface_modes=10, internal_modes=4)
JOURNEY = Journey(1.2, 1.6, speed=20.0, time_step=1e-4, fade_in=0.1)
RADIUS, AT = 0.43, 1.4


@dataclass(frozen=True)
class Dip:
    """A plainly written dip of the rail at AT: a chord, or a haversine, 20 mm long."""

    chord: bool
    domain = (-np.inf, np.inf)
    repeat_length = np.inf

    def __call__(self, x: Array, derivative: int = 0) -> Array:
        s = np.asarray(x) - AT
        if self.chord:
            height = np.sqrt(RADIUS**2 - 0.01**2)
            return np.minimum(height / np.cos(s / RADIUS) - RADIUS, 0.0)
        d = 0.02**2 / (8 * RADIUS)
        return np.where(np.abs(s) < 0.01, -0.5 * d * (1 + np.cos(2 * np.pi * s / 0.02)), 0.0)


def test_a_wheels_flat_is_the_rails_dip():
    track = SolidTrack(Track(solid_rail(COARSE), length=4.8), condense(COARSE))
    contact = SurfaceContact(elastic_wheel(WheelRecipe(size=0.004, contact_half_length=0.016)))
    for chord, flat in ((True, Flat(AT, 0.02)), (False, RoundedFlat(AT, 0.02))):
        profile = with_defects(SmoothRail(), None, flat, RADIUS)
        for law in (None, HertzSpring(9e10)):
            for contact_filter in (None, Trajectory(RADIUS)):
                if law is None and contact_filter is not None:
                    continue
                runs = [
                    surface_contact(track, contact, wheel_column(), r, JOURNEY)
                    if law is None
                    else point_contact(
                        track, wheel_column(), r, JOURNEY, law=law, contact_filter=contact_filter
                    )
                    for r in (profile, Dip(chord))
                ]
                a, b = (run.contact_force.values.ravel() for run in runs)
                kind = f"chord {chord}, {law}, {contact_filter}"
                print(f"{kind}: {a.max():.6g} N, as a dip {b.max():.6g} N; static {a[0]:.6g} N")
                assert np.ptp(a) > 0.2 * a[0]
                # the dip is faded as well, from before it on: the same to rounding
                np.testing.assert_allclose(a, b, rtol=1e-7)
