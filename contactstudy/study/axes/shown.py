"""What figures and tables show of what was measured: one array a quantity and design."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.study.axes.design import CASE
from contactstudy.study.kind import Quantity, find_kind
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr

RUN = "run"


@dataclass(frozen=True)
class Shown:
    """One quantity of one design.

    Attributes
    ----------
    values : xarray.DataArray
        Dimensions are those of the design and at most `RUN`, last; nan for what failed.
    title : str
        With the unit.
    """

    name: str
    data: xr.Dataset
    values: xr.DataArray
    title: str
    quantity: Quantity
    labels: dict[str, str]
    #: Run with which the others are compared.
    reference: str | None = None

    @property
    def file(self) -> str:
        """Name of its figure."""
        return f"{self.data.attrs['design']}_{self.name}".replace(".", "_")

    @property
    def quantity_and_unit(self) -> tuple[str, str]:
        """The title's two parts; "" for no unit."""
        if not self.title.endswith(")"):
            return self.title, ""
        what, _, unit = self.title[:-1].rpartition(" (")
        return what, unit

    @property
    def axes(self) -> list[str]:
        """Dimensions that vary."""
        return [str(d) for d in self.values.dims if d != RUN]

    @property
    def runs(self) -> list[str]:
        """Runs with a value; one without name where there are none."""
        return self.values[RUN].values.tolist() if RUN in self.values.dims else [""]

    def of_run(self, run: str) -> xr.DataArray:
        """Values of one run."""
        return self.values.sel({RUN: run}) if RUN in self.values.dims else self.values

    def outcome(self, name: str) -> xr.DataArray:
        """What `contactstudy.study.axes.refinement` says of the same: "order", "limit" ..."""
        found = self.data[f"{self.quantity.variable}_{name}"].sel(self.labels)
        return found * self.quantity.factor if name in ("limit", "uncertainty") else found


def shown(results: StudyResults) -> Iterator[Shown]:
    """All quantities of all designs that have any value."""
    chosen = find_kind(results.kind).shown
    for data in results.designs.values():
        dims = data["variant"].dims
        for quantity in chosen or _all(data):
            if quantity.variable not in data:
                continue
            values, labels = data[quantity.variable], dict[str, str]()
            for dim, wanted in quantity.labels.items():
                found = [w for w in wanted if w in values[dim].values.tolist()]
                if found:
                    values, labels[dim] = values.sel({dim: found[0]}, drop=True), found[0]
            others = [str(d) for d in values.dims if d not in dims and d != RUN]
            if others or len(labels) < len(quantity.labels):
                continue
            values = values.transpose(..., RUN, missing_dims="ignore") * quantity.factor
            if RUN in values.dims:
                there = values.notnull().any([d for d in values.dims if d != RUN]).values
                values = values.isel({RUN: np.flatnonzero(there)})
            if values.size and bool(values.notnull().any()):
                title = quantity.title.format(**labels)
                name = "_".join([quantity.variable, *labels.values()])
                yield Shown(name, data, values, title, quantity, labels, results.reference)


def _all(data: xr.Dataset) -> list[Quantity]:
    dims = set(data["variant"].dims) | {RUN}
    return [
        Quantity(str(name), f"{v.attrs['long_name']} ({v.attrs['units']})".replace(" (1)", ""))
        for name, v in data.data_vars.items()
        if v.dtype.kind == "f" and set(v.dims) <= dims and set(data["variant"].dims) <= set(v.dims)
    ]


def drawn(data: xr.Dataset, dim: str) -> bool:
    """Whether a dimension is a sample: cases that were drawn, or seeds."""
    return (dim == CASE and data.attrs["combine"] != "zip") or dim.endswith(".seed")
