"""Order, limit, index and verdict of all that was measured along a refined key."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.refinement import Convergence, convergence
from contactstudy.study.kind import Kind

if TYPE_CHECKING:
    import xarray as xr

OUTCOMES = {
    "order": "observed order",
    "order_error": "its standard error",
    "limit": "Richardson's limit",
    "uncertainty": "band of 95 % about the finest value",
    "index": "grid convergence index of the finest, relative",
}
VERDICT = "verdict"


def sizes(values: Array) -> Array:
    """Size h of each step of a refinement (n,): the value where it falls, else its inverse."""
    return values if values[0] > values[-1] else 1.0 / values


def with_convergence(data: xr.Dataset, kind: Kind) -> xr.Dataset:
    """The dataset of a refinement with ``<variable>_order``, ``_limit`` ... of what is shown.

    A verdict is empty where a value is missing or nothing changes along the refined key.
    """
    refined = str(data.attrs["refined"])
    names = dict.fromkeys(q.variable for q in kind.shown) or [
        n for n, v in data.data_vars.items() if v.dtype.kind == "f"
    ]
    h = sizes(np.asarray(data[refined].values, dtype=float))
    expected = data.attrs.get("expected_order")
    for name in names:
        if name not in data or refined not in data[name].dims:
            continue
        values = data[name].transpose(..., refined)
        others = values.dims[:-1]
        shape = values.shape[:-1]
        found = {o: np.full(shape, np.nan) for o in OUTCOMES}
        verdicts = np.full(shape, "", dtype=object)
        # norms of differences are relative already
        scale = 1.0 if "finest" in str(name) else None
        for index, f in _changing(values.values):
            made: Convergence = convergence(h.tolist(), f.tolist(), expected, scale)
            for outcome, array in found.items():
                array[index] = getattr(made, outcome)
            verdicts[index] = made.verdict
        for outcome, array in found.items():
            units = data[name].attrs["units"] if outcome in ("limit", "uncertainty") else "1"
            attrs = {"units": units, "long_name": f"{OUTCOMES[outcome]} of {name}"}
            data[f"{name}_{outcome}"] = (others, array, attrs)
        data[f"{name}_{VERDICT}"] = (others, verdicts.astype(str), {"long_name": f"of {name}"})
    return data


def _changing(values: Array) -> Iterator[tuple[tuple[int, ...], Array]]:
    """Index and values (n,) of each series that is whole and not constant."""
    for index in np.ndindex(values.shape[:-1]):
        f = values[index]
        if np.isfinite(f).all() and np.ptp(f) > 0.0:
            yield index, f
