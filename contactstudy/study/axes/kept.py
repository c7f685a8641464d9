"""Whole histories of all variants, where the study keeps them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.study.plan import Plan

if TYPE_CHECKING:
    import xarray as xr

SAMPLE = "sample"
"""Dimension of the samples of a history; shorter ones end in nan."""
_MOST = 2.5e8  # numbers, 2 GB


def kept_histories(
    plan: Plan, data: xr.Dataset, names: Mapping[tuple[int, ...], str], keep: Sequence[str]
) -> xr.Dataset:
    """The dataset of a design with histories of its variants' runs, and their coordinates.

    Raises
    ------
    InputError
        For a history that no run has, or when they are too large together.
    """
    found: dict[tuple[tuple[int, ...], str], xr.Dataset] = {}
    for index, name in names.items():
        if name in plan.left_out:
            continue
        variant = plan.variants[name]
        pieces = {n: plan.kept(p).value for n, p in variant.pieces.items()}
        if all(value is not None for value in pieces.values()):
            runs = plan.kind.collect(variant.study, pieces)
            found |= {(index, run): histories(value, keep) for run, value in runs.items()}
        size = sum(v.size for one in found.values() for v in one.variables.values())
        if size > _MOST:
            raise InputError(f"sweep.keep: histories of more than {8 * _MOST / 1e9:g} GB")
    wanted = dict.fromkeys(str(n) for one in found.values() for n in one.variables)
    if missing := [name for name in keep if name not in wanted and found]:
        raise InputError(f"sweep.keep: no run has the history {' or '.join(missing)}")
    measured = data["run"].values.tolist() if "run" in data.coords else []
    labels = list(dict.fromkeys([*measured, *(run for _, run in found)]))
    data = data.reindex(run=labels) if measured else data.assign_coords(run=labels)
    dims = data["variant"].dims
    longest = max((one.sizes.get(SAMPLE, 0) for one in found.values()), default=0)
    for name in wanted:
        own = {at: one[name] for at, one in found.items() if name in one.variables}
        extra = {d: 0 for array in own.values() for d in array.dims if d != SAMPLE}
        sizes = {d: max(a.sizes.get(d, 1) for a in own.values()) for d in extra}
        shape = [*(data.sizes[d] for d in dims), len(labels), *sizes.values(), longest]
        values, attrs = np.full(shape, np.nan), dict[str, Any]()
        for (index, run), array in own.items():
            array = array.expand_dims([d for d in extra if d not in array.dims])
            array = array.transpose(*extra, SAMPLE)
            values[index][labels.index(run)][tuple(map(slice, array.shape))] = array.values
            attrs = dict(array.attrs)
        data[name] = ((*dims, "run", *map(str, extra), SAMPLE), values, attrs)
    return data


def histories(run: xr.Dataset, keep: Sequence[str]) -> xr.Dataset:
    """Histories of one run, samples last, and the coordinates along them.

    Those of several wheels or stations have a dimension before that.
    """
    import xarray as xr

    made = xr.Dataset()
    for name in keep:
        if name in run and run[name].ndim:
            *others, dim = run[name].dims
            for n in (name, *(c for c in run.coords if dim in run[c].dims)):
                if set(run[n].dims) <= {*others, dim}:
                    dims = [SAMPLE if d == dim else d for d in run[n].dims]
                    made = made.assign({n: (dims, run[n].values, run[n].attrs)})
    return made
