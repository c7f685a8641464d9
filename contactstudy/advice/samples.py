"""Other samples of a study's irregularity, and what they say of the error of a scheme.

Surface contact is dear, so that it runs on one or two samples. How much the error of a scheme
varies from sample to sample is learnt from point runs alone: with E the error against surface
contact and A the difference from another point scheme, which are both made by what the scheme
lacks, ::

    ln E = ln A + d

A is known of many samples, d of those that surface contact ran on too. Of one more sample
ln E stays with a confidence c below ``mean(ln A) + mean(d) + t s sqrt(1 + 1/n)``: s is the
standard deviation of n values ln A, t Student's quantile of c for n - 1 degrees of freedom (a
prediction interval, e.g. NIST/SEMATECH e-Handbook of Statistical Methods, sec. 7.2.2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.driver import compute_study
from contactstudy.reporter import Reporter
from contactstudy.study.axes.design import Design
from contactstudy.study.axes.series import Series
from contactstudy.study.axes.swept import Source, Swept
from contactstudy.study.kind import find_kind
from contactstudy.study.kinds.passage.schema import Study

CONFIDENCE = 0.95
"""That the error on one more sample stays below the limit."""
SAMPLES = 8
"""Samples, the study's own among them, on which point runs show how an error varies."""


@dataclass(frozen=True)
class Samples:
    """Samples of one irregularity: values of a key, the study's own first."""

    key: str
    values: tuple[Any, ...]

    def of(self, study: Study, k: int) -> Study:
        """The study on the sample number k."""
        name = self.key.partition(".")[2]
        return replace(study, irregularity=replace(study.irregularity, **{name: self.values[k]}))

    def label(self, k: int) -> str:
        """What the sample number k is called: "seed 2"."""
        value = self.values[k]
        text = f"{value:g} m" if isinstance(value, float) else f"{value}"
        return f"{self.key.partition('.')[2]} {text}"


def samples(study: Study) -> Samples | None:
    """Other seeds, or other stretches of a measured level; None where there is one sample only."""
    table, journey = study.irregularity, study.journey
    if table.generated:
        return Samples("irregularity.seed", tuple(table.seed + k for k in range(SAMPLES)))
    if table.spectrum != "measured":
        return None
    low, high = table.profile().domain
    length = journey.end - journey.start
    # the domain moves with the origin: stretches on both sides of the study's own
    number = range(-int((journey.start - low) / length), int((high - journey.end) / length) + 1)
    shifts = sorted(number, key=lambda k: (abs(k), -k))[:SAMPLES]
    found = tuple(table.origin + k * length for k in shifts)
    return Samples("irregularity.origin", found) if len(found) > 1 else None


@dataclass(frozen=True)
class _Moved(Source):
    """Makes the variants of a study on other samples."""

    study: Any = None
    samples: Any = None

    def load(self, values: Mapping[str, Any]) -> Any:
        """As in `Source`; without values the study itself."""
        if not values:
            return self.study
        return self.samples.of(self.study, self.samples.values.index(values[self.samples.key]))


@dataclass(frozen=True)
class Varied:
    """Differences A of a scheme from another one, on all samples; nan where one failed."""

    differences: tuple[float, ...]

    def expected(self, errors: Sequence[float]) -> float:
        """Geometric mean over samples of the error, of which the first ones are given."""
        logs, shift = self._logs(errors)
        return float(np.exp(logs.mean() + shift)) if len(logs) else errors[0]

    def limit(self, errors: Sequence[float], confidence: float = CONFIDENCE) -> float:
        """What the error on one more sample stays below.

        Infinite from fewer than three samples; at least the largest error given.
        """
        from scipy.special import stdtrit

        logs, shift = self._logs(errors)
        n = len(logs)
        if n < 3:
            return float("inf")
        wide = stdtrit(n - 1, confidence) * logs.std(ddof=1) * np.sqrt(1.0 + 1.0 / n)
        return float(max(np.exp(logs.mean() + shift + wide), *errors))

    def _logs(self, errors: Sequence[float]) -> tuple[Array, float]:
        """All ln A, and the mean of ln E - ln A; nothing where none of these is known."""
        made, known = np.array(self.differences), np.array(errors)
        good = np.isfinite(made) & (made > 0.0)
        both = good[: len(known)] & (known > 0.0)
        if not both.any():
            return np.zeros(0), 0.0
        shift = np.log(known[both]) - np.log(made[: len(known)][both])
        return np.log(made[good]), float(shift.mean())


def varied(
    study: Study, over: Samples, part: str, folder: Path, reporter: Reporter | None = None
) -> dict[str, Varied]:
    """How far each point run's force is from the reference's on all samples, in this process.

    The study has point runs only; `part` of the force is total or dynamic.
    """
    series = {over.key: Series(over.values, tuple(map(float, over.values)))}
    source = _Moved(find_kind(study.kind), Path(study.name), {}, study=study, samples=over)
    swept = Swept.of(study, (Design("sweep", series),), source)
    results = compute_study(swept, folder, 1, reporter, here=True)
    found = results.designs["sweep"]["relative_l2"].sel(signal="contact_force", part=part)
    return {
        str(run): Varied(tuple(map(float, found.sel(run=run).values)))
        for run in found["run"].values
    }
