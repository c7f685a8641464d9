"""The surface-contact solver: meshed elastic wheel on meshed elastic rail."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from contactstudy.contact.press import PRESS_LOADS
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.contact.surface_coupling import SurfaceCoupling
from contactstudy.contact.wheel_path import WheelPath
from contactstudy.dynamics.stepper import Integrator, average_acceleration
from contactstudy.irregularity import DefectiveProfile, Profile
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.run import run_through
from contactstudy.track.meshed import MeshedTrack, not_meshed
from contactstudy.validation import raise_if
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr


def surface_contact(
    track: MeshedTrack,
    contact: SurfaceContact,
    vehicle: Vehicle,
    irregularity: Profile,
    journey: Journey,
    *,
    observers: Sequence[Observer] = (),
    integrator: Integrator | None = None,
) -> xr.Dataset:
    """Run a meshed wheel over a solid rail.

    Parameters
    ----------
    track : MeshedTrack
        Discretised track with a solid rail: a `SolidTrack` or an `UnreducedTrack`.
    vehicle : Vehicle
        With one wheel.
    irregularity : Profile
        r(X), positive raises the running surface, uniform across the rail; faded in from the
        wheel's start. It is evaluated at every contact point's own X; a defect of the wheel at
        every contact point.
    observers : sequence of Observer
        Watch the run, and may add to its dataset: `solvers.observers.ReportProgress`,
        `solvers.instants.Instants`, `solvers.frames.Frames`.

    Returns
    -------
    xarray.Dataset
        See `contactstudy.solvers.dataset`; in addition `contact_area` (of the patch, from
        the gap around it), `peak_pressure` (at the wheel's tread nodes), `penetration` (largest),
        the static press of this very geometry (`press_force`, `press_approach` from the hub to the
        rail's centre line, `press_penetration`), of a whole section the lateral motion and
        roll of the rail under the wheel.

    Raises
    ------
    InputError
        Listing everything about the arguments that is impossible.
    NumericalError
        When the computation breaks down, with step and position.
    """
    began = time.perf_counter()
    raise_if(not_meshed(track))
    problems = journey.problems_on(track.track, vehicle) + contact.problems_on(track)
    problems += vehicle.problems_on_one_rail()
    if vehicle.n_wheels != 1:
        problems.append(
            f"surface contact: the vehicle has {vehicle.n_wheels} wheels; exactly one is possible"
        )
    for observer in observers:
        problems += observer.problems_on(journey)
    raise_if(problems)

    passage = Passage(track, contact.on(vehicle), irregularity, journey)
    coupling = surface_coupling(passage, contact)
    pressed = geometry_press(track, contact, float(passage.static_loads[0]) * PRESS_LOADS)
    told = {"solver": "surface", "rail": "solid", "mesh_size": track.recipe.size}
    setup = time.perf_counter() - began
    data = run_through(
        passage,
        coupling,
        integrator or average_acceleration(),
        observers,
        told | contact.describe(),
    )
    data.attrs["seconds_setup"] += setup
    texts = {
        "force": ("N", "pressing force"),
        "approach": ("m", "approach of the wheel's hub to the rail's centre line"),
        "penetration": ("m", "largest penetration"),
    }
    return data.assign(
        {
            f"press_{name}": ("press", getattr(pressed, name), {"units": unit, "long_name": text})
            for name, (unit, text) in texts.items()
        }
    )


def surface_coupling(passage: Passage[MeshedTrack], contact: SurfaceContact) -> SurfaceCoupling:
    """Join a wheel's contact points to all positions of a passage, its modes in the vehicle."""
    positions, profile, x = passage.positions, passage.faded(0), contact.points.x
    path = WheelPath(positions[:, 0], profile(positions + x))
    if isinstance(profile, DefectiveProfile) and (wheel := profile.wheel) is not None:
        level = profile.without_wheel(positions + x)
        path = WheelPath(positions[:, 0], level, lambda X: contact.level(wheel, X))
    return SurfaceCoupling(
        passage.track,
        contact.moving(int(passage.wheels[0][0, 0]), passage.n_dofs),
        path,
        contact.candidates,
        contact.enforcement,
    )
