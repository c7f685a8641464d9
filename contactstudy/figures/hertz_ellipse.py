"""Hertz's patch for the geometry of a study, to be drawn over a computed one."""

from dataclasses import dataclass
from functools import cache

from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.plot.text import exact
from contactstudy.profiles.rail import rail_profile
from contactstudy.study.results import StudyResults


@dataclass(frozen=True)
class HertzPatch:
    """Elliptic patch of Hertz's theory.

    Attributes
    ----------
    along, across : float
        Semi-axes along and across the rail, m.
    peak_pressure : float
        Pa.
    approach : float
        Of distant points of the two bodies, m.
    radii : str
        The radii it was computed for, in words.
    """

    along: float
    across: float
    peak_pressure: float
    approach: float
    radii: str


def hertz_patch(results: StudyResults, force: float) -> HertzPatch | None:
    """Patch of a cylindrical wheel on the crown of the study's rail under `force` [N].

    None where the study has no rail profile, where the rail is not touched, and where the patch
    may lie anywhere on the profiles.
    """
    if results.config.get("solid", {}).get("section") == "whole":
        return None
    track = results.config.get("track", {})
    radius = results.config.get("vehicle", {}).get("wheel_radius")
    if track.get("rail", "given") == "given" or radius is None or force <= 0.0:
        return None
    crown = _crown_radius(str(track["rail"]))
    modulus = contact_modulus(float(track["youngs_modulus"]), float(track["poisson_ratio"]))
    found = hertz_contact(force, modulus, float(radius), crown)
    words = f"wheel {exact(float(radius))} m, crown {exact(crown)} m"
    return HertzPatch(
        found.semi_axis_x, found.semi_axis_y, found.peak_pressure, found.approach, words
    )


@cache
def _crown_radius(profile: str) -> float:
    return rail_profile(profile).crown_radius
