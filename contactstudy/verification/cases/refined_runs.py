"""The shipped study on a shortened journey, refined in one key at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

import xarray as xr

from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.loading import load_study
from contactstudy.verification.cases.refinement import Refinement

STUDY = "point_vs_surface"
SHORT = (
    "journey.from=12 m", "journey.to=15.6 m", "journey.fade_in=1.2 m",
    "journey.stations=[]", "solid.pressure_at=[]",
)  # fmt: skip

MESHES = (0.004, 0.003, 0.0025, 0.002, 0.1 / 60)
INTERIORS = (0.012, 0.009, 0.006, 0.0045)
PENALTIES = (1e14, 1e15, 1e16, 1e17, 1e18)
TOLERANCE = 1e-10
"""m, of the augmented Lagrangian that is the limit of the penalty at nodes."""
MODES = (8, 10, 12, 14, 18, 22)
TIME_STEPS = (2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5)


def surface_run(*changes: str) -> xr.Dataset:
    """Surface contact of the shortened study with keys set as on the command line.

    What `changes` say takes the place of `SHORT`.
    """
    keys = dict(text.split("=", 1) for text in (*SHORT, *changes))
    return execute_run(load_study(STUDY, [f"{k}={v}" for k, v in keys.items()]), "surface")


def refined(
    key: str,
    levels: Sequence[float],
    default: float,
    changes: Sequence[str] = (),
    size: Callable[[float], float] = float,
    algebraic: bool = True,
) -> Refinement:
    """Run the shortened study at several levels of one key.

    Parameters
    ----------
    levels : sequence of float
        SI values, coarsest first.
    default : float
        The one of them that is the default.
    changes : sequence of str
        Further keys, ``key=value``.
    size : callable
        From a level to what goes to zero.
    """
    runs = tuple(surface_run(*changes, f"{key}={level!r}") for level in levels)
    sizes = tuple(size(level) for level in levels)
    return Refinement(tuple(levels), sizes, list(levels).index(default), runs, algebraic)


@cache
def mesh_series() -> Refinement:
    """Element size at the running surface."""
    return refined("solid.mesh_size", MESHES, 0.002)


@cache
def interior_series() -> Refinement:
    """Largest element size of the rail's section, on a 4 mm running surface."""
    return refined("solid.coarse_mesh_size", INTERIORS, 0.009, ("solid.mesh_size=4 mm",))


@cache
def penalty_series(points: str) -> Refinement:
    """Penalty, at "gauss" points or "nodes"; at nodes the augmented Lagrangian comes last."""
    at = f"solid.contact_points={points}"
    plain = refined("solid.penalty", PENALTIES, 1e16, (at,), lambda e: 1.0 / e)
    if points == "gauss":
        return plain
    limit = surface_run(
        at, "solid.enforcement=augmented", f"solid.penetration_tolerance={TOLERANCE!r}"
    )
    # a penalty that lets overlap no more than that
    equal = 1e9 / TOLERANCE
    return replace(
        plain,
        levels=(*plain.levels, equal),
        sizes=(*plain.sizes, 1.0 / equal),
        runs=(*plain.runs, limit),
    )


@cache
def modes_series() -> Refinement:
    """Generalised modes of the rail's interface planes."""
    return refined("solid.interface_modes", MODES, 14, size=lambda n: 1.0 / n, algebraic=False)


@cache
def time_step_series() -> Refinement:
    """Time step."""
    return refined("journey.time_step", TIME_STEPS, 5e-5)
