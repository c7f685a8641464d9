"""A modal wheel on a point: nothing of its give counts twice, and waves as in surface contact."""

from functools import cache

import numpy as np
import pytest

from contactstudy.contact.filters import PatchMean
from contactstudy.contact.laws import LinearSpring
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import HarmonicProfile, SmoothRail
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, residual_flexibility, wheel_modes
from contactstudy.solids.wheel_recipe import FAR_STEP_OF_MODES
from contactstudy.solvers.at_rest import geometry_table
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column

RAIL = CellRecipe(size=0.004)
WHEEL = WheelRecipe(size=0.004, far_step=FAR_STEP_OF_MODES)
LOAD = float(wheel_column().static_loads[0])


@cache
def track():
    return SolidTrack(Track(rail=solid_rail(RAIL), length=9.0), condense(RAIL))


@cache
def contact(modal):
    modes = wheel_modes(ModesRecipe(WHEEL)) if modal else None
    return SurfaceContact(elastic_wheel(WHEEL), modes=modes)


@cache
def table():
    return geometry_table(track(), contact(False), LOAD)


@cache
def wheel():
    return PointWheel.of(contact(True), table())


def test_modes_give_statically_what_the_press_leaves_out():
    rest = residual_flexibility(contact(True).wheel, contact(True).modes)
    pressed = geometry_table(track(), SurfaceContact(rest), LOAD)
    left = table().without(wheel().give)
    whole, other, found = (1 / float(t.tangent) for t in (table(), pressed, left))
    print(f"give at the static load: {whole:.4e} m/N; without modes: {other:.4e}, here {found:.4e}")
    assert wheel().give > 0.1 * whole
    # the forces on the patch spread a little otherwise without the modes
    assert found == pytest.approx(other, rel=2e-3)
    np.testing.assert_allclose(left.approach[3:], pressed.approach[3:], rtol=2e-3)


@pytest.mark.parametrize(("wavelength", "worst", "static"), [(0.2, 0.05, 0.0), (0.05, 0.07, 0.1)])
def test_waves_at_300_km_h(wavelength, worst, static):
    journey = Journey(3.6, 5.1, 300 / 3.6, min(wavelength / 40 / (300 / 3.6), 3e-5), fade_in=0.3)
    profile = HarmonicProfile(np.array([5e-6]), np.array([2 * np.pi / wavelength]), np.zeros(1))

    def part(run):
        return np.ravel(run(profile).contact_force) - np.ravel(run(SmoothRail()).contact_force)

    def surface(r):
        return surface_contact(track(), contact(True), wheel_column(), r, journey)

    def point(modal):
        press = table().without(wheel().give) if modal else table()
        return lambda r: point_contact(
            track(),
            wheel_column(),
            r,
            journey,
            law=LinearSpring(float(press.tangent)),
            contact_filter=PatchMean(press.offsets, press.weights_at(LOAD)),
            wheel=wheel() if modal else None,
        )

    exact = part(surface)
    off = {}
    late = np.arange(len(exact)) > 0.3 / journey.speed / journey.time_step
    for modal in (True, False):
        found = part(point(modal))
        off[modal] = np.linalg.norm((found - exact)[late]) / np.linalg.norm(exact[late])
    print(f"{1e3 * wavelength:g} mm: modal {off[True]:.3f}, quasi-static {off[False]:.3f}")
    assert off[True] < worst
    assert off[False] > static
