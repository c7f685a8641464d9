"""Which variants a study has: full grids, zipped series, samples, and refinements about each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

from contactstudy.study.axes.series import Series

GRID, ZIP, SOBOL, LATIN = "grid", "zip", "sobol", "latin_hypercube"
COMBINATIONS = (GRID, ZIP, SOBOL, LATIN)
SWEEP = "sweep"
"""Group of the results with the variants of ``[sweep]``; of ``[refine]`` it is ``refine.KEY``."""
CASE = "case"
"""Dimension of series that are zipped, and of samples."""


@dataclass(frozen=True)
class Design:
    """Variants on one set of dimensions: a group of the results.

    Attributes
    ----------
    name : str
        Of its group.
    series : mapping
        Dotted key of the study -> its values.
    combine : str
        How the keys are combined; those of a grid are a dimension each.
    refined : str
        Key that is refined, from coarse to fine; a dimension after all others. "" for none.
    expected : float, optional
        Order of convergence that the study states.
    why : str
        Why it is that, or why there is none; "" where the study does not say.
    """

    name: str
    series: Mapping[str, Series]
    combine: str = GRID
    refined: str = ""
    expected: float | None = None
    why: str = ""

    @property
    def swept(self) -> tuple[str, ...]:
        """Keys that are varied, without the refined one."""
        return tuple(key for key in self.series if key != self.refined)

    @property
    def sizes(self) -> dict[str, int]:
        """Dimension -> its length."""
        if self.combine == GRID or len(self.swept) == 0:
            found = {key: len(self.series[key]) for key in self.swept}
        else:
            found = {CASE: len(self.series[self.swept[0]])}
        return found | ({self.refined: len(self.series[self.refined])} if self.refined else {})

    def __len__(self) -> int:
        return math.prod(self.sizes.values())

    def points(self) -> Iterator[tuple[tuple[int, ...], dict[str, Any]]]:
        """Index in the dimensions, and the value of each key, of every variant in order."""
        grid = self.combine == GRID
        for index in product(*(range(n) for n in self.sizes.values())):
            at = dict(zip(self.sizes, index, strict=True))
            yield (
                index,
                {
                    key: made.values[at[key if grid or key == self.refined else CASE]]
                    for key, made in self.series.items()
                },
            )
