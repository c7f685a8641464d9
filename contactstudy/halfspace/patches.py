"""Static press of a wheel on a rail in any position, both elastic half-spaces, all patches.

The half-space holds as long as a patch is small against the radii of curvature. Each region of
overlap is solved on the wheel's surface, unrolled. Pressure acts along the rail's local normal.
All cells of one region feel each other; different regions do not: a force F would lift the
surface at a distance r by F/(pi E* r), 2 um for 8 kN and 10 mm, if the rail's head were a
half-space that far.
"""

from contactstudy.arrays import Array
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.placement import Geometry
from contactstudy.halfspace.first_press import REGION_CELLS, cell_side, first_press, settle, solve
from contactstudy.halfspace.love import GridTooSmallError
from contactstudy.halfspace.patch import WheelPress, patches_of
from contactstudy.halfspace.patch_grid import Bodies, Pressed
from contactstudy.validation import positive, raise_if

JOIN = 4e-3
"""Regions of overlap closer than this along the profile are solved together [m]."""


def press_wheel(
    geometry: Geometry,
    load: float,
    modulus: float,
    *,
    cells: int = 64,
    side: float | None = None,
    join: float = JOIN,
    tolerance: float = 1e-6,
) -> WheelPress:
    """Press a wheel on a rail with a vertical load, frictionless, both half-spaces.

    A coarse grid over each region of overlap finds the approach, a fine one around the pressure
    found there answers; gaps are computed anew at every approach.

    Parameters
    ----------
    load : float
        Vertical resultant of all patches [N], met within the relative tolerance.
    modulus : float
        E* of both bodies [Pa].
    cells : int
        Cells across each region under pressure, and along it.
    side : float, optional
        Side of the cells in place of their number [m]; a patch has three cells across at least.
    join : float
        Regions of overlap closer than this along the profile are solved together [m].

    Raises
    ------
    InputError
        If an argument is impossible, the bodies do not touch properly, or half-spaces
        cannot carry the load (`first_press`).
    NumericalError
        If the load is not met.
    """
    raise_if(
        positive("vertical load", load, "N")
        + positive("contact modulus", modulus, "Pa")
        + ([] if cells >= 16 else [f"cells = {cells}: must be 16 or more"])
        + ([] if side is None else positive("side of the cells", side, "m"))
    )
    bodies = Bodies(geometry, modulus)
    travel, pressed = first_press(bodies, load, join)
    for margin in (0.1, 0.2, 0.4):
        grids = [
            bodies.around(p.grid, p.pressure > 0, margin, cells, cell_side(side, p))
            for p in pressed
        ]
        # each solution is the first guess of the next
        last: list[Array | None] = [None] * len(grids)

        def fine(d: float, grids=grids, last=last) -> list[Pressed]:  # type: ignore[no-untyped-def]
            found = [solve(bodies, g, d, p) for g, p in zip(grids, last, strict=True)]
            last[:] = [f.pressure for f in found]
            return found

        try:
            travel, pressed = settle(fine, load, travel, tolerance)
        except GridTooSmallError:
            continue
        if len(bodies.regions(travel, join, REGION_CELLS)) == len(grids):
            break
        pressed = [solve(bodies, g, travel) for g in bodies.regions(travel, join, REGION_CELLS)]
    else:
        raise NumericalError(f"press of {load:.6g} N: the patches outgrow their grids")
    patches = [p for k, region in enumerate(pressed) for p in patches_of(bodies, region, travel, k)]
    return WheelPress(travel, geometry.touch, tuple(sorted(patches, key=lambda p: -p.normal_force)))
