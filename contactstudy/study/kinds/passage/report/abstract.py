"""The abstract: sentences whose numbers and whose wording follow from the results."""

from collections.abc import Iterable

import numpy as np

from contactstudy.compare.signals import position, speed, values
from contactstudy.figures.irregularity import comparisons, irregularity_of
from contactstudy.figures.passing_components import all_passing
from contactstudy.figures.signals import fade_end
from contactstudy.plot.text import capital, exact, label, number
from contactstudy.report.quantity import grouped, percent
from contactstudy.study.kinds.passage.metrics import LEAST
from contactstudy.study.kinds.passage.report import rungs
from contactstudy.study.kinds.passage.report.metrics import between, of_run
from contactstudy.study.kinds.passage.report.tables import describe
from contactstudy.study.results import StudyResults

# Upper limits of the relative L2 error of the dynamic part, and what is said below each.
GRADES = (
    (0.01, "can hardly be told from it"),
    (0.05, "follows it closely"),
    (0.2, "follows it in the main, with visible differences"),
    (np.inf, "differs markedly from it"),
)


def grade(error: float) -> str:
    """Wording for a relative L2 error of the dynamic part."""
    return next(words for limit, words in GRADES if error < limit or limit == np.inf)


def abstract(results: StudyResults) -> list[str]:
    """Paragraphs of the abstract; what the study does not compare is not spoken of."""
    paragraphs = [_case(results)]
    if _errors(results):
        paragraphs += rungs.sentences(results) or [_verdict(results)]
        paragraphs.append(_cost(results))
    elif results.metrics["comparisons"]:
        paragraphs.append(
            "The contact force of the reference hardly changes as the wheel runs: its dynamic part "
            f"is below {100 * LEAST:g} % of it, next to which no error is given."
        )
    for companion in results.companions:
        paragraphs += list(_companion(companion))
    return [p for p in paragraphs if p]


def _case(results: StudyResults) -> str:
    if not results.runs:
        return _irregularity(results)
    run = results.runs[results.reference or next(iter(results.runs))]
    x = position(run)
    count = len(results.runs)
    text = (
        f"{capital(_count(count))} model{'s' if count > 1 else ''} of a wheel rolling on a rail "
        f"{'are' if count > 1 else 'is'} run over the same track, with the same vehicle, the same "
        f"irregularity and the same time stepper, from X = {exact(x[0])} to {exact(x[-1])} m "
        f"at {exact(round(speed(run) * 3.6, 3))} km/h."
    )
    r = values(run, "irregularity") if "irregularity" in run else np.zeros(1)
    if np.any(r):
        text += f" The irregularity under the wheel has a range of {number(np.ptp(r) * 1e3)} mm."
    force = values(run, "contact_force")
    after = force[x >= fade_end(results)]
    whose = "of the reference " if results.reference else ""
    text += (
        f" The contact force {whose}is {number(force[0] * 1e-3)} kN at rest and lies between "
        f"{number(after.min() * 1e-3)} and {number(after.max() * 1e-3)} kN in motion."
    )
    lost = [
        label(n)
        for n, d in results.runs.items()
        if np.any(values(d, "contact_force")[position(d) >= fade_end(results)] <= 0.0)
    ]
    text += f" Contact is lost at times in {_listing(lost)}." if lost else " Contact is never lost."
    return text


def _irregularity(results: StudyResults) -> str:
    """What a study without runs is about."""
    info = irregularity_of(results)
    text = "This study has no runs; it shows a rail irregularity."
    if info.profile is not None:
        x, r = info.profile.position, info.profile.level * 1e3
        text += (
            f" Over {exact(float(x[-1] - x[0]), 3)} m the profile ({info.profile.label}) has a "
            f"root mean square of {number(float(np.std(r)))} mm and a range of "
            f"{number(float(np.ptp(r)))} mm."
        )
    return " ".join([text, *comparisons(info)])


def _errors(results: StudyResults) -> dict[str, tuple[float, float, float]]:
    """Run -> errors of its contact force: relative total, relative dynamic, largest in N."""
    found = {}
    for name in results.runs:
        errors = between(results, name, "contact_force")
        if errors and errors.get("relative_l2_dynamic") is not None:
            found[name] = (
                float(errors["relative_l2"]),
                float(errors["relative_l2_dynamic"]),
                float(errors["linf"]),
            )
    return found


def _verdict(results: StudyResults) -> str:
    errors = _errors(results)
    ordered = sorted(errors, key=lambda name: errors[name][1])
    papers = papers_scheme(results)
    told = [papers] if papers in errors else []
    told += [name for name in dict.fromkeys((ordered[0], ordered[-1])) if name not in told]
    text = f"The reference is the run {_model(results, str(results.reference))}."
    for name in told:
        total, dynamic, largest = errors[name]
        if name == papers:
            text += f" The contact force of the paper's scheme, the run {_model(results, name)},"
        elif len(errors) == 1:
            text += f" The contact force of the run {_model(results, name)}"
        else:
            rank = "lowest" if name == ordered[0] else "highest"
            text += (
                f" The {rank} error is that of the run {_model(results, name)}, whose contact force"
            )
        text += (
            f" {grade(dynamic)}: the relative L₂ error is {percent(dynamic)} % of the dynamic "
            f"part, {percent(total)} % of the total force, and the forces are at most "
            f"{number(largest * 1e-3)} kN apart."
        )
    rest = [f"{percent(errors[n][1])} % (“{label(n)}”)" for n in ordered if n not in told]
    if rest:
        others = "runs" if len(rest) > 1 else "run"
        text += f" In the other {others} the error of the dynamic part is {_listing(rest)}."
    return text


def papers_scheme(results: StudyResults) -> str | None:
    """Name of the run that is the paper's: Euler beam, constant k_r given as a number."""
    for name, run in results.config.get("runs", {}).items():
        linear = run.get("solver") == "point" and run.get("law") == "linear"
        if linear and run.get("rail") == "euler" and isinstance(run.get("k_r"), int | float):
            return str(name)
    return None


def _model(results: StudyResults, name: str) -> str:
    rail, contact = describe(results, name)
    return f"“{label(name)}” (contact: {contact}; rail: {rail})"


def _cost(results: StudyResults) -> str:
    reference = str(results.reference)
    theirs = int(of_run(results, reference)["dofs"])
    ours = [int(of_run(results, name)["dofs"]) for name in _errors(results)]
    low, high = min(ours), max(ours)
    span = grouped(low) if low == high else f"{grouped(low)} to {grouped(high)}"
    return (
        f"The reference has {grouped(theirs)} degrees of freedom, the runs compared with it "
        f"{span}. All error figures are this program's own; none is the paper's."
    )


def _companion(results: StudyResults) -> Iterable[str]:
    found = all_passing(results)
    if found:
        parts = [f"{number(p.percent(1), 2)} % ({label(name)})" for name, p in found.items()]
        yield (
            "On a smooth rail the contact force changes as the wheel passes the sleepers, with an "
            f"amplitude of {_listing(parts)} of the static load."
        )


def _listing(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _count(n: int) -> str:
    words = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
    return words[n] if n < len(words) else str(n)
