"""Whether the positions of a study are possible, found out before any of them is pressed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.geometry.wheelset import SIDES, Side
from contactstudy.halfspace.first_press import first_press
from contactstudy.halfspace.patch_grid import Bodies
from contactstudy.halfspace.patches import JOIN
from contactstudy.reporter import Quiet, Reporter
from contactstudy.study.kinds.passage.wheelset import complaint_of_position, derailed
from contactstudy.study.kinds.positions.table import PositionsStudy
from contactstudy.validation import raise_if


def names(study: PositionsStudy) -> dict[str, tuple[Side, int]]:
    """Name of every press, with its side and the number of its position, in their order."""
    return {
        f"{side}_{k + 1:03d}": (side, k)
        for side in study.table.wheels
        for k in range(len(study.positions))
    }


def roll_of(study: PositionsStudy, k: int) -> float:
    """Roll at position k [rad]: the one given, or that at which both wheels touch.

    Raises
    ------
    NumericalError
        If there is none.
    """
    shift, yaw, roll = study.positions[k]
    return study.wheelset.rest_roll(shift, yaw) if roll is None else roll


def check(study: PositionsStudy, companions: Sequence[Any], reporter: Reporter) -> list[str]:
    """Refuse impossible positions; the number of presses and the expected time."""
    check_positions(study, reporter=reporter)
    presses = len(names(study))
    # a roll at rest is searched for once for both wheels
    seconds = 0.5 * presses + (1.2 * len(study.positions) if study.table.roll == "rest" else 0.0)
    return [f"{presses} presses, expected time about {max(seconds, 1):.0f} s"]


def admit(study: PositionsStudy, asked: Sequence[str], reporter: Reporter) -> None:
    """Find all impossible positions before any is pressed."""
    at = names(study)
    check_positions(study, [at[name] for name in asked], reporter)


def check_positions(
    study: PositionsStudy,
    of: Iterable[tuple[Side, int]] | None = None,
    reporter: Reporter | None = None,
) -> None:
    """Find wheelsets that do not fit, have derailed, or cannot be pressed with the load.

    `of` are the presses that are asked for; all without it.

    Raises
    ------
    InputError
        Listing all of them; the same complaint about several positions once.
    """
    reporter = reporter or Quiet()
    sides_at: dict[int, list[Side]] = {}
    for side, k in names(study).values() if of is None else of:
        sides_at.setdefault(k, []).append(side)
    found: dict[str, list[str]] = {}
    reporter.begin("checks", len(sides_at))
    for done, (k, sides) in enumerate(sides_at.items()):
        reporter.progress("checks", done, len(sides_at))
        for problem in _wrong_at(study, k, sides):
            shift, yaw, _ = study.positions[k]
            where = complaint_of_position("positions.lateral", shift, yaw)
            found.setdefault(problem, []).append(where)
    reporter.end("checks", not found)
    raise_if(
        f"{at[0]}{f' (and at {len(at) - 1} more)' if len(at) > 1 else ''}: {problem}"
        for problem, at in found.items()
    )


def _wrong_at(study: PositionsStudy, k: int, sides: list[Side]) -> list[str]:
    shift, yaw, given = study.positions[k]
    wheelset = study.wheelset
    try:
        roll = roll_of(study, k)
        climbed = derailed(wheelset, SIDES if given is None else tuple(sides), shift, yaw, roll)
    except ContactStudyError as error:
        return _problems(error)
    if climbed:
        return climbed
    problems = []
    for side in sides:
        bodies = Bodies(wheelset.geometry(side, shift, yaw, roll), study.modulus)
        try:
            first_press(bodies, study.table.load, JOIN)
        except ContactStudyError as error:
            problems += [f"{side} wheel: positions.{problem}" for problem in _problems(error)]
    return problems


def _problems(error: ContactStudyError) -> list[str]:
    return list(error.problems) if isinstance(error, InputError) else [str(error)]
