"""Manchester contact benchmark, case A-2.2: one wheelset, shifted and yawed, at 21 positions.

P. Shackleton, S. Iwnicki, Vehicle System Dynamics 46 (2008) 129-149. Rolls and pitch rates of the
wheelset at each position are those of the public example of the open-source program CONTACT
(github.com/eve70a/CONTACT, examples/mbench_a22_left.inp, after which each wheel carries 10 kN
vertically, the total of normal and friction forces).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.wheelset import Side, Wheelset, WheelsetDimensions
from contactstudy.halfspace.patch import Patch
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.friction import vertical_friction

RAIL = "UIC60-Manchester"

INCLINATION = math.atan(1 / 40)
GAUGE, GAUGE_DEPTH = 1.435, 0.014
FLANGE_BACKS, TAPE_LINE, RADIUS = 1.360, 0.070, 0.460
LOAD, SHEAR_MODULUS, POISSON, FRICTION, SPEED = 10e3, 82e9, 0.28, 0.30, 2.0
MODULUS = SHEAR_MODULUS / (1.0 - POISSON)
"""E* of two equal bodies: 1/E* = 2 (1 - nu^2)/E, E = 2 G (1 + nu)."""
ORIGIN = 7.4917e-3
"""Y of the origin of the benchmark's rail coordinates, from the crown [m]."""

# wheelset's roll [rad] and pitch rate [rad/s] at the shifts 0, 0.5, ... 10 mm; x forwards, y to
# the right, z down
ROLL = (
    0.0, -2.304e-5, -5.049e-5, -8.103e-5, -1.128e-4, -1.457e-4, -1.803e-4, -2.168e-4, -2.557e-4,
    -2.977e-4, -3.554e-4, -4.777e-4, -6.272e-4, -4.376e-3, -6.393e-3, -7.642e-3, -8.606e-3,
    -9.408e-3, -1.010113e-2, -1.071386e-2, -1.126431e-2,
)  # fmt: skip
PITCH_RATE = (
    4.3481181, 4.3474134, 4.3465752, 4.346244, 4.3459197, 4.3455627, 4.3451503, 4.3446688,
    4.344093, 4.3433715, 4.3353637, 4.3318864, 4.3293718, 4.2748834, 4.2635629, 4.2575747,
    4.2534857, 4.2503245, 4.2477561, 4.2455665, 4.2436375,
)  # fmt: skip


@dataclass(frozen=True)
class ManchesterRow:
    """One contact patch of one wheel at one position of the wheelset.

    Attributes
    ----------
    case : int
        1 to 21.
    shift, yaw : float
        Of the wheelset: to the right [m], clockwise seen from above [rad].
    patch : int
        1 for the largest normal force.
    y, z : float
        Contact position `found.reference` in the benchmark's rail coordinates: y to the right for
        both rails, z down, origin on top of the rail [m].
    """

    case: int
    wheel: Side
    shift: float
    yaw: float
    patch: int
    y: float
    z: float
    found: Patch


@lru_cache(maxsize=1)
def benchmark_wheelset() -> Wheelset:
    """The benchmark's wheelset on its track."""
    dimensions = WheelsetDimensions(INCLINATION, GAUGE, GAUGE_DEPTH, FLANGE_BACKS, TAPE_LINE)
    return Wheelset.of(dimensions, wheel_curve("S1002"), rail_curve(RAIL), RADIUS)


def benchmark_pose(case: int, wheel: Side) -> Pose:
    """Position of one wheel on its rail, case 1 to 21, in this rail's axes, Y to the field side."""
    shift, yaw = 0.5e-3 * (case - 1), 1.2e-3 * (case - 1)
    return benchmark_wheelset().pose(wheel, shift, yaw, ROLL[case - 1])


def benchmark_patches(case: int, wheel: Side, side: float = 0.2e-3) -> tuple[Patch, ...]:
    """Contact patches of one wheel at one position.

    Parameters
    ----------
    side : float
        Side of the cells [m].
    """
    pose = benchmark_pose(case, wheel)
    bodies = Geometry(rail_curve(RAIL), wheel_curve("S1002"), RADIUS, pose)
    pitch = PITCH_RATE[case - 1]
    load = LOAD
    # sum of normal and friction forces: a few steps of a fixed point, the share of friction, which
    # enters this balance only, hardly depends on the load
    for _ in range(8):
        press = press_wheel(bodies, load, MODULUS, side=side)
        lift = [
            vertical_friction(p, bodies.placed, SPEED, pitch, FRICTION, SHEAR_MODULUS)
            for p in press.patches
        ]
        total = sum(p.vertical_force for p in press.patches) + sum(lift)
        if abs(total - LOAD) < 1e-4 * LOAD:
            break
        load *= LOAD / total
    return press.patches


def manchester_rows(
    cases: tuple[int, ...] = tuple(range(1, 22)),
    wheels: tuple[Side, ...] = ("left", "right"),
    side: float = 0.2e-3,
) -> list[ManchesterRow]:
    """All contact patches of both wheels at the benchmark's positions.

    Parameters
    ----------
    cases : tuple of int
        Positions, 1 to 21: shift 0 to 10 mm by 0.5 mm, yaw 0 to 24 mrad by 1.2 mrad.
    side : float
        Side of the cells [m]; 0.2 mm are CONTACT's, whose contact area counts whole cells.

    Returns
    -------
    list of ManchesterRow
        By wheel, position and falling normal force.
    """
    rows = []
    for wheel in wheels:
        sign = 1.0 if wheel == "right" else -1.0
        # the highest point of the inclined crown, above its own top
        top = (1.0 / math.cos(INCLINATION) - 1.0) * float(rail_curve(RAIL).curvature(0.0)) ** -1
        for case in cases:
            for number, p in enumerate(benchmark_patches(case, wheel, side), start=1):
                rows.append(
                    ManchesterRow(
                        case=case,
                        wheel=wheel,
                        shift=0.5e-3 * (case - 1),
                        yaw=1.2e-3 * (case - 1),
                        patch=number,
                        y=sign * (p.reference.y - ORIGIN),
                        z=top - p.reference.z,
                        found=p,
                    )
                )
    return rows
