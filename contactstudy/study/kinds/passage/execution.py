"""One run of a study, in the process at hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Progress, Task
from contactstudy.solids.cache import CachedBody, cached, is_cached
from contactstudy.solids.wheel_recipe import LARGEST_ZONE
from contactstudy.solvers import observers
from contactstudy.solvers.car_bodies import CarBodies
from contactstudy.solvers.observers import Observer
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.kinds.passage.roughness import irregularity_of, irregularity_of_rails
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import untwinned
from contactstudy.study.kinds.passage.zone import on_large_enough

if TYPE_CHECKING:
    import xarray as xr


def execute_run(study: Study, run: str, progress: Progress | None = None) -> xr.Dataset:
    """Build the domain objects of a run or of its smooth twin, call its solver.

    `progress` is called with steps done and steps in all.
    """
    study, run = untwinned(study, run)
    table = study.runs[run]
    if isinstance(table, SurfaceRun):
        return _surface(study, run, table, progress)
    return _point(study, run, table, progress)


def _point(study: Study, run: str, table: PointRun, progress: Progress | None) -> xr.Dataset:
    from contactstudy.solvers.point import point_contact

    vehicle, smooth = build.vehicle(study), table.irregularity == "smooth"
    return point_contact(
        build.point_track(study, table, build.track(study)),
        vehicle,
        irregularity_of(study, smooth, table.direction)
        if vehicle.planar
        else irregularity_of_rails(study, smooth),
        build.journey(study, run),
        law=contact.contact_law(study, run),
        contact_filter=contact.contact_filter(study, run),
        wheel=contact.point_wheel(study, run),
        lateral_stiffness=table.lateral_k_r,
        observers=(*_reports(progress), CarBodies()),
        integrator=table.method(),
    )


def _surface(study: Study, run: str, table: SurfaceRun, progress: Progress | None) -> xr.Dataset:
    from contactstudy.solvers.frames import Frames
    from contactstudy.solvers.instants import Instants
    from contactstudy.solvers.surface import surface_contact

    def compute(study: Study) -> xr.Dataset:
        data = surface_contact(
            build.solid_track(study, build.track(study)),
            build.surface_contact(study, run),
            study.vehicle.vehicle(),
            irregularity_of(study, table.irregularity == "smooth"),
            build.journey(study, run),
            observers=(
                *_reports(progress),
                Instants(study.solid.pressure_at),
                Frames(build.frames_at(study)),
            ),
            integrator=table.method(),
        )
        return data.assign_attrs({key: getattr(study.solid, key) for key in LARGEST_ZONE})

    return on_large_enough(study, compute)


def _reports(progress: Progress | None) -> tuple[Observer, ...]:
    return () if progress is None else (observers.ReportProgress(progress),)


def execute_batch(
    runs: Sequence[tuple[Study, str]], progress: Progress | None = None
) -> list[xr.Dataset | ContactStudyError]:
    """As `execute_run`, of runs that share what is dear; of each its dataset, or its error."""
    found: list[xr.Dataset | ContactStudyError] = []
    for done, (study, run) in enumerate(runs):
        try:
            found.append(execute_run(study, run))
        except ContactStudyError as error:
            found.append(error)
        if progress is not None:
            progress(done + 1, len(runs))
    return found


def condensing(study: Study, run: str) -> list[Task]:
    """Making the bodies of a run that the cache does not have, each after those it is made of."""
    study, run = untwinned(study, run)
    needed = [body for body in contact.bodies(study, run) if not is_cached(body)]
    names = [_MAKING.get(body.name, f"condensing the {body.name}") for body in needed]
    return [
        Task(name, condense_body, (body,), tuple(names[:k]) if body.name in _MAKING else ())
        for k, (name, body) in enumerate(zip(names, needed, strict=True))
    ]


_MAKING = {"press": "pressing the bodies", "bay": "loading a bay"}
"""What is made of condensed bodies."""


def condense_body(body: CachedBody[Any], progress: Progress | None = None) -> None:
    """Condense a body into the cache."""
    cached(body)
