"""The surface solver on a coarse mesh: statics, the point model it must fall back to, ripple."""

from functools import cache

import numpy as np
import pytest
import xarray as xr

from contactstudy.contact.laws import LinearSpring
from contactstudy.contact.press import tangent_stiffness
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.stepper import generalised_alpha
from contactstudy.exceptions import InputError
from contactstudy.irregularity import HarmonicProfile, SmoothRail
from contactstudy.solids.cell import RailCell, condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, elastic_wheel, rigid_wheel
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.solvers.frames import Frames
from contactstudy.solvers.instants import Instants
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track, WinklerFoundation
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import bare_wheel, train, wheel_column

COARSE = CellRecipe(size=0.004, interface_modes=10, internal_modes=4)


@cache
def cell() -> RailCell:
    return condense(COARSE)


@cache
def wheel() -> WheelFlexibility:
    return elastic_wheel(WheelRecipe(size=0.004))


@cache
def track(winkler: bool = False) -> SolidTrack:
    rail = solid_rail(COARSE)
    if winkler:
        support = WinklerFoundation(100e6, 100e3)
        return SolidTrack(Track(rail, support, length=7.2, ends="free"), cell())
    return SolidTrack(Track(rail, length=4.8), cell())


def smooth_run(**changes: object) -> xr.Dataset:
    journey = Journey(1.2, 1.6, time_step=1e-4, fade_in=0.0)
    arguments: dict = {"irregularity": SmoothRail(), "journey": journey}
    return surface_contact(track(), SurfaceContact(wheel()), wheel_column(), **arguments | changes)


def test_static_start_is_the_press() -> None:
    data = smooth_run()
    load = float(data.attrs["static_load"][0])
    assert float(data.contact_force[0]) == pytest.approx(load, rel=1e-9)
    approach = float(data.rail_displacement[0] - data.wheel_displacement[0])
    pressed = geometry_press(track(), SurfaceContact(wheel()), np.array([load]), x=1.2).approach[0]
    print(f"approach hub to centre line: run {approach:.9e} m, press {pressed:.9e} m")
    assert approach == pytest.approx(pressed, rel=1e-6)


def test_press_does_not_depend_on_the_track() -> None:
    # supports and position are taken out with the centre line; what is left is local
    loads = np.array([40e3, 80e3])
    base = geometry_press(track(), SurfaceContact(wheel()), loads).approach
    next_bay = geometry_press(track(), SurfaceContact(wheel()), loads, x=2.1).approach
    uniform = geometry_press(track(winkler=True), SurfaceContact(wheel()), loads).approach
    print("approach", base, "next bay", next_bay, "uniform foundation", uniform, "m")
    np.testing.assert_allclose(next_bay, base, rtol=1e-3)
    # the uniform bed pushes on the foot right below: the web is compressed 1 um more
    np.testing.assert_allclose(uniform, base, rtol=0.02)


def test_small_roughness_is_the_linear_spring_on_the_same_rail() -> None:
    # 4 um at a wavelength of 0.4 m (208 Hz): patch filter and nonlinearity are below 1e-3
    wavelength, load = 0.4, 67e3
    profile = HarmonicProfile(np.array([2e-6]), np.array([2 * np.pi / wavelength]), np.zeros(1))
    journey = Journey(1.5, 4.5, time_step=5e-5, fade_in=0.6)
    vehicle, on = bare_wheel(890.0, load), track(winkler=True)
    k = tangent_stiffness(
        geometry_press(on, SurfaceContact(wheel()), load * np.linspace(0.6, 1.4, 9)), load
    )
    surface = surface_contact(on, SurfaceContact(wheel()), vehicle, profile, journey)
    point = point_contact(on, vehicle, profile, journey, law=LinearSpring(k))
    late = surface.position.values > 2.4
    x = surface.position.values[late]
    window = np.hanning(len(x)) * np.exp(-2j * np.pi * x / wavelength)
    # complex amplitudes at the wavelength: what the meshes add elsewhere does not matter
    f, g = (np.sum(window * (d.contact_force.values[late] - load)) for d in (surface, point))
    print(f"k_r {k:.4e} N/m; surface over point: {abs(f / g):.5f}, {np.angle(f / g):.5f} rad")
    assert abs(f / g - 1) < 0.01


def test_pressure_field_carries_the_force() -> None:
    watching = Instants((1.3, 1.5)), Frames((1.3, 1.4, 1.5))
    data = smooth_run(observers=watching, integrator=generalised_alpha(0.8))
    assert data.pressure.dims == ("instant", "point")
    np.testing.assert_allclose(data.instant_position, [1.3, 1.5], atol=0.005)
    for k in range(2):
        force = float((data.pressure[k] * data.point_area).sum())
        at = float(data.contact_force.sel(time=data.instant_time[k], method="nearest"))
        assert force == pytest.approx(at, rel=1e-3)
    assert float(data.pressure.min()) >= 0.0
    assert data.section_wheel_displacement.shape == data.section_wheel_nodes.shape
    for name in ("contact_area", "peak_pressure", "penetration"):
        assert np.all(data[name].values > 0)
        assert data[name].attrs["units"]
    assert float(data.penetration.max()) < 0.01 * 100e-6
    # the frames are the same fields
    np.testing.assert_array_equal(data.frame_pressure[::2], data.pressure)
    np.testing.assert_allclose(data.frame_position, [1.3, 1.4, 1.5], atol=0.005)
    # points within the patch that are open have no status, but belong to its area
    closed = float((data.contact_status[0] * data.point_area).sum())
    assert 0.75 < closed / float(np.interp(1.3, data.position, data.contact_area)) < 1.0
    # at every point sqrt(3) tau <= von Mises <= 2 tau, so the maxima keep this as well
    ratio = data.von_mises.values / data.maximum_shear.values
    assert np.all((ratio > np.sqrt(3.0) - 1e-9) & (ratio < 2.0 + 1e-9))
    assert np.all((data.maximum_shear_depth > 1e-3) & (data.maximum_shear_depth < 5e-3))


def test_wrong_arguments_are_refused_together() -> None:
    two = train([wheel_column(), wheel_column()], [0.0, -0.5])
    other = SurfaceContact(rigid_wheel(WheelRecipe(size=0.004, rail_profile="UIC60-Manchester")))
    journey = Journey(1.2, 1.6, fade_in=0.0)
    with pytest.raises(InputError) as caught:
        surface_contact(track(), other, two, SmoothRail(), journey, observers=(Instants((3.0,)),))
    text = str(caught.value)
    for part in ("2 wheels", "made for rail UIC60-Manchester", "pressure_at.0 = 3"):
        assert part in text
    with pytest.raises(InputError, match=r"penalty = -1"):
        SurfaceContact(wheel(), penalty=-1.0)


def test_a_track_of_the_wrong_kind_is_refused_with_the_right_one() -> None:
    rest = wheel_column(), SmoothRail(), Journey(1.2, 1.6, fade_in=0.0)
    described, contact = track().track, SurfaceContact(wheel())
    for wrong in (described, BeamTrack(described)):
        name = type(wrong).__name__
        with pytest.raises(InputError, match=f"a {name} has no meshed rail; give a SolidTrack"):
            surface_contact(wrong, contact, *rest)  # type: ignore[arg-type]
    for wrong in (solid_rail(COARSE), contact):
        name = type(wrong).__name__
        with pytest.raises(InputError, match=f"a {name} is no track; give a Track, a BeamTrack"):
            point_contact(wrong, *rest, law=LinearSpring(1e9))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="only surface contact"):
        point_contact(described, *rest, law=LinearSpring(1e9), observers=(Frames((1.3,)),))


@pytest.mark.slow
def test_no_ripple_at_the_cell_length() -> None:
    # uniform damped foundation, smooth rail, 2 mm: nothing but the mesh can move the force
    recipe = CellRecipe()
    support = WinklerFoundation(100e6, 100e3)
    on = SolidTrack(Track(solid_rail(recipe), support, length=24.0, ends="free"), condense(recipe))
    data = surface_contact(
        on,
        SurfaceContact(elastic_wheel(WheelRecipe())),
        bare_wheel(890.0, 67e3),
        SmoothRail(),
        Journey(8.0, 14.0, fade_in=0.0),
    )
    late = data.position.values > 11.0
    force, x = data.contact_force.values[late], data.position.values[late]
    window = np.hanning(len(force))
    for length, bound in ((0.1, 3e-4), (0.05, 1e-3)):
        wave = np.exp(-2j * np.pi * x / length)
        ripple = 2 * np.abs(np.sum(window * (force - force.mean()) * wave)) / window.sum()
        print(f"ripple at {1e3 * length:g} mm: {100 * ripple / 67e3:.4f} % of the static load")
        assert ripple < bound * 67e3
