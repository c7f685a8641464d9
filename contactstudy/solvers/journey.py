"""Where the wheels run, how fast, and in which time steps."""

import math
from dataclasses import dataclass

import numpy as np

from contactstudy.track.model import Track
from contactstudy.validation import not_negative, positive, raise_if
from contactstudy.vehicle import Vehicle


@dataclass(frozen=True)
class Journey:
    """A run at constant speed.

    Parameters
    ----------
    start, end : float
        X of the leading wheel at the first and (at most) at the last step [m].
    speed : float
        [m/s].
    time_step : float
        [s].
    fade_in : float
        Length over which the irregularity grows from nothing, from each wheel's start on [m].
    stations : tuple of float
        X where the rail's displacement is recorded [m].
    """

    start: float = 6.0
    end: float = 30.0
    speed: float = 300.0 / 3.6
    time_step: float = 5e-5
    fade_in: float = 3.0
    stations: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        problems = (
            positive("journey speed", self.speed, "m/s")
            + positive("journey time_step", self.time_step, "s")
            + not_negative("journey fade_in", self.fade_in, "m")
        )
        if not (math.isfinite(self.start) and math.isfinite(self.end) and self.end > self.start):
            problems.append(
                f"journey from start = {self.start:g} m to end = {self.end:g} m: the end must lie"
                " beyond the start"
            )
        elif not problems and self.n_steps < 1:
            problems.append(
                f"journey time_step = {self.time_step:g} s: longer than the whole run"
                f" of {(self.end - self.start) / self.speed:g} s"
            )
        raise_if(problems)

    @property
    def n_steps(self) -> int:
        """Number of time steps."""
        steps = (self.end - self.start) / (self.speed * self.time_step)
        return math.floor(steps * (1.0 + 1e-12))

    @property
    def times(self) -> np.ndarray:
        """Time of each state, from 0, (n_steps + 1,) s."""
        return self.time_step * np.arange(self.n_steps + 1)

    def wheel_positions(self, offsets: np.ndarray) -> np.ndarray:
        """X of each wheel at each state, (n_steps + 1, n_wheels) m."""
        return self.start + self.speed * self.times[:, None] + np.asarray(offsets)[None, :]

    def problems_on(self, track: Track, vehicle: Vehicle) -> list[str]:
        """Everything that makes this journey impossible on that track with that vehicle."""
        problems = []
        rear = self.start + float(np.min(vehicle.wheel_offsets))
        if rear < 0.0 or self.end > track.length * (1.0 + 1e-12):
            problems.append(
                f"wheels run from {rear:g} m to {self.end:g} m: must stay on the track,"
                f" 0 to {track.length:g} m"
            )
        problems += [
            f"journey station at {x:g} m: must lie on the track, 0 to {track.length:g} m"
            for x in self.stations
            if not 0.0 <= x <= track.length
        ]
        return problems
