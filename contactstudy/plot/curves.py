"""Curves on one pair of axes as plain data; `contactstudy.plot.draw` draws them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

Style = Literal["line", "points", "both", "reference"]


@dataclass(frozen=True)
class Curve:
    """One labelled line or set of points.

    Attributes
    ----------
    x, y : tuple of float
        Equally long; nan leaves a gap.
    style : {"line", "points", "both", "reference"}
        "reference" is the black line that the others are compared with.
    """

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    style: Style = "line"

    def __post_init__(self) -> None:
        if len(self.x) != len(self.y):
            raise ValueError(f"{self.label}: {len(self.x)} abscissae, {len(self.y)} ordinates")


@dataclass(frozen=True)
class Plot:
    """One pair of axes with curves.

    Attributes
    ----------
    caption : str
        What is drawn, and in numbers what is seen.
    x_label, y_label : str
        With units.
    """

    caption: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    x_scale: Literal["linear", "log"] = "linear"
    y_scale: Literal["linear", "log"] = "linear"


def curve(label: str, x: npt.ArrayLike, y: npt.ArrayLike, style: Style = "line") -> Curve:
    """`Curve` from arrays (n,)."""
    return Curve(label, _floats(x), _floats(y), style)


def _floats(values: npt.ArrayLike) -> tuple[float, ...]:
    return tuple(np.asarray(values, dtype=float).ravel().tolist())
