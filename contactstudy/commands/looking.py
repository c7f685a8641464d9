"""Commands that look at finished results: one's own figures and tables, and what is different."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from contactstudy.commands.options import Out
from contactstudy.exceptions import ContactStudyError, InputError

Names = tuple[str, ...]


def plot(
    results: Path,
    *,
    out: Out,
    signal: Annotated[
        Names, Parameter(help="Signal, e.g. contact_force; one panel each.", negative="")
    ],
    runs: Annotated[Names, Parameter(help="Runs; all if left out.", negative="")] = (),
    x: Annotated[str, Parameter(help='From where to where, e.g. "10..14" or "10 m..14 m".')] = "",
    over: Annotated[str, Parameter(help="Abscissa, e.g. time; the position if left out.")] = "",
) -> None:
    """Draw signals of finished results (.png, .pdf, .svg), or write them as a table (.csv, SI).

    Parameters
    ----------
    results
        Folder of a study's results.
    out
        File to write; its ending says what.
    """
    from contactstudy.figures.chosen import traces, within, write_traces
    from contactstudy.study.results import read_results

    read = read_results(results)
    found = traces(read, _split(signal), _split(runs), over)
    if x:
        found = within(found, *_span(x, found[0].abscissa_unit))
    write_traces(found, read.reference, out)
    print(out)


def diff(
    first: Path,
    second: Path,
    *,
    tolerance: Annotated[
        float, Parameter(help="Relative difference of numbers and signals that is none.")
    ] = 0.0,
    most: Annotated[int, Parameter(help="Differences of each sort that are shown.")] = 12,
) -> None:
    """Say what is different between two results: keys, norms, signals, versions.

    Exit status 1 when anything is; times and memory do not count.

    Parameters
    ----------
    first, second
        Folders of results.
    """
    from contactstudy.plot.text import counted
    from contactstudy.study.differences import differences, table
    from contactstudy.study.results import read_results
    from contactstudy.study.terminal import console

    if not tolerance >= 0.0:
        raise InputError(f"--tolerance {tolerance:g}: must be at least 0")
    pair = read_results(first), read_results(second)
    found = [d for d in differences(*pair) if d.beyond(tolerance)]
    if not found:
        print("no difference" if not tolerance else f"no difference beyond {tolerance:g}")
        return
    console().print(table(found, str(first), str(second), most))
    raise ContactStudyError(f"{counted(len(found), 'difference')}")


def _split(names: Names) -> list[str]:
    return [part for name in names for part in name.split(",") if part]


def _span(text: str, unit: str) -> tuple[float, float]:
    from contactstudy.units import UnitError, to_si

    low, dots, high = text.partition("..")
    try:
        if not dots:
            raise UnitError('must be FROM..TO, e.g. "10..14"')
        span = to_si(low, unit), to_si(high, unit)
        if not span[0] < span[1]:
            raise UnitError("must go from a smaller to a larger value")
    except UnitError as error:
        raise InputError(f"--x {text}: {error}") from error
    return span
