"""A varied key as an axis of a figure or a column of a table: positions, names, unit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.plot.text import exact, label, pretty_unit

if TYPE_CHECKING:
    import xarray as xr


_SHORT = 0.1
"""Lengths of which some are shorter are called in mm up to a metre [m]."""


@dataclass(frozen=True)
class AxisOf:
    """A varied key: where its values stand, and how they are called."""

    title: str
    #: (n,) in the unit of the title; 0, 1, 2 ... of texts.
    at: Array
    #: What each is called, with its unit.
    names: tuple[str, ...]
    numeric: bool = True

    @property
    def logarithmic(self) -> bool:
        """Whether the values span more than a factor of 8, in ratios evener than their steps."""
        if not self.numeric or len(self.at) < 3 or self.at.min() <= 0.0:
            return False
        ordered = np.sort(self.at)
        ratios, steps = np.diff(np.log(ordered)), np.diff(ordered)
        evener = np.std(ratios) / np.mean(ratios) < np.std(steps) / np.mean(steps)
        return bool(evener and ordered[-1] > 8 * ordered[0])


def axis_of(data: xr.Dataset, dim: str) -> AxisOf:
    """The axis of a dimension; a number of cases where several keys vary along it."""
    if dim not in data.coords:
        keys = [str(k) for k in data.coords if data[k].dims == (dim,)]
        if len(keys) != 1:
            numbers = np.arange(1.0, data.sizes[dim] + 1)
            return AxisOf("case", numbers, tuple(f"case {n:.0f}" for n in numbers))
        dim = keys[0]
    values, attrs = data[dim].values, data[dim].attrs
    title = title_of(dim)
    if values.dtype.kind not in "iuf":
        texts = (str(v) for v in values.tolist())
        names = tuple(v if {".", "/"} & set(v) else label(v) for v in texts)  # files as they are
        return AxisOf(title, np.arange(float(len(values))), names, numeric=False)
    unit, factor = _shown(attrs["units"], np.asarray(values, dtype=float))
    told = f"times the {of}" if (of := attrs.get("factor_of")) else pretty_unit(unit)
    at = np.array([float(f"{v:.12g}") for v in np.asarray(values, dtype=float) * factor])
    names = tuple(f"{exact(v, 4)} {told}".strip() for v in at)
    if unit == "m" and at.min() < _SHORT:
        names = tuple(f"{exact(1e3 * v, 3)} mm" if v < 0.9995 else f"{exact(v, 4)} m" for v in at)
    return AxisOf(f"{title} ({told})" if told else title, at, names)


def title_of(key: str) -> str:
    """Dotted key for people: "time step", "elements per bay of point"."""
    parts = [label(part) for part in key.split(".")]
    return f"{parts[2]} of {parts[1]}" if len(parts) == 3 else parts[-1]


def _shown(unit: str, values: Array) -> tuple[str, float]:
    """Unit that people use, and its factor from the SI unit."""
    largest = float(np.abs(values).max())
    if unit == "m/s":
        return "km/h", 3.6
    if unit == "m" and largest < 0.5:
        return ("mm", 1e3) if largest >= 1e-3 else ("µm", 1e6)
    if unit == "s" and largest < 0.5:
        return "µs", 1e6
    if unit == "Pa/m":  # of penalties the power of ten is what is read
        return unit, 1.0
    for factor, prefix in ((1e-9, "G"), (1e-6, "M"), (1e-3, "k")):
        if unit.startswith(("N", "Pa")) and largest * factor >= 1.0:
            return prefix + unit, factor
    return ("", 1.0) if unit == "1" else (unit, 1.0)
