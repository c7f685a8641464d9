"""Curves of rails and wheels by name: those that are drawn, and files of worn ones."""

from functools import lru_cache
from pathlib import Path
from typing import Literal

from contactstudy.given_files import changed
from contactstudy.profiles.curve import ProfileCurve, joined
from contactstudy.profiles.orientation import Way
from contactstudy.profiles.profile_file import SUFFIXES
from contactstudy.profiles.rail import running_surface
from contactstudy.profiles.wheel import wheel_profile
from contactstudy.profiles.worn import worn_curve

Ways = tuple[Way, Way]
OWN: Ways = ("own", "own")


def rail_curve(name: str = "60E1", ways: Ways = OWN) -> ProfileCurve:
    """Running surface of a rail with both side faces, in the rail's own axes.

    s = 0 at the crown, s grows with y; normals point up and out.

    Parameters
    ----------
    name : str
        ``"60E1"``, ``"UIC60-Manchester"``, the rail of the Manchester contact benchmark, or the
        name of a CSV file with a worn profile (`contactstudy.profiles.worn`).
    ways : tuple of str
        Where y and z of a file point, as there.

    Raises
    ------
    InputError
        If there is no such profile, or the file is faulty.
    """
    return _worn(name, "rail", ways) if _is_file(name) else running_surface(name)


def wheel_curve(name: str, ways: Ways = OWN) -> ProfileCurve:
    """Profile of a wheel: y from the tape circle to the field side, z up, normals pointing down.

    s = 0 and z = 0 at the tape circle's lowest point; s grows with y.

    Parameters
    ----------
    name : str
        ``"cylinder"``, ``"cone"`` (1:20), ``"S1002"``, or the name of a CSV file with a worn
        profile (`contactstudy.profiles.worn`).
    ways : tuple of str
        Where y and z of a file point, as there.

    Raises
    ------
    InputError
        If there is no such profile, or the file is faulty.
    """
    return _worn(name, "wheel", ways) if _is_file(name) else _drawn_wheel(name)


@lru_cache(maxsize=16)
def _drawn_wheel(name: str) -> ProfileCurve:
    profile = wheel_profile(name)
    return joined(profile.name, profile.pieces, upper=False)


def _is_file(name: str) -> bool:
    return Path(name).suffix.lower() in (".csv", *SUFFIXES)


def _worn(name: str, body: Literal["rail", "wheel"], ways: Ways) -> ProfileCurve:
    return _read(Path(name), body, ways, changed(name))


@lru_cache(maxsize=16)
def _read(path: Path, body: Literal["rail", "wheel"], ways: Ways, changed: int) -> ProfileCurve:
    return worn_curve(path, body, ways=ways)
