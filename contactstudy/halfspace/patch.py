"""What is reported of a contact patch of a wheel on a rail."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.arrays import BoolArray
from contactstudy.geometry.smooth_touch import SmoothTouch
from contactstudy.halfspace.patch_grid import Bodies, Pressed


@dataclass(frozen=True)
class RailPlace:
    """Place on the rail's surface.

    Attributes
    ----------
    y, z : float
        In track axes from the rail's crown [m].
    arc : float
        Arc length from the crown [m].
    angle : float
        Contact angle: of the normal with the track's vertical [rad], positive where it points
        to the flange's side.
    """

    y: float
    z: float
    arc: float
    angle: float


@dataclass(frozen=True)
class Patch:
    """One contact patch.

    Attributes
    ----------
    region : int
        Region of overlap, from 0; patches of one region feel each other.
    reference : RailPlace
        Centroid of the overlap of the undeformed bodies, weighted with the square of its depth.
    centre : RailPlace
        Centre of pressure.
    deepest : RailPlace
        Where the undeformed bodies overlap most.
    x : float
        Centre of pressure along the rail, from the tape circle's lowest point [m].
    wheel_s : float
        Centre of pressure on the wheel: arc length on its profile [m].
    normal_force : float
        Integral of the pressure [N].
    vertical_force, lateral_force : float
        Its resultant on the wheel along the track's Z and Y [N].
    approach : float
        Largest overlap of the undeformed bodies along the normal [m].
    peak_pressure : float
        [Pa].
    area : float
        Of all cells under pressure [m^2].
    along, across : float
        Semi-axes of the ellipse of Hertz with the same second moments, along the circumference
        and along the profile [m].
    cells : tuple of int
        Cells under pressure along and across.
    """

    region: int
    reference: RailPlace
    centre: RailPlace
    deepest: RailPlace
    x: float
    wheel_s: float
    normal_force: float
    vertical_force: float
    lateral_force: float
    approach: float
    peak_pressure: float
    area: float
    along: float
    across: float
    cells: tuple[int, int]


@dataclass(frozen=True)
class WheelPress:
    """Static press of a wheel on a rail.

    Attributes
    ----------
    travel : float
        Vertical approach of the bodies from first touch [m].
    touch : SmoothTouch
        The first touch.
    patches : tuple of Patch
        By falling normal force.
    """

    travel: float
    touch: SmoothTouch
    patches: tuple[Patch, ...]


def patches_of(bodies: Bodies, region: Pressed, travel: float, number: int) -> list[Patch]:
    """Connected parts of a region under pressure."""
    from scipy import ndimage

    labels, count = ndimage.label(region.pressure > 0, structure=np.ones((3, 3)))
    return [_patch(bodies, region, travel, labels == k + 1, labels, number) for k in range(count)]


def _patch(
    bodies: Bodies,
    region: Pressed,
    travel: float,
    part: BoolArray,
    labels: NDArray[np.int32],
    number: int,
) -> Patch:
    from scipy import ndimage

    grid, facing, love = region.grid, region.facing, region.grid.love
    forces = np.where(part, region.forces, 0.0)
    total = float(forces.sum())
    u = love.width * np.arange(love.shape[0])
    centre_u = float(forces.sum(axis=1) @ u) / total
    centre_s = float(forces.sum(axis=0) @ grid.s) / total
    # Hertz's pressure has <u^2> = a^2/5 under its own weight
    along = np.sqrt(5.0 * float(forces.sum(axis=1) @ (u - centre_u) ** 2) / total)
    across = np.sqrt(5.0 * float(forces.sum(axis=0) @ (grid.s - centre_s) ** 2) / total)
    # every cell that overlaps belongs to the nearest patch of its region
    nearest = ndimage.distance_transform_edt(
        labels == 0, return_distances=False, return_indices=True
    )
    overlap = np.maximum(-facing.gap.reshape(love.shape), 0.0)
    overlap = np.where(labels[tuple(nearest)] == labels[part][0], overlap, 0.0)
    # cells miss the very bottom: look closer along the locus
    row = int(np.argmax(overlap)) % love.shape[1]
    ends = grid.s[max(row - 1, 0)], grid.s[min(row + 1, len(grid.s) - 1)]
    deepest = bodies.geometry.on_locus(np.linspace(*ends, 81), travel)
    bottom = int(np.argmin(deepest.gap))
    weights = forces.ravel() / total
    square = overlap.ravel() ** 2 / float((overlap**2).sum())
    resultant = forces.ravel() @ facing.normal
    return Patch(
        region=number,
        reference=_place(bodies, float(square @ facing.arc)),
        centre=_place(bodies, float(weights @ facing.arc)),
        deepest=_place(bodies, float(deepest.arc[bottom])),
        x=float(weights @ facing.x),
        wheel_s=centre_s,
        normal_force=total,
        vertical_force=float(resultant[1]),
        lateral_force=float(resultant[0]),
        approach=-float(deepest.gap[bottom]),
        peak_pressure=float(region.pressure[part].max()),
        area=float(part.sum() * love.cell_area),
        along=float(along),
        across=float(across),
        cells=(int(part.any(axis=1).sum()), int(part.any(axis=0).sum())),
    )


def _place(bodies: Bodies, arc: float) -> RailPlace:
    rail, track = bodies.geometry.rail, bodies.geometry.pose.track_of_rail
    (y, z), n = track(rail.point(arc)), track(rail.normal(arc))
    return RailPlace(float(y), float(z), arc, float(np.arctan2(-n[0], n[1])))
