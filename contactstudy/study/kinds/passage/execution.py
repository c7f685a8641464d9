"""One run of a study, in the process at hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from contactstudy.executor import Progress
from contactstudy.solids.cache import Body, cached
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.roughness import irregularity_of
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.vehicles import vehicle

if TYPE_CHECKING:
    import xarray as xr


def execute_run(study: Study, run: str, progress: Progress | None = None) -> xr.Dataset:
    """Build the domain objects of a run, call its solver, return its dataset.

    Parameters
    ----------
    study : Study
    run : str
        Name of one of its runs.
    progress : callable, optional
        Called with steps done and steps in all.
    """
    table = study.runs[run]
    if isinstance(table, SurfaceRun):
        return _surface(study, run, table, progress)
    return _point(study, run, table, progress)


def _point(study: Study, run: str, table: PointRun, progress: Progress | None) -> xr.Dataset:
    from contactstudy.solvers.point import point_contact

    track = build.track(study)
    return point_contact(
        build.solid_track(study, track) if table.rail == "solid" else track,
        vehicle(study),
        irregularity_of(study, table.irregularity == "smooth", table.direction),
        build.journey(study, run),
        rail_theory="timoshenko" if table.rail == "timoshenko" else "euler",
        elements_per_bay=table.elements_per_bay,
        local_compliance=table.local_compliance,
        law=build.contact_law(study, run, track),
        direction=table.direction,
        integrator=build.integrator(table),
        progress=progress,
    )


def _surface(study: Study, run: str, table: SurfaceRun, progress: Progress | None) -> xr.Dataset:
    from contactstudy.solvers.surface import surface_contact

    return surface_contact(
        build.solid_track(study, build.track(study)),
        build.wheel(study, run),
        vehicle(study),
        irregularity_of(study, table.irregularity == "smooth"),
        build.journey(study, run),
        geometry=geometry(study),
        modes=build.modes(study, run),
        wheel_damping=study.solid.wheel_damping,
        penalty=study.solid.penalty,
        quadrature=study.solid.contact_points,
        tolerance=study.solid.tolerance,
        pressure_at=study.solid.pressure_at,
        frames_at=build.frames_at(study),
        integrator=build.integrator(table),
        progress=progress,
    )


def condense_body(body: Body[Any], progress: Progress | None = None) -> None:
    """Condense a body into the cache."""
    cached(body)
