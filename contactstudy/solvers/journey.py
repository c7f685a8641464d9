"""Where the wheels run, how fast, and in which time steps."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.track.model import Track
from contactstudy.validation import AtLeast, Key, Naming, Parameters, Unit, Usual, complaint
from contactstudy.validation import quantities as q
from contactstudy.vehicle import Vehicle

Travel = Literal["forward", "backward"]

STEPS_A_WAVE = 40
"""Time steps a wave of a sinusoid, if the time step is left out."""
LONGEST_STEP = 1e-4
"""Time step that is not exceeded then [s]."""
MOST_STEPS = 5_000_000
"""Of a run: the histories of so many take half a gigabyte."""


FASTEST = 574.8 / 3.6
"""Speed record of wheels on rails, 3 April 2007 [m/s]."""


@dataclass(frozen=True)
class Journey(Parameters):
    """A run at constant speed.

    Over a sinusoid end, fade-in and time step follow from the wavelength where they are left out.
    """

    start: Annotated[q.LengthOrZero, Key("from"), "where the leading wheel starts"] = 6.0
    end: Annotated[q.LengthOrZero, Key("to"), "where it ends"] = 30.0
    speed: Annotated[q.Speed, Usual(0.1, FASTEST, 'km/h are written "300 km/h"'), "speed"] = (
        300.0 / 3.6
    )
    time_step: Annotated[q.Duration, "time step"] = 5e-5
    fade_in: Annotated[q.LengthOrZero, "length over which the irregularity grows"] = 3.0
    stations: Annotated[
        tuple[float, ...], Unit("m"), AtLeast(0), "where the rail's displacement is recorded"
    ] = ()
    travel: Annotated[Travel, Key(""), "to +X, or to -X from the far end of the track"] = "forward"

    def over_bridge(self, length: float, behind: float) -> "Journey":
        """The same with what was left out fitted to a track on a bridge of a length [m].

        It starts with the leading wheel where the track begins, and ends when the last one,
        `behind` it [m], leaves the track.
        """
        start = self.start if self.given("start") else 0.0
        end = self.end if self.given("end") else length + behind
        return self.changed(start=start, end=end)

    def fitting(self, wavelength: float, bay: float) -> "Journey":
        """The same with what was left out fitted to a sinusoid of a wavelength [m].

        Fade-in over a wave, at least a bay [m]; then three waves, at least two bays; at least
        `STEPS_A_WAVE` steps a wave, of at most `LONGEST_STEP`.
        """
        step = min(LONGEST_STEP, wavelength / (STEPS_A_WAVE * self.speed))
        fade_in = self.fade_in if self.given("fade_in") else max(wavelength, bay)
        end = self.start + fade_in + max(3.0 * wavelength, 2.0 * bay)
        return self.changed(
            fade_in=fade_in,
            end=self.end if self.given("end") else end,
            time_step=self.time_step if self.given("time_step") else step,
        )

    def problems(self, key: Naming) -> list[str]:
        """A journey that leads nowhere, fades in to its end, or has too few or many steps."""
        distance = self.end - self.start
        if distance <= 0.0:
            return [
                complaint(key("end"), self.end, f"must be beyond {key('start')}, {self.start:g} m")
            ]
        problems = []
        if self.fade_in >= distance:
            allowed = f"must be below the distance run, {distance:g} m"
            problems.append(complaint(key("fade_in"), self.fade_in, allowed))
        return problems + self.problems_of_step(key("time_step"), self.time_step)

    def problems_of_step(self, key: str, step: float) -> list[str]:
        """Complaint about a time step [s] that is called `key`, if it is too large or small."""
        duration = (self.end - self.start) / self.speed
        if step > duration / 2:
            allowed = f"must be at most half the duration of the run, {duration / 2:.3g} s"
            return [complaint(key, step, allowed)]
        if step < duration / MOST_STEPS:
            allowed = f"must be at least {duration / MOST_STEPS:.3g} s, for {MOST_STEPS} steps"
            return [complaint(key, step, allowed)]
        return []

    def steps_over(self, length: float, step: float) -> float:
        """Time steps [s] in which the wheel passes a length [m]."""
        return length / (self.speed * step)

    @property
    def n_steps(self) -> int:
        """Number of time steps."""
        steps = (self.end - self.start) / (self.speed * self.time_step)
        return math.floor(steps * (1.0 + 1e-12))

    @property
    def times(self) -> Array:
        """Time of each state, from 0, (n_steps + 1,) s."""
        return np.asarray(self.time_step * np.arange(self.n_steps + 1))

    def wheel_positions(self, offsets: Array) -> Array:
        """X of each wheel at each state, (n_steps + 1, n_wheels) m."""
        return self.start + self.speed * self.times[:, None] + np.asarray(offsets)[None, :]

    def steps_at(self, at: Sequence[float]) -> IntArray:
        """Steps at which the leading wheel is nearest to positions X, (k,) for k of them."""
        x = self.start + self.speed * self.times
        return np.array([int(np.argmin(np.abs(x - one))) for one in at], dtype=np.int64)

    def not_passed(self, name: str, at: Sequence[float]) -> list[str]:
        """Complaints about positions X, a list called `name`, that the wheel does not pass."""
        where = f"the wheel must pass it, {self.start:g} to {self.end:g} m"
        return [
            complaint(f"{name}.{i}", x, where)
            for i, x in enumerate(at)
            if not self.start <= x <= self.end
        ]

    def problems_on(
        self, track: Track, vehicle: Vehicle | None = None, key: Naming | None = None
    ) -> list[str]:
        """Everything that makes this journey impossible on that track with that vehicle.

        Without a vehicle it is one wheel; `key` gives the caller's name of a field.
        """
        key = key or (lambda name: f"Journey.{name}")
        if track.structure is not None:
            return self._problems_on_bridge(track, vehicle, key)
        where = f"must lie on the track, 0 to {track.length:g} m"
        points = {key("start"): self.start, key("end"): self.end}
        points |= {f"{key('stations')}.{i}": x for i, x in enumerate(self.stations)}
        problems = [
            complaint(name, x, where)
            for name, x in points.items()
            if x > track.length * (1.0 + 1e-12)
        ]
        behind = 0.0 if vehicle is None else -float(np.min(vehicle.wheel_offsets))
        if self.start < behind:
            allowed = f"must leave room for the last wheel, {behind:g} m behind the first"
            problems.append(complaint(key("start"), self.start, allowed))
        return problems

    def _problems_on_bridge(self, track: Track, vehicle: Vehicle | None, key: Naming) -> list[str]:
        """As above, where wheels come from the ground before the track and leave to that behind."""
        behind = 0.0 if vehicle is None else -float(np.min(vehicle.wheel_offsets))
        problems, last = [], track.length + behind
        if self.start >= track.length:
            allowed = f"must be before the end of the track, {track.length:g} m"
            problems.append(complaint(key("start"), self.start, allowed))
        if self.end > last * (1.0 + 1e-9):
            allowed = f"must be at most {last:g} m, where the last wheel leaves the track"
            problems.append(complaint(key("end"), self.end, allowed))
        where = f"must lie on the track, 0 to {track.length:g} m"
        return problems + [
            complaint(f"{key('stations')}.{i}", x, where)
            for i, x in enumerate(self.stations)
            if x > track.length
        ]
