"""Print an advice: the answer and its reasons, the schemes worth their cost, the run to copy."""

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from contactstudy.advice.advise import MEASURES, Advice, Tried


def print_advice(advice: Advice, console: Console) -> None:
    """Print all of it."""
    for sentence in advice.sentences():
        console.print(sentence, markup=False, highlight=False)
    table = Table(box=SIMPLE, caption="each is more accurate than all that are cheaper")
    table.add_column("scheme")
    for heading in ("elements a bay", "time step", "dofs x steps", "error"):
        table.add_column(heading, justify="right", no_wrap=True)
    for tried in front(advice):
        run = advice.results.metrics["runs"][tried.name]
        mark = " <-" if tried == advice.answer else ""
        table.add_row(
            tried.scheme.words,
            str(tried.scheme.table.get("elements_per_bay", "")),
            f"{1e6 * run['dt']:.4g} us",
            f"{tried.work:.2g}",
            f"{100 * tried.error:.2g} %{mark}",
        )
    table.title = f"relative L2 error of {MEASURES[advice.measure][1]}"
    console.print(table)
    if advice.answer is not None:
        console.print(advice.answer.scheme.toml(), markup=False, highlight=False)


def front(advice: Advice) -> list[Tried]:
    """The schemes that are more accurate than every cheaper one, from the cheapest."""
    found: list[Tried] = []
    for tried in advice.tried:
        if not found or tried.error < found[-1].error:
            found.append(tried)
    return found
