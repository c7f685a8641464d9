"""The table ``[measured]``: a record that a passage is held against."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.signals import at_station
from contactstudy.exceptions import InputError
from contactstudy.given_files import changed
from contactstudy.irregularity.table import read_numbers
from contactstudy.solvers.bridge_sensors import IN_SPACE, ON_SUPPORTS, VARIABLES
from contactstudy.solvers.dataset import POINT_SIGNALS, SIGNALS
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.on_bridge import planar_on
from contactstudy.study.kinds.passage.record_faults import gaps, jumps_to_nothing, wrong_columns
from contactstudy.track.model import Track
from contactstudy.units import UnitError, to_si
from contactstudy.validation import Above, File, Naming, Parameters, Unit, complaint, did_you_mean
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr

_CHANNEL = re.compile(
    r"(?P<column>[^=]+?)\s*=\s*(?P<sign>-?)\s*(?P<signal>\w+)(?:\s+at\s+(?P<at>.+))?"
)
_FORM = 'must be like "COLUMN = SIGNAL" or "COLUMN = SIGNAL at 12.5 m"'
_FEWEST = 3  # samples of a record, and of them within the run's time
_SHORTEST = 0.01  # of the run's time, of a record: it would fit anywhere
_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6}


@dataclass(frozen=True)
class Channel:
    """A column of the record, and its signal: at a station or support X, or of the first wheel."""

    column: str
    signal: str
    at: float | None
    #: 1, or -1 for a column that counts the other way.
    sign: float = 1.0

    @property
    def unit(self) -> str:
        """SI unit of the signal."""
        return (VARIABLES.get(self.signal) or SIGNALS[self.signal])[0]

    @property
    def label(self) -> str:
        """Signal and place."""
        where = "" if self.at is None else f" at {self.at:g} m"
        return f"{self.signal.replace('_', ' ')}{where}"

    def of(self, run: xr.Dataset) -> Array:
        """The signal (n,) of a run."""
        return at_station(run, self.signal, self.at)

    @property
    def reversed(self) -> str:
        """How the channel is written with the opposite sign."""
        where = "" if self.at is None else f" at {self.at:g} m"
        return f"{self.column} = {'-' if self.sign > 0.0 else ''}{self.signal}{where}"


@dataclass(frozen=True)
class Record:
    """What a file holds: times (n,) [s], and of each channel (c, n) in SI units."""

    time: Array
    values: Array


@dataclass(frozen=True)
class MeasuredRecord(Parameters):
    """A measured record, which is laid over the computed signals and compared by the same norms.

    ``channels = ["mid = station_displacement at 12.5 m"]`` says which column is which signal;
    ``"mid = -deck_strain at 12.5 m"`` is a column of the opposite sign.
    """

    file: Annotated[str, File(), "CSV file with the record; nothing is compared without"] = ""
    channels: Annotated[
        tuple[str, ...],
        'what its columns are, "COLUMN = SIGNAL" or "COLUMN = SIGNAL at X"; -SIGNAL if reversed',
    ] = ()  # fmt: skip
    unit: Annotated[str, 'unit of the channels, "mm" or "um/m"; SI if left out'] = ""
    time_column: Annotated[str, 'column with the time; "" for samples at a rate'] = "t"
    time_unit: Annotated[Literal["s", "ms", "us"], "its unit"] = "s"
    rate: Annotated[
        float | None, Unit("Hz"), Above(0), "samples a second, of a record without times"
    ] = None  # fmt: skip
    shift: Annotated[
        float | Literal["fitted"], Unit("s"),
        "added to the record's time; fitted by the largest correlation",
    ] = "fitted"  # fmt: skip
    scale: Annotated[
        float | Literal["fitted"], "of the computed signals; fitted by least squares"
    ] = 1.0  # fmt: skip
    zero: Annotated[
        Literal["recorded", "fitted"],
        "what gauges read without load: 0, or of each channel a constant, fitted with the scale",
    ] = "recorded"

    @property
    def used(self) -> bool:
        """Whether there is a record."""
        return bool(self.file)

    def problems(self, key: Naming) -> list[str]:
        """Channels that name no signal, of a wrong unit, or none; times that are not known."""
        problems = list[str]()
        if self.used and not self.channels:
            problems.append(f"{key('channels')}: is missing; say which column is which signal")
        if self.used and not self.time_column and self.rate is None:
            problems.append(f"{key('time_column')}: is missing; or give {key('rate')}")
        if self.rate is not None and self.time_column:
            allowed = f'applies only with {key("time_column")} = ""'
            problems.append(complaint(key("rate"), self.rate, allowed))
        if self.scale != "fitted" and self.scale == 0.0:
            problems.append(complaint(key("scale"), self.scale, 'must not be 0, or "fitted"'))
        return problems + [
            complaint(f"{key('channels')}.{k}", self.channels[k], why)
            for k, why in self._wrong_channels().items()
        ]

    def _wrong_channels(self) -> dict[int, str]:
        """Number of a channel -> what is wrong with it."""
        found = {}
        for k, text in enumerate(self.channels):
            try:
                factor(self.unit, _channel(text).unit)
            except UnitError as error:
                found[k] = str(error)
        if not found:
            names = [channel.column for channel in self.parsed]
            found = wrong_columns(self.time_column, names)
        return found

    @property
    def parsed(self) -> tuple[Channel, ...]:
        """The channels."""
        return tuple(_channel(text) for text in self.channels)

    def problems_on(
        self, journey: Journey, track: Track | None, vehicle: Vehicle | None = None
    ) -> list[str]:
        """Signals and places that a run lacks; a file that cannot be used; no common time."""
        if self._wrong_channels():
            return []  # complained about
        problems = [
            complaint(f"measured.channels.{k}", text, why)
            for k, (text, channel) in enumerate(zip(self.channels, self.parsed, strict=True))
            if (why := _lacking(channel, journey, track, vehicle))
        ]
        try:
            record = self.read()
        except InputError as error:
            return problems + [f"measured.file: {problem}" for problem in error.problems]
        duration = journey.n_steps * journey.time_step
        step = float(np.median(np.diff(record.time)))
        if duration < _FEWEST * step:
            problems.append(
                f"measured.file: {self.file}: its samples are {step:g} s apart (measured.time_unit"
                f" or measured.rate); the run of {duration:.4g} s needs {_FEWEST} of them at least"
            )
        lasts = float(np.ptp(record.time))
        if lasts < _SHORTEST * duration:
            problems.append(
                f"measured.file: {self.file}: lasts {lasts:.3g} s (measured.time_unit or "
                f"measured.rate); the run of {duration:.4g} s needs {100 * _SHORTEST:g} % of that "
                "at least"
            )
        if self.shift != "fitted":
            first, last = record.time[0] + self.shift, record.time[-1] + self.shift
            if first >= duration or last <= 0.0:
                problems.append(
                    f"measured.shift = {self.shift:g} s: the record then goes from {first:.4g} to "
                    f"{last:.4g} s and has no common time with the run, 0 to {duration:.4g} s"
                )
        return problems

    def read(self) -> Record:
        """The record in SI units.

        Raises
        ------
        InputError
            Listing everything that is wrong with the file.
        """
        return _read(self, changed(self.file))


@lru_cache(maxsize=4)
def _read(own: MeasuredRecord, changed: int) -> Record:
    """The record of a file as it was `changed` last."""
    columns = [channel.column for channel in own.parsed]
    named = [own.time_column] if own.time_column else []
    table, lines, problems = read_numbers(Path(own.file), [*named, *columns])
    if len(table) < _FEWEST:
        problems.append(f"{own.file}: {len(table)} rows of numbers; allowed: 3 or more")
    time = np.arange(len(table)) / own.rate if own.rate else table[:, 0]
    time = time * _SECONDS[own.time_unit]
    if not problems and np.any(falls := np.diff(time) <= 0.0):
        line = lines[1:][falls][0]
        problems.append(f"{own.file}, line {line}: the time does not increase")
    if not problems:
        problems += gaps(own.file, time, lines)
        for column, values in zip(columns, table[:, len(named) :].T, strict=True):
            problems += jumps_to_nothing(own.file, column, values, lines)
        problems += [
            f"{own.file}, column '{column}' is {values[0]:g} throughout; there is nothing to lay "
            "over a computed signal"
            for column, values in zip(columns, table[:, len(named) :].T, strict=True)
            if np.ptp(values) == 0.0
        ]
    if problems:
        raise InputError(problems)
    factors = [channel.sign * factor(own.unit, channel.unit) for channel in own.parsed]
    return Record(time, table[:, len(named) :].T * np.array(factors)[:, None])


def _lacking(
    channel: Channel, journey: Journey, track: Track | None, vehicle: Vehicle | None
) -> str:
    """What a run must have for a channel and has not; "" if nothing is missing."""
    name, at = channel.signal, channel.at
    if at is None or track is None:
        return ""
    bridge = track.structure
    if bridge is None and name != "station_displacement":
        return 'needs track.structure = "bridge"'
    planar = bridge is None or vehicle is None or planar_on(track, vehicle)
    if planar and name in IN_SPACE:
        return "needs a run in space, of a vehicle with lateral data"
    if name.startswith(ON_SUPPORTS):
        supports = [] if bridge is None else bridge.supports.tolist()
        places = supports[1:-1] if name.startswith("pier") else supports
        if name.startswith("pier") and bridge is not None and bridge.piers is None:
            return 'needs track.piers = "column"'
        if not any(abs(at - x) < 1e-6 for x in places):
            return f"needs the X of a support, {', '.join(f'{x:g}' for x in places)} m"
        return ""
    if not any(abs(at - x) < 1e-6 for x in journey.stations):
        return f"needs {at:g} m among journey.stations"
    decks = () if bridge is None else bridge.decks
    if name.startswith("deck_") and not any(ends[0] <= at <= ends[-1] for ends in decks):
        return "needs a place on a bridge's deck"
    return ""


def factor(unit: str, si: str) -> float:
    """From a unit to the SI unit; `UnitError` if they do not fit."""
    return to_si(f"1 {unit}", si if si != "1" else "") if unit else 1.0


def _channel(text: str) -> Channel:
    match = _CHANNEL.fullmatch(text.strip())
    if match is None:
        raise UnitError(_FORM)
    signal, at = match["signal"], match["at"]
    known = {**dict.fromkeys(POINT_SIGNALS), **VARIABLES}
    if signal not in known:
        hint = did_you_mean(signal, known)
        raise UnitError(f"there is no signal {signal}{hint}; allowed: {', '.join(known)}")
    if (signal in VARIABLES) != (at is not None):
        needs = "needs a place" if signal in VARIABLES else "has no place"
        raise UnitError(f"{signal} {needs}; {_FORM}")
    place, sign = None if at is None else to_si(at, "m"), -1.0 if match["sign"] else 1.0
    return Channel(match["column"].strip(), signal, place, sign)
