"""Random studies on which the promise of an advice is tried: it must hold on one more sample."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from contactstudy.advice.advise import MEASURES, Advice, advise
from contactstudy.advice.trials import Trials
from contactstudy.exceptions import ContactStudyError
from contactstudy.reporter import Reporter
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.vehicle.lumped import GRAVITY

LISTS: Mapping[str, tuple[Any, ...]] = {
    "track.spacing": ("0.55 m", "0.6 m", "0.65 m", "0.7 m"),
    "vehicle.type": ("bare_wheel", "wheel_column"),
    "irregularity.spectrum": ("paper", "german_low", "german_high", "fra4", "fra6", "tbt3352"),
    "bound": (0.03, 0.05, 0.1, 0.2),
}
"""Values of which one is drawn. A cell of rail is condensed for each spacing."""
RANGES: Mapping[str, tuple[str, float, float]] = {
    "track.pad_stiffness": ("MN/m", 30.0, 300.0),
    "track.pad_damping": ("kN*s/m", 15.0, 90.0),
    "track.ballast_stiffness": ("MN/m", 40.0, 250.0),
    "track.ballast_damping": ("kN*s/m", 20.0, 120.0),
    "vehicle.wheel_mass": ("kg", 500.0, 900.0),
    "wheel load": ("kN", 40.0, 125.0),
    "journey.speed": ("km/h", 60.0, 330.0),
    "shortest wave": ("m", 0.1, 0.6),
}
"""Unit and ends of what is drawn uniformly on the logarithmic scale; the seed is below a million.

The longest wave is 6 m. The time step is a twentieth of the shortest wave, at most 250 us; the
mesh has 4 mm, the journey a fade-in over two bays and nine more.
"""
_LONGEST_WAVE, _LONGEST_STEP, _STEPS_A_WAVE = 6.0, 250e-6, 20
_OTHER = 500_000  # between the seeds of the study and of the check, far beyond the samples
SHARE = 0.95
"""Of the promises, which must be kept."""


@dataclass(frozen=True)
class Draw:
    """A random study, what was promised for it, and the error on another sample; or a failure."""

    number: int
    values: Mapping[str, Any]
    bound: float
    advice: Advice | None = None
    error: float = float("nan")
    failure: str = ""

    @property
    def promised(self) -> bool:
        """Whether there is a scheme."""
        return self.advice is not None and self.advice.answer is not None

    @property
    def held(self) -> bool:
        """Whether the promise was kept."""
        return self.promised and self.error <= self.bound


def drawn(number: int) -> tuple[dict[str, Any], float]:
    """Tables of the random study of a number, and the bound that is asked for."""
    rng = np.random.default_rng(number)
    one = {key: choices[rng.integers(len(choices))] for key, choices in LISTS.items()}
    of = {
        key: float(np.exp(rng.uniform(math.log(low), math.log(high))))
        for key, (_, low, high) in RANGES.items()
    }
    seed = int(rng.integers(1, _OTHER))
    bay = float(one["track.spacing"].split()[0])
    load, mass = 1e3 * of["wheel load"], of["vehicle.wheel_mass"]
    speed, wave = of["journey.speed"] / 3.6, of["shortest wave"]
    vehicle: dict[str, Any] = {"type": one["vehicle.type"], "wheel_mass": mass}
    if vehicle["type"] == "bare_wheel":
        vehicle["static_load"] = load
    else:
        bogie = 0.1 * load / GRAVITY
        vehicle |= {"bogie_mass": bogie, "car_mass": load / GRAVITY - mass - bogie}
    track = {
        key.partition(".")[2]: f"{value:.6g} {RANGES[key][0]}"
        for key, value in of.items()
        if key.startswith("track.")
    }
    tables = {
        "irregularity": {
            "spectrum": one["irregularity.spectrum"],
            "seed": seed,
            "band": [2.0 * math.pi / _LONGEST_WAVE, 2.0 * math.pi / wave],
        },
        "track": track | {"spacing": one["track.spacing"], "length": 16 * bay},
        "vehicle": vehicle,
        "journey": {
            "from": 2 * bay,
            "to": 13 * bay,
            "fade_in": 2 * bay,
            "speed": speed,
            "time_step": min(_LONGEST_STEP, wave / (_STEPS_A_WAVE * speed)),
        },
        "solid": {"mesh_size": "4 mm"},
    }
    return tables, one["bound"]


def draws(
    count: int, first: int, folder: Path, workers: int = 1, reporter: Reporter | None = None
) -> Iterator[Draw]:
    """Ask for advice on random studies, and try it on another sample; one after the other."""
    for number in range(first, first + count):
        tables, bound = drawn(number)
        made = Draw(number, tables, bound)
        try:
            study = parse_study(f"draw_{number}", tables)
            yield _tried(made, study, folder, workers, reporter)
        except ContactStudyError as error:
            yield replace(made, failure=str(error).splitlines()[0])


def _tried(made: Draw, study: Study, folder: Path, workers: int, reporter: Reporter | None) -> Draw:
    advice = advise(study, made.bound, folder, "dynamic", workers, reporter)
    if advice.answer is None:
        return replace(made, advice=advice)
    table = study.irregularity
    other = replace(study, irregularity=replace(table, seed=table.seed + _OTHER))
    trials = Trials.of(other, MEASURES["dynamic"][0], folder, workers, reporter)
    name = advice.answer.name
    runs, failures = trials.run({name: advice.answer.scheme})
    if failures:
        return replace(made, advice=advice, failure=failures[name])
    return replace(made, advice=advice, error=trials.error(runs[name], runs[trials.REFERENCE]))
