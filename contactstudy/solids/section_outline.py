"""Right half of a rail's outline, where its blocks' corners lie, and the columns of the head."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.profiles.rail import RailProfile
from contactstudy.solids.mapped import Grading

_LOWEST = 0.010
"""m, by which the fine running surface ends above the head's lower corner at least."""


def columns_of(grading: Grading, low: float, high: float, length: float) -> tuple[Array, IntArray]:
    """Arc lengths from the axis to the shoulder, fine from `low` to `high`; which are fine."""
    h = grading.size
    count = max(2, round((high - low) / h))
    fine = low + (high - low) / count * np.arange(count + 1)
    if low <= 0.0 <= high:
        # a line on the axis, which both halves share
        fine = h * np.arange(np.ceil(low / h - 0.499), np.floor(high / h + 0.499) + 1)
    fine = fine[fine >= -1e-9 * h]
    if not len(fine):
        # all of the fine zone lies on the other half: go on growing from where it ends
        first = min(h + (grading.growth - 1) * -high, grading.coarse)
        return grading.steps(length, first), np.empty(0, dtype=np.int64)
    before = fine[0] - grading.steps(fine[0])[:0:-1] if fine[0] > 1e-9 * h else np.empty(0)
    columns = np.r_[before, fine, fine[-1] + grading.steps(length - fine[-1])[1:]]
    return columns, len(before) + np.arange(len(fine))


@dataclass(frozen=True)
class Outline:
    """Right half of the outline and where the corners of the blocks lie on it.

    Attributes
    ----------
    side : ndarray (n, 2)
        Points (y, z) from the crown to the middle of the foot in m.
    marks : tuple of int
        Corners among them: shoulder, lower corner of the head, top and bottom of the web, upper
        and lower end of the foot's edge.
    """

    profile: RailProfile
    side: Array
    marks: tuple[int, ...]

    @classmethod
    def of(cls, profile: RailProfile, round_corner: bool) -> "Outline":
        """Of a profile; the head's upper edge ends before or goes round its corner."""
        side, marks = profile.half_outline(), []
        for corner in _block_corners(profile, round_corner):
            side, mark = _with_point(side, corner)
            marks.append(mark)
        return cls(profile, side, tuple(marks))

    @property
    def top_length(self) -> float:
        """Arc length from the crown to the end of the head's upper edge in m."""
        top = self.side[: self.marks[0] + 1]
        return float(np.sum(np.hypot(*np.diff(top, axis=0).T)))


def fine_reach(profile: RailProfile, size: float) -> float:
    """How far from the crown the fine running surface may reach, arc length in m."""
    return Outline.of(profile, round_corner=True).top_length - size - _LOWEST


def _block_corners(profile: RailProfile, round_corner: bool) -> list[tuple[float, float]]:
    """Where the blocks' corners sit on the right half of the outline, from top to bottom."""
    z = profile.heights
    foot_web = [z["head_bottom_axis"], z["foot_top_axis"]]
    if round_corner:
        # the head's lower corner, and the middle of its underside: the outline is straight there,
        # so one element has an angle of 180 degrees
        levels = [
            0.5 * (z["side_bottom"] + z["head_corner"]),
            0.5 * (z["head_corner"] + z["head_web"]),
        ]
        half = profile.half_width(np.array(levels))
        head = list(zip(half.tolist(), levels, strict=True))
    else:
        shoulder = float(0.9 * profile.half_width(np.array([z["side_top"]]))[0])
        level = 0.5 * (z["side_bottom"] + z["head_corner"])
        head = [
            (shoulder, float(profile.curve.height(shoulder))),
            (float(profile.half_width(np.array([level]))[0]), level),
        ]
    return [
        *head,
        *zip(profile.half_width(np.array(foot_web)).tolist(), foot_web, strict=True),
        # middle of the rounding of the foot's upper edge: the nearest point to its sharp corner
        (0.5 * profile.foot_width, z["foot_edge_top"] + 0.003),
        (profile.bearing_half_width, z["foot_bottom"]),
    ]


def _with_point(side: Array, point: tuple[float, float]) -> tuple[Array, int]:
    """Outline with a point of it among its vertices, and which one that is."""
    distance = np.hypot(side[:, 0] - point[0], side[:, 1] - point[1])
    nearest = int(np.argmin(distance))
    # vertices stand closely on arcs; lines have none between their ends
    if distance[nearest] < 2e-3:
        return side, nearest
    # z falls from vertex to vertex
    after = int(np.searchsorted(-side[:, 1], -point[1]))
    return np.insert(side, after, [point], axis=0), after
