"""The irregularity of a study on a track with both rails."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from contactstudy.irregularity.chosen import Irregularity
from contactstudy.irregularity.coherence import (
    constant_coherence,
    decaying_coherence,
    other_rail,
)
from contactstudy.irregularity.defective import with_defects
from contactstudy.irregularity.profile import HarmonicProfile, Profile, SmoothRail
from contactstudy.irregularity.rails import RailProfiles


def both_rails(
    table: Irregularity, required: tuple[float, float] | None = None, radius: float = 0.43
) -> RailProfiles:
    """The irregularity of both rails, vertical and transverse.

    The right rail has the profiles of a track with one rail, the left one others of the table's
    coherence. A sinusoid is on both rails, and vertical only, as are defects of the rail; a
    measured alignment has its own columns.

    Arguments and errors are those of `Irregularity.profile`.
    """
    even = replace(table, rail_defect=None, wheel_defect=None)
    smooth = SmoothRail(), SmoothRail()
    if table.generated:
        vertical, transverse = _generated(even, "Z"), _generated(even, "Y")
    elif table.spectrum == "measured":
        up, left, across, left_across = (
            _measured(even, name, required)
            for name in ("level_column", "left_column", "lateral_column", "left_lateral_column")
        )
        assert up is not None
        vertical = up, left or up
        transverse = across or smooth[0], left_across or across or smooth[1]
    else:
        wave = even.profile("Z")
        vertical, transverse = (wave, wave), smooth
    defects = table.rail_defect, table.wheel_defect
    if any(defects):
        right, other = (with_defects(profile, *defects, radius) for profile in vertical)
        vertical = right, other
    return RailProfiles(*vertical, *transverse)


def _generated(table: Irregularity, direction: Literal["Z", "Y"]) -> tuple[Profile, Profile]:
    right = table.profile(direction)
    assert isinstance(right, HarmonicProfile)
    coherence = (
        decaying_coherence(table.coherence_wavelength)
        if table.coherence == "decaying"
        else constant_coherence(float(table.coherence))
    )
    which: Literal["vertical", "transverse"] = "vertical" if direction == "Z" else "transverse"
    return right, other_rail(right, coherence, table.seed, which)


def _measured(
    table: Irregularity, column: str, required: tuple[float, float] | None
) -> Profile | None:
    """The level in the column that a key names; None if it names none."""
    name = getattr(table, column)
    return replace(table, level_column=name).profile("Z", required) if name else None
