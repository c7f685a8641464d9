"""Trains of cars, and single bogies, by the names or files of their cars."""

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any

from contactstudy.exceptions import InputError
from contactstudy.validation import (
    File,
    Naming,
    Parameters,
    Unit,
    Usual,
    Written,
    complaint,
    listed,
    raise_if,
)
from contactstudy.vehicle.car import Car
from contactstudy.vehicle.derived import train
from contactstudy.vehicle.model import Vehicle
from contactstudy.vehicle.suspended import CarModel, bogie_vehicle, car_vehicle, wheelset_positions
from contactstudy.vehicle.vehicle_file import read_car

_ENTRY = re.compile(r"(?:(?P<count>[1-9][0-9]{0,2}) x )?(?P<file>.+?)(?P<reversed> reversed)?")
_MOST: dict[CarModel, int] = {"planar": 250, "three_dimensional": 80}
"""Cars of a train, whose matrices are dense: 2500 dofs."""
_TOLERANCE = 1e-9  # m, of ends that touch


class _OfCars(Parameters, ABC):
    """What wheels over one rail are, by the leading car."""

    @property
    @abstractmethod
    def cars_read(self) -> tuple[Car, ...]:
        """Each car, front to rear."""

    @property
    @abstractmethod
    def _entries(self) -> dict[str, Car]:
        """The car of each entry of the key that names them."""

    def unusual(self, key: Naming | None = None) -> list[str]:
        """As in `Parameters`, with what is unusual in the files of the cars."""
        own, name = super().unusual(key), key or self._naming()
        for entry, car in self._entries.items():
            field, *place = entry.split(".")
            own += [f"{'.'.join([name(field), *place])}: {text}" for text in car.unusual()]
        return own

    @property
    def leading(self) -> Car:
        """The first car."""
        return self.cars_read[0]

    @property
    def data(self) -> list[Any]:
        """What the files of the cars say, as plain data."""
        return [car.resolved() for car in dict.fromkeys(self.cars_read)]

    @property
    def static_load(self) -> float:
        """Of a wheel of the first car [N]."""
        return 0.5 * self.leading.static_axle_load

    @property
    def wheel_radius(self) -> float:
        """Of the first car [m]."""
        return self.leading.wheel_radius

    @property
    def wheel_mass(self) -> float:
        """Half of a wheelset of the first car [kg]."""
        return 0.5 * self.leading.wheelset_mass


@dataclass(frozen=True)
class Train(_OfCars):
    """Cars behind each other, front to rear; they are coupled by the track only.

    Each is a shipped car or a file like those of ``vehicles/``, perhaps several, perhaps the other
    way round: ``["s300_end", "10 x s300", "s300_end reversed"]``. In the plane it is the half over
    one rail; in three dimensions it runs on two rails.
    """

    cars: Annotated[
        tuple[str, ...], File(True, _ENTRY),
        "shipped cars or TOML files from front to rear, also as \"10 x NAME\", \"NAME reversed\"",
    ] = ("s300_end", "10 x s300", "s300_end reversed")  # fmt: skip
    model: Annotated[CarModel, "heave and pitch; or lateral motion, roll and yaw as well"] = (
        "planar"
    )
    gaps: Annotated[
        tuple[float, ...], Unit("m"), Usual(0.0, 30.0), Written(listed, "a list of them"),
        "between the ends of neighbouring cars, one for all or one each; lengths are over couplers",
    ] = (0.0,)  # fmt: skip

    def problems(self, key: Naming) -> Iterable[str]:
        """Cars that there are not or that overlap, gaps that do not fit, missing lateral data."""
        if not self.cars:
            yield f"{key('cars')}: must name at least one car"
            return
        cars = dict[str, Car]()
        for k, text in enumerate(self.cars):
            try:
                cars[text] = _read(text)[0]
            except InputError as error:
                yield from (f"{key('cars')}.{k}: {problem}" for problem in error.problems)
        if len(cars) < len(set(self.cars)):
            return
        n = len(self.consist)
        yield from self._too_many(key("cars"))
        if len(self.gaps) not in (1, n - 1):
            has = f"{key('gaps')}: has {len(self.gaps)} values"
            yield f"{has}; must have 1, or {n - 1} for {n} cars"
        for k, gap in enumerate(self.gaps):
            if gap < -_TOLERANCE:
                which = "neighbouring cars" if len(self.gaps) == 1 else f"cars {k + 1} and {k + 2}"
                yield complaint(f"{key('gaps')}.{k}", gap, f"{which} overlap by {-gap:g} m")
        if self.model == "three_dimensional":
            for text, car in cars.items():
                if car.missing:
                    yield complaint(
                        key("model"),
                        self.model,
                        f"car {text} lacks lateral data: {', '.join(car.missing)}",
                    )

    def _too_many(self, name: str) -> list[str]:
        n, most = len(self.consist), _MOST[self.model]
        told = f'{name}: {n} cars; must be at most {most} with model = "{self.model}"'
        return [told] if n > most else []

    @cached_property
    def consist(self) -> tuple[tuple[Car, bool], ...]:
        """Each car and whether it is reversed, front to rear."""
        return tuple(one for text in self.cars for one in _read(text)[1])

    @property
    def cars_read(self) -> tuple[Car, ...]:
        """See `_OfCars.cars_read`."""
        return tuple(car for car, _ in self.consist)

    @property
    def _entries(self) -> dict[str, Car]:
        return {f"cars.{k}": _read(text)[0] for k, text in enumerate(self.cars)}

    @property
    def length(self) -> float:
        """Over the couplers [m]."""
        return sum(car.length for car, _ in self.consist) + sum(self._gaps)

    @property
    def repeat_length(self) -> float | None:
        """L_c, of the commonest car with the gap behind it [m]; None of a single car."""
        lengths = [car.length for car, _ in self.consist]
        if len(lengths) == 1:
            return None
        pitches = [length + gap for length, gap in zip(lengths, self._gaps, strict=False)]
        return max(pitches, key=pitches.count)

    @property
    def _gaps(self) -> list[float]:
        n = len(self.consist) - 1
        return list(self.gaps) if len(self.gaps) == n else [self.gaps[0]] * n

    @cached_property
    def _ends(self) -> tuple[list[float], list[float]]:
        """X of the middle between each car's bogies, and of its front end, from the train's."""
        middles, fronts, end = list[float](), list[float](), 0.0
        for (car, reverse), gap in zip(self.consist, [0.0, *self._gaps], strict=False):
            end -= gap
            fronts.append(end)
            offset = -car.pivot_offset if reverse else car.pivot_offset
            middles.append(end - 0.5 * car.length + offset)
            end -= car.length
        return middles, fronts

    @property
    def outlines(self) -> list[tuple[float, float, float, float]]:
        """X of each car's front end, bogies and rear end, from the leading wheelset [m]."""
        middles, fronts = self._ends
        first = middles[0] + max(wheelset_positions(self.leading))
        return [
            (
                front - first,
                middle + 0.5 * car.pivot_distance - first,
                middle - 0.5 * car.pivot_distance - first,
                front - car.length - first,
            )
            for (car, _), middle, front in zip(self.consist, middles, fronts, strict=True)
        ]

    def vehicle(self, rails: int | None = None) -> Vehicle:
        """The whole train on one rail or two, by default as many as its model has.

        ``InputError`` for more cars than matrices are made of.
        """
        raise_if(self._too_many("cars"))
        rails = rails or (2 if self.model == "three_dimensional" else 1)
        made = {car: car_vehicle(car, self.model, rails) for car, _ in self.consist}
        cars = [car for car, _ in self.consist]
        wheels = [
            middle + max(wheelset_positions(car))
            for car, middle in zip(cars, self._ends[0], strict=True)
        ]
        return train([made[car] for car in cars], [x - wheels[0] for x in wheels])


@dataclass(frozen=True)
class Bogie(_OfCars):
    """One bogie of a car over one rail, with its half of the car body on top."""

    car: Annotated[str, File(True), "shipped car, or a TOML file with one"] = "s300"

    def problems(self, key: Naming) -> Iterable[str]:
        """A car that there is not."""
        try:
            read_car(self.car)
        except InputError as error:
            yield from (f"{key('car')}: {problem}" for problem in error.problems)

    @cached_property
    def cars_read(self) -> tuple[Car, ...]:
        """See `_OfCars.cars_read`."""
        return (read_car(self.car),)

    @property
    def _entries(self) -> dict[str, Car]:
        return {"car": self.leading}

    def vehicle(self) -> Vehicle:
        """Dofs car body z, bogie z and pitch, two wheelsets z."""
        return bogie_vehicle(self.leading)


def car_file(text: str) -> str:
    """The name or file in an entry such as "10 x NAME"."""
    match = _ENTRY.fullmatch(text)
    return match["file"] if match else text


def _read(text: str) -> tuple[Car, list[tuple[Car, bool]]]:
    """The car of an entry; as many of it as the entry says."""
    match = _ENTRY.fullmatch(text)
    if match is None:
        raise InputError(f'"{text}" names no car')
    if match["count"] is None and re.match("[0-9]+ x ", text):
        raise InputError(f'"{text}": must be 1 to 999 of a car')
    car = read_car(match["file"])
    return car, [(car, match["reversed"] is not None)] * int(match["count"] or 1)
