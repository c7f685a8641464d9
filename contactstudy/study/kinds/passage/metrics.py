"""What goes into ``metrics.json``: sizes, costs, and error norms of each run.

::

    runs.<name>:  dofs, steps, dt [s], seconds {setup, stepping}, peak_memory_mb, and of surface
                  contact the largest penetration left [m], in the run and in its static press
    reference:    name of the run that all others are compared with
    dynamic_part: rms [N] of the reference's contact force about its static value, of_static, and
                  whether it is large enough to be compared
    comparisons.<name>.<signal>:
        relative_l2, relative_l2_dynamic, linf, rms, correlation,
        sprague_geers {M, P, C}, sprague_geers_dynamic {M, P, C},
        with ``compare.smooth`` also relative_l2_irregularity and sprague_geers_irregularity,
        softer {k_r: part of the run's, relative_l2_dynamic} with ``compare.softer``,
        third_octave {nominal centre in Hz: level less the reference's in dB}, of bands in which
        the reference has content
    comfort:      of runs with car bodies, see `comfort_of`
    wheel_forces: of runs on bridges, see `contactstudy.study.kinds.passage.safety`
    measured:     with ``[measured]``, see `held_against`
    rungs.<name>: with ``compare.rungs``, the run ``above`` and the same norms against it

Signals are those of wheel and rail, and on a bridge `OF_DECK`.
Both are compared at equal wheel positions behind the fade-in, those of runs that travel the
reference's way; `contactstudy.compare.norms`
defines the norms. ``linf`` and ``rms`` are in the signal's SI unit. The dynamic part is what is
left of a signal when its own value in the static start is taken off; the irregularity's part,
when the same run on a smooth rail is taken off. The wheel's displacement is compared from rest on
(`contactstudy.compare.signals.WITHOUT_STATIC`): the run's is moved so that both start from the
reference's static value. A norm that does not exist, because a signal is zero or constant, is null;
so are those of the dynamic part where the reference's is next to nothing (`LEAST_DYNAMIC`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare import norms
from contactstudy.compare.bands import level_differences
from contactstudy.compare.signals import (
    WITHOUT_STATIC,
    at_rest,
    carries,
    position,
    same_way,
    speed,
)
from contactstudy.study.kinds.passage.comfort import comfort_of
from contactstudy.study.kinds.passage.held_against import held_against
from contactstudy.study.kinds.passage.safety import safety_of
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import OF_DECK, SIGNALS, SMOOTH, SOFTER

if TYPE_CHECKING:
    import xarray as xr

LEAST_DYNAMIC = 0.005
"""Least root mean square of the reference's dynamic force, over the static load, to compare.

Below that an error of the dynamic part says more of the reference's own than of the model: meshes
and time steps leave about 0.13 % of the force (``contactstudy verify convergence``).
"""


def metrics(
    study: Study, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Mapping[str, Any]]
) -> dict[str, Any]:
    """Content of ``metrics.json``, the norms behind the fade-in."""
    compare_from = study.journey.start + study.journey.fade_in
    made = study_metrics(runs, costs, study.reference, compare_from)
    if study.rungs:
        made["rungs"] = rungs(runs, compare_from)
    if found := comfort_of(runs):
        made["comfort"] = found
    if found := safety_of(runs):
        made["wheel_forces"] = found
    if study.measured.used and runs:
        made["measured"] = held_against(study.measured, runs)
    return made


def rungs(runs: Mapping[str, xr.Dataset], start: float) -> dict[str, Any]:
    """Each run against the one above it in the study file, whose name is ``above``."""
    names = list(runs)
    return {
        name: {"above": above, **compare_runs(runs[name], runs[above], start, bands=False)}
        for above, name in pairwise(names)
    }


def study_metrics(
    runs: Mapping[str, xr.Dataset],
    costs: Mapping[str, Mapping[str, Any]],
    reference: str | None,
    compare_from: float,
) -> dict[str, Any]:
    """Content of ``metrics.json``; compared from the wheel position `compare_from` [m] on.

    `costs` holds ``seconds`` and ``peak_memory_mb`` of each run.
    """
    result: dict[str, Any] = {
        "runs": {
            name: {
                "dofs": int(run.attrs["dofs"]),
                "steps": int(run.attrs["steps"]),
                "dt": float(run.attrs["dt"]),
                **_penetration(run),
                **costs[name],
            }
            for name, run in runs.items()
        },
        "reference": reference,
        "comparisons": {},
    }
    if reference is not None and reference in runs:
        result["compared_from_m"] = compare_from
        result["comparisons"] = {
            name: compare_runs(run, runs[reference], compare_from)
            for name, run in runs.items()
            if name != reference and same_way(run, runs[reference])
        }
        result["dynamic_part"] = found = dynamic_part(runs[reference], compare_from)
        if not found["compared"]:
            for errors in result["comparisons"].values():
                for signal, entry in errors.items():
                    errors[signal] = _without_dynamic(entry)
    return result


def dynamic_part(run: xr.Dataset, start: float) -> dict[str, Any]:
    """How large a run's contact force is about its static value, from `start` [m] on."""
    force, x = np.asarray(run["contact_force"].values, dtype=float), position(run)
    static = at_rest(run, "contact_force")
    dynamic = behind(norms.dynamic_part(force, static), x, start)
    rms = float(np.sqrt(np.mean(dynamic**2)))
    of_static = rms / float(np.mean(np.abs(static)) or 1.0)
    return {"rms": rms, "of_static": of_static, "compared": of_static >= LEAST_DYNAMIC}


def behind(values: Array, x: Array, start: float) -> Array:
    """The samples (..., n) at positions (n,) behind the fade-in, which ends at `start` [m]."""
    return np.asarray(values[..., x >= start - 1e-9 * max(abs(start), 1.0)])


def _without_dynamic(entry: Mapping[str, Any]) -> dict[str, Any]:
    nothing = {
        "relative_l2_dynamic": None,
        "sprague_geers_dynamic": dict.fromkeys("MPC"),
        "third_octave": {},
    }
    kept = {key: value for key, value in entry.items() if key != "softer"}
    return kept | {key: value for key, value in nothing.items() if key in entry}


def _penetration(run: xr.Dataset) -> dict[str, float]:
    found = {"penetration": "penetration", "penetration_of_press": "press_penetration"}
    return {key: float(run[name].max()) for key, name in found.items() if name in run}


def compare_runs(
    run: xr.Dataset, reference: xr.Dataset, start: float, bands: bool = True
) -> dict[str, Any]:
    """Norms of each signal of `run` against `reference`, from the position `start` [m] on.

    Levels in third octaves are left out without `bands`.
    """
    return {
        name: _compare_signals(run, reference, name, start, bands)
        for name in (*SIGNALS, *OF_DECK)
        if carries(run, name) and carries(reference, name)
    }


def parts_of(run: xr.Dataset, name: str) -> dict[str, Array]:
    """A signal without its static value, and without that of the run's twin if it has one."""
    values = _histories(run, name)
    parts = {"dynamic": norms.dynamic_part(values, values[..., 0])}
    if name + SMOOTH in run:
        parts["irregularity"] = values - _histories(run, name + SMOOTH)
    return parts


def _compare_signals(
    run: xr.Dataset, reference: xr.Dataset, name: str, start: float, bands: bool
) -> Any:
    x_run, x_reference = position(run), position(reference)
    x = norms.common_positions(x_run, x_reference, start)
    a = norms.at_positions(_histories(run, name), x_run, x)
    if name in WITHOUT_STATIC:
        a = norms.dynamic_part(a, at_rest(run, name) - at_rest(reference, name))
    b = norms.at_positions(_histories(reference, name), x_reference, x)
    made: dict[str, Any] = {
        "relative_l2": _number(norms.relative_l2(a, b, x)),
        "linf": _number(norms.linf(a, b)),
        "rms": _number(norms.rms(a, b, x)),
        "correlation": _number(norms.correlation(a, b, x)),
        "sprague_geers": _sprague_geers(a, b, x),
    }
    of_run, of_reference = parts_of(run, name), parts_of(reference, name)
    for part in (part for part in of_run if part in of_reference):
        pair = (
            norms.at_positions(of_run[part], x_run, x),
            norms.at_positions(of_reference[part], x_reference, x),
        )
        made[f"relative_l2_{part}"] = _number(norms.relative_l2(*pair, x))
        made[f"sprague_geers_{part}"] = _sprague_geers(*pair, x)
        if bands and part == "dynamic":
            made["third_octave"] = level_differences(*pair, x, speed(reference))
    if name + SOFTER in run:
        softer = run[name + SOFTER]
        own = norms.dynamic_part(softer.values, softer.values[..., 0])
        pair = (
            norms.at_positions(own, x_run, x),
            norms.at_positions(of_reference["dynamic"], x_reference, x),
        )
        made["softer"] = {
            "k_r": float(softer.attrs["part_of_k_r"]),
            "relative_l2_dynamic": _number(norms.relative_l2(*pair, x)),
        }
    return made


def _histories(run: xr.Dataset, name: str) -> Array:
    """A signal's values (..., time), of decks without the stations beside them."""
    values = np.asarray(run[name].values)
    return values[np.isfinite(values).any(axis=-1)] if "station" in run[name].dims else values


def _sprague_geers(a: Any, b: Any, x: Array) -> dict[str, float | None]:
    found = norms.sprague_geers(a, b, x)
    return {
        "M": _number(found.magnitude),
        "P": _number(found.phase),
        "C": _number(found.combined),
    }


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
