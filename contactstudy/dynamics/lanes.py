"""Several runs of one system side by side, each in a lane of arrays (n, lanes).

There are 8 lanes, which one instruction of the processor handles together, or a single one. A
lane's numbers depend neither on the other lanes nor on how many there are: every sum is taken in
the order in which it is written.
"""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.compiled import compiled
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.windows import Windows, windows

LANES = 8
"""Lanes of several runs; `subtract_in_lanes` is written out for this number."""


class LaneSystem(NamedTuple):
    """M, C, K and S = (I + L) D (I + L)^T by rows, all divided by D (n,).

    With D^-1 S = (I + D^-1 L D) (I + L^T) nothing is left to divide: `lower` is D^-1 L D, `upper`
    L^T, and matrices and loads come with their rows divided by D, `inverse` being 1/D.
    """

    mass: Windows
    damping: Windows
    stiffness: Windows
    lower: Windows
    upper: Windows
    inverse: Array


def lane_system(system: LinearSystem, factor: Factor) -> LaneSystem:
    """The matrices of a system and the factor of its S, as the compiled steps take them."""
    root = factor.band[0]
    inverse = 1.0 / root**2
    # column j of Cholesky's factor holds L_ij sqrt(d_j)
    rows, columns = np.nonzero(factor.band[1:])
    below = sp.csr_array(
        (factor.band[1 + rows, columns] / root[columns], (columns + rows + 1, columns)),
        shape=(factor.n, factor.n),
    )
    scaled = sp.diags_array(inverse)
    return LaneSystem(
        windows(scaled @ system.mass),
        windows(scaled @ system.damping),
        windows(scaled @ system.stiffness),
        windows(scaled @ below @ sp.diags_array(root**2)),
        windows(below.T),
        inverse,
    )


@compiled
def subtract_in_lanes(matrix: Windows, x: Array, y: Array, upwards: bool) -> None:
    """y -= A x in each lane of x and y (n, lanes), row by row from the first or from the last.

    With y for x it solves (I + A) y' = y: upwards where A is an upper triangle, else a lower one.
    """
    first, width, begin, values = matrix
    n = y.shape[0]
    # unsigned indices: signed ones would be asked each time whether they count from the end
    if y.shape[1] == 1:
        x_one, y_one = x.reshape(-1), y.reshape(-1)
        for count in range(n):
            row = np.uint64(n - 1 - count if upwards else count)
            at, j = np.uint64(begin[row]), np.uint64(first[row])
            total = y_one[row]
            for k in range(np.uint64(width[row])):
                total -= values[at + k] * x_one[j + k]
            y_one[row] = total
        return
    for count in range(n):
        row = np.uint64(n - 1 - count if upwards else count)
        at, j = np.uint64(begin[row]), np.uint64(first[row])
        y0, y1, y2, y3 = y[row, 0], y[row, 1], y[row, 2], y[row, 3]
        y4, y5, y6, y7 = y[row, 4], y[row, 5], y[row, 6], y[row, 7]
        for k in range(np.uint64(width[row])):
            value = values[at + k]
            y0 -= value * x[j + k, 0]
            y1 -= value * x[j + k, 1]
            y2 -= value * x[j + k, 2]
            y3 -= value * x[j + k, 3]
            y4 -= value * x[j + k, 4]
            y5 -= value * x[j + k, 5]
            y6 -= value * x[j + k, 6]
            y7 -= value * x[j + k, 7]
        y[row, 0], y[row, 1], y[row, 2], y[row, 3] = y0, y1, y2, y3
        y[row, 4], y[row, 5], y[row, 6], y[row, 7] = y4, y5, y6, y7
