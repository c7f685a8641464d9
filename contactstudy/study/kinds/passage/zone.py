"""Fine meshes that grow: a run whose patch outgrows its zone is repeated on a larger one."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from typing import Any, TypeVar

from contactstudy.exceptions import InputError
from contactstudy.geometry.points import EDGE_KEYS, EdgeReachedError
from contactstudy.solids.wheel_recipe import LARGEST_ZONE
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.validation.definition import parameter

GROWTH = 1.5
"""By how much a zone grows each time."""
Made = TypeVar("Made")


def on_large_enough(study: Study, compute: Callable[[Study], Made]) -> Made:
    """What `compute` makes of the study, with the zone of its wheel as large as the patch needs.

    A zone that the study gives is left as it is.

    Raises
    ------
    NumericalError
        If the patch reaches the edge of the zone given, or of the largest that can be meshed.
    """
    chosen = {key for key in EDGE_KEYS.values() if _chosen(study.solid, key)}
    reached: EdgeReachedError | None = None
    while True:
        try:
            return compute(study)
        except EdgeReachedError as error:
            reached = error
            study = _wider(study, error, chosen)
        except InputError as error:  # so large a zone does not fit the bodies
            raise reached or error from None


def _wider(study: Study, error: EdgeReachedError, chosen: Collection[str]) -> Study:
    """The study with a larger zone in the way that was too small; raises the error if it cannot."""
    key = EDGE_KEYS[error.way]
    size, most = getattr(study.solid, key), LARGEST_ZONE[key]
    if key in chosen or size >= most:
        raise error
    try:
        grown: dict[str, Any] = {key: min(GROWTH * size, most)}
        return replace(study, solid=replace(study.solid, **grown))
    except InputError:
        raise error from None


def _chosen(solid: Solid, key: str) -> bool:
    by = parameter(Solid, key).by
    assert by is not None
    return bool(getattr(solid, key) != by.defaults[solid.section])
