"""First look at a static press on few cells: approach, regions, and whether it is possible."""

from collections.abc import Callable

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.halfspace.love import GridTooSmallError, contact_pressure
from contactstudy.halfspace.patch_grid import DEEPEST, LOOK, Bodies, CellGrid, Pressed

REGION_CELLS = 24
"""Cells each way over a region of overlap at the first look."""
# a press on cells of a given side has at least so many across a patch
_FEWEST = 3
# below ten points of the look for overlap nothing is known of a patch's shape [m]
_RESOLVED = 10 * LOOK


def first_press(bodies: Bodies, load: float, join: float) -> tuple[float, list[Pressed]]:
    """Approach of a vertical load [N] within 1 %, and the pressure in every region of overlap.

    The travel is counted from first touch [m]; each region is pressed on 24 by 24 cells; `join` as
    in `contactstudy.halfspace.patches.press_wheel` [m].

    Raises
    ------
    InputError
        If the load is too small to be resolved, or too large for half-spaces.
    NumericalError
        If the load is not met.
    """
    # Hertz's order of magnitude, F = 4/3 E* sqrt(R) d^(3/2) with R about 0.1 m
    start = (load / (4 / 3 * bodies.modulus * np.sqrt(0.1))) ** (2 / 3)
    last: list[CellGrid] = []

    def regions(travel: float) -> list[Pressed]:
        last[:] = bodies.regions(travel, join, REGION_CELLS)
        return [solve(bodies, g, travel) for g in last]

    try:
        return settle(regions, load, start, 1e-2)
    except GridTooSmallError as error:
        wide = max(float(np.ptp(grid.s)) for grid in last)
        wrong = (
            f"is spread over {1e3 * wide:.2g} mm, too little to be resolved: must be larger"
            if wide < _RESOLVED
            else "presses wheel and rail together as far as the end of a profile, or beyond where "
            f"they lie {1e3 * DEEPEST:g} mm apart at first touch: must be smaller for half-spaces"
        )
        raise InputError(f"load = {load:.6g} N: {wrong}") from error


def cell_side(side: float | None, pressed: Pressed) -> float | None:
    """The side asked for, but at least three cells across what is under pressure [m]."""
    if side is None:
        return None
    long, wide = (
        n * size
        for n, size in zip(
            (pressed.pressure.any(axis=1).sum(), pressed.pressure.any(axis=0).sum()),
            (pressed.grid.love.width, pressed.grid.love.breadth),
            strict=True,
        )
    )
    return float(min(side, min(long, wide) / _FEWEST))


def solve(bodies: Bodies, grid: CellGrid, travel: float, guess: Array | None = None) -> Pressed:
    """Pressure on a grid with the wheel lowered from first touch, from a first guess."""
    facing = bodies.facing(travel, grid)
    gap = facing.gap.reshape(grid.love.shape)
    return Pressed(grid, facing, contact_pressure(grid.love, gap, guess))


def settle(
    regions: Callable[[float], list[Pressed]], load: float, travel: float, tolerance: float
) -> tuple[float, list[Pressed]]:
    """Travel that gives the load: secant on F^(2/3), which Hertz's law makes a straight line."""
    low, high = 0.0, np.inf
    before: tuple[float, float] | None = (0.0, -(load ** (2 / 3)))
    for _ in range(60):
        pressed = regions(travel)
        force = sum(p.vertical for p in pressed)
        if abs(force - load) <= tolerance * load:
            return travel, pressed
        low, high = (travel, high) if force < load else (low, travel)
        off = max(force, 0.0) ** (2 / 3) - load ** (2 / 3)
        new = np.inf
        if before is not None and off != before[1]:
            new = travel - off * (travel - before[0]) / (off - before[1])
        before = (travel, off)
        if not low < new < high:
            new = 0.5 * (low + high) if high < np.inf else 2.0 * travel
        travel = float(new)
    raise NumericalError(
        f"press: no approach found for {load:.6g} N (last {travel:.6e} m gave {force:.6g} N)"
    )
