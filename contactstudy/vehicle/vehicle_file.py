"""Vehicle files, like ``vehicles/s300.toml``: the parameters of one car and their source."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from contactstudy.exceptions import InputError
from contactstudy.given_files import changed, named_file, toml_file
from contactstudy.resources import shipped
from contactstudy.validation import read
from contactstudy.vehicle.car import Car

_TEXTS = ("name", "source", "notes")


def shipped_cars() -> dict[str, Path]:
    """Name -> file of the cars that come with the program."""
    return shipped("vehicles")


def read_car(name: str) -> Car:
    """A shipped car by its name, or a user's by the path of a file like ``vehicles/s300.toml``.

    Raises
    ------
    InputError
        Listing everything that is wrong with the file.
    """
    path = named_file(name, shipped_cars(), "car")
    return _read(path, changed(path))


@lru_cache(maxsize=64)
def _read(path: Path, changed: int) -> Car:
    """The car of a file as it was `changed` last."""
    data = toml_file(path)
    problems = [
        f"{key}: unknown key; allowed: {', '.join(_TEXTS)} and the table [car]"
        for key in data
        if key not in (*_TEXTS, "car")
    ]
    problems += [
        f"{key} = {data[key]!r}: must be text"
        for key in _TEXTS
        if key in data and not isinstance(data[key], str)
    ]
    car = None
    if not isinstance(data.get("car"), Mapping):
        problems.append("car: is missing; the parameters stand in the table [car]")
    else:
        car, wrong = read(Car, data["car"], "car")
        problems += wrong
    if problems or not isinstance(car, Car):
        raise InputError([f"{path}: {problem}" for problem in problems])
    return car
