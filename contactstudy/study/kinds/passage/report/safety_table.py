"""Table of the wheel forces of a passage beside the limits of EN 14363."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from contactstudy.compare.running_safety import (
    QUOTIENT,
    UNLOADING,
    track_shift_limit,
    wheel_force_limit,
)
from contactstudy.plot.text import label, number
from contactstudy.report.blocks import Block, table
from contactstudy.study.results import StudyResults

_NOTE = (
    "In brackets the wheelset, counted from the front. As computed: all frequencies that the time "
    "step lets through. Up to 20 Hz{}: as EN 14363 takes them, but the largest value of this one "
    "passage instead of the percentile of many sections of track. Unloading is up to 20 Hz too. "
    "Limits of EN 14363: "
)
_LATERAL = (
    ", and Y/Q outwards and ΣY as means over 2 m of it (Y is that of linear springs, without "
    "flange and creep)"
)


def safety_table(results: StudyResults) -> list[Block]:
    """Of each run the worst wheel; nothing without wheels that feel the rail of a bridge."""
    found = results.metrics.get("wheel_forces", {})
    if not found:
        return []
    lateral = any("quotient" in one for one in found.values())
    columns = ["Run", "Q, least (kN)", "largest (kN)", "up to 20 Hz (kN)", "Unloading (%)"]
    columns += ["Y (kN)", "Y/Q", "ΣY (kN)"] if lateral else []
    rows = [_row(results, name, one, lateral) for name, one in found.items()]
    note = _NOTE.format(_LATERAL if lateral else "") + _limits(results, next(iter(found)), lateral)
    return [table(columns, rows, "Wheel forces.", 1, note)]


def _row(results: StudyResults, name: str, one: dict[str, Any], lateral: bool) -> list[str]:
    run = results.runs[name]
    each = _wheels_a_set(run)
    least = [-value for value in one["smallest_q"]]
    cells = [
        label(name),
        _worst(least, -1e-3, each),
        _worst(one["largest_q"], 1e-3, each),
        _worst(one["filtered_q"], 1e-3, each),
        _worst(one["unloading"], 100.0, each),
    ]
    if lateral:
        cells += [
            _worst(one.get("largest_y"), 1e-3, each),
            _worst(one.get("quotient"), 1.0, each),
            _worst(one.get("track_shift"), 1e-3, 1),
        ]
    return cells


def _worst(values: Sequence[float] | None, factor: float, each: int) -> str:
    if not values:
        return "–"
    k = int(np.argmax(values))
    return f"{number(factor * values[k], 3)} ({k // each + 1})"


def _wheels_a_set(run: Any) -> int:
    """Wheels at the same place: 2 on two rails, 1 on one."""
    x = np.atleast_2d(run["position"].values)[:, 0]
    return 2 if len(x) > 1 and abs(x[1] - x[0]) < 1e-9 else 1


def _limits(results: StudyResults, name: str, lateral: bool) -> str:
    run, speed = results.runs[name], float(results.config["journey"]["speed"])
    static = np.asarray(run.attrs["static_load"], dtype=float)
    told = [
        f"Q at most {number(1e-3 * wheel_force_limit(float(static.min()), speed), 3)} kN up to "
        f"20 Hz; unloading at most {100 * UNLOADING:g} %, stated for twisted track at rest or at "
        "low speed"
    ]
    if lateral:
        shift = track_shift_limit(2.0 * float(static.min()))
        told += [f"Y/Q at most {QUOTIENT:g}", f"ΣY at most {number(1e-3 * shift, 3)} kN"]
    return "; ".join(told) + ", of the lightest axle."
