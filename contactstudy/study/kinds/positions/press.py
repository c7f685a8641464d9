"""One press of one wheel at one position of a study."""

from __future__ import annotations

from typing import Any

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.executor import Progress
from contactstudy.geometry.wheelset import Side
from contactstudy.halfspace.patches import press_wheel
from contactstudy.study.kind import Inputs, Work
from contactstudy.study.kinds.positions.check import names, roll_of
from contactstudy.study.kinds.positions.table import PositionsStudy

# name -> unit, meaning
VARIABLES = {
    "lateral": ("m", "lateral shift of the wheelset, to the right"),
    "yaw": ("rad", "yaw of the wheelset, clockwise seen from above"),
    "roll": ("rad", "roll of the wheelset, right side down"),
    "y": ("m", "contact position on the rail, to the field side"),
    "z": ("m", "contact position, up from the crown"),
    "x": ("m", "centre of pressure ahead of the axle"),
    "wheel_s": ("m", "centre of pressure on the wheel, arc length from the tape circle"),
    "angle": ("rad", "contact angle"),
    "normal_force": ("N", "normal force"),
    "vertical_force": ("N", "vertical force"),
    "approach": ("m", "largest overlap of the undeformed bodies along the normal"),
    "peak_pressure": ("Pa", "peak pressure"),
    "area": ("m^2", "area under pressure"),
    "along": ("m", "semi-axis along, of the ellipse with the pressure's second moments"),
    "across": ("m", "semi-axis across"),
}


def work(study: PositionsStudy, inputs: Inputs) -> list[Work]:
    """A piece a press."""
    table = inputs.config["positions"]
    shared = {k: v for k, v in table.items() if k not in ("wheels", "lateral", "yaw", "roll")}
    return [
        Work(name, [side, study.positions[k], shared], _place(study, side, k), "positions")
        for name, (side, k) in names(study).items()
    ]


def _place(study: PositionsStudy, side: Side, k: int) -> str:
    """What messages call the press at position k."""
    shift, yaw, _ = study.positions[k]
    return f"{side} wheel at {1e3 * shift:g} mm and {1e3 * yaw:g} mrad"


def press_one(
    study: PositionsStudy, name: str, progress: Progress | None = None
) -> list[dict[str, Any]]:
    """Press one wheel at one position.

    Its name is one of `names`; progress is not called: a press has no steps.

    Returns
    -------
    list of dict
        A contact patch each, by falling force: ``wheel``, ``position``, ``patch`` and `VARIABLES`.

    Raises
    ------
    NumericalError or InputError
        If it cannot be pressed, with its place.
    """
    side, k = names(study)[name]
    shift, yaw, _ = study.positions[k]
    table, wheelset, turned = study.table, study.wheelset, roll_of(study, k)
    where = _place(study, side, k)
    try:
        placed = wheelset.geometry(side, shift, yaw, turned)
        press = press_wheel(placed, table.load, study.modulus, side=table.cell)
    except InputError as error:
        raise InputError([f"{where}: {problem}" for problem in error.problems]) from error
    except NumericalError as error:
        raise NumericalError(f"{where}: {error}") from error
    rows = []
    for number, p in enumerate(press.patches, start=1):
        row: dict[str, Any] = {"wheel": side, "position": k + 1, "patch": number}
        row |= {"lateral": shift, "yaw": yaw, "roll": turned}
        row |= {"y": p.reference.y - table.origin, "z": p.reference.z, "angle": p.reference.angle}
        rows.append(row | {v: float(getattr(p, v)) for v in VARIABLES if v not in row})
    return rows
