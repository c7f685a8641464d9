"""The surface-contact solver: meshed elastic wheel on meshed elastic rail."""

import time
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from contactstudy.banded import Factor
from contactstudy.contact.coupling import SurfaceCoupling
from contactstudy.contact.points import ContactPoints, contact_points, rolling_drop
from contactstudy.contact.press import PressCurve, press_curve
from contactstudy.contact.quadrature import Quadrature
from contactstudy.contact.residual import ResidualFlexibility, patch_splines
from contactstudy.contact.search import CandidateList, FacetSearch, grid_surface
from contactstudy.dynamics import Integrator, average_acceleration
from contactstudy.irregularity import Profile, faded
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel import wheel_profile
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, rigid_wheel
from contactstudy.solvers.instants import Instants
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.run import Assembly, Progress, run
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.validation import positive, raise_if
from contactstudy.vehicle import Vehicle

Array = NDArray[np.float64]

PRESS_LOADS = np.linspace(0.25, 2.0, 8)
"""Loads of the static press that comes with a run, in static wheel loads."""


def surface_contact(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility | None,
    vehicle: Vehicle,
    irregularity: Profile,
    journey: Journey,
    *,
    penalty: float = 1e16,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
    pressure_at: Sequence[float] = (),
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
    penalty : float
        Pressure per penetration in Pa/m.
    quadrature : {"gauss", "nodes"}
        Contact points: Gauss points of the wheel's facets, or its tread nodes.
    tolerance : float, optional
        Largest penetration in m that an augmented Lagrangian leaves, see `contact.augmented`;
        None: the penalty alone.
    pressure_at : sequence of float
        Positions of the wheel in m at whose nearest step the pressure field is kept.
    integrator : Integrator, optional
        Average acceleration when not given.
    progress : callable, optional
        Called with (steps done, steps).

    Returns
    -------
    xarray.Dataset
        See `contactstudy.solvers.dataset`; in addition `contact_area`, `peak_pressure` (at the
        wheel's tread nodes), `penetration` (largest), the static press of this very geometry
        (`press_force`, `press_approach` from the hub to the rail's centre line, `press_penetration`),
        and with
        `pressure_at` the field `pressure` (instant, point) at the tread nodes and the deformed
        sections of wheel and rail at the first instant.

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
    problems += _problems(track, wheel, vehicle, quadrature)
    problems += [
        f"pressure_at = {x:g} m: the wheel must pass it, from {journey.start:g} to "
        f"{journey.end:g} m"
        for x in pressure_at
        if not journey.start <= x <= journey.end
    ]
    raise_if(problems)

    assembly = Assembly(track, vehicle)
    coupling, r = surface_coupling(
        assembly, wheel, irregularity, journey, penalty, quadrature, tolerance
    )
    points = coupling.points
    kept = Instants(coupling, track, coupling.positions, pressure_at)
    load = float(assembly.static_loads[0])
    pressed = geometry_press(
        track, wheel, load * PRESS_LOADS, penalty, quadrature=quadrature, tolerance=tolerance
    )
    elastic = bool(wheel.flexibility.any())
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
            "wheel": "elastic" if elastic else "rigid",
            "mesh_size": track.recipe.size,
            "contact_points": len(points.gap),
        },
        progress=progress,
        on_state=kept,
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
    return kept.into(data, points, wheel)


def surface_coupling(
    assembly: Assembly,
    wheel: WheelFlexibility,
    irregularity: Profile,
    journey: Journey,
    penalty: float = 1e16,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
) -> tuple[SurfaceCoupling, Array]:
    """Join the contact points of a wheel to all positions of a journey.

    Parameters
    ----------
    assembly : Assembly
        Of a `SolidTrack` or `UnreducedTrack` and a vehicle with one wheel.
    wheel : WheelFlexibility
    irregularity : Profile
        Before it is faded in.
    journey : Journey
    penalty : float
        In Pa/m.
    quadrature, tolerance
        As in `surface_contact`.

    Returns
    -------
    coupling : SurfaceCoupling
    irregularity : ndarray (n_times, 1)
        r under the wheel, faded in from its start, in m.
    """
    track, points = assembly.track, wheel_points(wheel, quadrature)
    assert isinstance(track, SolidTrack | UnreducedTrack)
    positions = journey.wheel_positions(assembly.vehicle.wheel_offsets)
    profile = faded(irregularity, float(positions[0, 0]), journey.fade_in)
    coupling = SurfaceCoupling(
        track,
        points,
        wheel.flexibility,
        int(assembly.wheel_dofs[0]),
        positions[:, 0],
        profile(positions + points.x),
        candidate_list(track, wheel),
        penalty,
        track.thickness,
        track.residual_period,
        tolerance,
    )
    return coupling, profile(positions)


def wheel_points(wheel: WheelFlexibility, quadrature: Quadrature = "gauss") -> ContactPoints:
    """Contact points of a centred wheel on the rail of its recipe."""
    recipe = wheel.recipe
    return contact_points(
        wheel.x,
        wheel.y,
        recipe.dimensions.radius,
        rail_profile(recipe.rail_profile),
        wheel_profile(recipe.profile),
        quadrature=quadrature,
    )


def candidate_list(track: SolidTrack | UnreducedTrack, wheel: WheelFlexibility) -> CandidateList:
    """Search of the wheel's tread facets over the rail's running surface."""
    recipe = wheel.recipe
    rail, radius = rail_profile(recipe.rail_profile), recipe.dimensions.radius
    drop = rolling_drop(wheel.x, wheel_profile(recipe.profile).height(wheel.y), radius)
    reach = 1.5 * float(wheel.x[-1])
    y = track.surface_y
    top = np.broadcast_to(rail.running_surface(y), (2, len(y)))
    step = max(float(np.diff(wheel.x).max()), float(np.diff(y).max()))
    return CandidateList(
        FacetSearch(grid_surface(wheel.x, wheel.y, drop)),
        grid_surface(np.array([-reach, reach]), y, top),
        y,
        sagitta=step**2 / 8 * (1 / radius + 1 / rail.crown_radius),
    )


def geometry_press(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    loads: Array,
    penalty: float = 1e16,
    x: float | None = None,
    quadrature: Quadrature = "gauss",
    tolerance: float | None = None,
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
    quadrature, tolerance
        As in `surface_contact`.

    Returns
    -------
    PressCurve
    """
    points = wheel_points(wheel, quadrature)
    x = (track.track.n_bays // 2 + 0.5) * track.track.bay_length if x is None else x
    half_length = float(np.abs(points.x).max()) + 2 * track.thickness
    patch = track.patch(x, half_length)
    factor = Factor(track.stiffness)
    unit = np.zeros((factor.n, len(patch.dofs)))
    unit[patch.dofs, np.arange(len(patch.dofs))] = 1.0
    solved = factor.solve(unit)
    C = solved[patch.dofs]
    along, across = patch_splines(patch, points)
    P = np.kron(along(x - patch.x[0] + points.x), across)
    residual = ResidualFlexibility(
        track, along, across, points.x, half_length, track.thickness, track.residual_period
    )
    PH = P @ patch.map
    tread = points.wheel_rows.matrix(len(wheel.flexibility))
    W = residual(x).block(np.arange(len(points.gap))) + tread @ wheel.flexibility @ tread.T
    W += PH @ (0.5 * (C + C.T)) @ PH.T
    # deflection of the centre line per unit nodal force; forces push the rail down
    reference = P @ (patch.map @ (patch.centre_map[0] @ solved[patch.centre_dofs]))
    reference += P @ patch.centre_residual[0]
    return press_curve(points, W, loads, penalty, reference, tolerance)


def _problems(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    vehicle: Vehicle,
    quadrature: Quadrature,
) -> list[str]:
    problems = []
    if vehicle.n_wheels != 1:
        problems.append(
            f"surface contact: the vehicle has {vehicle.n_wheels} wheels; exactly one is possible"
        )
    if wheel.recipe.rail_profile != track.recipe.profile:
        problems.append(
            f"surface contact: the wheel was made for rail {wheel.recipe.rail_profile}, the track "
            f"has {track.recipe.profile}"
        )
    outermost = float(wheel_points(wheel, quadrature).y[-1])
    if outermost > track.surface_y[-1]:
        problems.append(
            f"wheel contact_half_width = {wheel.y[-1]:.4g} m: its outermost contact points, at "
            f"{outermost:.4g} m, lie beyond the rail's finely meshed running surface, "
            f"{track.surface_y[-1]:.4g} m wide on each side"
        )
    return problems
