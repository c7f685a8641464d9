"""Elastic half-spaces under uniform pressure on rectangles: influence and frictionless contact.

A. E. H. Love (1929), as in K. L. Johnson, Contact Mechanics (1985), eq. (3.25). With the modulus
E* of both bodies the influence is the approach of their surfaces, so different materials need
nothing else.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.validation import positive, raise_if


def love_influence(x: Array, y: Array, width: float, breadth: float, modulus: float) -> Array:
    """Approach [m/Pa] of two half-spaces under unit pressure on one rectangle.

    With the corners of the rectangle seen from the point,
    ``pi E* u = f(x+a, y+b) - f(x+a, y-b) - f(x-a, y+b) + f(x-a, y-b)`` and
    ``f(x, y) = x asinh(y/|x|) + y asinh(x/|y|)``, the double integral of 1/r.

    The places x, y (...) are relative to the rectangle's centre, its sides `width` 2a along x and
    `breadth` 2b along y [m]; the modulus E* [Pa] of one body gives its own displacement.
    """

    def f(x: Array, y: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            value = x * np.arcsinh(y / np.abs(x)), y * np.arcsinh(x / np.abs(y))
        # x asinh(y/|x|) vanishes with x
        return np.where(x == 0, 0.0, value[0]) + np.where(y == 0, 0.0, value[1])

    a, b = 0.5 * width, 0.5 * breadth
    corners = f(x + a, y + b) - f(x + a, y - b) - f(x - a, y + b) + f(x - a, y - b)
    return np.asarray(corners / (np.pi * modulus))


class GridTooSmallError(InputError):
    """The contact reaches the border of its grid: the grid is too small."""


@dataclass(frozen=True)
class LoveGrid:
    """Equal rectangles that fill a larger one; products with the influence matrix by FFT.

    The shape counts cells along x and along y; their sides are in m, the modulus E* in Pa.
    """

    shape: tuple[int, int]
    width: float
    breadth: float
    modulus: float

    def __post_init__(self) -> None:
        raise_if(
            positive("cell width", self.width, "m")
            + positive("cell breadth", self.breadth, "m")
            + positive("contact modulus", self.modulus, "Pa")
        )

    @property
    def cell_area(self) -> float:
        """[m^2]."""
        return self.width * self.breadth

    @cached_property
    def _padded(self) -> tuple[int, int]:
        from scipy import fft

        nx, ny = self.shape
        return fft.next_fast_len(2 * nx - 1, real=True), fft.next_fast_len(2 * ny - 1, real=True)

    @cached_property
    def _kernel(self) -> NDArray[np.complex128]:
        from scipy import fft

        (nx, ny), (mx, my) = self.shape, self._padded
        kernel = np.zeros((mx, my))
        i, j = np.arange(-nx + 1, nx), np.arange(-ny + 1, ny)
        x, y = np.meshgrid(i * self.width, j * self.breadth, indexing="ij")
        values = love_influence(x, y, self.width, self.breadth, self.modulus)
        # offset i is stored at i mod mx, so that the cyclic product is the plain one
        kernel[np.ix_(i % mx, j % my)] = values
        return np.asarray(fft.rfft2(kernel))

    def approach(self, pressure: Array) -> Array:
        """Approach of the surfaces (nx, ny) [m] under pressures (nx, ny) [Pa]."""
        from scipy import fft

        nx, ny = self.shape
        product = fft.rfft2(pressure, s=self._padded) * self._kernel
        return np.asarray(fft.irfft2(product, s=self._padded)[:nx, :ny])


def contact_pressure(
    grid: LoveGrid,
    gap: Array,
    start: Array | None = None,
    *,
    tolerance: float = 1e-8,
    max_iterations: int = 2000,
) -> Array:
    """Pressure (nx, ny) [Pa] of frictionless unilateral contact of two half-spaces.

    ``w = gap + K p, p >= 0, w >= 0, p w = 0`` by projected conjugate gradients: I. A. Polonsky, L.
    M. Keer, Wear 231 (1999) 206-219, with the approach given in place of the load.

    The gap (nx, ny) of the undeformed surfaces is negative where they overlap [m]; `start` is a
    first guess of the pressure. The tolerance is the gap left in the contact, relative to the
    deepest overlap.

    Raises
    ------
    GridTooSmallError
        If contact reaches the border of the grid.
    NumericalError
        If the iteration does not converge.
    """
    if gap.shape != grid.shape:
        raise InputError(f"contact pressure: gap {gap.shape} on a grid of {grid.shape} cells")
    depth = float(-gap.min())
    if depth <= 0.0:
        return np.zeros(grid.shape)
    # a pressure with the overlap's shape that just lifts as much as the deepest overlap
    lifting = np.where(gap < 0, -gap / depth, 0.0)
    lifting *= depth / float(grid.approach(lifting).max())
    p = lifting if start is None else np.maximum(start, 0.0)
    direction, last, conjugate = np.zeros(grid.shape), 1.0, 0.0
    for _ in range(max_iterations):
        if not p.any():
            # a step too long has lifted everything off: begin again
            p, conjugate = lifting, 0.0
        residual = grid.approach(p) + gap
        active = p > 0
        overlap = ~active & (residual < -tolerance * depth)
        worst = float(np.abs(residual[active]).max(initial=0.0))
        if worst <= tolerance * depth and not overlap.any():
            _inside(p)
            return np.asarray(p)
        size = float((residual[active] ** 2).sum())
        direction = np.where(active, residual + conjugate * size / last * direction, 0.0)
        image = grid.approach(direction)
        slope = float((direction * image)[active].sum())
        length = float((residual * direction)[active].sum()) / slope if slope > 0 else 0.0
        p = np.maximum(p - length * direction, 0.0)
        # cells that overlap without pressure come in along the steepest descent
        opening = (p == 0) & (residual < 0)
        conjugate = 0.0 if (opening & ~active).any() else 1.0
        p[opening] -= abs(length) * residual[opening]
        last = size if size > 0 else 1.0
    raise NumericalError(
        f"contact pressure: {worst:.3e} m left in the contact after {max_iterations} iterations "
        f"(deepest overlap {depth:.3e} m)"
    )


def _inside(p: Array) -> None:
    border = np.concatenate([p[0], p[-1], p[:, 0], p[:, -1]])
    if border.any():
        raise GridTooSmallError("contact pressure: the contact reaches the border of the grid")
