"""What goes into ``metrics.json``: sizes, costs, and error norms of each run.

::

    runs.<name>:  dofs, steps, dt [s], seconds {setup, stepping}, peak_memory_mb, and of surface
                  contact the largest penetration left [m], in the run and in its static press
    reference:    name of the run that all others are compared with
    comparisons.<name>.<signal>:
        relative_l2, relative_l2_dynamic, linf, rms, correlation,
        sprague_geers {M, P, C}, sprague_geers_dynamic {M, P, C},
        third_octave {nominal centre in Hz: level less the reference's in dB}

Both signals are compared at equal wheel positions behind the fade-in; `contactstudy.compare.norms`
defines the norms. ``linf`` and ``rms`` are in the signal's SI unit. The dynamic part is what is
left of a signal when its own value in the static start is taken off. A norm that does not exist,
because a signal is zero or constant, is null.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare import norms
from contactstudy.compare.bands import level_differences
from contactstudy.study.kinds.passage.schema import Study

if TYPE_CHECKING:
    import xarray as xr

SIGNALS = ("contact_force", "wheel_displacement", "wheel_acceleration", "rail_displacement")


def metrics(
    study: Study, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Mapping[str, Any]]
) -> dict[str, Any]:
    """Content of ``metrics.json``, the norms behind the fade-in."""
    compare_from = study.journey.start + study.journey.fade_in
    return study_metrics(runs, costs, study.reference, compare_from)


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
            if name != reference
        }
    return result


def _penetration(run: xr.Dataset) -> dict[str, float]:
    found = {"penetration": "penetration", "penetration_of_press": "press_penetration"}
    return {key: float(run[name].max()) for key, name in found.items() if name in run}


def compare_runs(run: xr.Dataset, reference: xr.Dataset, start: float) -> dict[str, Any]:
    """Norms of each signal of `run` against `reference`, from the position `start` [m] on."""
    return {
        name: _compare_signals(run, reference, name, start)
        for name in SIGNALS
        if name in run and name in reference
    }


def _compare_signals(run: xr.Dataset, reference: xr.Dataset, name: str, start: float) -> Any:
    x_run, x_reference = _position(run), _position(reference)
    x = norms.common_positions(x_run, x_reference, start)
    a_all, b_all = run[name].values, reference[name].values
    a, b = norms.at_positions(a_all, x_run, x), norms.at_positions(b_all, x_reference, x)
    a_static, b_static = a_all[..., 0], b_all[..., 0]
    dynamic = norms.dynamic_part(a, a_static), norms.dynamic_part(b, b_static)
    return {
        "relative_l2": _number(norms.relative_l2(a, b, x)),
        "relative_l2_dynamic": _number(norms.relative_l2(*dynamic, x)),
        "linf": _number(norms.linf(a, b)),
        "rms": _number(norms.rms(a, b, x)),
        "correlation": _number(norms.correlation(a, b, x)),
        "sprague_geers": _sprague_geers(a, b, x),
        "sprague_geers_dynamic": _sprague_geers(*dynamic, x),
        "third_octave": level_differences(*dynamic, x, _speed(reference)),
    }


def _sprague_geers(a: Any, b: Any, x: Array) -> dict[str, float | None]:
    found = norms.sprague_geers(a, b, x)
    return {
        "M": _number(found.magnitude),
        "P": _number(found.phase),
        "C": _number(found.combined),
    }


def _position(run: xr.Dataset) -> Array:
    """Position (n,) of the leading wheel in m."""
    position = run["position"]
    return np.asarray((position.isel(wheel=0) if "wheel" in position.dims else position).values)


def _speed(run: xr.Dataset) -> float:
    x, t = _position(run), run["time"].values
    return float((x[-1] - x[0]) / (t[-1] - t[0]))


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
