"""The depth that is missing on a wheel's tread, read from a CSV file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.csv_rows import read_rows
from contactstudy.exceptions import InputError
from contactstudy.irregularity.depth_doubts import impossible
from contactstudy.irregularity.flats import LocalDefect, TreadLines
from contactstudy.irregularity.measured import Interpolation
from contactstudy.irregularity.table import read_numbers
from contactstudy.validation import File, Key, Naming, raise_if

_ALONG = {"angle": np.pi / 180.0, "s": 1e-3}  # to rad, to m


@dataclass(frozen=True, eq=False)
class DepthTable:
    """Depth (n, m) in m on a grid of places (n,) round the wheel and y (m,) in m.

    Places are angles in rad, or distances round the wheel in m where `angles` is False. Between
    them a cubic spline, of lower degree where there are fewer than four lines; or linear.
    """

    places: Array
    y: Array
    depths: Array
    angles: bool = True
    interpolation: Interpolation = "cubic"

    def distances(self, radius: float) -> Array:
        """The places as distances round a wheel of that radius, (n,), both in m."""
        return self.places * radius if self.angles else self.places

    @property
    def mirrored(self) -> bool:
        """Whether it is the same at y and -y."""
        return np.allclose(self.y, -self.y[::-1], atol=1e-9) and np.allclose(
            self.depths, self.depths[:, ::-1], atol=1e-9
        )

    @cached_property
    def _spline(self) -> Callable[[Array, Array], Array]:
        from scipy.interpolate import RectBivariateSpline

        degree = 3 if self.interpolation == "cubic" else 1
        kx, ky = (min(degree, n - 1) for n in self.depths.shape)
        return RectBivariateSpline(self.places, self.y, self.depths, kx=kx, ky=ky).ev

    def __call__(self, s: Array, y: Array, radius: float) -> Array:
        """Depth (k, l) at distances s (k,) round the wheel and y (l,), all in m; 0 outside."""
        place = s[:, None] / (radius if self.angles else 1.0)
        on = (place >= self.places[0]) & (place <= self.places[-1])
        on = on & (y >= self.y[0]) & (y <= self.y[-1])
        return np.where(on, self._spline(*np.broadcast_arrays(place, y)), 0.0)


def read_depth_map(path: Path, interpolation: Interpolation = "cubic") -> DepthTable:
    """Read a file with columns angle [deg] or s [mm], y [mm] and depth [mm], a row a place.

    Raises
    ------
    InputError
        For a file that cannot be read, missing columns, cells that are no finite numbers, depths
        that no wheel has (`contactstudy.irregularity.depth_doubts`), or places that are not a full
        grid of two or more by two or more.
    """
    along = "s" if "s" in (name.strip() for name in read_rows(path)[0][1]) else "angle"
    table, lines, problems = read_numbers(path, (along, "y", "depth"))
    raise_if(problems or impossible(path, table[:, 2], lines))
    places, i = np.unique(table[:, 0], return_inverse=True)
    y, j = np.unique(table[:, 1], return_inverse=True)
    cells = i * len(y) + j
    full = len(places) > 1 and len(y) > 1 and len(table) == len(places) * len(y)
    if not full or len(np.unique(cells)) != len(table):
        raise InputError(
            f"{path}: {len(table)} rows with {len(places)} different values of {along} and {len(y)}"
            " of y; allowed: a full grid, each place once, at least two by two"
        )
    depths = np.empty(len(table))
    depths[cells] = 1e-3 * table[:, 2]
    grid = depths.reshape(len(places), len(y))
    return DepthTable(places * _ALONG[along], 1e-3 * y, grid, along == "angle", interpolation)


@dataclass(frozen=True)
class DepthMap(LocalDefect):
    """A measured or computed shape: missing depth over angle and y."""

    file: Annotated[
        str, File(), Key("wheel_defect_file"),
        "CSV file with columns angle (deg; the larger meets the rail later) or s (mm round the "
        "wheel), y (mm from the tape circle) and depth (mm), a full grid",
    ] = ""  # fmt: skip
    interpolation: Annotated[
        Interpolation, Key("wheel_defect_interpolation"), "between the places of the map"
    ] = "cubic"

    def problems(self, key: Naming) -> list[str]:
        """No file."""
        if self.file:
            return []
        return [f"{key('file')}: is missing; a depth map needs a CSV file"]

    @cached_property
    def read(self) -> DepthTable:
        """The map; ``InputError`` if the file is not one."""
        return read_depth_map(Path(self.file), self.interpolation)

    def half_length(self, radius: float) -> float:
        """See `LocalDefect`."""
        return float(np.abs(self.read.distances(radius)).max()) if self.file else 0.0

    def depth(self, s: Array, radius: float, lines: TreadLines) -> Array:
        """See `LocalDefect`; none outside the map."""
        return self.read(s, lines.y, radius)
