"""Which way up and round a profile or a scan is: stated, and seen by its flange or its crown."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from contactstudy.arrays import Array

Way = Literal["own", "along", "back", "to field", "to flange", "to gauge", "up", "down"]
"""Where an axis of a file points; "own" is this program's, or what the kind of file has."""
_WAYS = {
    "along": (0, 1), "back": (0, -1), "to field": (1, 1), "to flange": (1, -1), "to gauge": (1, -1),
    "up": (2, 1), "down": (2, -1),
}  # fmt: skip
_OURS: tuple[Way, ...] = ("along", "to field", "up")


def stated(ways: Sequence[Way]) -> tuple[Way, ...]:
    """Where the last axes of (x, y, z) point, those that are "own" as this program's."""
    ours = _OURS[-len(ways) :]
    return tuple(o if way == "own" else way for way, o in zip(ways, ours, strict=True))


def problems_of_ways(ways: Sequence[Way], names: Sequence[str]) -> list[str]:
    """Complaints about axes, called `names`, that do not span a space, or a plane across."""
    first = 3 - len(ways)
    lines = [_WAYS[way][0] for way in stated(ways)]
    if sorted(lines) == list(range(first, 3)):
        return []
    told = " and ".join(f'{n} = "{w}"' for n, w in zip(names, stated(ways), strict=True))
    need = "across the rail and upwards" if first else "along the rail, across it and upwards"
    return [f"{told}: must be different axes, {need}, either way"]


def turned(points: Array, ways: Sequence[Way]) -> tuple[Array, bool]:
    """Points (n, len(ways)) of a file in this program's axes, and whether they were mirrored."""
    first = 3 - len(ways)
    found, matrix = np.empty_like(points), np.zeros((len(ways), len(ways)))
    for column, way in enumerate(stated(ways)):
        line, sign = _WAYS[way]
        found[:, line - first] = sign * points[:, column]
        matrix[line - first, column] = sign
    return found, bool(np.linalg.det(matrix) < 0.0)


TAPE = 0.07
"""Distance of the tape circle from the flange back [m] (EN 13715)."""
TIP = (-0.08, -0.025)
"""Where a flange's tip, or what a worn or cut one has left of it, lies from the tape circle [m]."""
_FLANGE = 8e-3  # depth [m] that no tread has beside its flange
_SECOND = 0.6
"""Share of the flange's depth that no wheel has on its other side."""
_WIDEST_HEAD = 0.085
"""Width of a rail's head [m] above which both its sides must be seen."""
_BULGE = 2e-3  # height [m] of a head's middle over its sides


@dataclass(frozen=True)
class Found:
    """What the shape says: factors of y and z to this program's axes (0: it does not say)."""

    y: Literal[-1, 0, 1]
    z: Literal[-1, 0, 1]
    told: str
    #: y of a flange's tip from the tape circle [m].
    tip: float = 0.5 * sum(TIP)
    #: What else it looks like.
    other: str = ""

    def faults(self, body: str, ways: Sequence[Way] = ("own", "own")) -> list[str]:
        """Axes that point elsewhere than stated by `ways`, and what to state instead."""
        if self.other:
            return [self.other]
        found = []
        if self.y > 0 and self.z > 0 and not TIP[0] <= self.tip <= TIP[1]:
            found.append(
                f"the flange's tip is at y = {1e3 * self.tip:.1f} mm from the tape circle, y = 0; "
                f"allowed: {1e3 * TIP[0]:g} to {1e3 * TIP[1]:g} mm"
            )
        names = ("x", "y", "z")[-len(ways) :]
        for line, factor in ((1, self.y), (2, self.z)):
            if factor >= 0:
                continue
            k = next(k for k, way in enumerate(stated(ways)) if _WAYS[way][0] == line)
            way = stated(ways)[k]
            instead = next(w for w, v in _WAYS.items() if v == (line, -_WAYS[way][1]))
            found.append(
                f"{names[k]} points {instead}: {self.told}; state {body}_{names[k]} = "
                f'"{instead}" if the file has it so'
            )
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
    beyond = (points[:, 0] - (points[k, 0] - y)) * y < 0.0
    second = float((off[beyond] / off[k]).max(initial=0.0))
    other = ""
    if second > _SECOND:
        other = f"{way} on both sides, by {1e3 * abs(off[k]):.1f} and "
        other += f"{1e3 * abs(second * off[k]):.1f} mm, as the head of a rail"
    up: Literal[-1, 1] = 1 if off[k] < 0 else -1
    return Found(1 if y < 0 else -1, up, told, float(points[k, 0]), other)


def shape_of_rail(points: Array) -> Found:
    """The crown of a rail's points (n, 2) = (y, z) [m], which its sides hang down from."""
    middle = 0.5 * (points[:, 0].min() + points[:, 0].max())
    off = points[:, 1] - points[np.argmin(np.abs(points[:, 0] - middle)), 1]
    k = int(np.argmax(np.abs(off)))
    if abs(off[k]) < _BULGE:
        return Found(0, 0, "no sides of a head")
    way = "hang down" if off[k] < 0 else "stand up"
    told = f"the head's sides {way} by {1e3 * abs(off[k]):.1f} mm"
    beyond = (points[:, 0] - middle) * (points[k, 0] - middle) < 0.0
    second = float((off[beyond] / off[k]).max(initial=0.0))
    other = ""
    if np.ptp(points[:, 0]) > _WIDEST_HEAD and second < 1.0 - _SECOND:
        side = "hangs down" if off[k] < 0 else "stands up"
        other = f"one side only {side}, by {1e3 * abs(off[k]):.1f} mm, as the flange of a wheel"
    return Found(0, 1 if off[k] < 0 else -1, told, other=other)
