"""Static press of a study's wheel on its rail as an input file for CalculiX."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import press_mesh
from contactstudy.files import write_file
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry, meshed_rail
from contactstudy.study.kinds.passage.runs import SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.units import UnitError, to_si
from contactstudy.validation import complaint, did_you_mean, raise_if
from contactstudy.version import __version__

CELLS = 4
"""Rail cells that are exported by default: the fewest that a condensed track has."""
REPEATS = 2
"""Further steps of whole sections, see `PressLoading`."""


def export_press(
    study: Study,
    out: Path,
    run: str | None = None,
    load: str | None = None,
    rail_length: str | None = None,
) -> str:
    """Write the input file of the static press; what to tell the user.

    Parameters
    ----------
    run : str, optional
        Which run; the reference or the first one of surface contact when not given.
    load : str, optional
        Wheel load, a number in N or text with a unit; the vehicle's static load when not given.
    rail_length : str, optional
        The same in m; `CELLS` rail cells when not given.

    Raises
    ------
    InputError
        Listing everything that is impossible.
    """
    problems: list[str] = []

    def given(name: str, value: str | None, unit: str, default: float) -> float:
        try:
            number = default if value is None else to_si(value, unit)
        except UnitError as error:
            problems.append(complaint(name, value, str(error)))
            return default
        if number <= 0:
            problems.append(complaint(name, value, f"must be above 0 ({unit})"))
            return default
        return number

    name = _run(study, run, problems)
    if study.track.rail.profile_name is None:
        problems.append('track.rail = "given": a rail of given values has no section to mesh')
    elif not study.solid.half:
        problems += _other_surfaces(study)
    if name and study.wheel(name) == "rigid":
        problems.append(f'wheel = "rigid" in the run {name}: only an elastic wheel can be exported')
    newtons = given("--load", load, "N", study.vehicle.static_load)
    length = given("--rail-length", rail_length, "m", CELLS * study.solid.cell_length)
    if out.is_dir():
        problems.append(f"--out {out}: is a folder; give the name of a file")
    raise_if(problems)
    cell, wheel, placed = build.recipe(study), build.wheel_recipe(study), geometry(study)
    start = _start(cell, wheel, placed, newtons)
    mesh = press_mesh(cell, wheel, length, placed)
    header = (
        f"contactstudy {__version__}: static press of an elastic wheel on an elastic rail",
        f"study {study.name}: {study.title}; run {name}",
        f"wheel load {newtons:.6g} N on the hub{' (half of it here)' * mesh.symmetric}, penalty "
        f"{study.solid.penalty:.6g} Pa/m",
        f"rail {cell.profile}, {length:g} m, clamped at both ends; elements of {cell.size:g} m, "
        f"slices of {cell.thickness:g} m; {len(mesh.rail)} elements",
        f"wheel {wheel.profile}, radius {wheel.dimensions.radius:g} m, elements of "
        f"{wheel.size:g} m; {len(mesh.wheel)} elements",
        f"E = {cell.youngs_modulus:.6g} Pa, nu = {cell.poisson_ratio:g}",
        *_axes(placed.pose, cell.symmetric),
    )
    loading = PressLoading(
        newtons, study.solid.penalty, start, repeats=0 if mesh.symmetric else REPEATS
    )
    text = calculix_input(mesh, loading, cell.youngs_modulus, cell.poisson_ratio, header)
    write_file(out, text.encode("ascii", errors="replace"))
    return (
        f"{out}: {len(mesh.nodes)} nodes, {len(mesh.elements)} elements, "
        f"{newtons:.6g} N on {length:g} m of rail"
    )


def _axes(pose: Pose, symmetric: bool) -> tuple[str, ...]:
    """Lines of the header: axes, position of the bodies, where the results are."""
    if symmetric:
        return (
            "half model y >= 0; X along the rail, Y lateral, Z up; origin at first touch",
            "results of the second step: approach = -U3 of HUB; force and area = twice those of CF",
        )
    return (
        "whole model in axes of the track: X along the rail, Y to the field side, Z up; origin at "
        "the crown of the rail, in the middle of its length",
        f"rail turned about X, its top to -Y, by {pose.rail_inclination:.6g} rad; wheel turned "
        f"about X, field side up, by {pose.roll:.6g} rad, then about Z by {pose.yaw:.6g} rad; the "
        f"lowest point of its tape circle at Y = {pose.lateral:.6g} m",
        "the smooth profiles just touch; the hub moves along Z only",
        "results of the last step: approach = -U3 of HUB; force on the wheel and area in CF; each "
        "load step pairs the faces where the one before has moved them",
    )


def _other_surfaces(study: Study) -> list[str]:
    """Surfaces in the gap that are not those of the meshes, which alone are written."""
    problems, meshed = [], meshed_rail(study)
    if study.wheelset.rail_profile not in ("", meshed):
        allowed = f"the faces of the mesh are those of {meshed}; only it can be exported"
        problems.append(complaint("wheelset.rail_profile", study.wheelset.rail_profile, allowed))
    if study.scan.used:
        problems.append("scan: scanned surfaces are not meshed; only drawn ones can be exported")
    return problems


def _start(cell: CellRecipe, wheel: WheelRecipe, placed: Geometry, load: float) -> float:
    """Approach in m at which the faces overlap, their patch within the fine zones.

    The patch is about where the bodies, undeformed, overlap at 0.55 of the approach (Kik &
    Piotrowski 1996).
    """
    # somewhat more than steel wheels approach, as for the middle of the fine zones
    approach = 80e-6 * (load / 70e3) ** (2 / 3)
    s, arc = placed.overlap(0.55 * approach)
    along = float(np.sqrt(2 * placed.radius * 0.55 * approach))
    along += abs(placed.touch.wheel_x)
    across = np.abs(s - wheel.contact_centre).max() > wheel.contact_half_width
    across |= np.abs(arc - cell.contact_centre).max() > cell.contact_half_width
    if across or along > wheel.contact_half_length:
        raise InputError(
            f"load = {load:.6g} N: the patch, about {along:.4g} m along from the wheel's lowest "
            f"point and from {1e3 * s.min():.4g} to {1e3 * s.max():.4g} mm of the wheel's profile, "
            "does not fit on the finely meshed tread: enlarge solid.contact_half_length (now "
            f"{wheel.contact_half_length:g} m) or solid.contact_half_width "
            f"({wheel.contact_half_width:g} m)"
        )
    # the flat faces lie inside the smooth bodies by their sagitta h^2/8 k, along the normal
    bend = np.abs(placed.rail.curvature(arc)).max() + np.abs(placed.wheel.curvature(s)).max()
    sagitta = wheel.size**2 / 8 * float(bend + 1 / placed.radius)
    return approach + sagitta / float(np.cos(placed.touch.angle))


def _run(study: Study, wanted: str | None, problems: list[str]) -> str | None:
    """Name of the run, None with a complaint."""
    surface = [name for name, run in study.runs.items() if isinstance(run, SurfaceRun)]
    if wanted in surface:
        return wanted
    if not surface:
        problems.append(f'study {study.name}: has no run with solver = "surface" to export')
    elif wanted is None:
        return study.reference if study.reference in surface else surface[0]
    else:
        hint = did_you_mean(wanted, surface)
        allowed = f"must be a run of surface contact{hint}: {', '.join(surface)}"
        problems.append(complaint("--run", wanted, allowed))
    return None
