"""What a passage prints in the end."""

from rich.box import SIMPLE
from rich.table import Table
from rich.text import Text

from contactstudy.study.results import StudyResults

_CAPTION = "error: relative L2 of the contact force, of the total and of its dynamic part"
_NOTHING = "; a dash where the reference has next to none"


def summary(results: StudyResults) -> list[Table]:
    """What each run cost, and how far it is from the reference."""
    runs, compared = results.metrics["runs"], results.metrics["comparisons"]
    table = Table(title=Text(results.title), box=SIMPLE, collapse_padding=True)
    table.caption = _CAPTION if compared else None
    if any(
        c.get("contact_force", {}).get("relative_l2_dynamic", 0) is None for c in compared.values()
    ):
        table.caption = _CAPTION + _NOTHING
    table.add_column("run", no_wrap=True)
    errors = ("error", "dynamic") if compared else ()
    for heading in ("dofs", "steps", "set-up s", "steps s", "MB", *errors):
        table.add_column(heading, justify="right", no_wrap=True)
    for name, run in runs.items():
        force = compared.get(name, {}).get("contact_force", {})
        norms = (force.get("relative_l2"), force.get("relative_l2_dynamic")) if compared else ()
        table.add_row(
            name,
            str(run["dofs"]),
            str(run["steps"]),
            f"{run['seconds']['setup']:.1f}",
            f"{run['seconds']['stepping']:.1f}",
            "" if run["peak_memory_mb"] is None else f"{run['peak_memory_mb']:.0f}",
            *(_percent(norm, name == results.reference) for norm in norms),
        )
    return [table, *_measured(results)] if runs else []


def _measured(results: StudyResults) -> list[Table]:
    """How each channel of a measured record agrees."""
    found = results.metrics.get("measured", {}).get("runs", {})
    if not found:
        return []
    table = Table(title="against the measured record", box=SIMPLE, collapse_padding=True)
    table.add_column("run", no_wrap=True)
    table.add_column("channel", no_wrap=True)
    for heading in ("correlation", "peaks", "error", "late by ms"):
        table.add_column(heading, justify="right", no_wrap=True)
    told = []
    for name, one in found.items():
        if "failure" in one:
            table.add_row(name, Text(one["failure"]))
            continue
        text = f"{name}: record shifted by {one['shift']:.4f} s, scale {one['scale']:.4g}"
        zeros = [f"{k} {c['zero']:.3g}" for k, c in one["channels"].items() if "zero" in c]
        told.append(text + (f", zeros {', '.join(zeros)}" if zeros else ""))
        for column, channel in one["channels"].items():
            table.add_row(
                name,
                column,
                f"{channel['correlation']:.4f}",
                f"{channel['peak_ratio']:.3f}",
                f"{100 * channel['normalised_error']:.1f} %",
                f"{1e3 * channel['timing']:.1f}",
            )
    table.caption = Text("\n".join(told))
    return [table]


def _percent(value: float | None, reference: bool) -> str:
    if reference:
        return "ref."
    return "–" if value is None else f"{100 * value:.2f} %"
