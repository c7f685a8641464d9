"""Where the undeformed bodies overlap, and grids of cells on the wheel's surface there."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.geometry.facing import Facing
from contactstudy.geometry.placement import Geometry
from contactstudy.halfspace.love import LoveGrid

Span = tuple[float, float]

# spacing of the look along the wheel's profile, and the deepest overlap looked for [m]
LOOK, DEEPEST = 0.02e-3, 1e-3


@dataclass(frozen=True, eq=False)
class CellGrid:
    """Equal cells on the wheel's surface: angle about the axle by arc length on the profile.

    Attributes
    ----------
    angle, s : ndarray (nx,), (ny,)
        Centres of the cells [rad], [m].
    love : LoveGrid
        The same unrolled: sides along the circumference and along the profile.
    """

    angle: Array
    s: Array
    love: LoveGrid

    @classmethod
    def spanning(
        cls, bodies: "Bodies", angle: Span, s: Span, cells: int, side: float | None
    ) -> "CellGrid":
        """Cells that fill a range of angles and arc lengths, lower and upper ends [rad], [m].

        As many each way as `cells`, or of the given side [m].
        """
        radius = float(bodies.local_radius(np.array([0.5 * (s[0] + s[1])]))[0])
        long, wide = radius * (angle[1] - angle[0]), s[1] - s[0]
        if side is None:
            shape, sides = (cells, cells), (long / cells, wide / cells)
        else:
            shape = (int(np.ceil(long / side)), int(np.ceil(wide / side)))
            sides = (side, side)
        i, j = (np.arange(n) - 0.5 * (n - 1) for n in shape)
        return cls(
            np.asarray(0.5 * (angle[0] + angle[1]) + i * sides[0] / radius),
            np.asarray(0.5 * (s[0] + s[1]) + j * sides[1]),
            LoveGrid(shape, sides[0], sides[1], bodies.modulus),
        )


@dataclass(frozen=True, eq=False)
class Bodies:
    """A wheel over a rail, from their first touch on; E* of both bodies [Pa]."""

    geometry: Geometry
    modulus: float

    def local_radius(self, s: Array) -> Array:
        """Rolling radius (n,) at arc lengths s [m]."""
        return np.asarray(self.geometry.radius - self.geometry.wheel.point(s)[:, 1])

    def facing(self, travel: float, grid: CellGrid) -> Facing:
        """Gap, normals and feet of the cells' centres, wheel lowered from first touch."""
        s = np.tile(grid.s, len(grid.angle))
        x = self.local_radius(s) * np.sin(np.repeat(grid.angle, len(grid.s)))
        return self.geometry.facing(x, s, travel)

    @cached_property
    def _near(self) -> Array:
        """Arc lengths on the wheel that can come into contact."""
        s0, s1 = self.geometry.wheel.s_range
        s = np.linspace(s0, s1, int((s1 - s0) / (10 * LOOK)) + 2)
        gap = self.geometry.on_locus(s).gap
        close = s[gap < DEEPEST]
        return np.arange(max(close[0] - 10 * LOOK, s0), min(close[-1] + 10 * LOOK, s1), LOOK)

    def regions(self, travel: float, join: float, cells: int) -> list[CellGrid]:
        """Grids over the regions where the wheel, `travel` [m] below touch, overlaps the rail.

        Pressure opens gaps everywhere, so contact lies inside the overlap. Regions closer than
        `join` along the profile share a grid [m] of as many cells each way as `cells`.
        """
        s = self._near
        facing = self.geometry.on_locus(s, travel)
        inside = np.flatnonzero(facing.gap < 0.0)
        if not len(inside):
            return []
        radius = self.local_radius(s)
        centre = np.arcsin(self.geometry.placed.locus(s) / radius)
        # along the circumference the wheel leaves the rail by n_r u^2/(2 r), n_r the radial
        # component of its normal (Meusnier): it overlaps for u^2 < 2 r depth / n_r
        radial = np.abs(self.geometry.wheel.normal(s)[:, 1])
        depth = np.maximum(-facing.gap, 0.0)
        half = np.sqrt(2.0 * depth / (radius * np.maximum(radial, 0.02)))
        grids = []
        for run in np.split(inside, np.flatnonzero(np.diff(s[inside]) > join) + 1):
            lines = slice(run[0], run[-1] + 1)
            low, high = (centre - half)[lines].min(), (centre + half)[lines].max()
            room = 0.05 * (high - low)
            edge = 0.05 * (s[run[-1]] - s[run[0]]) + LOOK
            grids.append(
                CellGrid.spanning(
                    self,
                    (low - room, high + room),
                    (s[run[0]] - edge, s[run[-1]] + edge),
                    cells,
                    None,
                )
            )
        return grids

    def around(
        self,
        grid: CellGrid,
        pressed: BoolArray,
        margin: float,
        cells: int,
        side: float | None,
    ) -> CellGrid:
        """Grid around the cells of another one that are under pressure."""
        i, j = np.flatnonzero(pressed.any(axis=1)), np.flatnonzero(pressed.any(axis=0))
        step = grid.angle[1] - grid.angle[0], grid.s[1] - grid.s[0]
        spans = []
        for line, index, width in ((grid.angle, i, step[0]), (grid.s, j, step[1])):
            low, high = line[index[0]] - 0.5 * width, line[index[-1]] + 0.5 * width
            room = margin * (high - low)
            spans.append((low - room, high + room))
        return CellGrid.spanning(self, spans[0], spans[1], cells, side)


@dataclass(frozen=True, eq=False)
class Pressed:
    """A region at one travel: its cells and their pressure (nx, ny)."""

    grid: CellGrid
    facing: Facing
    pressure: Array

    @property
    def forces(self) -> Array:
        """Normal forces of the cells, (nx, ny) [N]."""
        return np.asarray(self.pressure * self.grid.love.cell_area)

    @property
    def vertical(self) -> float:
        """Vertical resultant [N]."""
        return float(self.forces.ravel() @ self.facing.normal_z)
