"""Figures of studies with axes: one a quantity and design, of the form that its dimensions ask."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from contactstudy.figures.axes import effects, lines, maps, refined, samples
from contactstudy.plot.drawing import Drawing
from contactstudy.study.axes.effects import too_many
from contactstudy.study.axes.shown import Shown, drawn, shown
from contactstudy.study.kind import find_kind
from contactstudy.study.results import StudyResults

_MAPPED = 3  # keys with a figure a run


def drawings(results: StudyResults) -> list[Drawing]:
    """All that these results can fill; none for a study without axes.

    Of quantities over three keys, a figure a run each, only the first, and none where the kind
    draws them; the others are in the data.
    """
    made, mapped = list[Drawing](), set[str]()
    if results.swept and find_kind(results.kind).draws_grid(results):
        mapped = set(results.designs)
    refinements: dict[str, list[Shown]] = {}
    for quantity in shown(results):
        design = quantity.data.attrs["design"]
        if quantity.data.attrs["refined"]:
            refinements.setdefault(design, []).append(quantity)
            continue
        large = len(_free(quantity)) == _MAPPED
        if not (large and design in mapped):
            made += _of(quantity, lambda key: find_kind(results.kind).marks(results, key))
        mapped |= {design} if large else set()
    made += [one for of_design in refinements.values() for one in refined.drawings(of_design)]
    count, found = Counter[str](), []
    for one in made:  # names of files are distinct
        count[one.name] += 1
        number = f"_{count[one.name]}" if count[one.name] > 1 else ""
        found.append(replace(one, name=one.name + number))
    return found


def _free(quantity: Shown) -> list[str]:
    """Keys that are no samples."""
    return [dim for dim in quantity.axes if not drawn(quantity.data, dim)]


def _of(quantity: Shown, marks: lines.MarksOf) -> list[Drawing]:
    free = _free(quantity)
    if not free:
        return samples.drawings(quantity)
    longer = sorted((quantity.data.sizes[dim] for dim in free), reverse=True)
    if len(free) == 1 or (len(free) == 2 and longer[1] <= lines.FEW):
        return lines.drawings(quantity, free, marks)
    draw = effects.drawings if too_many(quantity, free) else maps.drawings
    return draw(quantity, free)
