"""Which way up and round a profile is: where its flange or its crown lies."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from contactstudy.arrays import Array

TAPE = 0.07
"""Distance of the tape circle from the flange back [m] (EN 13715)."""
_FLANGE = 8e-3  # depth [m] that no tread has beside its flange
_BULGE = 2e-3  # height [m] of a head's middle over its sides


@dataclass(frozen=True)
class Found:
    """What the shape says: factors of y and z to this program's axes (0: it does not say)."""

    y: Literal[-1, 0, 1]
    z: Literal[-1, 0, 1]
    told: str

    def faults(self) -> list[str]:
        """Axes that are not as declared: y to the field side, z up."""
        found = []
        if self.z < 0:
            found.append(f"z points down: {self.told}")
        if self.y < 0:
            found.append(f"y points away from the field side: {self.told}")
        return found


def shape_of_wheel(points: Array) -> Found:
    """The flange of a wheel's points (n, 2) = (y, z) [m]: it hangs down, at y < 0.

    It is what lies farthest from the tread, the points' median height.
    """
    off = points[:, 1] - np.median(points[:, 1])
    k = int(np.argmax(np.abs(off)))
    if abs(off[k]) < _FLANGE:
        return Found(0, 0, "no flange")
    y = points[k, 0] - 0.5 * (points[:, 0].min() + points[:, 0].max())
    way = "hangs down" if off[k] < 0 else "stands up"
    side = "the flange's side, y < 0" if y < 0 else "the field side, y > 0"
    told = f"the flange {way} by {1e3 * abs(off[k]):.1f} mm on {side}"
    return Found(1 if y < 0 else -1, 1 if off[k] < 0 else -1, told)


def shape_of_rail(points: Array) -> Found:
    """The crown of a rail's points (n, 2) = (y, z) [m], which its sides hang down from."""
    middle = 0.5 * (points[:, 0].min() + points[:, 0].max())
    off = points[:, 1] - points[np.argmin(np.abs(points[:, 0] - middle)), 1]
    k = int(np.argmax(np.abs(off)))
    if abs(off[k]) < _BULGE:
        return Found(0, 0, "no sides of a head")
    way = "hang down" if off[k] < 0 else "stand up"
    return Found(
        0, 1 if off[k] < 0 else -1, f"the head's sides {way} by {1e3 * abs(off[k]):.1f} mm"
    )
