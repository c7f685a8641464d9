"""The cheapest point scheme that keeps a bound: chosen on one sample, proven on another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from contactstudy.advice.reasons import Waves, waves
from contactstudy.advice.samples import Samples, Varied, samples
from contactstudy.advice.schemes import FAMILIES, Scheme, schemes
from contactstudy.advice.trials import Trials
from contactstudy.exceptions import InputError
from contactstudy.reporter import Reporter
from contactstudy.study.kind import Study
from contactstudy.study.kinds.passage.schema import Study as Passage
from contactstudy.study.loading import base_of
from contactstudy.validation import complaint, raise_if

MEASURES: Mapping[str, tuple[str, str]] = {
    "dynamic": ("dynamic", "the dynamic part of the contact force"),
    "total": ("total", "the contact force"),
}
"""Which error is bounded -> the part of the force, and what it is called."""
_GROUP = 8  # schemes that are tried at once


@dataclass(frozen=True)
class Tried:
    """A scheme and what became of it.

    Attributes
    ----------
    dofs, steps : int
    seconds : float
        What it takes, about: by this schemes are ordered.
    error : float
        Relative, on the study's own sample; nan where it failed.
    expected, limit : float or None
        Mean over samples, and what the error on another sample stays below; None where it was
        out of the question already.
    proof : float or None
        Error on the other sample.
    waves : Waves or None
        Where most of the error lies.
    failure : str
        Why it could not be run.
    """

    name: str
    scheme: Scheme
    dofs: int
    steps: int
    seconds: float
    error: float = float("nan")
    expected: float | None = None
    limit: float | None = None
    proof: float | None = None
    waves: Waves | None = None
    failure: str = ""


@dataclass(frozen=True)
class Advice:
    """What was found.

    Attributes
    ----------
    tried : tuple of Tried
        From the cheapest to the answer, or to the dearest where there is none.
    answer : Tried or None
    reference_error : float
        Of surface contact itself, by a coarser mesh and time step.
    reference_seconds : float
        What surface contact takes, about.
    samples : tuple of str
        What the study's own sample and the one of the proof are called; empty if there is one.
    lost : float
        Share of the way on which surface contact loses contact.
    time_step : float
        Of the journey [s].
    stiffness : float
        Of the answer's contact at the static load [N/m]; nan without one.
    patch : float
        Length over which its filter averages [m], 0 without.
    """

    study: str
    bound: float
    measure: str
    tried: tuple[Tried, ...]
    answer: Tried | None
    reference_error: float
    reference_seconds: float
    samples: tuple[str, ...]
    lost: float
    time_step: float
    stiffness: float = float("nan")
    patch: float = 0.0

    def best(self, family: str) -> Tried | None:
        """The most accurate scheme of a family that was tried."""
        own = [t for t in self.tried if t.scheme.family == family and t.error == t.error]
        return min(own, key=lambda t: t.error, default=None)


def advise(
    study: Study,
    bound: float,
    folder: Path,
    measure: str = "dynamic",
    workers: int = 2,
    reporter: Reporter | None = None,
) -> Advice:
    """Find the cheapest point scheme whose force error stays below a bound.

    The schemes of `contactstudy.advice.schemes` run over the study's own track and irregularity,
    the cheapest first; the study's own runs and axes are left out. The first one is taken whose
    error against surface contact with a modal wheel, with what it may be on another sample
    (`contactstudy.advice.samples`) and with the reference's own error, stays below the bound, and
    which keeps it on another sample too.

    Parameters
    ----------
    study : Study
        A passage; of one with axes its base.
    bound : float
        Relative L2 error of the contact force, against surface contact behind the fade-in.
    folder : Path
        Where finished runs are kept.
    measure : str
        A key of `MEASURES`.

    Raises
    ------
    InputError
        For a study of another kind, a bound outside 0..1, or a force without the part measured.
    NumericalError
        When surface contact broke down.
    """
    base = base_of(study)
    problems = []
    if not 0.0 < bound < 1.0:
        problems.append(complaint("bound", bound, "must lie between 0 and 1 (5 % is 0.05)"))
    if measure not in MEASURES:
        problems.append(complaint("measure", measure, f"must be one of: {', '.join(MEASURES)}"))
    if not isinstance(base, Passage):
        problems.append(f"study {study.name}: must be a passage, with a journey over a track")
    raise_if(problems)
    assert isinstance(base, Passage)
    trials = Trials.of(base, MEASURES[measure][0], folder, workers, reporter)
    doubt = trials.reference_error()
    if doubt != doubt:
        raise InputError(
            f"study {study.name}: {MEASURES[measure][1]} is zero: there is nothing to compare"
        )
    over, tried, answer = samples(base), list[Tried](), None
    order = _by_cost(trials, schemes(base.journey.time_step))
    for k in range(0, len(order) if doubt < bound else 0, _GROUP):
        answer = _first(trials, order[k : k + _GROUP], bound - doubt, over, tried)
        if answer is not None:
            break
    table = {} if answer is None else trials.contact(answer.name, answer.scheme)
    return Advice(
        study.name,
        bound,
        measure,
        tuple(tried),
        answer,
        doubt,
        trials.seconds(),
        () if over is None else (over.label(0), over.label(1)),
        trials.lost(),
        base.journey.time_step,
        **table,
    )


def _first(
    trials: Trials, group: list[Tried], within: float, over: Samples | None, tried: list[Tried]
) -> Tried | None:
    """The first scheme of a group that stays within a bound; all that were tried are noted."""
    runs, failures = trials.run({t.name: t.scheme for t in group})
    reference = runs[trials.REFERENCE]
    found = [
        replace(t, failure=failures[t.name])
        if t.name in failures
        else replace(
            t,
            error=trials.error(runs[t.name], reference),
            waves=waves(runs[t.name], reference, trials.start),
        )
        for t in group
    ]
    good = {t.name: t.scheme for t in found if t.error <= within}
    varied = trials.differences(good, over) if over is not None and good else {}
    for one in found:
        checked = one
        if one.name in varied and over is not None:
            checked = _elsewhere(trials, one, within, over, varied[one.name])
        tried.append(checked)
        sure = (checked.error, *(e for e in (checked.limit, checked.proof) if e is not None))
        if all(e <= within for e in sure):
            return checked
    return None


def _elsewhere(trials: Trials, one: Tried, within: float, over: Samples, varied: Varied) -> Tried:
    """A scheme with what its error may be on other samples, and is on the next one."""
    errors, proof = [one.error], None
    if varied.limit(errors) <= within:
        proof = trials.proof(one.name, one.scheme, over)
        errors.append(proof)
    return replace(one, expected=varied.expected(errors), limit=varied.limit(errors), proof=proof)


def _by_cost(trials: Trials, found: Mapping[str, Scheme]) -> list[Tried]:
    """Schemes from the cheapest on, of equally dear ones the simpler first."""
    sized = [
        Tried(name, scheme, *size)
        for name, scheme in found.items()
        if (size := trials.size(name, scheme)) is not None
    ]
    families = list(FAMILIES)
    return sorted(sized, key=lambda t: (t.seconds, families.index(t.scheme.family)))


def read_bound(text: str) -> float:
    """A share given as "5 %" or 0.05."""
    number, percent, rest = text.partition("%")
    try:
        value = float(number) / (100.0 if percent else 1.0)
    except ValueError:
        value = float("nan")
    if rest.strip() or not 0.0 < value < 1.0:
        raise InputError(complaint("bound", text, 'must lie between 0 and 100 %, as "5 %" or 0.05'))
    return value
