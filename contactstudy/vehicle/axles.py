"""Trains by their axle loads alone: any axles, load model HSLM-A, freight wagons."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from contactstudy.validation import Above, AtMost, Naming, Parameters, Same, Unit, Usual, raise_if
from contactstudy.validation import quantities as q
from contactstudy.vehicle.car import WEIGHT
from contactstudy.vehicle.lumped import GRAVITY, BareWheel
from contactstudy.vehicle.model import Vehicle

# EN 1991-2:2003, Table 6.3: intermediate coaches N, coach length D [m], axles of a bogie d [m],
# point force P [N]
_HSLM_A = {
    "A1": (18, 18.0, 2.0, 170e3),
    "A2": (17, 19.0, 3.5, 200e3),
    "A3": (16, 20.0, 2.0, 180e3),
    "A4": (15, 21.0, 3.0, 190e3),
    "A5": (14, 22.0, 2.0, 170e3),
    "A6": (13, 23.0, 2.0, 180e3),
    "A7": (13, 24.0, 2.0, 190e3),
    "A8": (12, 25.0, 2.5, 190e3),
    "A9": (11, 26.0, 2.0, 210e3),
    "A10": (11, 27.0, 2.0, 210e3),
}
_POWER_CAR = (0.0, 3.0, 14.0, 17.0)
_MOST = 1000  # axles, whose matrices are dense: with both rails 0.1 GB
_TO_COACH = 3.525  # m, last axle of the power car to the first of the coach


def _too_many(name: str, axles: int) -> list[str]:
    return [f"{name}: {axles} axles; must be at most {_MOST}"] if axles > _MOST else []


@dataclass(frozen=True)
class Axles(Parameters, ABC):
    """Loads of axles, half of each on a rail; with a law that moves, on bare wheels."""

    wheel_mass: Annotated[float, Same(BareWheel, "wheel_mass")] = BareWheel.wheel_mass
    wheel_radius: Annotated[float, Same(BareWheel, "wheel_radius")] = BareWheel.wheel_radius

    @property
    @abstractmethod
    def axles(self) -> tuple[Sequence[float], Sequence[float]]:
        """Distances of the axles behind the first [m], and their loads [N]."""

    @property
    def static_load(self) -> float:
        """Of a wheel of the first axle [N]."""
        return 0.5 * self.axles[1][0]

    @property
    def repeat_length(self) -> float | None:
        """L_c, at which groups of axles repeat [m]; None where they do not."""
        return None

    def vehicle(self, rails: int = 1) -> Vehicle:
        """A bare wheel under every axle on one rail or two.

        ``InputError`` for more axles than matrices are made of.
        """
        raise_if(_too_many("axles", len(self.axles[1])))
        behind, loads = (np.asarray(part, dtype=float) for part in self.axles)
        n = rails * len(loads)
        return Vehicle(
            mass=self.wheel_mass * np.eye(n),
            damping=np.zeros((n, n)),
            stiffness=np.zeros((n, n)),
            wheel_dofs=np.arange(n) if rails == 1 else np.zeros(0, dtype=np.int64),
            wheel_offsets=-np.repeat(behind, rails),
            static_loads=0.5 * np.repeat(loads, rails),
            dof_names=tuple(f"wheel {k + 1}" for k in range(n)),
            contact_rows=np.eye(n),
            contact_rails=np.tile(np.arange(rails), len(loads)),
        )


@dataclass(frozen=True)
class AxleLoads(Axles):
    """Any axles."""

    axle_loads: Annotated[
        tuple[float, ...], Unit("N"), Above(0), WEIGHT, Usual(2e4, 5e5, "is it a mass in kg?"),
        "of the axles from front to rear",
    ] = (134e3,)  # fmt: skip
    axle_distances: Annotated[
        tuple[float, ...], Unit("m"), Above(0), Usual(0.5, 100.0), "from each axle to the next"
    ] = ()  # fmt: skip

    def problems(self, key: Naming) -> Iterable[str]:
        """Distances that do not fit the loads."""
        loads, distances = len(self.axle_loads), len(self.axle_distances)
        yield from _too_many(key("axle_loads"), loads)
        if not loads:
            yield f"{key('axle_loads')}: must have at least one load"
        elif distances != loads - 1:
            yield (
                f"{key('axle_distances')}: has {distances} values; must have {loads - 1} for "
                f"{loads} axles"
            )

    @property
    def axles(self) -> tuple[Sequence[float], Sequence[float]]:
        """See `Axles.axles`."""
        return np.cumsum([0.0, *self.axle_distances]).tolist(), self.axle_loads


@dataclass(frozen=True)
class HighSpeedLoadModel(Axles):
    """Load model HSLM-A of EN 1991-2: power car, end coach, N coaches on shared bogies, and back.

    In figure 6.12 a coach is D long between the middles of its bogies; the end coach begins in the
    middle between the power car's last axle and its own first.
    """

    hslm: Annotated[
        Literal["A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8", "A9", "A10"],
        "universal train of load model HSLM-A",
    ] = "A1"  # fmt: skip

    @property
    def repeat_length(self) -> float:
        """Length of a coach [m]."""
        return _HSLM_A[self.hslm][1]

    @property
    def axles(self) -> tuple[Sequence[float], Sequence[float]]:
        """See `Axles.axles`."""
        coaches, length, spacing, force = _HSLM_A[self.hslm]
        first = _POWER_CAR[-1] + _TO_COACH
        begin = _POWER_CAR[-1] + 0.5 * _TO_COACH
        end = 2.0 * begin + (coaches + 2) * length  # last axle of the train
        shared = [begin + length * (k + 1) for k in range(coaches + 1)]
        middles = [first + 0.5 * spacing, *shared, end - first - 0.5 * spacing]
        bogies = [x + half for x in middles for half in (-0.5 * spacing, 0.5 * spacing)]
        behind = [*_POWER_CAR, *bogies, *(end - x for x in reversed(_POWER_CAR))]
        return behind, [force] * len(behind)


@dataclass(frozen=True)
class FreightWagons(Axles):
    """Reference wagons of line category D4 of EN 15528: 22.5 t an axle, 8 t/m; no suspension.

    Four axles 1.5, 3.3, 7.95 and 9.75 m behind the front coupler of a wagon of 11.25 m.
    """

    wagons: Annotated[q.Count, AtMost(_MOST // 4), "number of wagons"] = 10

    @property
    def repeat_length(self) -> float | None:
        """Length of a wagon [m]."""
        return 11.25 if self.wagons > 1 else None

    @property
    def axles(self) -> tuple[Sequence[float], Sequence[float]]:
        """See `Axles.axles`."""
        wagon = (0.0, 1.8, 6.45, 8.25)
        behind = [11.25 * k + x for k in range(self.wagons) for x in wagon]
        return behind, [22.5e3 * GRAVITY] * len(behind)
