"""Print an advice: the answer with its numbers, the reasons, the schemes tried, the run to copy."""

from itertools import pairwise
from math import pi

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from contactstudy.advice.advise import MEASURES, Advice, Tried
from contactstudy.advice.draws import LISTS, RANGES, Draw
from contactstudy.advice.samples import CONFIDENCE
from contactstudy.advice.schemes import FAMILIES
from contactstudy.plot.text import number


def print_advice(advice: Advice, console: Console) -> None:
    """Print all of it."""
    console.print(headline(advice), markup=False, highlight=False)
    if advice.answer is not None:
        console.print(_properties(advice, advice.answer))
    for sentence in reasons(advice):
        console.print(sentence, markup=False, highlight=False)
    if advice.tried:
        console.print(_front(advice))
    if advice.answer is not None:
        console.print(advice.answer.scheme.toml(), markup=False, highlight=False)


def headline(advice: Advice) -> str:
    """The answer in one sentence."""
    wanted = f"{_percent(advice.bound)} of {MEASURES[advice.measure][1]}"
    if advice.answer is not None:
        return f"The cheapest scheme that keeps {wanted}: {advice.answer.scheme.words}."
    if not advice.tried:
        return (
            f"No advice within {wanted}: surface contact itself is only known to "
            f"{_percent(advice.reference_error)}. Choose a finer solid.mesh_size or time step."
        )
    return f"No point scheme keeps {wanted}. Surface contact itself is needed."


def reasons(advice: Advice) -> list[str]:
    """Why nothing cheaper will do, and what the numbers rest on."""
    told = []
    for name, family in FAMILIES.items():
        best = advice.best(name)
        if best is None or best is advice.answer:
            continue
        if advice.answer is not None and best.seconds > advice.answer.seconds:
            continue
        text = f"Not enough: {family.words}, {_percent(best.error)} off"
        if best.limit is not None and best.error <= advice.bound:
            text += f", up to {_percent(best.limit)} on other samples"
        if best.waves is not None:
            w = best.waves
            text += (
                f"; {100 * w.share:.0f} % of that in waves of {_length(w.shortest)} to "
                f"{_length(w.longest)}"
            )
        told.append(f"{text}. {_why(advice, name)}.")
    failed = [t for t in advice.tried if t.failure]
    if failed:
        told.append(f"{len(failed)} schemes could not be run; the first: {failed[0].failure}")
    if advice.lost > 0.0:
        told.append(
            f"Surface contact loses contact over {_percent(advice.lost)} of the way: schemes with "
            "a linear spring lift off at another place."
        )
    told.append(_basis(advice))
    return told


def _why(advice: Advice, family: str) -> str:
    names, answer = list(FAMILIES), advice.answer
    if answer is not None and names.index(family) > names.index(answer.scheme.family):
        return "It has more in it than the answer, but its mesh or its time step is too coarse"
    return f"What it leaves out most of all: {cause(advice, family)}"


def cause(advice: Advice, family: str) -> str:
    """What a family leaves out that makes most of its error.

    The families add one thing after the other: what takes the largest part of the mean square of
    the error, of those that were tried.
    """
    names = list(FAMILIES)
    errors = {n: t.error for n in names[names.index(family) :] if (t := advice.best(n)) is not None}
    drops = {a: errors[a] ** 2 - errors[b] ** 2 for a, b in pairwise(errors)}
    return FAMILIES[max(drops, key=lambda n: drops[n]) if drops else family].lacks


def _basis(advice: Advice) -> str:
    text = (
        "Errors are relative to surface contact with a modal wheel, behind the fade-in. Its own "
        f"error, by a coarser mesh and time step, is {_percent(advice.reference_error)} and "
        "counts against the bound."
    )
    if not advice.samples:
        return f"{text} There is one sample of this irregularity: the answer holds on it."
    return (
        f"{text} Chosen on {advice.samples[0]}; what the error of a scheme stays below on "
        f"{_percent(CONFIDENCE)} of other samples comes from point runs on "
        "further ones; proven by surface contact "
        f"on {advice.samples[1]}."
    )


def _properties(advice: Advice, answer: Tried) -> Table:
    table = Table(box=SIMPLE, show_header=False)
    run = answer.scheme.table
    held = {"linear": "constant", "press": "tangent of the press's curve at the static load"}
    rows = {
        "k_r": f"{1e-9 * advice.stiffness:.4g}e9 N/m ({held[run.get('law', 'linear')]})",
        "contact filter": "none",
        "mesh": "the meshed rail",
        "time step": f"{_step(answer, advice)}, {answer.steps} steps",
        "cost": (
            f"about {number(answer.seconds, 2)} s, {answer.dofs} dofs; surface contact takes "
            f"about {number(advice.reference_seconds, 2)} s"
        ),
    }
    if advice.patch > 0.0:
        rows["contact filter"] = f"patch: mean over about {_length(advice.patch)}"
    if "elements_per_bay" in run:
        rows["mesh"] = f"{run['elements_per_bay']} elements a bay"
    own = f" on {advice.samples[0]}" if advice.samples else ""
    rows["error"] = f"{_percent(answer.error)}{own}"
    if answer.expected is not None and answer.limit is not None:
        rows["error expected"] = (
            f"{_percent(answer.expected)} on the mean sample, below {_percent(answer.limit)} on "
            f"{_percent(CONFIDENCE)} of them"
        )
    if answer.proof is not None:
        rows["error proven"] = f"{_percent(answer.proof)} on {advice.samples[1]}"
    for name, text in rows.items():
        table.add_row(name, text)
    return table


def _front(advice: Advice) -> Table:
    table = Table(box=SIMPLE, caption="each is more accurate than all that are cheaper")
    table.title = f"relative L2 error of {MEASURES[advice.measure][1]}"
    table.add_column("scheme")
    for heading in ("elements a bay", "time step", "seconds", "error", "limit"):
        table.add_column(heading, justify="right", no_wrap=True)
    for tried in front(advice):
        mark = " <-" if tried is advice.answer else ""
        table.add_row(
            tried.scheme.words,
            str(tried.scheme.table.get("elements_per_bay", "")),
            _step(tried, advice),
            number(tried.seconds, 2),
            _percent(tried.error) + mark,
            "" if tried.limit is None else _percent(tried.limit),
        )
    return table


def front(advice: Advice) -> list[Tried]:
    """The schemes that are more accurate than every cheaper one, from the cheapest; the answer."""
    found: list[Tried] = []
    for tried in advice.tried:
        better = not found or tried.error < found[-1].error
        if (better and tried.error == tried.error) or tried is advice.answer:
            found.append(tried)
    return found


def _step(tried: Tried, advice: Advice) -> str:
    return str(tried.scheme.table.get("time_step", f"{number(1e6 * advice.time_step, 4)} us"))


def _percent(share: float) -> str:
    return f"{number(100.0 * share, 2)} %"


def _length(metres: float) -> str:
    return f"{number(1e3 * metres, 3)} mm" if metres < 1.0 else f"{number(metres, 3)} m"


def ranges() -> list[str]:
    """What random studies are drawn from, a line a key."""
    lists = [f"{key}: {', '.join(map(_choice, choices))}" for key, choices in LISTS.items()]
    return lists + [
        f"{key}: {low:g} to {high:g} {unit}, logarithmic"
        for key, (unit, low, high) in RANGES.items()
    ]


def told(draw: Draw) -> str:
    """What became of a random study, in one line."""
    irregularity, journey = draw.values["irregularity"], draw.values["journey"]
    text = (
        f"{draw.number}: {irregularity['spectrum']} from "
        f"{_length(2.0 * pi / irregularity['band'][1])} on, {3.6 * journey['speed']:.0f} km/h, "
        f"{_percent(draw.bound)}: "
    )
    if draw.failure:
        return f"{text}failed: {draw.failure}"
    assert draw.advice is not None
    answer = draw.advice.answer
    if answer is None:
        return f"{text}no point scheme"
    limit = f", limit {_percent(answer.limit)}" if answer.limit is not None else ""
    held = "held" if draw.held else "NOT HELD"
    return f"{text}{answer.name}{limit}; on another sample {_percent(draw.error)}: {held}"


def _choice(value: object) -> str:
    return _percent(value) if isinstance(value, float) else str(value)
