"""Tables of the errors of all signals against the reference."""

from collections.abc import Mapping
from typing import Any

from contactstudy.compare.bands import share_above
from contactstudy.compare.signals import values
from contactstudy.figures.ladder import IRREGULARITY
from contactstudy.figures.signals import SIGNALS, Signal
from contactstudy.plot.text import label
from contactstudy.report.blocks import Block, table
from contactstudy.report.quantity import fixed, percent, rounded
from contactstudy.study.kinds.passage.report.metrics import between
from contactstudy.study.results import StudyResults

_FASTEST, _FAST = "rail_acceleration", 2e3
"""The signal with most above where beams and meshes of the usual sizes part, and where [Hz]."""
_FIRST = ("L₂ total (%)", "L₂ dynamic (%)")
_LAST = ("Correlation", "Magnitude", "Phase", "Both")


def error_tables(results: StudyResults) -> list[Block]:
    """A table a signal with a row for each run; of one run a table with a row for each signal."""
    found = {
        (signal, name): errors
        for signal in SIGNALS
        for name in results.runs
        if (errors := between(results, name, signal.name)) is not None
    }
    twins = any(IRREGULARITY in errors for errors in found.values())
    first = [*_FIRST, *(["L₂ of irregularity (%)"] if twins else [])]
    against = f"against {label(str(results.reference))}"
    names = list(dict.fromkeys(name for _, name in found))
    if len(names) == 1:
        rows = [
            [f"{signal.label} ({signal.unit})", *_cells(errors, signal, twins)]
            for (signal, _), errors in found.items()
        ]
        columns = ["Signal (unit)", *first, "Largest (unit)", "RMS (unit)", *_LAST]
        caption = f"Errors of {label(names[0])} {against}."
        return [table(columns, rows, caption, note=_note(results)) | {"size": 8}]
    made = []
    for signal in dict.fromkeys(signal for signal, _ in found):
        rows = [
            [label(name), *_cells(errors, signal, twins)]
            for (of, name), errors in found.items()
            if of is signal
        ]
        columns = ["Run", *first, f"Largest ({signal.unit})", f"RMS ({signal.unit})", *_LAST]
        note = _note(results) if signal.name == _FASTEST else ""
        caption = f"{signal.label}: errors {against}."
        made.append(table(columns, rows, caption, note=note) | {"size": 8})
    return made


def _note(results: StudyResults) -> str:
    """That of the rail's acceleration; a ladder has tables of its own that say it."""
    return "" if "rungs" in results.metrics else fast_note(results)


def fast_note(results: StudyResults) -> str:
    """What to think of the rail's acceleration where most of it is fast."""
    top = results.runs[str(results.reference)]
    if _FASTEST not in top:
        return ""
    time_step = float(top["time"][1] - top["time"][0])
    share = share_above(values(top, _FASTEST), time_step, _FAST)
    if share < 0.5:
        return ""
    return (
        f"{rounded(100 * share, 2)} % of the variance of the rail's acceleration in "
        f"{label(str(results.reference))} lies above {_FAST / 1e3:g} kHz. There the spread of the "
        "load over the rail and the length of the elements decide, so that these differences say "
        "little of the force."
    )


def _cells(errors: Mapping[str, Any], signal: Signal, twins: bool) -> list[str]:
    sprague = errors.get("sprague_geers_dynamic", {})
    return [
        percent(errors["relative_l2"], 3),
        percent(errors["relative_l2_dynamic"], 3),
        *([percent(errors.get(IRREGULARITY), 3)] if twins else []),
        rounded(signal.scale * errors["linf"]),
        rounded(signal.scale * errors["rms"]),
        fixed(errors.get("correlation"), 5),
        *(fixed(sprague.get(key), 3) for key in ("M", "P", "C")),
    ]
