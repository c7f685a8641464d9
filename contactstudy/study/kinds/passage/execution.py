"""One run of a study, in the process at hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Progress, Task
from contactstudy.solids.cache import CachedBody, cached, is_cached
from contactstudy.solids.wheel_recipe import LARGEST_ZONE
from contactstudy.solvers import observers
from contactstudy.solvers.bridge_frames import BridgeFrames
from contactstudy.solvers.car_bodies import CarBodies, bodies
from contactstudy.solvers.observers import Observer
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.kinds.passage.roughness import irregularity_of, irregularity_of_rails
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import untwinned
from contactstudy.study.kinds.passage.zone import on_large_enough
from contactstudy.vehicle import Train, Vehicle

if TYPE_CHECKING:
    import xarray as xr

    from contactstudy.solvers.point_case import PointCase


def execute_run(study: Study, run: str, progress: Progress | None = None) -> xr.Dataset:
    """Build the domain objects of a run or of its smooth twin, call its solver.

    `progress` is called with steps done and steps in all.
    """
    study, run = untwinned(study, run)
    table = study.runs[run]
    if isinstance(table, SurfaceRun):
        return _surface(study, run, table, progress)
    from contactstudy.solvers.point import point_contacts

    (found,) = point_contacts([_point(study, run, table)], progress)
    if isinstance(found, ContactStudyError):
        raise found
    return found


def _point(study: Study, run: str, table: PointRun) -> PointCase:
    from contactstudy.solvers.point_case import PointCase

    vehicle, smooth = build.vehicle(study), table.irregularity == "smooth"
    return PointCase(
        build.point_track(study, table, build.track(study)),
        vehicle,
        irregularity_of(study, smooth, table.direction)
        if vehicle.planar
        else irregularity_of_rails(study, smooth),
        build.journey(study, run),
        contact.contact_law(study, run),
        contact.contact_filter(study, run),
        contact.point_wheel(study, run),
        table.method(),
        table.lateral_k_r,
        _watching(study, vehicle),
    )


def _watching(study: Study, vehicle: Vehicle) -> tuple[Observer, ...]:
    structure = study.track.structure
    frames = 0 if structure is None else structure.animation_frames
    found: tuple[Observer, ...] = (CarBodies(),) if bodies(vehicle) else ()
    if frames:
        outlines = study.vehicle.outlines if isinstance(study.vehicle, Train) else ()
        found += (BridgeFrames(frames, tuple(outlines)),)
    return found


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
    """As `execute_run`, of point runs that are stepped side by side; of each dataset or error."""
    from contactstudy.solvers.point import point_contacts

    found: list[xr.Dataset | ContactStudyError | None] = []
    cases: list[PointCase] = []
    for study, name in runs:
        owner, run = untwinned(study, name)
        table = owner.runs[run]
        assert isinstance(table, PointRun)
        try:
            cases.append(_point(owner, run, table))
        except ContactStudyError as error:
            found.append(error)
        else:
            found.append(None)
    made = iter(point_contacts(cases, progress))
    return [next(made) if one is None else one for one in found]


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
