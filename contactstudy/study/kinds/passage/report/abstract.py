"""The abstract: sentences whose numbers and whose wording follow from the results."""

from collections.abc import Iterable

import numpy as np

from contactstudy.compare.signals import is_moving_force, position, speed, values
from contactstudy.figures.irregularity import comparisons, irregularity_of
from contactstudy.figures.passing_components import all_passing
from contactstudy.figures.signals import fade_end, others
from contactstudy.plot.text import between as range_of
from contactstudy.plot.text import capital, exact, label, listing, number
from contactstudy.report.quantity import grouped, percent
from contactstudy.study.kinds.passage.report import lost, rungs
from contactstudy.study.kinds.passage.report.conclusion import conclusion
from contactstudy.study.kinds.passage.report.deck_table import deck_sentences
from contactstudy.study.kinds.passage.report.measured_table import measured_sentences
from contactstudy.study.kinds.passage.report.metrics import between, of_run
from contactstudy.study.kinds.passage.report.naming import OUR_READING, model, papers_scheme
from contactstudy.study.results import StudyResults

# Upper limits of the relative L2 error of the dynamic part, and what is said below each.
GRADES = (
    (0.01, "is nearly indistinguishable from it"),
    (0.05, "follows it closely"),
    (0.2, "follows it, with visible differences"),
    (np.inf, "differs markedly from it"),
)


_WHEEL = ("a wheel rolling on a rail", "")
_TRAIN = ("a train rolling on rails", " its leading wheel")
_VEHICLES = {
    "bogie": ("a bogie rolling on a rail", " its leading wheel"),
    **dict.fromkeys(("train", "axle_loads", "hslm", "freight_wagons"), _TRAIN),
}
"""Vehicle -> what rolls, and whose positions are told; all others are a wheel."""


def grade(error: float) -> str:
    """Wording for a relative L2 error of the dynamic part."""
    return next(words for limit, words in GRADES if error < limit or limit == np.inf)


def abstract(results: StudyResults) -> list[str]:
    """Paragraphs of the abstract; what the study does not compare is not spoken of."""
    paragraphs = [_case(results), *deck_sentences(results), *measured_sentences(results)]
    if _errors(results):
        paragraphs += rungs.sentences(results) or [_verdict(results)]
        paragraphs.append(_cost(results))
    elif len(results.runs) == 1:
        paragraphs.append(_patch(results) or "With one run there is nothing to compare.")
    for companion in results.companions:
        paragraphs += list(_companion(companion))
    return [p for p in paragraphs if p]


def _case(results: StudyResults) -> str:
    if not results.runs:
        return _irregularity(results)
    run = results.runs[results.reference or next(iter(results.runs))]
    x = position(run)
    count = len(results.runs)
    same = " with the same vehicle, irregularity and time stepper," if count > 1 else ""
    who, led = _VEHICLES.get(results.config.get("vehicle", {}).get("type", ""), _WHEEL)
    bridge = results.config.get("track", {}).get("structure") == "bridge"
    where = "bridge" if bridge else "track"
    told = [
        f"{capital(_count(count))} model{'s' if count > 1 else ''} of {who} "
        f"run{'' if count > 1 else 's'} over {'one' if count > 1 else 'the'} {where},{same}{led} "
        f"from X = {exact(x[0])} to {exact(x[-1])} m at {exact(round(speed(run) * 3.6, 3))} km/h."
    ]
    r = values(run, "irregularity") if "irregularity" in run else np.zeros(1)
    if np.any(r):
        told.append(
            f"The irregularity under the wheel has a range of {number(np.ptp(r) * 1e3)} mm."
        )
    else:
        told.append("The irregularity is zero: the rail is smooth.")
    force = values(run, "contact_force")
    after = force[x >= fade_end(results)]
    whose = "of the reference " if results.reference else ""
    told.append(
        f"The contact force {whose}is {number(force[0] * 1e-3)} kN at rest and "
        f"{range_of(after.min() * 1e-3, after.max() * 1e-3)} kN in motion."
    )
    return " ".join([*told, *_other_way(results), *lost.sentences(results)])


def _patch(results: StudyResults) -> str:
    """Area and peak pressure of the one run, if it has a patch."""
    (run,) = results.runs.values()
    if not {"contact_area", "peak_pressure"} <= set(run.variables):
        return ""
    after = position(run) >= fade_end(results)
    area, peak = (values(run, name)[after] for name in ("contact_area", "peak_pressure"))
    return (
        f"The area of the contact patch {range_of(1e6 * area.min(), 1e6 * area.max())} mm², its "
        f"peak pressure {range_of(1e-6 * peak.min(), 1e-6 * peak.max())} MPa."
    )


def _other_way(results: StudyResults) -> list[str]:
    """Which runs are not compared with the reference, and why."""
    if results.reference not in results.runs:
        return []
    known = [results.reference, *others(results)]
    apart = [f"“{label(name)}”" for name in results.runs if name not in known]
    if not apart:
        return []
    verbs = ("travel", "are") if len(apart) > 1 else ("travels", "is")
    return [f"{listing(apart)} {verbs[0]} the other way and {verbs[1]} not compared."]


def _irregularity(results: StudyResults) -> str:
    """What a study without runs is about."""
    info = irregularity_of(results)
    told = "This study has no runs; it shows a rail irregularity."
    if info.profile is not None:
        x, r = info.profile.position, info.profile.level * 1e3
        told += (
            f" Over {exact(float(x[-1] - x[0]), 3)} m the profile ({info.profile.label}) has a "
            f"root mean square of {number(float(np.std(r)))} mm and a range of "
            f"{number(float(np.ptp(r)))} mm."
        )
    return " ".join([told, *comparisons(info)])


def _errors(results: StudyResults) -> dict[str, tuple[float, float | None, float]]:
    """Run -> errors of its contact force: relative total, relative dynamic, largest in N."""
    found = {}
    for name, run in results.runs.items():
        if is_moving_force(run):  # which is constant
            continue
        errors = between(results, name, "contact_force")
        if errors and errors.get("relative_l2") is not None:
            dynamic = errors.get("relative_l2_dynamic")
            found[name] = (float(errors["relative_l2"]), dynamic, float(errors["linf"]))
    return found


def _verdict(results: StudyResults) -> str:
    told = [f"The reference is the run {model(results, str(results.reference))}."]
    dynamic = {n: (t, d, top) for n, (t, d, top) in _errors(results).items() if d is not None}
    if len(dynamic) < len(_errors(results)):
        return " ".join([*told, *_nothing_dynamic(results)])
    ordered = sorted(dynamic, key=lambda name: dynamic[name][1])
    papers = papers_scheme(results)
    shown = [papers] if papers in dynamic else []
    shown += [name for name in dict.fromkeys((ordered[0], ordered[-1])) if name not in shown]
    told += [_told(results, name, *dynamic[name], rank=_rank(ordered, name)) for name in shown]
    rest = [f"{percent(dynamic[n][1])} % (“{label(n)}”)" for n in ordered if n not in shown]
    if rest and not conclusion(results):  # whose table has them
        others = "runs" if len(rest) > 1 else "run"
        told.append(f"In the other {others} the error of the dynamic part is {listing(rest)}.")
    return " ".join(told)


def _rank(ordered: list[str], name: str) -> str:
    if len(ordered) == 1:
        return ""
    return {ordered[0]: "lowest", ordered[-1]: "highest"}.get(name, "")


def _told(
    results: StudyResults, name: str, total: float, error: float, largest: float, rank: str
) -> str:
    """How far one run is from the reference."""
    if name == papers_scheme(results):
        ours = f"{OUR_READING}, the run {model(results, name)}, with our k_r = 1e11 N/m,"
        return (
            f"The contact force of {ours} {grade(error)}: the relative L₂ error is "
            f"{percent(error)} % of the dynamic part, {percent(total)} % of the total force, and "
            f"the forces are at most {number(largest * 1e-3)} kN apart."
        )
    who = f"The contact force of “{label(name)}”"
    if rank:
        who = f"The {rank} error is that of “{label(name)}”, whose contact force"
    return (
        f"{who} {grade(error)}: {percent(error)} % of the dynamic part, {percent(total)} % of the "
        f"total, at most {number(largest * 1e-3)} kN apart."
    )


def _nothing_dynamic(results: StudyResults) -> list[str]:
    """Errors of the total force alone, where the reference has next to no dynamic part."""
    part = results.metrics.get("dynamic_part", {})
    size = f", {percent(part['of_static'])} % of the static load" if part else ""
    parts = [f"{percent(total)} % (“{label(n)}”)" for n, (total, _, _) in _errors(results).items()]
    return [
        f"The dynamic part of its contact force is too small to compare{size} (root mean square): "
        "an error relative to it would say nothing, and is not given.",
        f"Of the total force the relative L₂ error is {listing(parts)}.",
    ]


def _cost(results: StudyResults) -> str:
    reference = str(results.reference)
    theirs = int(of_run(results, reference)["dofs"])
    ours = [int(of_run(results, name)["dofs"]) for name in _errors(results)]
    low, high = min(ours), max(ours)
    models = "models" if len(ours) > 1 else "model"
    span = grouped(low) if low == high else f"{grouped(low)} to {grouped(high)}"
    return (
        f"The reference has {grouped(theirs)} degrees of freedom, the {models} compared with "
        f"it {span}. "
        "All error figures are ours, not the paper's."
    )


def _companion(results: StudyResults) -> Iterable[str]:
    found = all_passing(results)
    if found:
        parts = [f"{number(p.percent(1), 2)} % ({label(name)})" for name, p in found.items()]
        yield (
            "On a smooth rail the contact force changes as the wheel passes the sleepers, with an "
            f"amplitude of {listing(parts)} of the static load."
        )


def _count(n: int) -> str:
    words = (
        "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
        "eleven", "twelve",
    )  # fmt: skip
    return words[n] if n < len(words) else str(n)
