"""The default study on a shortened journey, refined in one thing at a time."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.runs import SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.tables import JourneyTable, SolidTable
from contactstudy.verification.cases.series import Series, series

MESHES = (0.004, 0.003, 0.0025, 0.002, 0.1 / 60)
INTERIORS = (0.012, 0.009, 0.006, 0.0045)
PENALTIES = (1e14, 1e15, 1e16, 1e17, 1e18)
TOLERANCE = 1e-10
"""m, of the augmented Lagrangian that is the limit of the penalty at nodes."""
MODES = (8, 10, 12, 14, 18, 22)
TIME_STEPS = (2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5)


def short_study(**solid: object) -> Study:
    """The default study on a shortened journey, with other values in ``[solid]``."""
    return Study(
        name="convergence",
        title="Convergence",
        journey=JourneyTable.model_validate({"from": 12.0, "to": 15.6, "fade_in": 1.2}),
        solid=SolidTable.model_validate(solid),
        runs={"surface": SurfaceRun()},
    )


def with_solid(study: Study, **values: object) -> Study:
    """A study with other values in ``[solid]``."""
    solid = SolidTable.model_validate(study.solid.model_dump() | values)
    return replace(study, solid=solid)


def with_time_step(study: Study, step: float) -> Study:
    """A study with another time step in s."""
    return replace(study, journey=study.journey.model_copy(update={"time_step": step}))


@cache
def mesh_series() -> Series:
    """Element size at the running surface."""
    return series(short_study(), lambda s, h: with_solid(s, mesh_size=h), MESHES, 0.002)


@cache
def interior_series() -> Series:
    """Largest element size of the rail's section, on a 4 mm running surface."""
    return series(
        short_study(mesh_size=0.004),
        lambda s, h: with_solid(s, coarse_mesh_size=h),
        INTERIORS,
        0.009,
    )


@cache
def penalty_series(points: str) -> Series:
    """Penalty, at "gauss" points or "nodes"; at nodes the augmented Lagrangian comes last."""
    study = short_study(contact_points=points)
    plain = series(study, lambda s, e: with_solid(s, penalty=e), PENALTIES, 1e16, lambda e: 1.0 / e)
    if points == "gauss":
        return plain
    limit = with_solid(study, enforcement="augmented", penetration_tolerance=TOLERANCE)
    # a penalty that lets overlap no more than that
    runs = (*plain.runs, execute_run(limit, "surface"))
    equal = 1e9 / TOLERANCE
    return replace(
        plain, levels=(*plain.levels, equal), sizes=(*plain.sizes, 1.0 / equal), runs=runs
    )


@cache
def modes_series() -> Series:
    """Generalised modes of the rail's interface planes."""
    return series(
        short_study(),
        lambda s, n: with_solid(s, interface_modes=int(n)),
        MODES,
        14,
        lambda n: 1.0 / n,
        algebraic=False,
    )


@cache
def time_step_series() -> Series:
    """Time step."""
    return series(short_study(), with_time_step, TIME_STEPS, 5e-5)
