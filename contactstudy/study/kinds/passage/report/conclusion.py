"""The conclusion: which point model to use, what error to expect, and how sure that is."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from contactstudy.plot.text import exact, label, listing, number
from contactstudy.report.blocks import Block, table, text
from contactstudy.report.quantity import percent, rounded
from contactstudy.study.kinds.passage.report.metrics import between, of_run
from contactstudy.study.kinds.passage.report.reference_error import (
    COMMAND,
    ReferenceError,
    reference_error,
)
from contactstudy.study.kinds.passage.report.tables import describe
from contactstudy.study.results import StudyResults

_FORCE = "contact_force"
_POOR = 0.2
"""Error of the dynamic part from which not even the best model is recommended."""


@dataclass(frozen=True)
class Compared:
    """Errors of a point model's contact force, relative but for `largest` in N.

    Attributes
    ----------
    dofs : int
        Degrees of freedom.
    linear : bool
        Whether its law is linear.
    softer : tuple of float or None
        Part of its k_r, and the error of the dynamic part with that.
    rank : int
        Place among all; the same for those that cannot be told apart.
    """

    name: str
    total: float
    dynamic: float
    largest: float
    dofs: int
    linear: bool
    softer: tuple[float, float] | None
    rank: int = 0


def conclusion(results: StudyResults) -> list[Block]:
    """Paragraphs and a table; nothing where there is nothing to conclude."""
    runs = results.config.get("runs", {})
    reference: Mapping[str, Any] = runs.get(results.reference or "", {})
    if reference.get("solver") != "surface":
        return []
    own, unknown = reference_error(results)
    found = ranked(compared(results), own)
    if not found:
        return []
    told = [_choice(results, found), _certainty(found, own, unknown)]
    said = text(" ".join(s for part in told for s in part))
    return [said, _table(found, own)] if len(found) > 1 else [said]  # which says it all of one


def compared(results: StudyResults) -> list[Compared]:
    """The point models whose dynamic part is compared, the best first."""
    found = []
    for name, run in results.config.get("runs", {}).items():
        errors = between(results, name, _FORCE) if name in results.runs else None
        if run.get("solver") != "point" or not errors:
            continue
        if (dynamic := errors.get("relative_l2_dynamic")) is None:
            continue
        softer = errors.get("softer") or {}
        twin = (float(softer["k_r"]), softer["relative_l2_dynamic"]) if softer else None
        found.append(
            Compared(
                name,
                float(errors["relative_l2"]),
                float(dynamic),
                float(errors["linf"]),
                int(of_run(results, name)["dofs"]),
                run.get("law") == "linear",
                twin,
            )
        )
    return sorted(found, key=lambda one: one.dynamic)


def ranked(found: list[Compared], own: ReferenceError | None) -> list[Compared]:
    """With places: who is within the reference's own error of the best at a place shares it."""
    made = list[Compared]()
    best, rank = -math.inf, 0  # error and place of the first who has the place at hand
    for place, one in enumerate(found, 1):
        if one.dynamic - best > (own.dynamic if own else 0.0):
            best, rank = one.dynamic, place
        made.append(replace(one, rank=rank))
    return made


def simplest_of_the_best(found: list[Compared]) -> Compared:
    """Of those that share the first place a linear one, with the fewest degrees of freedom."""
    best = [one for one in found if one.rank == 1]
    return min(best, key=lambda one: (not one.linear, one.dofs, one.dynamic))


def _choice(results: StudyResults, found: list[Compared]) -> Iterator[str]:
    one = simplest_of_the_best(found)
    rail, contact = describe(results, one.name)
    which = f"“{label(one.name)}” ({rail}; {contact.removeprefix('point, ')})"
    error = (
        f"{percent(one.dynamic)} % of the dynamic part of the contact force ({percent(one.total)} "
        f"% of the total force, at most {number(one.largest * 1e-3)} kN)"
    )
    if one.dynamic > _POOR:
        yield (
            f"None of the point models here can stand in for surface contact: the nearest, "
            f"{which}, is off by {error}."
        )
        return
    yield f"Use the point model {which}. Expect an error of {error}, on an irregularity like this."
    same = [label(o.name) for o in found if o.rank == 1 and o is not one]
    if same:
        verb = "is" if len(same) == 1 else "are"
        yield f"{listing(same)} {verb} as good within what can be told, but not as simple."
    if one.softer is not None:
        part, error_then = one.softer
        yield (
            f"With {exact(100 * (1 - part), 2)} % less k_r its error is "
            f"{rounded(100 * error_then)} instead of {rounded(100 * one.dynamic)} %."
        )


def _certainty(found: list[Compared], own: ReferenceError | None, unknown: str) -> Iterator[str]:
    one = simplest_of_the_best(found)
    if own is None:
        yield (
            f"How large the reference's own discretisation error is here is not known ({unknown}), "
            "so small differences between models may be the reference's."
        )
        return
    yield (
        f"The reference's own discretisation error is {percent(own.dynamic)} % of the dynamic part "
        f"({percent(own.force)} % of the total force), by “{COMMAND}”: models whose errors differ "
        "by less share a place."
    )
    if one.softer is not None and abs(one.softer[1] - one.dynamic) < own.dynamic:
        yield "The change with k_r is smaller than that: these runs do not tell a better k_r."


def _table(found: list[Compared], own: ReferenceError | None) -> Block:
    columns = ["Place", "Point model", "Error (%)"] + ["Reference’s own (%)"] * (own is not None)
    softer = {one.softer[0] for one in found if one.softer is not None}
    if softer:
        less = exact(100 * (1 - softer.pop()), 2)
        columns.append(f"With {less} % less k_r (%)")
    rows = []
    for one in found:
        row = [str(one.rank), label(one.name), percent(one.dynamic, 3)]
        row += [percent(own.dynamic)] if own else []
        if len(columns) > len(row):
            row.append(percent(one.softer[1], 3) if one.softer else "–")
        rows.append(row)
    caption = "Relative L₂ error of the dynamic part of the contact force."
    return table(columns, rows, caption, 2)
