"""Static press of a study's wheel on its rail as an input file for CalculiX."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from contactstudy import __version__
from contactstudy.contact.hertz import HertzContact, contact_modulus, hertz_contact
from contactstudy.exceptions import InputError
from contactstudy.export.calculix import calculix_input
from contactstudy.export.press_mesh import PressMesh, press_mesh
from contactstudy.profiles.rail import rail_profile
from contactstudy.study import build
from contactstudy.study.files import writing
from contactstudy.study.messages import complaint, did_you_mean
from contactstudy.study.runs import SurfaceRun
from contactstudy.study.schema import Study
from contactstudy.units import UnitError, to_si
from contactstudy.validation import raise_if

CELLS = 4
"""Rail cells that are exported by default: the fewest that a condensed track has."""


@dataclass(frozen=True)
class Exported:
    """What was written.

    Attributes
    ----------
    load, length : float
        Wheel load in N and length of the rail in m.
    mesh : PressMesh
    """

    load: float
    length: float
    mesh: PressMesh


def export_press(
    study: Study,
    out: Path,
    run: str | None = None,
    load: str | None = None,
    rail_length: str | None = None,
) -> Exported:
    """Write the input file.

    Parameters
    ----------
    study : Study
        With a run of surface contact.
    out : Path
        File to write.
    run : str, optional
        Which run; the reference or the first one of surface contact when not given.
    load : str, optional
        Wheel load, a number in N or text with a unit; the vehicle's static load when not given.
    rail_length : str, optional
        The same in m; `CELLS` rail cells when not given.

    Returns
    -------
    Exported

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
    if study.track.rail == "given":
        problems.append('track.rail = "given": a rail of given values has no section to mesh')
    if study.solid.section == "whole":
        problems.append('solid.section = "whole": only a half section can be exported')
    if name and study.wheel(name) == "rigid":
        problems.append(f'wheel = "rigid" in the run {name}: only an elastic wheel can be exported')
    newtons = given("--load", load, "N", float(build.vehicle(study).static_loads[0]))
    length = given("--rail-length", rail_length, "m", CELLS * study.solid.cell_length)
    if out.is_dir():
        problems.append(f"--out {out}: is a folder; give the name of a file")
    raise_if(problems)
    hertz = _hertz(study, newtons)
    cell, wheel = build.recipe(study), build.wheel_recipe(study)
    reach, half = wheel.contact_half_length, wheel.contact_half_width
    if hertz.semi_axis_x > reach or hertz.semi_axis_y > half:
        raise InputError(
            f"load = {newtons:.6g} N: the patch, {hertz.semi_axis_x:.4g} m along and "
            f"{hertz.semi_axis_y:.4g} m across from its middle after Hertz, does not fit on the "
            f"finely meshed tread: enlarge solid.contact_half_length (now {reach:g} m) or "
            f"solid.contact_half_width ({half:g} m)"
        )
    mesh = press_mesh(cell, wheel, length)
    header = (
        f"contactstudy {__version__}: static press of an elastic wheel on an elastic rail",
        f"study {study.name}: {study.title}; run {name}",
        f"wheel load {newtons:.6g} N on the hub (half of it here), penalty "
        f"{study.solid.penalty:.6g} Pa/m",
        f"rail {cell.profile}, {length:g} m, clamped at both ends; elements of {cell.size:g} m, "
        f"slices of {cell.length / cell.n_slices:g} m; {len(mesh.rail)} elements",
        f"wheel {wheel.profile}, radius {wheel.dimensions.radius:g} m, elements of "
        f"{wheel.size:g} m; {len(mesh.wheel)} elements",
        f"E = {cell.youngs_modulus:.6g} Pa, nu = {cell.poisson_ratio:g}",
        "half model y >= 0; X along the rail, Y lateral, Z up; origin at first touch",
        "results of the second step: approach = -U3 of HUB; force and area = twice those of CF",
    )
    text = calculix_input(
        mesh,
        newtons,
        study.solid.penalty,
        cell.youngs_modulus,
        cell.poisson_ratio,
        hertz.approach,
        header,
    )
    with writing(out) as temporary:
        temporary.write_text(text, "ascii", errors="replace")
    return Exported(newtons, length, mesh)


def _hertz(study: Study, load: float) -> HertzContact:
    E, nu = study.track.youngs_modulus, study.track.poisson_ratio
    crown = rail_profile(study.track.rail).crown_radius
    return hertz_contact(load, contact_modulus(E, nu), study.vehicle.wheel_radius, crown)


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
