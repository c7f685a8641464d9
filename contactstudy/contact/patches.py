"""Static press of a wheel on a rail in any position, both elastic half-spaces, all patches.

The half-space holds as long as a patch is small against the radii of curvature. Each region of
overlap is solved on the wheel's surface, unrolled. Pressure acts along the rail's local normal.
All cells of one region feel each other; different regions do not: a force F would lift the
surface at a distance r by F/(pi E* r), 2 um for 8 kN and 10 mm, if the rail's head were a
half-space that far.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from contactstudy.contact.love import GridTooSmallError, contact_pressure
from contactstudy.contact.patch import WheelPress, patches_of
from contactstudy.contact.patch_grid import Bodies, CellGrid, Pressed
from contactstudy.contact.pose import PlacedWheel
from contactstudy.contact.smooth_touch import smooth_touch
from contactstudy.exceptions import NumericalError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.validation import positive, raise_if

Array = NDArray[np.float64]


def press_wheel(
    wheel: PlacedWheel,
    rail: ProfileCurve,
    load: float,
    modulus: float,
    *,
    cells: int = 64,
    side: float | None = None,
    join: float = 4e-3,
    tolerance: float = 1e-6,
) -> WheelPress:
    """Press a wheel on a rail with a vertical load, frictionless, both half-spaces.

    A coarse grid over each region of overlap finds the approach, a fine one around the pressure
    found there answers; gaps are computed anew at every approach.

    Parameters
    ----------
    wheel : PlacedWheel
    rail : ProfileCurve
    load : float
        Vertical resultant of all patches [N].
    modulus : float
        E* of both bodies [Pa].
    cells : int
        Cells across each region under pressure, and along it.
    side : float, optional
        Side of the cells in place of their number [m].
    join : float
        Regions of overlap closer than this along the profile are solved together [m].
    tolerance : float
        Of the load, relative.

    Returns
    -------
    WheelPress

    Raises
    ------
    InputError
        If an argument is impossible or the bodies do not touch properly.
    NumericalError
        If the load is not met.
    """
    raise_if(
        positive("vertical load", load, "N")
        + positive("contact modulus", modulus, "Pa")
        + ([] if cells >= 16 else [f"cells = {cells}: must be 16 or more"])
        + ([] if side is None else positive("side of the cells", side, "m"))
    )
    bodies = Bodies(wheel, rail, smooth_touch(wheel, rail), modulus)
    # Hertz's order of magnitude, F = 4/3 E* sqrt(R) d^(3/2) with R about 0.1 m
    start = (load / (4 / 3 * modulus * np.sqrt(0.1))) ** (2 / 3)
    travel, pressed = _settle(
        lambda d: [_solve(bodies, g, d) for g in bodies.regions(d, join, 24)], load, start, 1e-2
    )
    for margin in (0.1, 0.2, 0.4):
        grids = [bodies.around(p.grid, p.pressure > 0, margin, cells, side) for p in pressed]
        # each solution is the first guess of the next
        last: list[Array | None] = [None] * len(grids)

        def fine(d: float, grids=grids, last=last) -> list[Pressed]:  # type: ignore[no-untyped-def]
            found = [_solve(bodies, g, d, p) for g, p in zip(grids, last, strict=True)]
            last[:] = [f.pressure for f in found]
            return found

        try:
            travel, pressed = _settle(fine, load, travel, tolerance)
        except GridTooSmallError:
            continue
        if len(bodies.regions(travel, join, 24)) == len(grids):
            break
        pressed = [_solve(bodies, g, travel) for g in bodies.regions(travel, join, 24)]
    else:
        raise NumericalError(f"press of {load:.6g} N: the patches outgrow their grids")
    patches = [p for k, region in enumerate(pressed) for p in patches_of(bodies, region, travel, k)]
    return WheelPress(travel, bodies.touch, tuple(sorted(patches, key=lambda p: -p.normal_force)))


def _solve(bodies: Bodies, grid: CellGrid, travel: float, guess: Array | None = None) -> Pressed:
    facing = bodies.facing(travel, grid)
    gap = facing.gap.reshape(grid.love.shape)
    return Pressed(grid, facing, contact_pressure(grid.love, gap, guess))


def _settle(
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
