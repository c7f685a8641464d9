"""The surface-contact solver: meshed elastic wheel on meshed elastic rail."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.press import PressCurve, press_curve
from contactstudy.contact.surface import SurfaceCoupling
from contactstudy.dynamics.stepper import Integrator, average_acceleration
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.geometry.tread import candidate_list, mesh_problems, wheel_points
from contactstudy.irregularity import Profile, faded
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, rigid_wheel
from contactstudy.solids.wheel_modes import WheelModes, residual_flexibility
from contactstudy.solvers.at_rest import bodies_at_rest
from contactstudy.solvers.frames import Frames, both
from contactstudy.solvers.instants import Instants
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.run import Assembly, Progress, run
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.validation import positive, raise_if
from contactstudy.vehicle import Vehicle, with_wheel_modes

if TYPE_CHECKING:
    import xarray as xr

PRESS_LOADS = np.linspace(0.25, 2.0, 8)
"""Loads of the static press that comes with a run, in static wheel loads."""

WHEEL_DAMPING = 1e-3
"""Damping ratio of the wheel's modes, an assumption: D. J. Thompson, Railway Noise and Vibration
(2009), ch. 6, uses 1e-2, 1e-3 and 1e-4 for one, no and more waves round a wheel."""


def surface_contact(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility | None,
    vehicle: Vehicle,
    irregularity: Profile,
    journey: Journey,
    *,
    geometry: Geometry | None = None,
    modes: WheelModes | None = None,
    wheel_damping: float = WHEEL_DAMPING,
    penalty: float = 1e16,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
    pressure_at: Sequence[float] = (),
    frames_at: Sequence[float] = (),
    integrator: Integrator | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Run a meshed wheel over a solid rail.

    Parameters
    ----------
    track : SolidTrack or UnreducedTrack
        Discretised track with a solid rail.
    wheel : WheelFlexibility or None
        Elastic wheel; None: a rigid one of the default dimensions.
    vehicle : Vehicle
        With one wheel.
    irregularity : Profile
        r(X), positive raises the running surface, uniform across the rail; faded in from the
        wheel's start. It is evaluated at every contact point's own X.
    journey : Journey
        Where, how fast, which steps.
    geometry : Geometry, optional
        Profiles and position of a whole wheel on a whole rail section: inclination, lateral
        shift, yaw. Half sections are centred and upright.
    modes : WheelModes, optional
        Elastic modes of the wheel, which then move with their inertia; without them it is
        quasi-static (or rigid, if it has no flexibility), all its inertia in the wheel's dof.
    wheel_damping : float
        Damping ratio of the modes.
    penalty : float
        Pressure per penetration in Pa/m.
    quadrature : {"gauss", "nodes"}
        Contact points: Gauss points of the wheel's facets, or its tread nodes.
    tolerance : float, optional
        Largest penetration in m that an augmented Lagrangian leaves, see `contact.augmented`;
        None: the penalty alone.
    pressure_at : sequence of float
        Positions of the wheel in m at whose nearest step the pressure field is kept.
    frames_at : sequence of float
        The same for the frames of an animation: pressure and contact status only.
    integrator : Integrator, optional
        Average acceleration when not given.
    progress : callable, optional
        Called with (steps done, steps).

    Returns
    -------
    xarray.Dataset
        See `contactstudy.solvers.dataset`; in addition `contact_area` (of the patch, from
        the gap around it), `peak_pressure` (at the wheel's tread nodes), `penetration` (largest),
        the static press of this very geometry (`press_force`, `press_approach` from the hub to the
        rail's centre line, `press_penetration`), of a whole section the lateral motion and
        roll of the rail under the wheel. With `pressure_at` the fields `pressure`, `gap` and
        `contact_status` (instant, point) at the tread nodes, the largest stresses below the patch,
        `von_mises` and `maximum_shear` (instant) with `_depth`, `_x` and `_y`, and the deformed
        sections of wheel and rail at the first instant; with `frames_at` `frame_pressure` and
        `frame_contact_status` (frame, point).

    Raises
    ------
    InputError
        Listing everything about the arguments that is impossible.
    NumericalError
        When the computation breaks down, with step and position.
    """
    began = time.perf_counter()
    integrator = integrator or average_acceleration()
    wheel = wheel or rigid_wheel(WheelRecipe(rail_profile=track.recipe.profile))
    problems = journey.problems_on(track.track, vehicle) + positive("penalty", penalty, "Pa/m")
    if tolerance is not None:
        problems += positive("tolerance of the penetration", tolerance, "m")
    problems += mesh_problems(track, wheel, wheel_points(wheel, quadrature, geometry))
    if vehicle.n_wheels != 1:
        problems.append(
            f"surface contact: the vehicle has {vehicle.n_wheels} wheels; exactly one is possible"
        )
    problems += [
        f"{name} = {x:g} m: the wheel must pass it, from {journey.start:g} to {journey.end:g} m"
        for name, at in (("pressure_at", pressure_at), ("frames_at", frames_at))
        for x in at
        if not journey.start <= x <= journey.end
    ]
    raise_if(problems)

    if modes is not None:
        vehicle = with_wheel_modes(vehicle, modes.frequencies, modes.participation, wheel_damping)
    assembly = Assembly(track, vehicle)
    coupling, r = surface_coupling(
        assembly, wheel, irregularity, journey, penalty, quadrature, tolerance, geometry, modes
    )
    points = coupling.points
    kept = Instants(coupling, track, coupling.positions, pressure_at)
    frames = Frames(coupling, frames_at)
    load = float(assembly.static_loads[0])
    pressed = geometry_press(
        track,
        wheel,
        load * PRESS_LOADS,
        penalty,
        quadrature=quadrature,
        tolerance=tolerance,
        geometry=geometry,
    )
    still = "quasi-static" if wheel.flexibility.any() else "rigid"
    data = run(
        assembly,
        coupling,
        journey,
        integrator,
        r,
        setup_began=began,
        attrs={
            "solver": "surface",
            "rail": "solid",
            "law": "penalty" if tolerance is None else "augmented Lagrangian",
            "penalty": penalty,
            **({} if tolerance is None else {"penetration_tolerance": tolerance}),
            "quadrature": quadrature,
            "wheel": still if modes is None else "modal",
            **({} if modes is None else {"wheel_modes": len(modes.frequencies)}),
            "mesh_size": track.recipe.size,
            "contact_points": len(points.gap),
        },
        progress=progress,
        # forces that meet a tolerance of the penetration are known no better than so
        start_tolerance=1e-11 if tolerance is None else 1e-8,
        on_state=both(kept, frames),
    )
    data["rail_displacement"] += data["centre_residual"]
    data = data.drop_vars("centre_residual")
    data["press_force"] = ("press", pressed.force, {"units": "N", "long_name": "pressing force"})
    data["press_approach"] = (
        "press",
        pressed.approach,
        {"units": "m", "long_name": "approach of the wheel's hub to the rail's centre line"},
    )
    data["press_penetration"] = (
        "press",
        pressed.penetration,
        {"units": "m", "long_name": "largest penetration"},
    )
    return frames.into(kept.into(data, points, wheel, modes))


def surface_coupling(
    assembly: Assembly,
    wheel: WheelFlexibility,
    irregularity: Profile,
    journey: Journey,
    penalty: float = 1e16,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
    geometry: Geometry | None = None,
    modes: WheelModes | None = None,
) -> tuple[SurfaceCoupling, Array]:
    """Join the contact points of a wheel to all positions of a journey.

    Parameters
    ----------
    assembly : Assembly
        Of a `SolidTrack` or `UnreducedTrack` and a vehicle with one wheel, its modes last
        among the dofs (`with_wheel_modes`) where there are any.
    wheel : WheelFlexibility
    irregularity : Profile
        Before it is faded in.
    journey : Journey
    penalty : float
        In Pa/m.
    quadrature, tolerance, geometry, modes
        As in `surface_contact`.

    Returns
    -------
    coupling : SurfaceCoupling
    irregularity : ndarray (n_times, 1)
        r under the wheel, faded in from its start, in m.
    """
    track, points = assembly.track, wheel_points(wheel, quadrature, geometry)
    assert isinstance(track, SolidTrack | UnreducedTrack)
    positions = journey.wheel_positions(assembly.vehicle.wheel_offsets)
    profile = faded(irregularity, float(positions[0, 0]), journey.fade_in)
    body = wheel if modes is None else residual_flexibility(wheel, modes)
    n_modes = 0 if modes is None else len(modes.frequencies)
    coupling = SurfaceCoupling(
        track,
        points,
        body.flexibility,
        int(assembly.wheel_dofs[0]),
        positions[:, 0],
        profile(positions + points.x),
        candidate_list(wheel, geometry),
        penalty,
        track.thickness,
        track.residual_period,
        tolerance,
        range(assembly.n_dofs - n_modes, assembly.n_dofs),
        None if modes is None else modes.shapes,
    )
    return coupling, profile(positions)


def geometry_press(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    loads: Array,
    penalty: float = 1e16,
    x: float | None = None,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
    geometry: Geometry | None = None,
) -> PressCurve:
    """Static press of the wheel on the rail, measured from the hub to the rail's centre line.

    The deflection of the rail as a beam is taken out with the centre line, so what is left is
    the local flexibility that a point model's contact spring stands for; its tangent at the
    static load (`contact.press.tangent_stiffness`) is the matching k_r.

    Parameters
    ----------
    track : SolidTrack
        Any supported track with the rail. In the middle of a bay its supports hardly matter;
        over a sleeper the compression of the web by the pad adds 3 % to the approach.
    wheel : WheelFlexibility
        Elastic or rigid.
    loads : ndarray (k,)
        In N.
    penalty : float
        In Pa/m.
    x : float, optional
        Position on the track in m; the middle of its middle bay when not given.
    quadrature, tolerance, geometry
        As in `surface_contact`.

    Returns
    -------
    PressCurve
    """
    at = bodies_at_rest(track, wheel, x, quadrature, geometry)
    return press_curve(at.points, at.flexibility, loads, penalty, at.centre_line, tolerance)
