"""What a refinement says of each run, and of each point of the other keys."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.refinement import AGREEMENT
from contactstudy.plot.text import label
from contactstudy.study.axes.axis import axis_of
from contactstudy.study.axes.refinement import OUTCOMES, VERDICT
from contactstudy.study.axes.shown import RUN, Shown

OF_ORDER = 3
"""Values that an order takes."""


@dataclass(frozen=True)
class Line:
    """One refinement: values from coarse to fine, and what `compare.refinement` says of them.

    Limit and uncertainty are in the unit of the values.
    """

    name: str
    values: Array
    order: float
    order_error: float
    limit: float
    uncertainty: float
    index: float
    verdict: str

    def agrees(self, expected: float) -> bool:
        """Whether the observed order is the expected one, but for what a verdict allows."""
        return bool(abs(self.order - expected) <= AGREEMENT * expected)

    @property
    def order_text(self) -> str:
        """Observed order with its standard error."""
        if not np.isfinite(self.order):
            return "no order"
        error = f" ± {self.order_error:.2f}" if np.isfinite(self.order_error) else ""
        return f"order {self.order:.2f}{error}"


def convergences(quantity: Shown) -> list[Line]:
    """Of each run, and each point of the other keys, what changes along the refined one.

    None of two values: their one difference shows no order.
    """
    refined = quantity.data.attrs["refined"]
    if quantity.data.sizes[refined] < OF_ORDER:
        return []
    others = [str(d) for d in quantity.values.dims if d != refined]
    names = [
        [label(r) for r in quantity.runs] if d == RUN else axis_of(quantity.data, d).names
        for d in others
    ]
    values = quantity.values.transpose(*others, refined).values
    told = {outcome: _like(quantity, outcome, others) for outcome in OUTCOMES}
    verdicts = _like(quantity, VERDICT, others)
    found = []
    for index in product(*(range(len(own)) for own in names)):
        if verdict := str(verdicts[index]):
            name = ", ".join(own[k] for own, k in zip(names, index, strict=True))
            outcomes = {o: float(array[index]) for o, array in told.items()}
            found.append(Line(name, values[index], **outcomes, verdict=verdict))
    return found


def _like(quantity: Shown, outcome: str, dims: list[str]) -> Array:
    found = quantity.outcome(outcome)
    if RUN in dims:
        found = found.sel({RUN: quantity.runs})
    return np.asarray(found.transpose(*dims).values)
