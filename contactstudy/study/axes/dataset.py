"""What was measured of all variants as one labelled dataset a design, and as a CSV file."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.files import write_file
from contactstudy.study.axes.design import CASE, GRID, Design
from contactstudy.study.axes.measured import Measured
from contactstudy.study.results import SWEEP_FILE

if TYPE_CHECKING:
    import xarray as xr

FAILURE = "failure"
"""Variable with the reason why a variant could not be computed, "" for a good one."""


def design_dataset(
    design: Design,
    names: Mapping[tuple[int, ...], str],
    measured: Mapping[str, Measured],
    failures: Mapping[str, str],
) -> xr.Dataset:
    """What was measured of the variants of a design.

    Parameters
    ----------
    names : mapping
        Index in the design's dimensions -> name of the variant.
    measured, failures : mapping
        Name -> what was measured of it; why it failed.

    Returns
    -------
    xarray.Dataset
        Dimensions are the varied keys (`CASE` for zipped ones and samples, along which the keys
        are coordinates) and those of what was measured: nan where there is nothing.
    """
    import xarray as xr

    sizes, own = design.sizes, [measured[n] for n in names.values() if n in measured]
    data = xr.Dataset(coords=_coordinates(design))
    data.attrs = {"design": design.name, "combine": design.combine, "refined": design.refined}
    if design.expected:
        data.attrs["expected_order"] = design.expected
    if design.why:
        data.attrs["why"] = design.why
    data["variant"] = _texts(sizes, names, {n: n for n in names.values()}, "name of the variant")
    data[FAILURE] = _texts(sizes, names, failures, "why it could not be computed")
    every = _labels([entry for one in own for entry in one.values()])
    data = data.assign_coords({dim: np.array(list(texts)) for dim, texts in every.items()})
    for name, template in _first(own).items():
        labels = {dim: list(every[dim]) for dim in template["dims"]}
        values = np.full([*sizes.values(), *map(len, labels.values())], np.nan)
        for index, variant in names.items():
            if name in measured.get(variant, {}):
                _fill(values[index], measured[variant][name]["values"], list(labels.values()))
        attrs = {"units": template["units"], "long_name": template["long_name"]}
        data[name] = ((*sizes, *labels), values, attrs)
    return data


def _coordinates(design: Design) -> dict[str, Any]:
    found = {}
    for key, made in design.series.items():
        attrs = {"units": made.unit or "1", "long_name": key}
        if made.factor_of:
            attrs["factor_of"] = made.factor_of
        dim = key if design.combine == GRID or key == design.refined else CASE
        found[key] = ((dim,), np.array(made.coordinates), attrs)
    return found


def _texts(
    sizes: Mapping[str, int],
    names: Mapping[tuple[int, ...], str],
    texts: Mapping[str, str],
    meaning: str,
) -> Any:
    values = np.full(list(sizes.values()), "", dtype=object)
    for index, name in names.items():
        values[index] = texts.get(name, "")
    return tuple(sizes), values.astype(str), {"long_name": meaning}


def _first(measured: list[Measured]) -> dict[str, Any]:
    """Each variable as it was first measured."""
    found: dict[str, Any] = {}
    for one in measured:
        found |= {name: entry for name, entry in one.items() if name not in found}
    return found


def _labels(entries: list[dict[str, Any]]) -> dict[str, dict[str, None]]:
    """Labels of each dimension; in the order of the variable that has most of them."""
    found: dict[str, list[dict[str, None]]] = {}
    for entry in entries:
        own: dict[str, dict[str, None]] = {dim: {} for dim in entry["dims"]}
        _gather(entry["values"], entry["dims"], own)
        for dim, labels in own.items():
            found.setdefault(dim, []).append(labels)
    return {
        dim: {text: None for labels in sorted(every, key=len, reverse=True) for text in labels}
        for dim, every in found.items()
    }


def _gather(values: Any, dims: list[str], into: dict[str, dict[str, None]]) -> None:
    if dims:
        into[dims[0]].update(dict.fromkeys(values))
        for inner in values.values():
            _gather(inner, dims[1:], into)


def _fill(into: Array, values: Any, labels: list[list[str]]) -> None:
    if not labels:
        into[...] = np.nan if values is None else values
        return
    for k, label in enumerate(labels[0]):
        if label in values:
            _fill(into[k, ...], values[label], labels[1:])


def write_csv(groups: Mapping[str, xr.Dataset], folder: Path) -> list[Path]:
    """Write datasets of designs: a line a variant, a column a key and each thing measured.

    The only design, and that of ``[sweep]``, is `SWEEP_FILE`; others have their names.
    """
    written = []
    for name, data in groups.items():
        alone = len(groups) == 1
        written.append(folder / (SWEEP_FILE if alone else f"{name}.csv"))
        columns = dict(_columns(data))
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([*columns])
        writer.writerows(zip(*columns.values(), strict=True))
        write_file(written[-1], text.getvalue())
    return written


def _columns(data: xr.Dataset) -> Iterator[tuple[str, list[Any]]]:
    """Heading and cells of each column; numbers as short as they are exact."""
    import xarray as xr

    dims = data["variant"].dims
    like = data["variant"]
    for name, variable in data.coords.items():
        if variable.dims and set(variable.dims) <= set(dims):
            spread = xr.broadcast(variable, like)[0].transpose(*dims)
            yield _heading(str(name), variable), spread.values.ravel().tolist()
    for name, variable in data.data_vars.items():
        if "sample" in variable.dims or not set(dims) <= set(variable.dims):
            continue  # histories, and what a refinement says of all its variants
        others = [d for d in variable.dims if d not in dims]
        stacked = variable.transpose(*dims, *others).values.reshape(like.size, -1)
        labels = _products([data[d].values.tolist() for d in others])
        for k, label in enumerate(labels):
            cells = stacked[:, k].tolist()
            if all(c != c for c in cells if isinstance(c, float)) and variable.dtype.kind == "f":
                continue
            yield (
                _heading(".".join([str(name), *label]), variable),
                ["" if c != c else c for c in cells],
            )


def _heading(name: str, variable: xr.DataArray) -> str:
    unit = variable.attrs.get("units", "")
    return f"{name} [{unit}]" if unit not in ("", "1") else name


def _products(labels: list[list[Any]]) -> list[tuple[str, ...]]:
    found: list[tuple[str, ...]] = [()]
    for own in labels:
        found = [(*head, str(label)) for head in found for label in own]
    return found
